// shortshot/recognizer.hpp: which objects are where: an implicit shape model, whose descriptors vote for the centres of
// objects. Hosted only: allocates, starts threads.
//
// After B. Leibe, A. Leonardis, B. Schiele: Robust object detection with interleaved categorization and segmentation
// (IJCV 77, 2008), with local reference frames in 3-D as in F. Tombari, L. Di Stefano: Object recognition in 3D scenes
// with occlusions and clutter by Hough voting (PSIVT 2010).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cloud.hpp"
#include "codebook.hpp"
#include "config.hpp"
#include "describe_at.hpp"
#include "executor.hpp"
#include "features.hpp"
#include "layout.hpp"
#include "match.hpp"
#include "mean_shift.hpp"
#include "rows.hpp"
#include "status.hpp"

namespace shortshot {

struct RecognizerOptions {
  float bandwidth = 0.03f;      ///< h of the density of votes, 1e-6 to 1e6 metres: about how far votes miss the centre
  std::uint32_t neighbors = 1;  ///< nearest codewords that each descriptor activates, 1 to 1024
  std::uint32_t most = 8;       ///< hypotheses at the most, from 1 on
};

/// An object that may be there; see Recognizer::class_name() and instance_name() for the numbers. Trivial type.
struct Hypothesis {
  std::uint32_t object_class;
  std::uint32_t instance;
  Point center;  ///< where that of the training views is in this view
  float score;   ///< density of the class' votes there: 1 for each that hits it, exp(-d^2 / (2 h^2)) if d metres off
};

/// The share that each class, and each instance, has in the codewords that were activated: 0 to 1, all of them 1
/// together, or all zero if none was.
struct ActivationShares {
  std::vector<float> classes;
  std::vector<float> instances;
};

inline namespace SHORTSHOT_ISA {

/// ok or bad_option.
[[nodiscard]] inline Status check(const RecognizerOptions& options) noexcept {
  const bool usable = options.bandwidth >= 1e-6f && options.bandwidth <= 1e6f && options.neighbors >= 1 &&
                      options.neighbors <= 1024 && options.most >= 1;
  return usable ? Status::ok : Status::bad_option;
}

/// Recognises objects by their descriptors. Every descriptor of the training views is a codeword. One of a new view
/// activates those that are nearest (L2), and each of these votes for the place where its object's centre would be: as
/// it lay in the key point's local reference frame in training. Votes for a class gather at the centres of its objects;
/// mean shift finds where they are densest.
///
/// Objects have a class ("mug") and an instance ("red mug"); an instance is known by both names together. For which
/// descriptor a recogniser is, is said by the first training view: the text `layout` (layout_of(), with whatever else
/// two descriptors must have in common to be compared) and the number of values. Radii, and how frames are turned, must
/// be the same in training and afterwards.
///
/// Calls of const functions may run at the same time. All may throw what extract() may; a recogniser that ran out of
/// memory in train() can only be assigned to or destroyed.
class Recognizer {
 public:
  Recognizer() = default;
  explicit Recognizer(const RecognizerOptions& options) noexcept : options_(options) {}

  [[nodiscard]] const RecognizerOptions& options() const noexcept { return options_; }
  void set_options(const RecognizerOptions& options) noexcept { options_ = options; }

  [[nodiscard]] std::size_t class_count() const noexcept { return codebook_.classes.size(); }
  [[nodiscard]] std::size_t instance_count() const noexcept { return codebook_.instances.size(); }
  [[nodiscard]] std::size_t codeword_count() const noexcept { return codebook_.codewords.size(); }
  /// For numbers below class_count() and instance_count(), in the order of training.
  [[nodiscard]] const std::string& class_name(std::size_t object_class) const {
    return codebook_.classes[object_class];
  }
  [[nodiscard]] const std::string& instance_name(std::size_t instance) const {
    return codebook_.instances[instance].name;
  }
  [[nodiscard]] std::uint32_t class_of(std::size_t instance) const {
    return codebook_.instances[instance].object_class;
  }

  /// What the first training view's descriptors were, and how many values they had; empty and 0 before it.
  [[nodiscard]] const std::string& layout() const noexcept { return codebook_.layout; }
  [[nodiscard]] std::size_t row_size() const noexcept { return codebook_.row_size; }

  /// Learns a view of an object. `center` is a point at the same place of the object in all of its views, best in its
  /// middle, in the view's coordinates. Rows whose status is not ok are left out; a view that has no other adds
  /// nothing, not even its names.
  ///
  /// Statuses: bad_rows (null pointers, rows without values, values that are not finite, 2^32 - 1 codewords or more),
  /// invalid_keypoint (a key point or the centre is not finite, or they lie 1e38 m apart), bad_frame, other_descriptor.
  /// Nothing has changed then. Allocates 16 bytes for a codeword and 4 for each of its values.
  [[nodiscard]] Status train(const FeatureRows& rows, std::string_view layout, const Point& center,
                             std::string_view object_class, std::string_view instance) {
    Status status = detail::check_values(rows);
    if (status == Status::ok && !is_finite(center)) status = Status::invalid_keypoint;
    if (status == Status::ok && codeword_count() > 0) status = codebook_.fits(rows.descriptors, layout);
    if (status == Status::ok) status = codebook_.add(rows, center, object_class, instance);
    if (status == Status::ok && codebook_.row_size == 0 && codeword_count() > 0) {
      codebook_.layout = layout;
      codebook_.row_size = rows.descriptors.size;
    }
    return status;
  }

  /// The same for what extract() gives with these key points.
  template <class D, class Color>
  [[nodiscard]] Status train(const Features<D, Color>& features, const std::vector<KeyPoint>& keypoints,
                             const Point& center, std::string_view object_class, std::string_view instance) {
    return train(rows_of(features, keypoints), layout_of<D>(), center, object_class, instance);
  }

  /// Finds the objects in a view: the maxima of the density of votes, densest first. The first one's class is what the
  /// view shows if it shows one object. Its instance is the one whose votes count for most there.
  ///
  /// `out`      of each class, maxima that lie farther than the bandwidth from any denser one; options().most in all.
  ///            Empty if no row has the status ok
  /// `threads`  how many threads share the work, or an executor (see extract()); the result is the same, bit for bit,
  ///            for any number, and on every machine
  ///
  /// Statuses: what train() has, bad_option and not_trained; `out` is empty then. The cost is that of nearest() and of
  /// mean shift from every vote, about V^2 / 10 microseconds for V votes for one class (measured on a desktop CPU: 2 ms
  /// for 130, 0.15 s for 1000). Allocates what nearest() does, and 50 bytes for each vote.
  template <class Threads = unsigned>
  [[nodiscard]] Status recognize(const FeatureRows& rows, std::string_view layout, std::vector<Hypothesis>& out,
                                 Threads&& threads = 1u) const {
    out.clear();
    std::vector<Match> matches;
    Status status = detail::check_values(rows);
    if (status == Status::ok) status = activate(rows.descriptors, layout, matches, threads);
    if (status != Status::ok) return status;
    const std::vector<detail::Vote> votes = cast_votes(rows, matches);
    std::vector<detail::Peak> peaks(votes.size());
    auto&& executor = detail::executor_of(threads, (votes.size() + vote_block - 1) / vote_block);
    const std::size_t team = std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
    detail::for_blocks(executor, team, votes.size(), vote_block, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) peaks[i] = density_for(votes, votes[i].object_class).climb(votes[i]);
    });
    choose(votes, peaks, out);
    return Status::ok;
  }

  template <class D, class Color, class Threads = unsigned>
  [[nodiscard]] Status recognize(const Features<D, Color>& features, const std::vector<KeyPoint>& keypoints,
                                 std::vector<Hypothesis>& out, Threads&& threads = 1u) const {
    return recognize(rows_of(features, keypoints), layout_of<D>(), out, threads);
  }

  /// The simpler way, without places: by which classes' and instances' codewords the descriptors are matched. A single
  /// object is what has the largest share. Statuses and `threads` as for recognize(); `out` is empty then.
  template <class Threads = unsigned>
  [[nodiscard]] Status activation_shares(const DescriptorRows& rows, std::string_view layout, ActivationShares& out,
                                         Threads&& threads = 1u) const {
    out.classes.clear();
    out.instances.clear();
    std::vector<Match> matches;
    Status status = detail::check_values(rows);
    if (status == Status::ok) status = activate(rows, layout, matches, threads);
    if (status != Status::ok) return status;
    out.classes.assign(class_count(), 0.0f);
    out.instances.assign(instance_count(), 0.0f);
    float activations = 0.0f;
    for (const Match& match : matches) {
      if (match.row == no_row) continue;
      const std::uint32_t instance = codebook_.codewords[match.row].instance;
      out.classes[class_of(instance)] += 1.0f;
      out.instances[instance] += 1.0f;
      activations += 1.0f;
    }
    for (float& share : out.classes) share /= std::max(activations, 1.0f);
    for (float& share : out.instances) share /= std::max(activations, 1.0f);
    return Status::ok;
  }

  template <class D, class Color, class Threads = unsigned>
  [[nodiscard]] Status activation_shares(const Features<D, Color>& features, ActivationShares& out,
                                         Threads&& threads = 1u) const {
    return activation_shares(rows_of(features), layout_of<D>(), out, threads);
  }

 private:
  friend Status save(const Recognizer& recognizer, std::vector<std::uint8_t>& bytes);
  friend Status load(const std::uint8_t* bytes, std::size_t size, std::string_view layout, Recognizer& out);

  /// Votes that a thread takes at a time.
  static constexpr std::size_t vote_block = 8;

  template <class Threads>
  [[nodiscard]] Status activate(const DescriptorRows& rows, std::string_view layout, std::vector<Match>& matches,
                                Threads& threads) const {
    Status status = check(options_);
    if (status == Status::ok) status = codebook_.fits(rows, layout);
    if (status == Status::ok) status = nearest(rows, codebook_.rows(), options_.neighbors, matches, threads);
    return status;
  }

  /// In ascending order of classes.
  [[nodiscard]] std::vector<detail::Vote> cast_votes(const FeatureRows& rows, const std::vector<Match>& matches) const {
    std::vector<detail::Vote> votes;
    std::vector<std::size_t> places(class_count() + 1);  // where the next vote for each class goes
    votes.reserve(matches.size());
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (matches[i].row == no_row) continue;
      const detail::Codebook::Codeword& codeword = codebook_.codewords[matches[i].row];
      const std::size_t row = i / options_.neighbors;
      const Point center = detail::from_local(codeword.center, rows.keypoints[row].position, rows.frames[row]);
      if (!is_finite(center)) continue;  // farther away than floats reach
      votes.push_back({center, class_of(codeword.instance), codeword.instance});
      ++places[votes.back().object_class + 1];
    }
    for (std::size_t c = 1; c < places.size(); ++c) places[c] += places[c - 1];
    std::vector<detail::Vote> sorted(votes.size());
    for (const detail::Vote& vote : votes) sorted[places[vote.object_class]++] = vote;
    return sorted;
  }

  [[nodiscard]] detail::VoteDensity density_for(const std::vector<detail::Vote>& votes,
                                                std::uint32_t object_class) const {
    const auto has_class_below = [](const detail::Vote& vote, std::uint32_t end) { return vote.object_class < end; };
    const auto begin = std::lower_bound(votes.begin(), votes.end(), object_class, has_class_below);
    const auto end = std::lower_bound(begin, votes.end(), object_class + 1, has_class_below);
    return {votes.data() + (begin - votes.begin()), votes.data() + (end - votes.begin()), options_.bandwidth};
  }

  /// The instance whose votes have the largest sum of weights at a place; the first trained one of those.
  [[nodiscard]] std::uint32_t heaviest_instance(const detail::VoteDensity& density, const Point& at) const {
    std::vector<float> sums(instance_count(), 0.0f);
    for (const detail::Vote& vote : density) sums[vote.instance] += density.weight(vote, at);
    return static_cast<std::uint32_t>(std::max_element(sums.begin(), sums.end()) - sums.begin());
  }

  /// Hypotheses from the peak that each vote has climbed to, densest first; of equal ones, as the votes are ordered.
  void choose(const std::vector<detail::Vote>& votes, const std::vector<detail::Peak>& peaks,
              std::vector<Hypothesis>& out) const {
    std::vector<std::uint8_t> is_known(peaks.size());  // at a hypothesis, or near one of the same class
    while (out.size() < options_.most) {
      std::size_t densest = peaks.size();
      for (std::size_t i = 0; i < peaks.size(); ++i) {
        const bool denser = densest == peaks.size() || peaks[i].density > peaks[densest].density;
        if (is_known[i] == 0 && denser) densest = i;
      }
      if (densest == peaks.size()) break;
      const std::uint32_t object_class = votes[densest].object_class;
      const Point& at = peaks[densest].at;
      is_known[densest] = 1;
      for (std::size_t i = 0; i < peaks.size(); ++i) {
        const bool near = squared_distance(at, peaks[i].at) <= rounded(options_.bandwidth * options_.bandwidth);
        if (near && votes[i].object_class == object_class) is_known[i] = 1;
      }
      const detail::VoteDensity density = density_for(votes, object_class);
      out.push_back({object_class, heaviest_instance(density, at), at, peaks[densest].density});
    }
  }

  RecognizerOptions options_;
  detail::Codebook codebook_;
};

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
