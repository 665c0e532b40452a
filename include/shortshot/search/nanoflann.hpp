// shortshot/search/nanoflann.hpp: neighbors from nanoflann's k-d tree. Hosted only: building it allocates, and may
// throw std::bad_alloc. A leaf: nothing else in the library includes it. Written for what nanoflann 1.4.0
// to 1.12 have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <nanoflann.hpp>
#include <vector>

#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "neighborhood.hpp"
#include "offer.hpp"
#include "radius.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The valid points of a cloud, as nanoflann wants to see them: NaN would spoil the tree.
struct NanoflannCloud {
  CloudView cloud;
  std::vector<std::uint32_t> valid;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return valid.size(); }
  [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return coordinate(point(cloud, valid[i]), axis);
  }
  template <class BoundingBox>
  bool kdtree_get_bbox(BoundingBox&) const {
    return false;
  }
};

/// Parameters of a tree that buildIndex() builds. From 1.4.3 on constructors do it unless they are told not to, by
/// flags that did not exist before.
template <class Parameters>
[[nodiscard]] auto not_built_yet(std::size_t leaf_size, int) -> decltype(Parameters().flags, Parameters()) {
  Parameters parameters(leaf_size);
  parameters.flags = decltype(parameters.flags)::SkipInitialBuildIndex;
  return parameters;
}
template <class Parameters>
[[nodiscard]] Parameters not_built_yet(std::size_t leaf_size, long) {
  return Parameters(leaf_size);
}

/// A nanoflann result set that passes candidates straight on to a neighborhood: queries allocate nothing, and whether
/// a candidate is a neighbor is decided by the same rule, in the same arithmetic, as in every other search.
template <class Neighbors>
class NanoflannSink {
 public:
  using DistanceType = float;
  using IndexType = std::uint32_t;

  NanoflannSink(const NanoflannCloud& points, const Point& center, Radius radius, Neighbors& out)
      : points_(points), center_(center), radius_(radius), worst_(worst_of(radius)), out_(out) {}

  bool addPoint(float, std::uint32_t i) {
    const std::uint32_t index = points_.valid[i];
    offer(out_, point(points_.cloud, index), index, center_, radius_.squared);
    return true;
  }
  [[nodiscard]] float worstDist() const { return worst_; }
  [[nodiscard]] std::size_t size() const { return out_.size; }
  [[nodiscard]] bool empty() const { return out_.size == 0; }
  [[nodiscard]] bool full() const { return true; }
  void sort() {}

 private:
  /// A little more than the radius, so that the tree's own rounding loses nobody on the rim. The tree adds up to three
  /// such numbers: where they may leave float's range, it is to look everywhere.
  [[nodiscard]] static float worst_of(Radius radius) {
    return radius.squared < 0.25f * std::numeric_limits<float>::max() ? radius.squared * 1.00001f
                                                                      : std::numeric_limits<float>::infinity();
  }

  const NanoflannCloud& points_;
  Point center_;
  Radius radius_;
  float worst_;
  Neighbors& out_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A k-d tree over a cloud; a search (see search.hpp). The cloud must outlive it. Queries are thread-safe.
class NanoflannSearch {
 public:
  /// Builds the tree: O(n log n), allocates. `leaf_size` is the most points in a leaf. An empty or bad view gives a
  /// search that finds nothing; status() says why.
  explicit NanoflannSearch(const CloudView& cloud, std::size_t leaf_size = 10)
      : points_{cloud, valid_points(cloud)},
        tree_(3, points_, detail::not_built_yet<nanoflann::KDTreeSingleIndexAdaptorParams>(leaf_size, 0)) {
    if (!points_.valid.empty()) tree_.buildIndex();
  }
  NanoflannSearch(const NanoflannSearch&) = delete;  // the tree refers to points_
  NanoflannSearch& operator=(const NanoflannSearch&) = delete;

  /// ok, empty_cloud (no valid point), or why the cloud cannot be read.
  [[nodiscard]] Status status() const noexcept {
    const Status usable = validate(points_.cloud);
    return usable == Status::ok && points_.valid.empty() ? Status::empty_cloud : usable;
  }

  /// Points of the cloud, valid or not.
  [[nodiscard]] std::size_t cloud_size() const noexcept { return points_.cloud.size; }

  /// The points of the cloud within `radius` of `center`, into an empty neighborhood `out`: ok, too_many_neighbors, or
  /// status(). Allocates nothing; reentrant.
  template <class Neighbors>
  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighbors& out) const noexcept {
    extend::clear(out, center);
    if (status() != Status::ok) return status();
    if (!is_finite(center)) return Status::ok;
    detail::NanoflannSink<Neighbors> sink(points_, center, radius, out);
    const float query[3] = {center.x, center.y, center.z};
    tree_.findNeighbors(sink, query, {});  // {}: SearchParams up to 1.4, SearchParameters from 1.5 on
    return extend::outcome(out);
  }

 private:
  using Distance = nanoflann::L2_Simple_Adaptor<float, detail::NanoflannCloud, float>;
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<Distance, detail::NanoflannCloud, 3, std::uint32_t>;

  [[nodiscard]] static std::vector<std::uint32_t> valid_points(const CloudView& cloud) {
    std::vector<std::uint32_t> valid;
    if (validate(cloud) != Status::ok) return valid;
    valid.reserve(cloud.size);
    extend::for_each_valid(cloud, [&](std::size_t i, const Point&) { valid.push_back(static_cast<std::uint32_t>(i)); });
    return valid;
  }

  detail::NanoflannCloud points_;
  Tree tree_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
