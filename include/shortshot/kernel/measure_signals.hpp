// shortshot/kernel/measure_signals.hpp: the values of a descriptor's signals, each in a row of the chunk. Most are
// measured while neighbors are located, for they may leave a neighbor out; those that look at nothing but the index,
// after that.
#ifndef SHORTSHOT_KERNEL_MEASURE_SIGNALS_HPP
#define SHORTSHOT_KERNEL_MEASURE_SIGNALS_HPP

#include <cstddef>
#include <cstdint>

#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "../descriptor/signals.hpp"
#include "../descriptor/source_set.hpp"
#include "../search/neighborhood.hpp"
#include "chunk.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Values of signals, for histograms' axes: beyond their ends would be beyond the part's memory.
[[nodiscard]] SHORTSHOT_INLINE simd::F32 cut_off(simd::F32 value) noexcept {
  return simd::max(simd::min(value, simd::all(1.0f)), simd::all(0.0f));
}
/// Signed ones: one point's must not leave the sums' integers.
[[nodiscard]] SHORTSHOT_INLINE simd::F32 cut_off_signed(simd::F32 value) noexcept {
  return simd::max(simd::min(value, simd::all(4.0f)), simd::all(-4.0f));
}

/// False for NaN, and for what is too large to be one. By the bits, which order as numbers do.
[[nodiscard]] SHORTSHOT_INLINE simd::Mask has_value(simd::F32 measured) noexcept {
  return simd::all_int(0x7EE1B1E6) > bits_of(simd::abs(measured));  // 1.5e38f
}

/// Where in its histogram a measured value lies.
template <class Signal>
[[nodiscard]] SHORTSHOT_INLINE simd::F32 place_in_histogram(simd::F32 measured) noexcept {
  if constexpr (Signal::is_signed) return cut_off(Signal::place(measured));
  return measured;
}

/// The values of one signal, given the sources of all.
template <class Signal, class... Kinds, class At, class Sources>
[[nodiscard]] SHORTSHOT_INLINE auto measure(extend::SourceKinds<Kinds...>, const At& at,
                                            const Sources& sources) noexcept {
  return Signal::measure(at, source_of<Kinds>(sources)...);
}

/// What is measured while neighbors are located: those of the Signals that may leave some of them out, or look at where
/// they are.
template <class Signals, class Sources>
struct SignalsOfPlace;
template <class... Signals, class Sources>
struct SignalsOfPlace<SignalList<Signals...>, Sources> {
  using List = SignalList<Signals...>;
  static constexpr int count = ((Signals::reads_index_only ? 0 : 1) + ... + 0);
  const Sources& sources;

  /// Into `values`; takes those without a value out of `described`.
  template <class At>
  SHORTSHOT_INLINE void measure(const At& at, simd::Mask& described, simd::F32* values) const noexcept {
    (measure_one<Signals>(at, described, values[place_in<Signals>(List{})]), ...);
  }
  /// The same values behind the first `size` of a chunk.
  template <class Chunk, class... Packing>
  SHORTSHOT_INLINE void append(Chunk& chunk, std::uint32_t size, const simd::F32* values,
                               const Packing&... packing) const noexcept {
    (append_one<Signals>(chunk, size, values[place_in<Signals>(List{})], packing...), ...);
  }

 private:
  template <class Signal, class At>
  SHORTSHOT_INLINE void measure_one(const At& at, simd::Mask& described, simd::F32& value) const noexcept {
    if constexpr (!Signal::reads_index_only) {
      const simd::F32 measured = detail::measure<Signal>(typename Signal::Sources{}, at, sources);
      described = described & has_value(measured);
      // NaN goes no further: to compare it is an invalid operation. (One lane at a time is not appended without a
      // value.)
      value = cut_off(simd::lanes > 1 ? keep(described, measured) : measured);
    }
  }
  template <class Signal, class Chunk, class... Packing>
  SHORTSHOT_INLINE void append_one(Chunk& chunk, std::uint32_t size, simd::F32 value,
                                   const Packing&... packing) const noexcept {
    if constexpr (!Signal::reads_index_only) {
      simd::store(chunk.rows + Chunk::template row_of<Signal> * std::size_t{Chunk::room} + size, value, packing...);
    }
  }
};

/// Where there are none: one type for all descriptors, which so share one locate().
struct NoSignalsOfPlace {
  static constexpr int count = 0;
  template <class At>
  SHORTSHOT_INLINE void measure(const At&, simd::Mask&, simd::F32*) const noexcept {}
  template <class Chunk, class... Packing>
  SHORTSHOT_INLINE void append(Chunk&, std::uint32_t, const simd::F32*, const Packing&...) const noexcept {}
};

template <class Signals, class Sources>
[[nodiscard]] SHORTSHOT_INLINE auto signals_of_place(const Sources& sources) noexcept {
  if constexpr (SignalsOfPlace<Signals, Sources>::count > 0) {
    return SignalsOfPlace<Signals, Sources>{sources};
  } else {
    return NoSignalsOfPlace{};
  }
}

/// One signal that looks at nothing but the index, into its row of a located chunk.
template <class Signal, class Chunk, class Sources>
inline void measure_by_index(const Sources& all, Chunk& chunk) noexcept {
  if constexpr (Signal::reads_index_only) {
    Collector<const Sources> sources = all;
    float* const row = chunk.rows + Chunk::template row_of<Signal> * std::size_t{Chunk::room};
    for (std::uint32_t i = 0; i < chunk.size; i += simd::lanes) {
      const IndicesAt at{chunk.index + i};
      const auto measured = measure<Signal>(typename Signal::Sources{}, at, sources);
      if constexpr (Signal::components == 1) {
        simd::store(row + i, cut_off(measured));
      } else {
        unroll<Signal::components>(
            [&](auto k) { simd::store(row + i + k * std::size_t{Chunk::room}, cut_off_signed(measured.of[k])); });
      }
    }
  }
}

template <class... Signals, class Chunk, class Sources>
inline void measure_all_by_index(SignalList<Signals...>, const Sources& sources, Chunk& chunk) noexcept {
  (measure_by_index<Signals>(sources, chunk), ...);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_MEASURE_SIGNALS_HPP
