#include "paper/registration.hpp"

#include <algorithm>

namespace shortshot_bench::paper {
namespace {

Registration register_rows(const Described& source, const Described& target, const MatchingSettings& settings,
                           const MotionTruth& truth) {
  const ReciprocalMatches matches = match_reciprocally(source, target, truth);
  Registration registration;
  registration.reciprocal = matches.pairs.size();
  registration.correct = matches.right;
  registration.trials =
      estimate_poses(matches.pairs, {settings.iterations, settings.inlier_distance, settings.seeds}, truth);
  registration.curve = ratio_curve(source, target, truth);
  return registration;
}

}  // namespace

double Registration::inlier_ratio() const {
  return reciprocal == 0 ? 0.0 : static_cast<double>(correct) / static_cast<double>(reciprocal);
}

double Registration::within(double degrees, double meters) const {
  const auto near = std::count_if(trials.begin(), trials.end(), [&](const Trial& t) {
    return t.found && t.rotation_deg < degrees && t.translation_m < meters;
  });
  return trials.empty() ? 0.0 : static_cast<double>(near) / static_cast<double>(trials.size());
}

std::vector<Registration> register_pair(const datasets::ViewPair& pair, const MatchingSettings& settings,
                                        const std::vector<Contender>& contenders) {
  const View source(pair.source, settings.source);
  const View target(pair.target, settings.target);
  const MotionTruth truth(pair.truth, source, target, settings.correct_distance);
  const auto keypoints = static_cast<double>(source.keypoints().size() + target.keypoints().size());
  std::vector<Registration> registrations;
  for (const Contender& contender : contenders) {
    if (contender.needs_colors && !(source.has_colors() && target.has_colors())) continue;
    const TimedRows of_source = contender.describe(source);
    const TimedRows of_target = contender.describe(target);
    for (const Form& form : contender.forms) {
      Registration& r = registrations.emplace_back(
          register_rows(form.code(of_source.rows), form.code(of_target.rows), settings, truth));
      r.descriptor = form.name;
      r.size_bytes = form.size_bytes(of_source.rows);
      r.microseconds = (of_source.microseconds + of_target.microseconds) / keypoints;
    }
  }
  return registrations;
}

nlohmann::ordered_json to_json(const std::vector<Registration>& registrations) {
  auto list = nlohmann::ordered_json::array();
  for (const Registration& r : registrations) {
    list.push_back({{"descriptor", r.descriptor},
                    {"size_bytes", r.size_bytes},
                    {"microseconds", r.microseconds},
                    {"reciprocal", r.reciprocal},
                    {"correct", r.correct},
                    {"trials", to_json(r.trials)},
                    {"curve", to_json(r.curve)}});
  }
  return list;
}

std::vector<Registration> registrations_of(const nlohmann::ordered_json& json) {
  std::vector<Registration> registrations;
  for (const auto& r : json) {
    registrations.push_back({r.at("descriptor"), r.at("size_bytes"), r.at("microseconds"), r.at("reciprocal"),
                             r.at("correct"), trials_of(r.at("trials")), ratio_curve_of(r.at("curve"))});
  }
  return registrations;
}

}  // namespace shortshot_bench::paper
