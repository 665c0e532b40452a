// shortshot/recognition/micro_recognizer.hpp: recognition without a heap: a view's key points one after the other,
// against a model in flash.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "../base/simd.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/keypoint.hpp"
#include "../config.hpp"
#include "../frame/frame.hpp"
#include "../frame/local_point.hpp"
#include "../kernel/describe_at.hpp"
#include "../kernel/support.hpp"
#include "../search/workspace.hpp"
#include "../status.hpp"
#include "../store/storage.hpp"
#include "climb.hpp"
#include "hypothesis.hpp"
#include "model_view.hpp"
#include "vote_centers.hpp"
#include "vote_density.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Votes for a class are those in [begin, end) of all.
struct VotesOfClass {
  std::size_t begin;
  std::size_t end;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Recognizes objects as recognize() does, with memory whose size is known before the program runs: sizeof this. The
/// hypotheses are those of recognize() with the recognizer that load_from_flash() makes of the model, bit for bit, for
/// the same key points in the same order.
///
///     static MicroRecognizer<NibbleDescriptor<ShapeColor95>, 128> recognizer;
///     recognizer.start(model);
///     for (each key point) recognizer.add(cloud, search, key point, 0.04f);
///     Hypothesis found[4];
///     const std::size_t count = recognizer.finish(found);
///
/// `Stored`        what the model is of: codes or bits of a descriptor that has a local reference frame
/// `MaxKeypoints`  of a view that count, at the most
/// `MaxNeighbors`  of a key point, as of a Workspace; 20 bytes each
/// `MaxActivated`  codewords that a descriptor activates at the most: RecognizerOptions::neighbors of the model
///
/// 48 bytes for each key point and activated codeword. No allocation; reentrant, one for each thread.
///
/// Time: add() is that of describe_at() and of a comparison with each codeword (some instructions for each of its
/// bytes). finish() is less than 100 steps of mean shift for each vote, where each step looks at each vote of its
/// class: at the most 100 V^2 looks for V votes, in practice some ten; and V^2 for each hypothesis.
template <class Stored, std::size_t MaxKeypoints, std::size_t MaxNeighbors = 512, std::size_t MaxActivated = 1>
class MicroRecognizer {
  using D = typename detail::Storage<Stored>::Descriptor;
  static_assert(D::needs_frame, "MicroRecognizer<Stored, ...> supports descriptors in a local reference frame");
  static_assert(MaxKeypoints >= 1 && MaxKeypoints <= 65536 && MaxActivated >= 1 && MaxActivated <= 1024,
                "MicroRecognizer<Stored, MaxKeypoints, MaxNeighbors, MaxActivated> supports 1 to 65536 key points and "
                "1 to 1024 codewords for each");

 public:
  /// Most votes that a view can have.
  static constexpr std::size_t max_votes = MaxKeypoints * MaxActivated;

  /// All zeros: static ones take no flash and no code.
  constexpr MicroRecognizer() noexcept = default;

  /// Begins a view, with a model, which is copied (its bytes are not).
  void start(const ModelView<Stored>& model) noexcept {
    model_ = model;
    votes_count_ = 0;
  }

  /// Describes a key point, by index or as a KeyPoint, and casts its votes; `own` as for describe_at().
  ///
  /// Statuses, the first one that applies: not_trained (not started, or no model is open), bad_option (a descriptor
  /// activates more than MaxActivated codewords), out_of_memory (MaxKeypoints have voted), and those of describe_at().
  /// The key point has no vote then, as one that is left out of recognize().
  template <class Search, class Place = KeyPoint, class... Own>
  [[nodiscard]] Status add(const CloudView& cloud, const Search& search, const Place& place, const Support& support,
                           const Own&... own) noexcept {
    Status status = ready();
    StoredKeyPoint<Stored> described;
    if (status == Status::ok) status = describe(cloud, search, place, support, described, own...);
    if (status == Status::ok) vote(described.descriptor, described.position, described.frame);
    return status;
  }

  /// Describes alone, for LearnedObjects or another add(): with or without a model. Statuses: those of describe_at();
  /// `out` is all zeros then.
  template <class Search, class Place = KeyPoint, class... Own>
  [[nodiscard]] Status describe(const CloudView& cloud, const Search& search, const Place& place,
                                const Support& support, StoredKeyPoint<Stored>& out, const Own&... own) noexcept {
    out = {};
    const Status status = detail::describe_key<D>(
        cloud, search, place, support, workspace_, values_,
        [&](const auto& n, const auto& sources, const Point& at) {
          out.position = at;
          return detail::describe_gathered<D, default_chunk_size>(n, sources, at, support, out.frame, values_);
        },
        own...);
    if (status == Status::ok) {
      detail::Storage<Stored>::make(values_, out.descriptor);
    } else {
      out = {};
    }
    return status;
  }

  /// The same for what was described elsewhere. Also invalid_keypoint and bad_frame.
  [[nodiscard]] Status add(const Stored& stored, const Point& position, const Frame& frame) noexcept {
    Status status = ready();
    if (status == Status::ok && !is_finite(position)) status = Status::invalid_keypoint;
    if (status == Status::ok) status = validate(frame);
    if (status == Status::ok) vote(stored, position, frame);
    return status;
  }

  /// Votes that were cast since start(). An object of the model has about this share of them as its score that it is
  /// seen in; where no hypothesis has an eighth, none of them may be there.
  [[nodiscard]] std::size_t votes() const noexcept { return votes_count_; }

  /// The densest places of all votes so far, at most `Most` and RecognizerOptions::most of the model; returns how many.
  /// See recognize(). More key points may follow.
  template <std::size_t Most>
  std::size_t finish(Hypothesis (&out)[Most]) noexcept {
    const std::size_t most = model_.options().most < Most ? model_.options().most : Most;
    const detail::VoteDensity density(model_.options().bandwidth);
    climb_from_all(density);
    std::size_t count = 0;
    while (count < most) {
      const std::size_t densest = densest_unknown(out, count);
      if (densest == votes_count_) break;
      const detail::Peak& peak = peaks_[densest];
      const std::uint32_t instance = heaviest_instance(density, votes_of_class_at(densest), peak.at);
      out[count++] = {votes_[densest].object_class, instance, peak.at, peak.density};
    }
    return count;
  }

 private:
  struct Activated {
    std::uint32_t codeword;
    std::uint32_t distance;
  };

  [[nodiscard]] Status ready() const noexcept {
    if (model_.codeword_count() == 0) return Status::not_trained;
    if (model_.options().neighbors > MaxActivated) return Status::bad_option;
    return votes_count_ + model_.options().neighbors > max_votes ? Status::out_of_memory : Status::ok;
  }

  /// One vote for each of the codewords that are nearest.
  void vote(const Stored& stored, const Point& position, const Frame& frame) noexcept {
    Activated nearest[MaxActivated];
    const std::size_t count = find_nearest(stored, nearest);
    for (std::size_t i = 0; i < count; ++i) {
      const Point center = detail::from_local(model_.center_of(nearest[i].codeword), position, frame);
      const std::uint32_t instance = model_.instance_of(nearest[i].codeword);
      if (is_finite(center)) insert({center, model_.class_of(instance), instance});
    }
  }

  /// Nearest first, the first ones of those that are as near; returns how many count.
  std::size_t find_nearest(const Stored& stored, Activated (&nearest)[MaxActivated]) const noexcept {
    const Stored arranged = model_.arranged(stored);
    for (Activated& none : nearest) none = {0, 0xFFFFFFFFu};
    model_.for_each_run([&](std::uint32_t first, const detail::CodewordRun& run) {
      for (std::uint32_t i = 0; i < run.count; ++i) {
        Activated next = first_below(run.is_arranged ? arranged : stored, run, i, nearest[MaxActivated - 1].distance);
        if (next.codeword == run.count) break;
        i = next.codeword;
        next.codeword += first;
        bool is_nearer = false;  // and then all that come later make room
        for (Activated& known : nearest) {
          is_nearer = is_nearer || next.distance < known.distance;
          if (is_nearer) std::swap(next, known);
        }
      }
    });
    const std::uint32_t most = model_.options().neighbors;
    return most < model_.codeword_count() ? most : model_.codeword_count();
  }

  /// The first codeword of a run from i on whose distance is below the limit; their number if there is none. Not in
  /// line: here most of the time goes, and all registers.
  [[gnu::noinline]] static Activated first_below(const Stored& stored, const detail::CodewordRun& run, std::uint32_t i,
                                                 std::uint32_t limit) noexcept {
    const std::uint32_t count = run.count;
    const std::uint8_t* row = run.row(i);
    for (; i < count; ++i, row += detail::FlashLayout::before_row + sizeof(Stored)) {
      const auto& codeword = *reinterpret_cast<const Stored*>(row);
      const std::uint32_t distance = detail::Storage<Stored>::distance_below(stored, codeword, limit);
      if (distance < limit) return {i, distance};
    }
    return {count, limit};
  }

  /// Behind all votes for its class and those before it.
  void insert(const detail::Vote& vote) noexcept {
    std::size_t place = votes_count_++;
    for (; place > 0 && vote.object_class < votes_[place - 1].object_class; --place) votes_[place] = votes_[place - 1];
    votes_[place] = vote;
  }

  [[nodiscard]] detail::VotesOfClass votes_of_class_at(std::size_t vote) const noexcept {
    detail::VotesOfClass of_class{vote, vote + 1};
    const std::uint32_t object_class = votes_[vote].object_class;
    while (of_class.begin > 0 && votes_[of_class.begin - 1].object_class == object_class) --of_class.begin;
    while (of_class.end < votes_count_ && votes_[of_class.end].object_class == object_class) ++of_class.end;
    return of_class;
  }

  void climb_from_all(const detail::VoteDensity& density) noexcept {
    for (std::size_t begin = 0; begin < votes_count_;) {
      const detail::VotesOfClass of_class = votes_of_class_at(begin);
      const detail::VoteCenters centers = centers_of(of_class);
      for (; begin < of_class.end; ++begin) {
        peaks_[begin] = detail::climb(density, votes_[begin].center, [&](const Point&) { return centers; });
      }
    }
  }

  [[nodiscard]] detail::VoteCenters centers_of(const detail::VotesOfClass& of_class) noexcept {
    const std::size_t count = of_class.end - of_class.begin;
    for (std::size_t i = 0; i < count; ++i) {
      const Point& center = votes_[of_class.begin + i].center;
      x_[i] = center.x;
      y_[i] = center.y;
      z_[i] = center.z;
    }
    detail::pad(x_, y_, z_, count);
    return {x_, y_, z_, detail::padded(count)};
  }

  /// The densest peak, the first one of those that are as dense, that is no hypothesis yet; votes_count_ if there is
  /// none.
  [[nodiscard]] std::size_t densest_unknown(const Hypothesis* known, std::size_t count) const noexcept {
    std::size_t densest = votes_count_;
    for (std::size_t i = 0; i < votes_count_; ++i) {
      if (densest < votes_count_ && !(peaks_[i].density > peaks_[densest].density)) continue;
      const bool is_known =
          detail::is_known(known, count, votes_[i].object_class, peaks_[i].at, model_.options().bandwidth);
      if (!is_known) densest = i;
    }
    return densest;
  }

  /// The instance whose votes have the largest sum of weights at a place, the first trained one of those.
  [[nodiscard]] std::uint32_t heaviest_instance(const detail::VoteDensity& density,
                                                const detail::VotesOfClass& of_class, const Point& at) noexcept {
    float* const weights = x_;  // the votes' columns are not needed any more
    for (std::size_t i = of_class.begin; i < of_class.end; ++i) {
      weights[i - of_class.begin] = density.weight(votes_[i], at);
    }
    std::uint32_t heaviest = votes_[of_class.begin].instance;
    float largest = -1.0f;
    for (std::size_t i = of_class.begin; i < of_class.end; ++i) {
      const std::uint32_t instance = votes_[i].instance;
      float sum = 0.0f;
      for (std::size_t k = of_class.begin; k < of_class.end; ++k) {
        if (votes_[k].instance == instance) sum += weights[k - of_class.begin];
      }
      if (sum > largest || (sum == largest && instance < heaviest)) {
        largest = sum;
        heaviest = instance;
      }
    }
    return heaviest;
  }

  static constexpr std::size_t columns = max_votes + extend::simd::lanes;

  ModelView<Stored> model_;
  std::size_t votes_count_ = 0;
  detail::Vote votes_[max_votes] = {};  // by class, those of a class in the order in which they were cast
  detail::Peak peaks_[max_votes] = {};
  float x_[columns] = {};
  float y_[columns] = {};
  float z_[columns] = {};
  float values_[D::size] = {};
  Workspace<MaxNeighbors> workspace_ = {};
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
