#include "paper/accuracy.hpp"

#include "paper/claims.hpp"

namespace shortshot_bench::paper {

std::vector<TaskResults> tasks_of(const nlohmann::ordered_json& parameters, const UnitResults& results) {
  std::map<std::string, const nlohmann::ordered_json*> of_unit;
  for (const campaign::UnitResult& r : results) of_unit[r.key] = &r.result;
  std::vector<TaskResults> tasks;
  for (const auto& [name, descriptors] : parameters.at("tasks").items()) {
    TaskResults task{name, {}};
    for (const auto& [descriptor, keys] : descriptors.items()) {
      std::vector<Judgement>& all = task.of[descriptor];
      for (const auto& key : keys) {
        for (const Judgement& j : judgements_of(*of_unit.at(key))) all.push_back(j);
      }
    }
    tasks.push_back(task);
  }
  return tasks;
}

namespace {

bool same_class(const ObjectLabel& a, const ObjectLabel& b) { return a.object_class == b.object_class; }
bool same_object(const ObjectLabel& a, const ObjectLabel& b) { return same_class(a, b) && a.instance == b.instance; }

}  // namespace

double hough_class(const Judgement& j) { return same_class(j.hough, j.truth) ? 1.0 : 0.0; }
double hough_instance(const Judgement& j) { return same_object(j.hough, j.truth) ? 1.0 : 0.0; }
double nearest_class(const Judgement& j) { return same_class(j.nearest, j.truth) ? 1.0 : 0.0; }
double nearest_instance(const Judgement& j) { return j.nearest.instance == j.truth.instance ? 1.0 : 0.0; }

ByObject correct(const std::vector<Judgement>& judgements, Correct correct) {
  std::map<std::pair<std::string, std::string>, std::vector<double>> groups;
  for (const Judgement& j : judgements) groups[{j.truth.object_class, j.truth.instance}].push_back(correct(j));
  ByObject values;
  for (const auto& group : groups) values.push_back(group.second);
  return values;
}

ByObject difference(const ByObject& a, const ByObject& b) {
  ByObject result = a;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < a[i].size(); ++k) result[i][k] -= b[i][k];
  }
  return result;
}

ByObject mean(const std::vector<ByObject>& several) {
  ByObject result = several.front();
  for (std::size_t i = 0; i < result.size(); ++i) {
    for (std::size_t k = 0; k < result[i].size(); ++k) {
      for (std::size_t n = 1; n < several.size(); ++n) result[i][k] += several[n][i][k];
      result[i][k] /= static_cast<double>(several.size());
    }
  }
  return result;
}

campaign::Interval over_objects(const ByObject& values) {
  return campaign::bootstrap(values, campaign::Statistic::mean, bootstrap_seed);
}

}  // namespace shortshot_bench::paper
