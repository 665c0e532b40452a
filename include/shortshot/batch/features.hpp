// shortshot/batch/features.hpp: what extract() gives, with the memory that it uses again for the next cloud. Hosted
// only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "../color/lab.hpp"
#include "../color/lab_table.hpp"
#include "../color/packed_lab.hpp"
#include "../config.hpp"
#include "../frame/frame.hpp"
#include "../search/neighborhood.hpp"
#include "../status.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace detail {

/// A workspace that grows: one per thread.
class GrowingWorkspace {
 public:
  [[nodiscard]] Neighborhood neighborhood() noexcept {
    const std::size_t n = index_.size();
    float* p = floats_.data();
    return {p, p + n, p + 2 * n, p + 3 * n, index_.data(), static_cast<std::uint32_t>(n), 0, 0};
  }

  /// A search's gather(); grows until the neighbors fit.
  template <class Search>
  [[nodiscard]] Status gather(const Search& search, const Point& center, Radius radius, Neighborhood& n) {
    n = neighborhood();
    const Status status = search.gather(center, radius, n);
    if (status != Status::too_many_neighbors || n.found > max_neighbors) return status;
    reserve(n.found);
    n = neighborhood();
    return search.gather(center, radius, n);
  }

  /// Room for `neighbors`; half as much again where it has to grow, so that it seldom does.
  void reserve(std::size_t neighbors) {
    if (neighbors <= index_.size()) return;
    const std::size_t capacity = neighbors + neighbors / 2;
    floats_.resize(4 * capacity);
    index_.resize(capacity);
  }

 private:
  std::vector<float> floats_;
  std::vector<std::uint32_t> index_;
};

}  // namespace detail

/// What extract() gives: one row per key point, in their order. Keep it from frame to frame and its memory is reused.
/// `Color` is how a cloud's colors are kept meanwhile: Lab, 12 bytes a point, or PackedLab, 4 bytes a point and less
/// exact.
template <class D, class Color = Lab>
struct Features {
  static_assert(std::is_same<Color, Lab>::value || std::is_same<Color, PackedLab>::value,
                "Features<D, Color> supports Lab and PackedLab");

  std::vector<float> values;             ///< size() * D::size, row by row; zeros where the status is not ok
  std::vector<Status> status;            ///< one per key point
  std::vector<Frame> frames;             ///< the local reference frame of each; zeros where the status is not ok
  std::vector<std::uint32_t> neighbors;  ///< found within the larger radius, the key point itself included

  [[nodiscard]] std::size_t size() const noexcept { return status.size(); }
  [[nodiscard]] const float* operator[](std::size_t row) const noexcept {
    return values.data() + row * static_cast<std::size_t>(D::size);
  }

  struct {
    LabTable<typename D::LabRule> to_lab;
    std::vector<Color> lab;                            // the cloud's colors
    std::vector<detail::GrowingWorkspace> workspaces;  // one per thread
    std::size_t leveled_for = 0;                       // neighbors that each of them has had room made for
  } scratch;                                           ///< extract()'s own; nothing to read there
};

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
