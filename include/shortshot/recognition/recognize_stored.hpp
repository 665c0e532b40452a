// shortshot/recognition/recognize_stored.hpp: recognizers of descriptors that are stored smaller: they are trained with
// them, compare and save them as they are. Hosted only: allocates, starts threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <vector>

#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "../store/stored_features.hpp"
#include "codebook.hpp"
#include "descriptor_rows.hpp"
#include "packed_rows.hpp"
#include "recognize.hpp"
#include "recognizer.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// What `use` makes of the rows: of codes or bits as they are, of halves as the floats that they stand for.
template <class Stored, class Use>
[[nodiscard]] Status with_rows(const StoredFeatures<Stored>& features, const Use& use) {
  const bool is_complete = features.descriptors.size() == features.size() &&
                           features.keypoints.size() == features.size() && features.frames.size() == features.size();
  if (!is_complete) return Status::bad_rows;
  if constexpr (std::is_same<typename Storage<Stored>::Value, std::uint16_t>::value) {
    constexpr auto row_size = static_cast<std::size_t>(Stored::size);
    std::vector<float> values(features.size() * row_size);
    for (std::size_t i = 0; i < features.size(); ++i) dequantize(features.descriptors[i], values.data() + i * row_size);
    const DescriptorRows rows{values.data(), features.size(), row_size, features.status.data()};
    return use(PlacedRows<DescriptorRows>{rows, features.keypoints.data(), features.frames.data()});
  } else {
    const auto rows = rows_of(features);
    return use(PlacedRows<std::decay_t<decltype(rows)>>{rows, features.keypoints.data(), features.frames.data()});
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// As for features, with the distances of the storage. What a recognizer is for is a descriptor and its storage, which
/// is said by storage_layout<Stored>(), also to load(): others are other_descriptor. Also bad_rows: vectors that are
/// not as long as each other. Allocates 16 bytes for a codeword, and the stored descriptor (of halves the floats).
template <class Stored>
[[nodiscard]] Status train(Recognizer& recognizer, const StoredFeatures<Stored>& features, const Point& center,
                           std::string_view object_class, std::string_view instance) {
  return detail::with_rows(features, [&](const auto& rows) {
    return detail::train_rows(recognizer, rows, storage_layout<Stored>(), center, object_class, instance);
  });
}
template <class Stored, class Threads = unsigned>
[[nodiscard]] Status recognize(const Recognizer& recognizer, const StoredFeatures<Stored>& features,
                               std::vector<Hypothesis>& out, Threads&& threads = 1u) {
  out.clear();
  return detail::with_rows(features, [&](const auto& rows) {
    return detail::recognize_rows(recognizer, rows, storage_layout<Stored>(), out, threads);
  });
}
template <class Stored, class Threads = unsigned>
[[nodiscard]] Status activation_shares(const Recognizer& recognizer, const StoredFeatures<Stored>& features,
                                       ActivationShares& out, Threads&& threads = 1u) {
  out.classes.clear();
  out.instances.clear();
  return detail::with_rows(features, [&](const auto& rows) {
    return detail::shares_of_rows(recognizer, rows.descriptors, storage_layout<Stored>(), out, threads);
  });
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
