// shortshot/kernel/finish.hpp: from the integers of all votes to values of L2 norm 1.
#ifndef SHORTSHOT_KERNEL_FINISH_HPP
#define SHORTSHOT_KERNEL_FINISH_HPP

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "../descriptor/descriptor.hpp"
#include "../descriptor/finish_rules.hpp"
#include "../status.hpp"
#include "accumulate.hpp"
#include "accumulate_means.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Integers to floats, in place.
inline void to_floats(float* values, int size) noexcept {
  for (int i = 0; i < size; ++i) values[i] = static_cast<float>(integer_at(values + i));
}

/// Integers (or, of parts that are finished, floats) to floats of L2 norm 1, in place or not. Squares are added up in
/// eight places, whatever the number of lanes: the same order, and so the same bits, from all.
template <bool AreIntegers>
[[nodiscard]] inline Status normalize(const float* from, float* values, int size) noexcept {
  constexpr int lanes = static_cast<int>(simd::lanes);
  const int whole = small_code && lanes == 1 ? 0 : size / 8 * 8;
  simd::F32 squares[8 / lanes] = {};
  for (int i = 0; i < whole; i += 8) {
    each<8 / lanes>([&](auto k) {
      simd::F32 value = simd::load(from + i + k * lanes);
      if constexpr (AreIntegers) {
        value = to_float(bits_of(value));
        simd::store(values + i + k * lanes, value);
      }
      squares[k] = squares[k] + value * value;
    });
  }
  float s[8];
  each<8 / lanes>([&](auto k) { simd::store(s + k * lanes, squares[k]); });
  for (int i = whole; i < size; ++i) {
    if constexpr (AreIntegers) values[i] = static_cast<float>(integer_at(from + i));
    s[i % 8] += unfused(values[i] * values[i]);
  }

  for (std::size_t count = 4; count > 0; count /= 2) {  // neighbors first
    for (std::size_t k = 0; k < count; ++k) s[k] = s[2 * k] + s[2 * k + 1];
  }
  if (!(s[0] > 0.0f)) return Status::too_few_neighbors;
  const float inverse = 1.0f / simd::sqrt(s[0]);
  for (int i = 0; i < whole; i += lanes) simd::store(values + i, simd::load(values + i) * simd::all(inverse));
  for (int i = whole; i < size; ++i) values[i] *= inverse;
  return Status::ok;
}

/// One part's sums to its values: means by their cells' votes, then as its rule says.
template <class Part>
inline void finish_part(float* values, [[maybe_unused]] float* weights) noexcept {
  if constexpr (Part::weight_cells > 0) divide_by_votes<Part>(values, weights);
  if constexpr (!std::is_same<typename Part::Finish, PlainSums>::value) Part::Finish::apply(values, Part::size);
}

/// All parts'; `sums` are the values themselves, unless all are plain; `weights`, the sums of votes of parts with
/// means.
template <class Voting, class... Parts, std::size_t... I>
[[nodiscard]] inline Status finish(Descriptor<Voting, Parts...>, std::index_sequence<I...>, const float* sums,
                                   float* values, [[maybe_unused]] float* weights) noexcept {
  using D = Descriptor<Voting, Parts...>;
  if constexpr (D::is_plain) {
    return normalize<true>(sums, values, D::size);
  } else {
    to_floats(values, D::size);
    to_floats(weights, D::weight_cells);
    (finish_part<Parts>(values + D::offset(I), weights + D::weight_offset(I)), ...);
    return normalize<false>(values, values, D::size);
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_FINISH_HPP
