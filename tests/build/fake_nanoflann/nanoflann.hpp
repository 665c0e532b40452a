// A stand-in for nanoflann 1.5 to 1.12, or with FAKE_NANOFLANN_1_4 for 1.4.0 to 1.4.2, which have no flags, build no
// tree by themselves, and call SearchParameters SearchParams: the names and signatures that
// shortshot/search/nanoflann.hpp uses, as they are there (SearchParameters, sort() on the result set, ...), over a
// search that looks at every point. The package that the other tests use is older, and newer ones are not installed
// everywhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#if defined(FAKE_NANOFLANN_1_4)
#define NANOFLANN_VERSION 0x142
#else
#define NANOFLANN_VERSION 0x150
#endif

namespace nanoflann {

#if defined(FAKE_NANOFLANN_1_4)
struct KDTreeSingleIndexAdaptorParams {
  KDTreeSingleIndexAdaptorParams(std::size_t max_leaf = 10) : leaf_max_size(max_leaf) {}
  std::size_t leaf_max_size;
};

struct SearchParams {
  SearchParams(int ignored = 32, float tolerance = 0, bool sort_results = true)
      : checks(ignored), eps(tolerance), sorted(sort_results) {}
  int checks;
  float eps;
  bool sorted;
};
using Search = SearchParams;

inline bool builds_index(const KDTreeSingleIndexAdaptorParams&) { return false; }
#else
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
using Search = SearchParameters;

inline bool builds_index(const KDTreeSingleIndexAdaptorParams& params) {
  return params.flags != KDTreeSingleIndexAdaptorFlags::SkipInitialBuildIndex;
}
#endif

template <class Value, class Points, class DistanceValue = Value, class Index = std::uint32_t>
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
    if (builds_index(params)) buildIndex();
  }

  void buildIndex() { built_ = points_.kdtree_get_point_count(); }

  template <class ResultSet>
  bool findNeighbors(ResultSet& result, const typename Distance::ElementType* query, const Search& params = {}) const {
    static_assert(std::is_same<typename ResultSet::DistanceType, typename Distance::DistanceType>::value, "");
    for (Index i = 0; i < built_; ++i) {
      typename Distance::DistanceType d2 = 0;
      for (std::size_t axis = 0; axis < dimension_; ++axis) {
        const auto difference = query[axis] - points_.kdtree_get_pt(i, axis);
        d2 += difference * difference;
      }
      if (d2 < result.worstDist() && !result.addPoint(d2, i)) return false;
    }
#if defined(FAKE_NANOFLANN_1_4)
    static_cast<void>(params);
#else
    if (params.sorted) result.sort();
#endif
    return result.full();
  }

 private:
  const Points& points_;
  std::size_t dimension_;
  std::size_t built_ = 0;
};

}  // namespace nanoflann
