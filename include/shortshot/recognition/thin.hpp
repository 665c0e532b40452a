// shortshot/recognition/thin.hpp: a trained recognizer with fewer codewords, for small memories. Hosted only:
// allocates.
//
// Each codeword is asked for as if it were seen: without it, which is nearest, and does that vote for the same instance
// at the same place? Codewords go one after the other, always the one that costs fewest right votes. After the idea of
// decremental reduction: D. R. Wilson, T. R. Martinez: Reduction techniques for instance-based learning algorithms
// (Machine Learning 38, 2000).
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "../base/unfused.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "../store/stored_features.hpp"
#include "codebook.hpp"
#include "flash_model_file.hpp"
#include "match.hpp"
#include "packed_rows.hpp"
#include "recognizer.hpp"
#include "row_format.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// What is left of a codebook, and whom each of its codewords, also those that are gone, would activate.
template <class Rows>
class Thinning {
 public:
  Thinning(const Codebook& codebook, const Rows& rows, float bandwidth)
      : codebook_(codebook),
        rows_(rows),
        squared_bandwidth_(unfused(bandwidth * bandwidth)),
        is_left_(rows.count, true),
        left_of_(codebook.instances.size(), 0),
        nearest_(rows.count) {
    for (const Codebook::Codeword& codeword : codebook.codewords) ++left_of_[codeword.instance];
    for (std::size_t i = 0; i < rows.count; ++i) find_nearest(i);
  }

  [[nodiscard]] bool is_left(std::size_t codeword) const { return is_left_[codeword]; }

  /// Takes one of the instance that has most: the one that costs fewest right votes; of those, who is activated least;
  /// of those, the last one.
  void remove_one() {
    std::vector<Loss> losses(rows_.count);
    for (std::size_t i = 0; i < rows_.count; ++i) {
      const TwoNearest& two = nearest_[i];
      if (two.first == no_row) continue;
      losses[two.first].right_votes += two.lost;
      ++losses[two.first].votes;
    }
    std::uint32_t most = 0;
    for (const std::uint32_t left : left_of_) most = left > most ? left : most;
    std::size_t least = rows_.count;
    for (std::size_t i = rows_.count; i-- > 0;) {
      if (!is_left_[i] || left_of_[codebook_.codewords[i].instance] != most) continue;
      if (least == rows_.count || losses[i] < losses[least]) least = i;
    }
    is_left_[least] = false;
    --left_of_[codebook_.codewords[least].instance];
    for (std::size_t i = 0; i < rows_.count; ++i) {
      if (nearest_[i].first == least || nearest_[i].second == least) find_nearest(i);
    }
  }

 private:
  struct TwoNearest {
    std::size_t first = no_row;
    std::size_t second = no_row;
    int lost = 0;  // right votes, if the first one goes
  };
  struct Loss {
    std::int64_t right_votes = 0;
    std::size_t votes = 0;
    [[nodiscard]] bool operator<(const Loss& other) const {
      return right_votes != other.right_votes ? right_votes < other.right_votes : votes < other.votes;
    }
  };

  /// Of those that are left, but for itself; the first ones of those that are as near.
  void find_nearest(std::size_t i) {
    TwoNearest two;
    typename RowsNumber<Rows>::type first{};
    typename RowsNumber<Rows>::type second{};
    for (std::size_t k = 0; k < rows_.count; ++k) {
      if (k == i || !is_left_[k]) continue;
      const auto distance = rows_.compare(i, rows_, k);
      if (two.first == no_row || distance < first) {
        two = {k, two.first, 0};
        second = std::exchange(first, distance);
      } else if (two.second == no_row || distance < second) {
        two.second = k;
        second = distance;
      }
    }
    two.lost = (is_right(i, two.first) ? 1 : 0) - (is_right(i, two.second) ? 1 : 0);
    nearest_[i] = two;
  }

  /// Would k vote as i does, where i is seen?
  [[nodiscard]] bool is_right(std::size_t i, std::size_t k) const {
    if (k == no_row) return false;
    const Codebook::Codeword& a = codebook_.codewords[i];
    const Codebook::Codeword& b = codebook_.codewords[k];
    return a.instance == b.instance && squared_distance(a.center, b.center) <= squared_bandwidth_;
  }

  const Codebook& codebook_;
  const Rows rows_;
  const float squared_bandwidth_;
  std::vector<bool> is_left_;
  std::vector<std::uint32_t> left_of_;  // of each instance
  std::vector<TwoNearest> nearest_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A recognizer of StoredFeatures<Stored> (codes or bits) with at most so many codewords: those that contribute most to
/// right votes. Each instance keeps as many as any other, or all that it has; they keep their order. So instances with
/// many views do not outvote those with few any more, either. The same on every machine.
///
/// Statuses: not_trained, bad_option (of the recognizer, or fewer codewords than there are instances),
/// other_descriptor. `out`, which may be the same recognizer, has not changed then. Compares each codeword with all
/// others some four times: 6 s for 10,000 of 44 bytes. Allocates 25 bytes for each, and the copy.
template <class Stored>
[[nodiscard]] Status thin(const Recognizer& recognizer, std::size_t most_codewords, Recognizer& out) {
  const detail::Codebook& codebook = detail::RecognizerAccess::codebook(recognizer);
  Status status = validate(recognizer.options());
  if (codebook.codewords.empty()) status = Status::not_trained;
  if (status == Status::ok) status = detail::validate_queries(codebook, sizeof(Stored), true, storage_layout<Stored>());
  if (status == Status::ok && most_codewords < codebook.instances.size()) status = Status::bad_option;
  if (status != Status::ok) return status;
  Recognizer thinned(recognizer);
  if (codebook.codewords.size() > most_codewords) {
    const auto rows = detail::rows_like(rows_of(StoredFeatures<Stored>()), codebook);
    detail::Thinning<std::decay_t<decltype(rows)>> thinning(codebook, rows, recognizer.options().bandwidth);
    for (std::size_t left = rows.count; left > most_codewords; --left) thinning.remove_one();
    detail::Codebook& kept = detail::RecognizerAccess::codebook(thinned);
    kept.codewords.clear();
    kept.packed.clear();
    for (std::size_t i = 0; i < rows.count; ++i) {
      if (!thinning.is_left(i)) continue;
      kept.codewords.push_back(codebook.codewords[i]);
      detail::append(kept, rows, i);
    }
  }
  out = std::move(thinned);
  return Status::ok;
}

/// The same with as many codewords as a model for flash of at most so many bytes has: save_for_flash(out, ...).
/// Also out_of_memory, in place of bad_option: it has not one for each instance.
template <class Stored>
[[nodiscard]] Status thin_for_flash(const Recognizer& recognizer, std::size_t most_bytes, Recognizer& out) {
  const detail::Codebook& codebook = detail::RecognizerAccess::codebook(recognizer);
  const std::size_t most = detail::codewords_in_flash<Stored>(codebook, most_bytes);
  if (!codebook.codewords.empty() && most < codebook.instances.size()) return Status::out_of_memory;
  return thin<Stored>(recognizer, most, out);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
