// shortshot/kernel/soft_cells.hpp: soft votes where there is one lane: each to its cell. For speed every part has code
// of its own; where code shall be small all of them share one loop over tables. The same bits.
#ifndef SHORTSHOT_KERNEL_SOFT_CELLS_HPP
#define SHORTSHOT_KERNEL_SOFT_CELLS_HPP

#include <cstddef>
#include <cstdint>
#include <utility>

#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "../descriptor/descriptor.hpp"
#include "accumulate.hpp"
#include "soft_layout.hpp"
#include "soft_shares.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Votes of a point for part `I` of a descriptor: to `weights`, the sums of cells' votes, and to `values`.
template <class D, std::size_t I, class Part>
struct CellVotes : SoftShares<D, I, Part> {
  using Shares = SoftShares<D, I, Part>;
  using Shares::layout, Shares::numbers;
  static constexpr int width = numbers > 0 ? Part::values : 1;  ///< values of what strides count

  SHORTSHOT_INLINE void add(const SoftPoints<D>& points, float* weights, float* values) const noexcept {
    std::int32_t first[2] = {0, 0};  // the place of the lowest cell; of the next one around, if there is such an axis
    unroll<layout.count>([&](auto i) {
      constexpr SoftAxis axis = layout.axes[i];
      std::int32_t lower = 0;
      simd::store(&lower, Shares::template between<i>(points).lower);
      first[0] += lower * (axis.stride / width);
      if constexpr (axis.is_around()) first[1] = (lower + 1 == axis.cells ? 1 - axis.cells : 1) * (axis.stride / width);
    });
    first[1] += first[0];
    float* const sums = (numbers > 0 ? weights : values);
    unroll<Shares::count>([&](auto k) {
      constexpr int offset = step(k);
      const std::int32_t place = first[is_around(k) ? 1 : 0];
      add_vote(sums + place + offset, this->template votes<k>());
      if constexpr (numbers > 0) {
        const std::int32_t cell = width * place;
        unroll<numbers - 1>([&](auto number) {
          constexpr int further = width * offset + number;
          add_vote(values + cell + further, this->template votes<k, number + 1>());
        });
      }
    });
  }

 private:
  /// Is cell `k` the upper one around?
  static constexpr bool is_around(int k) noexcept {
    bool around = false;
    for (int n = 0; n < layout.count; ++n)
      around = around || (layout.axes[Shares::axis_of(n)].is_around() && k >> n & 1);
    return around;
  }
  /// From the lowest cell to cell `k` but for the axis that goes around.
  static constexpr int step(int k) noexcept {
    int sum = 0;
    for (int n = 0; n < layout.count; ++n) {
      const SoftAxis axis = layout.axes[Shares::axis_of(n)];
      if (!axis.is_around()) sum += (k >> n & 1) * (axis.stride / width);
    }
    return sum;
  }
};

template <class D, std::size_t I, class Part, class Chunk>
SHORTSHOT_INLINE void add_to_cells(const Chunk& chunk, std::uint32_t i, const SoftPoints<D>& points, float* weights,
                                   float* values) noexcept {
  CellVotes<D, I, Part> votes;
  votes.share(points, chunk, i);
  votes.add(points, weights + D::weight_offset(I), values + D::offset(I));
}

/// A part as small code sees it.
struct SoftTable {
  SoftAxis axes[4];      ///< `stride`: in cells of means, else in values
  std::int16_t count;    ///< of axes
  std::int16_t numbers;  ///< that a cell of means adds up besides its votes
  std::int16_t first;    ///< of these, among a point's coordinates
  std::int16_t weights, values;
};

/// The coordinates of a point: place, then histograms' signals, one for each part, then what means are of.
template <class D>
struct SoftTables {
  SoftTable of[static_cast<std::size_t>(D::parts)];
  int coordinates;
  int most_cells;  ///< that a point votes for in one part

  template <class Part>
  constexpr void add(int part) noexcept {
    constexpr SoftLayout layout = soft_layout<Part>;
    constexpr bool means = Part::weight_cells > 0;
    SoftTable& table = of[part];
    for (int n = 0; n < layout.count; ++n) {
      table.axes[n] = layout.axes[(n + layout.within) % layout.count].of_part(part);
      if (means) table.axes[n].stride = static_cast<std::int16_t>(table.axes[n].stride / Part::values);
    }
    table.count = static_cast<std::int16_t>(layout.count);
    table.numbers = means ? Part::values : 0;
    most_cells = most_cells < 1 << layout.count ? 1 << layout.count : most_cells;
    table.first = static_cast<std::int16_t>(coordinates);
    coordinates += table.numbers;
    table.weights = static_cast<std::int16_t>(D::weight_offset(part));
    table.values = static_cast<std::int16_t>(D::offset(part));
  }
};

template <class Voting, class... Parts>
constexpr auto soft_tables(Descriptor<Voting, Parts...>) noexcept {
  SoftTables<Descriptor<Voting, Parts...>> tables{};
  tables.coordinates = 3 + static_cast<int>(sizeof...(Parts));
  int part = 0;
  (tables.template add<Parts>(part++), ...);
  return tables;
}
template <class D>
inline constexpr auto soft_tables_of = soft_tables(D{});

template <class Part, class Chunk>
inline void measure_for(const Chunk& chunk, std::uint32_t i, simd::F32& signal, simd::F32* numbers) noexcept {
  if constexpr (Part::weight_cells > 0) {
    values_of(typename Part::Averaged{}, chunk, i, numbers);
  } else if constexpr (Part::has_histogram) {
    using Signal = typename Part::Signal;
    signal = soft_place<Signal>(simd::load(chunk.row(Chunk::template row_of<Signal>, i)));
  }
}

/// The votes of a point for one part, to `MostCells` cells or fewer: SoftShares and CellVotes as loops.
template <int MostCells>
inline void add_by_table(const SoftTable& part, const simd::F32* coordinates, float one, float* weights,
                         float* values) noexcept {
  simd::F32 weight[static_cast<std::size_t>(MostCells)];
  std::int16_t place[static_cast<std::size_t>(MostCells)];
  int cells = 1;
  weight[0] = simd::all(one);
  place[0] = 0;
  for (int n = 0; n < part.count; ++n, cells *= 2) {
    const SoftAxis& axis = part.axes[n];
    const Between at = between(coordinates[axis.row], axis);
    std::int32_t lower = 0;
    simd::store(&lower, at.lower);
    const int upper = lower + 1 == axis.cells ? 0 : lower + 1;
    for (int k = 0; k < cells; ++k) {
      weight[cells + k] = weight[k] * at.upper;
      weight[k] = weight[k] - weight[cells + k];
      place[cells + k] = static_cast<std::int16_t>(place[k] + upper * axis.stride);
      place[k] = static_cast<std::int16_t>(place[k] + lower * axis.stride);
    }
  }
  float* const sums = part.numbers > 0 ? weights + part.weights : values + part.values;
  for (int k = 0; k < cells; ++k) {
    add_vote(sums + place[k], truncate_to_int(weight[k]));
    for (int n = 0; n < part.numbers; ++n) {
      add_vote(values + part.values + n + place[k] * part.numbers,
               truncated_product(weight[k], coordinates[part.first + n]));
    }
  }
}

/// One chunk into the cells of all parts.
template <class Voting, class... Parts, std::size_t... I, class Chunk>
[[gnu::noinline]] inline void add_soft_points([[maybe_unused]] Descriptor<Voting, Parts...> descriptor,
                                              std::index_sequence<I...>, const Chunk& chunk, float one, float* weights,
                                              float* values) noexcept {
  using D = Descriptor<Voting, Parts...>;
  const std::uint32_t size = chunk.size;
  for (std::uint32_t i = 0; i < size; ++i) {
    if constexpr (small_code) {
      constexpr const auto& tables = soft_tables_of<D>;
      simd::F32 coordinates[static_cast<std::size_t>(tables.coordinates)];
      for (int k = 0; k < 3; ++k) coordinates[k] = simd::load(chunk.row(k, i));
      (measure_for<Parts>(chunk, i, coordinates[3 + I], coordinates + tables.of[I].first), ...);
      for (const SoftTable& part : tables.of) add_by_table<tables.most_cells>(part, coordinates, one, weights, values);
    } else {
      SoftPoints<D> points;
      points.unit = simd::all(one);
      points.locate(descriptor, chunk, i);
      (add_to_cells<D, I, Parts>(chunk, i, points, weights, values), ...);
    }
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_SOFT_CELLS_HPP
