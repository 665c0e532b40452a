// match_pairs: how often match finds what is there, and what is not: over pairs of real clouds with the true motion,
// and pairs that have nothing in common.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "tools/io/view_of_cloud.hpp"
#include "tools/match/match.hpp"
#include "tools/match_pairs/pairs.hpp"

namespace {

using namespace shortshot_bench;

struct Options {
  std::vector<std::string> data;
  std::size_t count = 50;
  double most_degrees = 45.0;
  double tolerance = 0.03;
  double max_depth = 3.0;
  MatchOptions match;
};

struct Tally {
  int pairs = 0;
  int right = 0;  // found where the truth has it
  int wrong = 0;  // found elsewhere, or what is not there
};

struct Errors {
  double degrees, meters;
};

shortshot::Pose pose_of(const datasets::RigidMotion& motion) {
  shortshot::Pose pose{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t k = 0; k < 3; ++k) pose.rotation[3 * row + k] = static_cast<float>(motion[4 * row + k]);
    pose.translation[row] = static_cast<float>(motion[4 * row + 3]);
  }
  return pose;
}

/// How far the key points of b are from where the truth has them, on the mean; and the angle between both rotations.
Errors errors_of(const MatchResult& result, const shortshot::Pose& truth) {
  double meters = 0.0;
  for (const shortshot::Point& p : result.b) {
    const float d2 = shortshot::squared_distance(transform_point(result.pose, p), transform_point(truth, p));
    meters += std::sqrt(static_cast<double>(d2)) / static_cast<double>(result.b.size());
  }
  return {degrees_between(truth, result.pose), meters};
}

void try_pair(const std::vector<datasets::PairSet>& sets, const PairToTry& pair, const Options& options, Tally& tally,
              std::vector<Errors>& errors) {
  const RgbdCloud source = sets[pair.source.set].load_cloud(pair.source.cloud);
  const RgbdCloud target = sets[pair.target.set].load_cloud(pair.target.cloud);
  const MatchResult result = match_clouds(target, source, options.match);
  ++tally.pairs;
  std::string outcome = "not found";
  if (result.is_found && pair.is_right) {
    const shortshot::Pose truth = pose_of(pair.truth);
    const Errors e = errors_of(result, truth);
    const bool is_right = e.meters <= options.tolerance;
    ++(is_right ? tally.right : tally.wrong);
    if (is_right) errors.push_back(e);
    const Fit at_truth = fit_under(view_of_cloud(source), view_of_cloud(target), truth, refine_options_of(result));
    char text[120];
    std::snprintf(text, sizeof text, "found, fit %.2f (the truth's %.2f), off by %.2f deg, %.1f mm%s",
                  static_cast<double>(result.fit.share), static_cast<double>(at_truth.share), e.degrees, 1e3 * e.meters,
                  is_right ? "" : ": ELSEWHERE");
    outcome = text;
  } else if (result.is_found) {
    ++tally.wrong;
    outcome = "found: WRONG";
  }
  std::printf("%-5s %-34s %5.1f deg  %4zu of %4zu pairs, %2zu of %3zu places, 10^%.1f by chance: %s\n",
              pair.is_right ? "right" : "wrong", pair.name.c_str(), pair.rotation_deg, result.inliers.size(),
              result.rows.size(), result.chance.at.any, result.chance.at.places, result.chance.log10_expected,
              outcome.c_str());
  std::fflush(stdout);
}

double median(std::vector<Errors> errors, double Errors::*of) {
  if (errors.empty()) return 0.0;
  const auto half = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), half, errors.end(), [&](const Errors& a, const Errors& b) { return a.*of < b.*of; });
  return (*half).*of;
}

void run(const Options& options) {
  std::vector<datasets::PairSet> sets;
  for (const std::string& folder : options.data) {
    for (datasets::PairSet& set : datasets::open_pair_sets(folder, options.max_depth)) sets.push_back(std::move(set));
  }
  if (sets.empty()) throw std::runtime_error(std::string("none of the folders holds ") + datasets::looked_for_pairs);
  Tally right, wrong;
  std::vector<Errors> errors;
  for (const PairToTry& pair : right_pairs(sets, options.count, options.most_degrees)) {
    try_pair(sets, pair, options, right, errors);
  }
  for (const PairToTry& pair : wrong_pairs(sets, options.count)) try_pair(sets, pair, options, wrong, errors);
  std::printf("\n%-28s %6s %14s %16s %10s\n", "", "pairs", "found, right", "elsewhere", "not found");
  std::printf("%-28s %6d %14d %16d %10d\n", "the same object or place", right.pairs, right.right, right.wrong,
              right.pairs - right.right - right.wrong);
  std::printf("%-28s %6d %14s %16d %10d\n", "nothing in common", wrong.pairs, "-", wrong.wrong,
              wrong.pairs - wrong.wrong);
  std::printf("found, right: within %g m; median error %.2f degrees, %.1f mm\n", options.tolerance,
              median(errors, &Errors::degrees), 1e3 * median(errors, &Errors::meters));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("How often match finds what is there, and what is not.");
  app.name("match_pairs");
  app.add_option("data", options.data, std::string("folders with ") + datasets::looked_for_pairs)->required();
  app.add_option("--pairs", options.count, "right ones, and as many wrong ones")->capture_default_str();
  app.add_option("--most-degrees", options.most_degrees, "between the views of a right pair")->capture_default_str();
  app.add_option("--tolerance", options.tolerance, "mean distance in meters from the true places, of a right pose")
      ->capture_default_str();
  app.add_option("--max-depth", options.max_depth, "of frames, meters")->capture_default_str();
  app.add_option("--expected", options.match.expected, "as match has it")->capture_default_str();
  app.add_option("--threads", options.match.threads, "threads")->check(CLI::Range(1, 256))->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
