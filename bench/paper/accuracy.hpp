// Accuracies of recognition from a journal's results.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "paper/campaign/statistics.hpp"
#include "paper/experiment.hpp"
#include "paper/recognition.hpp"

namespace shortshot_bench::paper {

/// Judgements of the same views in the same order for each descriptor.
struct TaskResults {
  std::string name;
  std::map<std::string, std::vector<Judgement>> of;  // by descriptor
};

std::vector<TaskResults> tasks_of(const nlohmann::ordered_json& parameters, const UnitResults& results);

/// 1 where a recognizer is right, else 0.
using Correct = double (*)(const Judgement&);
double hough_class(const Judgement& j);
double hough_instance(const Judgement& j);
double nearest_class(const Judgement& j);
double nearest_instance(const Judgement& j);

struct NamedFigure {
  const char* name;
  Correct correct;
};

/// One value for each view, grouped by the object that it shows: what a bootstrap over objects takes.
using ByObject = std::vector<std::vector<double>>;

ByObject correct(const std::vector<Judgement>& judgements, Correct correct);

/// View by view, a - b; the mean of several.
ByObject difference(const ByObject& a, const ByObject& b);
ByObject mean(const std::vector<ByObject>& several);

campaign::Interval over_objects(const ByObject& values);

}  // namespace shortshot_bench::paper
