#include "speed/peers/measure.hpp"

#include <algorithm>
#include <utility>

#include "speed/peers/timing.hpp"

namespace shortshot_bench::peers {
namespace {

constexpr double long_step_ms = 3000.0;

using SuiteSamples = std::vector<Samples>;  // one per step

void sample(const Step& step, Samples& samples) {
  if (samples.taken() > 0 && samples.last_ms() > long_step_ms) return;
  const double rate_before = add_rate();
  const long preemptions_before = preemptions();
  const double start = now_seconds(step.clock);
  step.run();
  const double ms = 1e3 * (now_seconds(step.clock) - start);
  // CPU time stands still while another process has the core; wall time does not.
  const bool waited = step.clock == Clock::wall && preemptions() > preemptions_before;
  samples.add(ms, waited ? 0.0 : std::min(rate_before, add_rate()));
}

/// Of a cold start. Its steps are sampled too.
std::size_t peak_of_frame(const Suite& suite, const Contender& contender, const MeasurePeak& measure_peak,
                          SuiteSamples& samples) {
  suite.release();
  const std::size_t peak = measure_peak([&] {
    for (const std::size_t step : contender.frame) sample(suite.steps[step], samples[step]);
  });
  suite.release();
  return peak - std::min(peak, contender.output_bytes);
}

MeasuredContender sum_up(const Task& task, const Contender& contender, const SuiteSamples& samples, double least_rate) {
  MeasuredContender measured{contender};
  const Samples& describing = samples[contender.describe];
  const std::size_t made = contender.made > 0 ? contender.made : task.keypoints.size();
  measured.us_per_keypoint = 1e3 * describing.median_ms(least_rate) / static_cast<double>(made);
  for (const std::size_t step : contender.frame) measured.frame_ms += samples[step].median_ms(least_rate);
  measured.kept = describing.kept(least_rate);
  measured.taken = describing.taken();
  return measured;
}

}  // namespace

CloudResult measure(const Task& task, const std::vector<Suite>& suites, int rounds, const MeasurePeak& measure_peak) {
  std::vector<std::size_t> peaks;
  std::vector<SuiteSamples> samples;
  for (const Suite& suite : suites) {
    samples.emplace_back(suite.steps.size());
    for (const Contender& contender : suite.contenders) {
      peaks.push_back(peak_of_frame(suite, contender, measure_peak, samples.back()));
    }
    for (Samples& of_step : samples.back()) {  // a warm-up, but for what takes too long to be repeated
      if (of_step.taken() > 0 && of_step.last_ms() <= long_step_ms) of_step = {};
    }
  }

  for (int round = 0; round < rounds; ++round) {
    for (std::size_t turn = 0; turn < suites.size(); ++turn) {  // another one begins each round
      const std::size_t i = (turn + static_cast<std::size_t>(round)) % suites.size();
      for (std::size_t k = 0; k < suites[i].steps.size(); ++k) sample(suites[i].steps[k], samples[i][k]);
    }
  }

  double best_rate = 0.0;
  for (const SuiteSamples& of_suite : samples) {
    for (const Samples& of_step : of_suite) best_rate = std::max(best_rate, of_step.best_rate());
  }
  const double least_rate = undisturbed * best_rate;

  CloudResult result{task.cloud,
                     task.points.size(),
                     task.keypoints.size(),
                     static_cast<double>(task.radius),
                     static_cast<double>(task.leaf),
                     task.mean_neighbors};
  auto peak = peaks.begin();
  for (std::size_t i = 0; i < suites.size(); ++i) {
    for (std::size_t k = 0; k < samples[i].size(); ++k) {
      const Samples& s = samples[i][k];
      result.steps[suites[i].name + ": " + suites[i].steps[k].name] = {s.median_ms(least_rate), s.kept(least_rate),
                                                                       s.taken()};
      result.kept += s.kept(least_rate);
      result.taken += s.taken();
    }
    for (const Contender& contender : suites[i].contenders) {
      result.contenders.push_back(sum_up(task, contender, samples[i], least_rate));
      result.contenders.back().peak_bytes = *peak++;
    }
  }
  return result;
}

}  // namespace shortshot_bench::peers
