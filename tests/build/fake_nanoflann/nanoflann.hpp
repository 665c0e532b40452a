// A stand-in for nanoflann 1.5 to 1.12: the names and signatures that shortshot/search/nanoflann.hpp uses, as they are
// there (SearchParameters, sort() on the result set, ...), over a search that looks at every point. The package
// that the other tests use is older, and newer ones are not installed everywhere.
#pragma once

#include <cstddef>
#include <type_traits>

#define NANOFLANN_VERSION 0x150

namespace nanoflann {

enum class KDTreeSingleIndexAdaptorFlags { None = 0, SkipInitialBuildIndex = 1 };

struct KDTreeSingleIndexAdaptorParams {
  KDTreeSingleIndexAdaptorParams(std::size_t max_leaf = 10,
                                 KDTreeSingleIndexAdaptorFlags with_flags = KDTreeSingleIndexAdaptorFlags::None,
                                 unsigned threads = 1)
      : leaf_max_size(max_leaf), flags(with_flags), n_thread_build(threads) {}
  std::size_t leaf_max_size;
  KDTreeSingleIndexAdaptorFlags flags;
  unsigned n_thread_build;
};

struct SearchParameters {
  SearchParameters(float tolerance = 0, bool sort_results = true) : eps(tolerance), sorted(sort_results) {}
  float eps;
  bool sorted;
};

template <class Value, class Points, class DistanceValue = Value, class Index = std::size_t>
struct L2_Simple_Adaptor {
  using ElementType = Value;
  using DistanceType = DistanceValue;
  using IndexType = Index;
};

template <class Distance, class Points, int Dimension, class Index>
class KDTreeSingleIndexAdaptor {
 public:
  template <class... DistanceArguments>
  explicit KDTreeSingleIndexAdaptor(int dimension, const Points& points, const KDTreeSingleIndexAdaptorParams& params,
                                    DistanceArguments&&...)
      : points_(points), dimension_(static_cast<std::size_t>(dimension)) {
    if (params.flags != KDTreeSingleIndexAdaptorFlags::SkipInitialBuildIndex) buildIndex();
  }

  void buildIndex() { built_ = points_.kdtree_get_point_count(); }

  template <class ResultSet>
  bool findNeighbors(ResultSet& result, const typename Distance::ElementType* query,
                     const SearchParameters& params = {}) const {
    static_assert(std::is_same<typename ResultSet::DistanceType, typename Distance::DistanceType>::value, "");
    for (Index i = 0; i < built_; ++i) {
      typename Distance::DistanceType d2 = 0;
      for (std::size_t axis = 0; axis < dimension_; ++axis) {
        const auto difference = query[axis] - points_.kdtree_get_pt(i, axis);
        d2 += difference * difference;
      }
      if (d2 < result.worstDist() && !result.addPoint(d2, i)) return false;
    }
    if (params.sorted) result.sort();
    return result.full();
  }

 private:
  const Points& points_;
  std::size_t dimension_;
  std::size_t built_ = 0;
};

}  // namespace nanoflann
