#include "known_arrays.hpp"

#include <algorithm>
#include <map>
#include <type_traits>

#include "shortshot/color/lab.hpp"
#include "shortshot/descriptor/compact.hpp"
#include "shortshot/descriptor/descriptor.hpp"
#include "shortshot/descriptor/signals.hpp"
#include "shortshot/descriptor/spherical_grid.hpp"
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

template <int R, int E, int A>
using Grid = shortshot::SphericalGrid<R, E, A>;

constexpr DescriptorOutput descriptors[] = {
    output_of<shortshot::Ssh<Grid<1, 1, 8>>>("ssh8"),
    output_of<shortshot::Ssh<Grid<2, 2, 4>>>("ssh16"),
    output_of<shortshot::Ssh32>("ssh32"),
    output_of<shortshot::Ssh<Grid<2, 4, 8>>>("ssh64"),
    output_of<shortshot::Ssh96>("ssh96"),
    output_of<shortshot::Ssh<Grid<8, 4, 8>>>("ssh256"),
    output_of<shortshot::Scsh336>("scsh336"),
    output_of<shortshot::Scsh696>("scsh696"),
    output_of<shortshot::Scsh<Grid<2, 2, 8>, Grid<1, 1, 8>, 10>>("scsh_32_8_10"),
    output_of<shortshot::Scsh<Grid<4, 4, 8>, Grid<2, 2, 8>, 30>>("scsh_128_32_30"),
    output_of<shortshot::PclShot352>("shot352"),
    output_of<shortshot::PclCshot1344>("cshot1344"),
    output_of<shortshot::ShapeColor95>("shape_color95"),
    output_of<shortshot::ShapeColor32>("shape_color32"),
    output_of<shortshot::RoomColor95>("room_color95"),
    output_of<shortshot::HeightShape96>("height_shape96"),
    output_of<shortshot::ColorRings27>("color_rings27"),
};

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

std::optional<KnownArray> find_known_array(const std::string& name) {
  static const std::map<std::string, KnownArray> others = {
      {"points", {"<f4", "", {3}, Role::input}},
      {"rgb", {"u1", "points", {3}, Role::input}},
      {"normals", {"<f4", "points", {3}, Role::input}},
      {"keypoints", {"<i4", "", {}, Role::input}},
      {"frames", {"<f4", "keypoints", {3, 3}, Role::input}},
      {"neighbor_count", {"<i4", "keypoints", {}, Role::reference}},
      {"lrf_pcl", {"<f4", "keypoints", {3, 3}, Role::reference}},
      {"lab_pcl", {"<f4", "rgb", {3}, Role::reference}},
      {"lab_authors", {"<f4", "rgb", {3}, Role::reference}},
      {"bshot", {"u1", "keypoints", {44}, Role::reference}},
      {"fpfh33", {"<f4", "keypoints", {33}, Role::later}},
  };
  if (const DescriptorOutput* descriptor = find_descriptor(name)) {
    return KnownArray{"<f4", "keypoints", {static_cast<std::uint64_t>(descriptor->size)}, Role::reference};
  }
  if (const DescriptorOutput* stored = find_nibbles(name)) {
    return KnownArray{"u1", "keypoints", {static_cast<std::uint64_t>(stored->size + 1) / 2}, Role::reference};
  }
  const auto found = others.find(name);
  if (found == others.end()) return std::nullopt;
  return found->second;
}

}  // namespace shortshot_bench::golden
