// shortshot/recognition/half_rows.hpp: borrowed rows of 16-bit floats, which are matched as the floats that they stand
// for. Hosted only: allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../config.hpp"
#include "../status.hpp"
#include "../store/half.hpp"
#include "compare_rows.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// `count` descriptors of `size` halves each, row by row without gaps, as quantize() makes them. Borrowed. Matching
/// makes floats of them, for as long as it lasts: of the queries and of the database.
struct HalfRows {
  const std::uint16_t* values;  ///< count * size
  std::size_t count;            ///< number of rows
  std::size_t size;             ///< halves in a row
  const Status* status;         ///< one per row: those that are not ok are left out; null: all are ok
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// Descriptors as halves, which must outlive the rows; `status` as for codes.
template <class D>
[[nodiscard]] HalfRows rows_of(const std::vector<HalfDescriptor<D>>& descriptors,
                               const Status* status = nullptr) noexcept {
  static_assert(sizeof(HalfDescriptor<D>) == HalfDescriptor<D>::size_bytes, "rows without gaps");
  const auto* const values = reinterpret_cast<const std::uint16_t*>(descriptors.data());
  return {values, descriptors.size(), static_cast<std::size_t>(D::size), status};
}

/// ok or bad_rows, as for rows of floats.
[[nodiscard]] inline Status validate(const HalfRows& rows) noexcept {
  return rows.size > 0 && (rows.count == 0 || rows.values != nullptr) ? Status::ok : Status::bad_rows;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

struct HalvesAsFloats {
  std::vector<float> values;

  explicit HalvesAsFloats(const HalfRows& rows) : values(rows.count * rows.size) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = float_of_half(rows.values[i]);
  }
};

/// Rows of floats that own what they borrow.
class ComparedHalves : private HalvesAsFloats, public ComparedRows {
 public:
  explicit ComparedHalves(const HalfRows& rows)
      : HalvesAsFloats(rows), ComparedRows(DescriptorRows{values.data(), rows.count, rows.size, rows.status}) {}
  ComparedHalves(const ComparedHalves&) = delete;
  ComparedHalves& operator=(const ComparedHalves&) = delete;
};

template <>
struct Comparison<HalfRows> : FloatComparison<HalfRows, ComparedHalves> {};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
