// shortshot/recognition/recognize.hpp: what a recognizer does: learn views, and say which objects are where. Hosted
// only: allocates, starts threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "../base/unfused.hpp"
#include "../batch/executor.hpp"
#include "../batch/features.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../descriptor/layout_of.hpp"
#include "../kernel/describe_at.hpp"
#include "../status.hpp"
#include "codebook.hpp"
#include "descriptor_rows.hpp"
#include "hypothesis.hpp"
#include "match.hpp"
#include "mean_shift.hpp"
#include "recognizer.hpp"
#include "vote_centers.hpp"
#include "vote_density.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Votes that a thread takes at a time: enough for some that are close to each other.
inline constexpr std::size_t vote_block = 32;

/// Are these rows of a storage?
template <class Rows>
inline constexpr bool are_packed = !std::is_same<Rows, DescriptorRows>::value;

template <class Rows, class Threads>
[[nodiscard]] Status activate(const Recognizer& recognizer, const Rows& rows, std::string_view layout,
                              std::vector<Match>& matches, Threads& threads) {
  const Codebook& codebook = RecognizerAccess::codebook(recognizer);
  Status status = validate(recognizer.options());
  if (status == Status::ok) status = validate_queries(codebook, rows.size, are_packed<Rows>, layout);
  if (status != Status::ok) return status;
  return nearest(rows, rows_like(rows, codebook), recognizer.options().neighbors, matches, threads);
}

/// In ascending order of classes.
[[nodiscard]] inline std::vector<Vote> cast_votes(const Recognizer& recognizer, const KeyPoint* keypoints,
                                                  const Frame* frames, const std::vector<Match>& matches) {
  const auto& codewords = RecognizerAccess::codebook(recognizer).codewords;
  std::vector<Vote> votes;
  std::vector<std::size_t> places(recognizer.class_count() + 1);  // where the next vote for each class goes
  votes.reserve(matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i].row == no_row) continue;
    const Codebook::Codeword& codeword = codewords[matches[i].row];
    const std::size_t row = i / recognizer.options().neighbors;
    const Point center = from_local(codeword.center, keypoints[row].position, frames[row]);
    if (!is_finite(center)) continue;  // farther away than floats reach
    votes.push_back({center, recognizer.class_of(codeword.instance), codeword.instance});
    ++places[votes.back().object_class + 1];
  }
  for (std::size_t c = 1; c < places.size(); ++c) places[c] += places[c - 1];
  std::vector<Vote> sorted(votes.size());
  for (const Vote& vote : votes) sorted[places[vote.object_class]++] = vote;
  return sorted;
}

/// The first of the votes whose class is not below another.
[[nodiscard]] inline const Vote* first_of_class(const std::vector<Vote>& votes, std::uint32_t object_class) noexcept {
  std::size_t low = 0;
  std::size_t high = votes.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    votes[middle].object_class < object_class ? low = middle + 1 : high = middle;
  }
  return votes.data() + low;
}

/// The peak that each vote climbs to.
template <class Threads>
[[nodiscard]] std::vector<Peak> climb_from_all(const std::vector<Vote>& votes, float bandwidth, Threads& threads) {
  struct Start {
    std::size_t shift;
    std::size_t vote;
  };
  std::vector<MeanShift> shifts;  // one for each class that has votes
  std::vector<Start> starts;      // those that are close to each other one after the other
  starts.reserve(votes.size());
  for (std::size_t begin = 0; begin < votes.size(); begin = starts.size()) {
    shifts.emplace_back(votes.data() + begin, first_of_class(votes, votes[begin].object_class + 1), bandwidth);
    shifts.back().for_each_vote([&](std::size_t vote) { starts.push_back({shifts.size() - 1, begin + vote}); });
  }
  std::vector<Peak> peaks(votes.size());
  auto&& executor = executor_of(threads, (votes.size() + vote_block - 1) / vote_block);
  const std::size_t team = std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
  std::vector<MeanShift::Memory> memories;
  memories.reserve(team);
  while (memories.size() < team) memories.emplace_back(votes.size());
  for_blocks(executor, team, votes.size(), vote_block, [&](std::size_t thread, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      peaks[starts[i].vote] = shifts[starts[i].shift].climb(votes[starts[i].vote], memories[thread]);
  });
  return peaks;
}

/// The instance of a class whose votes have the largest sum of weights at a place; the first trained one of those.
[[nodiscard]] inline std::uint32_t heaviest_instance(const Recognizer& recognizer, const std::vector<Vote>& votes,
                                                     std::uint32_t object_class, const Point& at) {
  const VoteDensity density(recognizer.options().bandwidth);
  std::vector<float> sums(recognizer.instance_count(), 0.0f);
  const Vote* const end = first_of_class(votes, object_class + 1);
  for (const Vote* vote = first_of_class(votes, object_class); vote != end; ++vote)
    sums[vote->instance] += density.weight(*vote, at);
  std::size_t heaviest = 0;
  for (std::size_t i = 1; i < sums.size(); ++i) heaviest = sums[i] > sums[heaviest] ? i : heaviest;
  return static_cast<std::uint32_t>(heaviest);
}

/// Hypotheses from the peak that each vote has climbed to, densest first; of equal ones, as the votes are ordered.
inline void choose(const Recognizer& recognizer, const std::vector<Vote>& votes, const std::vector<Peak>& peaks,
                   std::vector<Hypothesis>& out) {
  const float bandwidth = recognizer.options().bandwidth;
  std::vector<std::size_t> order(peaks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return peaks[a].density > peaks[b].density || (peaks[a].density == peaks[b].density && a < b);
  });
  for (const std::size_t i : order) {
    if (out.size() == recognizer.options().most) break;
    const std::uint32_t object_class = votes[i].object_class;
    const Point& at = peaks[i].at;
    if (is_known(out.data(), out.size(), object_class, at, bandwidth)) continue;
    out.push_back({object_class, heaviest_instance(recognizer, votes, object_class, at), at, peaks[i].density});
  }
}

[[nodiscard]] inline PlacedRows<DescriptorRows> placed(const FeatureRows& rows) noexcept {
  return {rows.descriptors, rows.keypoints, rows.frames};
}

template <class Rows>
[[nodiscard]] Status train_rows(Recognizer& recognizer, const PlacedRows<Rows>& rows, std::string_view layout,
                                const Point& center, std::string_view object_class, std::string_view instance) {
  Codebook& codebook = RecognizerAccess::codebook(recognizer);
  Status status = check_values(rows);
  if (status == Status::ok && !is_finite(center)) status = Status::invalid_keypoint;
  if (status == Status::ok && recognizer.codeword_count() > 0)
    status = validate_queries(codebook, rows.descriptors.size, are_packed<Rows>, layout);
  if (status == Status::ok) status = add(codebook, rows, center, object_class, instance);
  if (status == Status::ok && codebook.row_size == 0 && recognizer.codeword_count() > 0) {
    codebook.layout = layout;
    codebook.row_size = rows.descriptors.size;
  }
  return status;
}

template <class Rows, class Threads>
[[nodiscard]] Status recognize_rows(const Recognizer& recognizer, const PlacedRows<Rows>& rows, std::string_view layout,
                                    std::vector<Hypothesis>& out, Threads& threads) {
  out.clear();
  std::vector<Match> matches;
  Status status = check_values(rows);
  if (status == Status::ok) status = activate(recognizer, rows.descriptors, layout, matches, threads);
  if (status != Status::ok) return status;
  const std::vector<Vote> votes = cast_votes(recognizer, rows.keypoints, rows.frames, matches);
  const std::vector<Peak> peaks = climb_from_all(votes, recognizer.options().bandwidth, threads);
  choose(recognizer, votes, peaks, out);
  return Status::ok;
}

template <class Rows, class Threads>
[[nodiscard]] Status shares_of_rows(const Recognizer& recognizer, const Rows& rows, std::string_view layout,
                                    ActivationShares& out, Threads& threads) {
  out.classes.clear();
  out.instances.clear();
  std::vector<Match> matches;
  Status status = check_values(rows);
  if (status == Status::ok) status = activate(recognizer, rows, layout, matches, threads);
  if (status != Status::ok) return status;
  out.classes.assign(recognizer.class_count(), 0.0f);
  out.instances.assign(recognizer.instance_count(), 0.0f);
  float activations = 0.0f;
  for (const Match& match : matches) {
    if (match.row == no_row) continue;
    const std::uint32_t instance = RecognizerAccess::codebook(recognizer).codewords[match.row].instance;
    out.classes[recognizer.class_of(instance)] += 1.0f;
    out.instances[instance] += 1.0f;
    activations += 1.0f;
  }
  for (float& share : out.classes) share /= std::max(activations, 1.0f);
  for (float& share : out.instances) share /= std::max(activations, 1.0f);
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Learns a view of an object. `center` is a point at the same place of the object in all of its views, best in its
/// middle, in the view's coordinates. Rows whose status is not ok are left out; a view that has no other adds
/// nothing, not even its names.
///
/// Statuses: bad_rows (null pointers, rows without values, values that are not finite, 2^32 - 1 codewords or more),
/// invalid_keypoint (a key point or the center is not finite, or they lie 1e38 m apart), bad_frame, other_descriptor.
/// Nothing has changed then. Allocates 16 bytes for a codeword and 4 for each of its values.
[[nodiscard]] inline Status train(Recognizer& recognizer, const FeatureRows& rows, std::string_view layout,
                                  const Point& center, std::string_view object_class, std::string_view instance) {
  return detail::train_rows(recognizer, detail::placed(rows), layout, center, object_class, instance);
}

/// The same for what extract() gives.
template <class D>
[[nodiscard]] Status train(Recognizer& recognizer, const Features<D>& features, const Point& center,
                           std::string_view object_class, std::string_view instance) {
  return train(recognizer, feature_rows_of(features), layout_of<D>(), center, object_class, instance);
}

/// Finds the objects in a view: the maxima of the density of votes, densest first. The first one's class is what the
/// view shows if it shows one object. Its instance is the one whose votes count for most there.
///
/// `out`      of each class, maxima that lie farther than the bandwidth from any denser one; options().most in all.
///            Empty if no row has the status ok
/// `threads`  how many threads share the work, or an executor (see extract()); the result is the same, bit for bit,
///            for any number, and on every machine
///
/// Statuses: what train() has, bad_option and not_trained; `out` is empty then. The cost is that of nearest(), of mean
/// shift from every vote, and of a look at all votes for each hypothesis. Mean shift takes some ten steps, each of them
/// 20 instructions (SSE2) for every vote of the class that is less than seven bandwidths away: 25 million for 2000
/// votes, half of them spread over two cubic meters. Allocates what nearest() does, 250 bytes for each vote and 32 more
/// for each thread, and up to 700 more where many votes lie closer together than that.
template <class Threads = unsigned>
[[nodiscard]] Status recognize(const Recognizer& recognizer, const FeatureRows& rows, std::string_view layout,
                               std::vector<Hypothesis>& out, Threads&& threads = 1u) {
  return detail::recognize_rows(recognizer, detail::placed(rows), layout, out, threads);
}

template <class D, class Threads = unsigned>
[[nodiscard]] Status recognize(const Recognizer& recognizer, const Features<D>& features, std::vector<Hypothesis>& out,
                               Threads&& threads = 1u) {
  return recognize(recognizer, feature_rows_of(features), layout_of<D>(), out, threads);
}

/// The simpler way, without places: by which classes' and instances' codewords the descriptors are matched. A single
/// object is what has the largest share. Statuses and `threads` as for recognize(); `out` is empty then.
template <class Threads = unsigned>
[[nodiscard]] Status activation_shares(const Recognizer& recognizer, const DescriptorRows& rows,
                                       std::string_view layout, ActivationShares& out, Threads&& threads = 1u) {
  return detail::shares_of_rows(recognizer, rows, layout, out, threads);
}

template <class D, class Threads = unsigned>
[[nodiscard]] Status activation_shares(const Recognizer& recognizer, const Features<D>& features, ActivationShares& out,
                                       Threads&& threads = 1u) {
  return activation_shares(recognizer, rows_of(features), layout_of<D>(), out, threads);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
