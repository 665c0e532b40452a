#include "descriptors.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <type_traits>

#include "named_descriptors.hpp"
#include "shortshot/color/lab.hpp"
#include "shortshot/descriptor/signals.hpp"
#include "shortshot/descriptor/voting.hpp"
#include "shortshot/kernel/describe.hpp"
#include "shortshot/store/coded.hpp"

namespace shortshot_bench::golden {
namespace {

template <class D>
shortshot::Status describe_by(const shortshot::Neighborhood& n, const shortshot::CloudView& cloud,
                              shortshot::Rgb key_color, const shortshot::Frame& frame, shortshot::Radius radius,
                              float* out) {
  const shortshot::CloudNormals normals{cloud};
  if constexpr (D::needs_colors) {
    using Rule = typename D::LabRule;
    const shortshot::RgbColors<Rule> colors{cloud, key_color};
    return shortshot::describe<D>(n, shortshot::sources(colors, normals), frame, radius, out);
  } else {
    return shortshot::describe<D>(n, normals, frame, radius, out);
  }
}

template <class D>
void to_nibbles(const float* row, std::uint8_t* out) {
  shortshot::NibbleDescriptor<D> nibbles;
  shortshot::quantize(row, nibbles);
  std::copy_n(nibbles.bytes, sizeof nibbles.bytes, out);
}

template <class D>
constexpr Sharing sharing_of = std::is_same_v<typename D::Voting, shortshot::MultilinearVoting> ? Sharing::continuous
                               : std::is_same_v<typename D::Voting, shortshot::PclVoting>       ? Sharing::shot
                                                                                                : Sharing::published;

template <class Signal>
constexpr bool is_of_colors = false;
template <int Bins, class Rule, class Reference>
constexpr bool is_of_colors<shortshot::ColorDistance<Bins, Rule, Reference>> = true;

template <class Part>
Histogram histogram_of() {
  using Grid = typename Part::Grid;
  int bins = 0;
  if constexpr (Part::has_histogram) bins = Part::Signal::bins;
  return {Grid::radial, Grid::elevation, Grid::azimuth, bins, is_of_colors<typename Part::Signal>};
}

template <class Voting, class... Parts>
std::vector<Histogram> histograms_of(const shortshot::Descriptor<Voting, Parts...>&) {
  if constexpr (std::is_same_v<Voting, shortshot::MultilinearVoting>)
    return {};
  else
    return {histogram_of<Parts>()...};
}

// Sums of votes are off by what their rounding is. Roots of them are more: the slope of a root grows without limit
// towards 0, and a share that should be 0 but is 1e-8 has a root of 1e-4.
template <class D>
constexpr double row_l2_of = D::is_plain ? 1e-5 : 1e-4;

template <class D>
constexpr DescriptorOutput output_of(const char* name) {
  return {name,
          D::size,
          D::needs_colors,
          D::needs_normals,
          row_l2_of<D>,
          sharing_of<D>,
          [] { return histograms_of(D{}); },
          describe_by<D>,
          static_cast<double>(shortshot::code_scale<D, 4>),
          to_nibbles<D>};
}

constexpr auto descriptors =
    std::apply([](auto... named) { return std::array{output_of<typename decltype(named)::Descriptor>(named.name)...}; },
               named_descriptors);

}  // namespace

const DescriptorOutput* find_descriptor(const std::string& name) {
  for (const DescriptorOutput& descriptor : descriptors) {
    if (name == descriptor.name) return &descriptor;
  }
  return nullptr;
}

const DescriptorOutput* find_nibbles(const std::string& name) {
  const std::string suffix = "_nibbles";
  if (name.size() < suffix.size() || name.compare(name.size() - suffix.size(), suffix.size(), suffix) != 0) {
    return nullptr;
  }
  return find_descriptor(name.substr(0, name.size() - suffix.size()));
}

}  // namespace shortshot_bench::golden
