// shortshot/recognition/packed_panels.hpp: packed rows where compare_packed.hpp wants them: those of a database as
// codes one after the other, queries side by side in panels. Hosted only: allocates.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../base/simd.hpp"
#include "../base/simd_sums.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "compare_rows.hpp"
#include "row_codes.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Rows of the database that meet a panel at the same time, and registers of sums for each: few enough for the
/// registers that there are, many enough for each load to serve several.
inline constexpr std::size_t packed_tile = 4;
inline constexpr std::size_t packed_sums = 2;

/// All rows of a database as codes.
template <class Rows>
class PackedDatabase {
 public:
  using Format = CodesOf<Rows>;
  using Code = typename Format::Code;
  static constexpr std::size_t chunk_codes = Format::chunk_steps * Format::Ops::step_codes;

  explicit PackedDatabase(const Rows& rows)
      : codes_(rows), values_(rows.count * codes_.codes()), norms_(rows.count * codes_.chunks()) {
    for (std::size_t i = 0; i < rows.count; ++i) {
      codes_.encode(rows, i, values_.data() + i * row_codes(), norms_.data() + i * chunks());
    }
  }
  [[nodiscard]] const RowCodes<Rows>& codes() const noexcept { return codes_; }
  [[nodiscard]] std::size_t row_codes() const noexcept { return codes_.codes(); }
  [[nodiscard]] std::size_t chunks() const noexcept { return codes_.chunks(); }
  [[nodiscard]] std::size_t chunk_steps(std::size_t chunk) const noexcept {
    return std::min(Format::chunk_steps, codes_.steps() - chunk * Format::chunk_steps);
  }
  /// The codes of a row in a chunk.
  [[nodiscard]] const Code* at(std::size_t row, std::size_t chunk) const noexcept {
    return values_.data() + row * row_codes() + chunk * chunk_codes;
  }
  [[nodiscard]] std::uint32_t norm(std::size_t row, std::size_t chunk) const noexcept {
    return norms_[row * chunks() + chunk];
  }

 private:
  RowCodes<Rows> codes_;
  std::vector<Code> values_;
  std::vector<std::uint32_t> norms_;
};

/// The sums of a panel and one row.
template <class Ops>
struct PanelSums {
  typename Ops::Sums of[packed_sums];
};

/// Some queries side by side. Lanes without a query have codes 0.
template <class Rows>
class Panel {
 public:
  using Format = CodesOf<Rows>;
  using Ops = typename Format::Ops;
  using Code = typename Ops::Code;
  static constexpr std::size_t rows = packed_sums * Ops::rows;
  static constexpr std::size_t registers = rows / simd::lanes;
  static constexpr std::size_t step_cells = packed_sums * Ops::step_cells;
  static_assert(query_block % rows == 0, "whole panels");

  explicit Panel(const RowCodes<Rows>& codes)
      : codes_(&codes), cells_(codes.steps() * step_cells), norms_(codes.chunks() * rows), limits_(rows), all_(rows) {}

  void pack(const Rows& queries, std::size_t first) {
    std::vector<Code> row_codes(rows * codes_->codes());
    std::vector<std::uint32_t> row_norms(codes_->chunks());
    std::fill(norms_.begin(), norms_.end(), 0u);
    for (std::size_t k = 0; k < rows && first + k < queries.count; ++k) {
      std::fill(row_norms.begin(), row_norms.end(), 0u);
      codes_->encode(queries, first + k, row_codes.data() + k * codes_->codes(), row_norms.data());
      for (std::size_t c = 0; c < row_norms.size(); ++c) norms_[c * rows + k] = row_norms[c];
    }
    for (std::size_t step = 0; step < codes_->steps(); ++step) {
      for (std::size_t s = 0; s < packed_sums; ++s) {
        const Code* of_rows[Ops::rows];
        for (std::size_t k = 0; k < Ops::rows; ++k) {
          of_rows[k] = row_codes.data() + (s * Ops::rows + k) * codes_->codes() + step * Ops::step_codes;
        }
        Ops::pack(of_rows, cells_.data() + step * step_cells + s * Ops::step_cells);
      }
    }
  }
  /// To what the distance of one of the queries is to be below.
  void set_limit(std::size_t k, std::uint32_t limit) noexcept {
    limits_[k] = Format::query_limit(norms_[k], limit);
    all_[k] = Format::no_query_limit(norms_[k]);
  }
  /// May any of the queries be nearer to a row than its limit, or than the row's (0: that does not count), by the sums
  /// of the first chunk?
  [[nodiscard, gnu::always_inline]] bool any_near(const PanelSums<Ops>& sums, std::uint32_t norm,
                                                  std::uint32_t limit) const noexcept {
    return any_near(sums, limits_.data(), Format::no_row_limit(norm)) ||
           (limit > 0 && any_near(sums, all_.data(), Format::row_limit(norm, limit)));
  }
  [[nodiscard]] const typename Ops::Cell* cells(std::size_t chunk) const noexcept {
    return cells_.data() + chunk * Format::chunk_steps * step_cells;
  }
  [[nodiscard]] const std::uint32_t* norms(std::size_t chunk) const noexcept { return norms_.data() + chunk * rows; }

 private:
  using Limit = typename Format::Limit;
  [[nodiscard, gnu::always_inline]] static bool any_near(const PanelSums<Ops>& sums, const Limit* limits,
                                                         Limit of_row) noexcept {
    bool any = false;
    unroll<int{packed_sums}>([&](auto k) { any = any || Ops::any_near(sums.of[k], limits + k * Ops::rows, of_row); });
    return any;
  }

  const RowCodes<Rows>* codes_;
  std::vector<typename Ops::Cell> cells_;
  std::vector<std::uint32_t> norms_;
  std::vector<Limit> limits_;  // of the queries by themselves,
  std::vector<Limit> all_;     // and if only the row's counts
};

/// Some steps of a panel and of a tile of rows, from these codes on.
template <class Ops>
[[gnu::noinline]] void sum_up(const typename Ops::Cell* cells, const typename Ops::Code* const (&codes)[packed_tile],
                              std::size_t steps, PanelSums<Ops> (&out)[packed_tile]) noexcept {
  constexpr int tile = packed_tile;
  constexpr int width = packed_sums;
  typename Ops::Sums sums[packed_tile][packed_sums];
  const typename Ops::Code* row[packed_tile];
  unroll<tile>([&](auto r) {
    row[r] = codes[r];
    unroll<width>([&](auto k) { sums[r][k] = Ops::none(); });
  });
  for (std::size_t step = 0; step < steps; ++step) {
    unroll<tile>([&](auto r) SHORTSHOT_INLINE_LAMBDA {
      unroll<width>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
        sums[r][k] = Ops::add(sums[r][k], cells + k * Ops::step_cells, row[r] + step * Ops::step_codes);
      });
    });
    cells += packed_sums * Ops::step_cells;
  }
  unroll<tile>([&](auto r) { unroll<width>([&](auto k) { out[r].of[k] = sums[r][k]; }); });
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
