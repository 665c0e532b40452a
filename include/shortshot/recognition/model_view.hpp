// shortshot/recognition/model_view.hpp: what a MicroRecognizer knows: a model that is read where it lies, and what was
// learned since.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "../store/code_distance.hpp"
#include "../store/storage.hpp"
#include "flash_model.hpp"
#include "hypothesis.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A model of one object, and what it and its class are numbered among all.
struct LearnedModel {
  CodewordRun codewords;
  const char* class_name = nullptr;
  const char* instance_name = nullptr;
  std::uint32_t object_class = 0;
  std::uint32_t instance = 0;
};

[[nodiscard]] inline bool same_text(const char* a, const char* b) noexcept {
  while (*a != 0 && *a == *b) ++a, ++b;
  return *a == *b;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A recognizer's model of descriptors in a storage (CodedDescriptor, BinaryDescriptor or SumBits), in memory that is
/// only read and must outlive the view. Nothing is copied, nothing allocated; reentrant.
///
///     ModelView<NibbleDescriptor<ShapeColor95>> model;
///     if (model.open(cups_model, sizeof cups_model) != Status::ok) ...
///     model.instance_name(3);
///
/// One with what was learned on the spot comes from LearnedObjects::model().
template <class Stored>
class ModelView {
 public:
  constexpr ModelView() noexcept = default;
  /// Without a codeword: what all is learned on the spot begins with. Options as validate() has them.
  explicit constexpr ModelView(const RecognizerOptions& options) noexcept : model_(options) {}

  /// What save_for_flash() has written. Takes a look at each byte (some 10 instructions each on a Cortex-M), whatever
  /// they say. Statuses, the first one that applies: not_a_model, other_version, damaged_model, other_descriptor. A
  /// model that was open before stays so.
  [[nodiscard]] Status open(const std::uint8_t* bytes, std::size_t size_bytes) noexcept {
    detail::FlashModel opened;
    const Status status = opened.open(bytes, size_bytes);
    if (status != Status::ok) return status;
    if (!is_of_storage(opened)) return Status::other_descriptor;
    *this = ModelView(opened);
    return Status::ok;
  }

  /// As it was trained; all zeros, and no codewords, before a model is open.
  [[nodiscard]] const RecognizerOptions& options() const noexcept { return model_.options(); }
  [[nodiscard]] std::uint32_t codeword_count() const noexcept { return codewords_; }
  [[nodiscard]] std::uint32_t instance_count() const noexcept { return instances_; }
  [[nodiscard]] std::uint32_t class_count() const noexcept { return classes_; }
  /// For numbers below the counts. Names are looked for from the first one on.
  [[nodiscard]] std::uint32_t class_of(std::uint32_t instance) const noexcept {
    if (instance < model_.instance_count()) return model_.class_of(instance);
    return first_learned([&](const detail::LearnedModel& m) { return m.instance == instance; }).object_class;
  }
  [[nodiscard]] const char* class_name(std::uint32_t object_class) const noexcept {
    if (object_class < model_.class_count()) return model_.class_name(object_class);
    return first_learned([&](const detail::LearnedModel& m) { return m.object_class == object_class; }).class_name;
  }
  [[nodiscard]] const char* instance_name(std::uint32_t instance) const noexcept {
    if (instance < model_.instance_count()) return model_.instance_name(instance);
    return first_learned([&](const detail::LearnedModel& m) { return m.instance == instance; }).instance_name;
  }
  [[nodiscard]] std::uint32_t instance_of(std::uint32_t codeword) const noexcept {
    const Place place = place_of_codeword(codeword);
    return place.learned == nullptr ? place.run.instance_of(place.codeword) : place.learned->instance;
  }
  /// The object's center in the frame of the codeword's key point.
  [[nodiscard]] Point center_of(std::uint32_t codeword) const noexcept {
    const Place place = place_of_codeword(codeword);
    return place.run.center_of(place.codeword);
  }
  /// As it was trained.
  [[nodiscard]] Stored descriptor(std::uint32_t codeword) const noexcept {
    static_assert(alignof(Stored) == 1, "ModelView<Stored> supports storages of bytes");
    const Place place = place_of_codeword(codeword);
    const auto& row = *reinterpret_cast<const Stored*>(place.run.row(place.codeword));
    if (!place.run.is_arranged) return row;
    Stored out{};
    for (std::uint32_t i = 0; i < number_count(); ++i)
      detail::put_number<number_bits>(out.bytes, place_of(i), detail::number_at<number_bits>(row.bytes, i));
    return out;
  }

  /// The order of the trained model's codes or bits: how many there are, and which one of the descriptor number i is.
  /// None: that of the descriptor.
  [[nodiscard]] std::uint32_t number_count() const noexcept { return model_.number_count(); }
  [[nodiscard]] std::uint32_t place_of(std::uint32_t i) const noexcept { return model_.place_of(i); }
  /// A descriptor with its codes or bits in that order, in which those come first that tell most codewords apart.
  [[nodiscard]] Stored arranged(const Stored& stored) const noexcept {
    if (number_count() == 0) return stored;
    Stored out{};
    detail::arrange<number_bits>(stored.bytes, out.bytes, sizeof out.bytes,
                                 [&](std::size_t i) { return place_of(static_cast<std::uint32_t>(i)); });
    return out;
  }

  /// use(first, run) for codewords that lie one behind the other, in ascending order: the number of the first one.
  template <class Use>
  void for_each_run(const Use& use) const noexcept {
    std::uint32_t first = 0;
    for (std::uint32_t part = 0; part <= learned_count_; ++part) {
      const detail::CodewordRun run = run_of(part);
      use(first, run);
      first += run.count;
    }
  }

 private:
  template <class S, class Memory, std::size_t MaxObjects>
  friend class LearnedObjects;

  static constexpr int number_bits = detail::Storage<Stored>::number_bits;

  struct Place {
    detail::CodewordRun run;
    std::uint32_t codeword;  // of the run
    const detail::LearnedModel* learned;
  };

  explicit ModelView(const detail::FlashModel& trained) noexcept
      : model_(trained),
        codewords_(trained.codeword_count()),
        instances_(trained.instance_count()),
        classes_(trained.class_count()) {}

  [[nodiscard]] static bool is_of_storage(const detail::FlashModel& model) noexcept {
    return model.storage() == detail::storage_number<Stored> && model.row_bytes() == sizeof(Stored) &&
           (model.number_bits() == 0 || model.number_bits() == std::uint32_t{number_bits});
  }

  /// The model's own codewords, or those of what was learned.
  [[nodiscard]] detail::CodewordRun run_of(std::uint32_t part) const noexcept {
    return part == 0 ? model_.codewords() : learned_[part - 1].codewords;
  }
  [[nodiscard]] Place place_of_codeword(std::uint32_t codeword) const noexcept {
    std::uint32_t part = 0;
    detail::CodewordRun run = run_of(0);
    for (; codeword >= run.count; run = run_of(++part)) codeword -= run.count;
    return {run, codeword, part == 0 ? nullptr : learned_ + part - 1};
  }
  template <class Condition>
  [[nodiscard]] const detail::LearnedModel& first_learned(const Condition& is_it) const noexcept {
    const detail::LearnedModel* learned = learned_;
    while (!is_it(*learned)) ++learned;
    return *learned;
  }

  /// Makes the next of the learned models one of this view's: numbers it, and what is new about it.
  void append(detail::LearnedModel& next) noexcept {
    next.object_class = 0;
    while (next.object_class < classes_ && !detail::same_text(class_name(next.object_class), next.class_name))
      ++next.object_class;
    const auto is_it = [&](std::uint32_t i) {
      return class_of(i) == next.object_class && detail::same_text(instance_name(i), next.instance_name);
    };
    next.instance = 0;
    while (next.instance < instances_ && !is_it(next.instance)) ++next.instance;
    if (next.object_class == classes_) ++classes_;
    if (next.instance == instances_) ++instances_;
    codewords_ += next.codewords.count;
    ++learned_count_;
  }

  detail::FlashModel model_;
  const detail::LearnedModel* learned_ = nullptr;
  std::uint32_t learned_count_ = 0;
  std::uint32_t codewords_ = 0;
  std::uint32_t instances_ = 0;
  std::uint32_t classes_ = 0;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
