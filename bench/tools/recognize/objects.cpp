#include "tools/recognize/objects.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tools/io/averaged_cloud.hpp"
#include "tools/io/require_ok.hpp"
#include "tools/io/view_of_cloud.hpp"
#include "tools/match/chance.hpp"
#include "tools/match/described.hpp"

namespace shortshot_bench {
namespace {

using shortshot::Point;
using shortshot::Status;
using ObjectFeatures = shortshot::Features<ObjectDescriptor>;

constexpr float bandwidth_of_radius = 0.75f;

/// Votes as recognize() counts them, each with its row.
class Votes {
 public:
  Votes(const shortshot::Recognizer& recognizer, const ObjectFeatures& features, unsigned threads)
      : recognizer_(recognizer),
        features_(features),
        codewords_(shortshot::detail::RecognizerAccess::codebook(recognizer).codewords) {
    const auto rows = shortshot::rows_of(features);
    require(shortshot::detail::activate(recognizer, rows, shortshot::layout_of<ObjectDescriptor>(), matches_, threads));
    for (std::uint32_t row = 0; row < features.size(); ++row) {
      if (features.status[row] == Status::ok) rows_.push_back(row);
    }
  }

  std::vector<std::uint32_t> voters_for(const shortshot::Hypothesis& h) const {
    std::vector<std::uint32_t> voters;
    const std::size_t each = recognizer_.options().neighbors;
    for (const std::uint32_t row : rows_) {
      bool is_voter = false;
      for (std::size_t k = 0; k < each; ++k) {
        const std::uint32_t codeword = matches_[row * each + k].row;
        is_voter = is_voter || (codeword != shortshot::no_row && hits(row, codeword, h));
      }
      if (is_voter) voters.push_back(row);
    }
    return voters;
  }

  /// Share of all rows' votes, had each of them any codeword: of a thousand of these, evenly chosen.
  double agreement_by_chance(const shortshot::Hypothesis& h) const {
    const std::size_t tries = std::min<std::size_t>(1000, codewords_.size());
    std::size_t hit = 0;
    for (const std::uint32_t row : rows_) {
      for (std::size_t k = 0; k < tries; ++k) {
        hit += hits(row, static_cast<std::uint32_t>(k * codewords_.size() / tries), h) ? 1u : 0u;
      }
    }
    const double each = static_cast<double>(hit) / static_cast<double>(std::max<std::size_t>(1, tries * rows_.size()));
    return 1.0 - std::pow(1.0 - each, static_cast<double>(recognizer_.options().neighbors));
  }

  Places places(float apart) const {
    std::vector<Point> points;
    std::vector<float> distances;
    for (const std::uint32_t row : rows_) {
      points.push_back(features_.keypoints[row].position);
      distances.push_back(matches_[row * recognizer_.options().neighbors].distance);
    }
    return places_of(points, distances, apart);
  }

  /// Numbers among the rows that vote.
  std::vector<std::uint32_t> numbers_of(const std::vector<std::uint32_t>& voters) const {
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t row : voters) {
      const auto at = std::lower_bound(rows_.begin(), rows_.end(), row);
      numbers.push_back(static_cast<std::uint32_t>(at - rows_.begin()));
    }
    return numbers;
  }

 private:
  bool hits(std::uint32_t row, std::uint32_t codeword, const shortshot::Hypothesis& h) const {
    if (recognizer_.class_of(codewords_[codeword].instance) != h.object_class) return false;
    const Point center = shortshot::detail::from_local(codewords_[codeword].center, features_.keypoints[row].position,
                                                       features_.frames[row]);
    const float reach = recognizer_.options().bandwidth;
    return shortshot::squared_distance(center, h.center) < reach * reach;
  }

  const shortshot::Recognizer& recognizer_;
  const ObjectFeatures& features_;
  const std::vector<shortshot::detail::Codebook::Codeword>& codewords_;
  std::vector<shortshot::Match> matches_;
  std::vector<std::uint32_t> rows_;
};

}  // namespace

float radius_of(const shortshot::Recognizer& recognizer) {
  return shortshot::detail::in_two_digits(recognizer.options().bandwidth / bandwidth_of_radius);
}

shortshot::RecognizerOptions recognizer_options(float radius) {
  shortshot::RecognizerOptions options;
  options.bandwidth = bandwidth_of_radius * radius;
  return options;
}

float suggested_radius(const RgbdCloud& cloud) {
  const shortshot::Suggestion suggested = shortshot::suggest(view_of_cloud(cloud), camera_of_cloud(cloud));
  require(suggested.status);
  return suggested.radius;
}

ObjectFeatures describe_object(const RgbdCloud& cloud, float radius, unsigned threads) {
  return described<ObjectDescriptor>(cloud, radius, 0.25f * radius, threads);
}

void learn(shortshot::Recognizer& recognizer, const RgbdCloud& cloud, const std::string& name, unsigned threads) {
  const ObjectFeatures features = describe_object(cloud, radius_of(recognizer), threads);
  require(train(recognizer, features, mean_point(view_of_cloud(cloud)), name, name));
}

std::vector<Recognized> recognize_objects(const shortshot::Recognizer& recognizer, const ObjectFeatures& features,
                                          unsigned threads) {
  std::vector<shortshot::Hypothesis> hypotheses;
  require(recognize(recognizer, features, hypotheses, threads));
  const Votes votes(recognizer, features, threads);
  const Places places = votes.places(radius_of(recognizer));
  std::vector<Recognized> out;
  for (const shortshot::Hypothesis& h : hypotheses) {
    Recognized r{h, votes.voters_for(h), {}, 0.0};
    r.at = agreement_at(places, votes.numbers_of(r.voters), votes.agreement_by_chance(h), 1);
    // Any vote may be where a hypothesis is; its place counts for nothing then.
    r.log10_expected =
        std::log10(static_cast<double>(std::max<std::size_t>(1, features.size()))) + r.at.log10_probability;
    out.push_back(r);
  }
  return out;
}

}  // namespace shortshot_bench
