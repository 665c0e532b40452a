#include "tradeoff/views.hpp"

#include <cstdint>

namespace shortshot_bench::tradeoff {
namespace {

using paper::Described;

/// The rows of several views, and the view that each is of.
struct Rows {
  Described described;
  std::vector<std::size_t> view;
};

Rows rows_of(const std::vector<Described>& of_views, const std::vector<std::size_t>& chosen) {
  Rows rows;
  for (const std::size_t i : chosen) {
    const Described& d = of_views[i];
    rows.described.size = d.size;
    rows.described.values.insert(rows.described.values.end(), d.values.begin(), d.values.end());
    rows.described.status.insert(rows.described.status.end(), d.status.begin(), d.status.end());
    rows.view.insert(rows.view.end(), d.status.size(), i);
  }
  return rows;
}

shortshot::DescriptorRows descriptors_of(const Rows& rows) {
  return {rows.described.values.data(), rows.view.size(), rows.described.size, rows.described.status.data()};
}

std::vector<Item> items_without_counts(const paper::RecognitionTask& task, const std::string& measure) {
  std::vector<Item> items;
  for (const paper::RecognitionView& v : task.views) {
    items.push_back({measure, v.name, v.label.object_class + "/" + v.label.instance, {}});
  }
  return items;
}

void count_fold(const paper::RecognitionTask& task, const std::vector<Described>& described, const paper::Fold& fold,
                const std::string& entry, std::vector<Item>& items) {
  const Rows test = rows_of(described, fold.test);
  const Rows training = rows_of(described, fold.training);
  std::vector<shortshot::Match> nearest;
  require(shortshot::nearest(descriptors_of(test), descriptors_of(training), 1, nearest));
  for (std::size_t row = 0; row < nearest.size(); ++row) {
    campaign::Fraction& count = items[test.view[row]].counts[entry];
    count.denominator += 1.0;
    if (nearest[row].row == shortshot::no_row) continue;
    const paper::ObjectLabel& truth = task.views[test.view[row]].label;
    const paper::ObjectLabel& found = task.views[training.view[nearest[row].row]].label;
    if (found.object_class == truth.object_class && found.instance == truth.instance) count.numerator += 1.0;
  }
}

std::vector<Item> with_counts(std::vector<Item> items) {
  std::vector<Item> counted;
  for (Item& item : items) {
    if (!item.counts.empty()) counted.push_back(std::move(item));
  }
  return counted;
}

}  // namespace

std::vector<Item> count_right_instances(const paper::RecognitionTask& task, const paper::Views& views,
                                        const std::string& measure, const Candidate& candidate) {
  std::vector<Described> described;
  for (std::size_t i = 0; i < task.views.size(); ++i) described.push_back(views[i].describe(candidate.configuration));
  std::vector<Item> items = items_without_counts(task, measure);
  for (const Storage& storage : candidate.storages) {
    std::vector<Described> codes;
    for (const Described& d : described) codes.push_back(coded(d, storage));
    for (const paper::Fold& fold : paper::folds_of(task)) {
      count_fold(task, codes, fold, entry_name(candidate, storage), items);
    }
  }
  return with_counts(std::move(items));
}

std::vector<Item> count_hough_instances(const paper::RecognitionTask& task, const paper::Views& views,
                                        const std::string& measure, const Candidate& candidate) {
  std::vector<Item> items = items_without_counts(task, measure);
  paper::RecognitionSettings settings;
  settings.nearest_votes = false;
  for (const Storage& storage : candidate.storages) {
    paper::Configuration of_codes = candidate.configuration;
    of_codes.describe = [&](const auto&... arguments) {
      return coded(candidate.configuration.describe(arguments...), storage);
    };
    for (const paper::Prediction& p : paper::recognize_views(task, views, of_codes, settings)) {
      const bool right = p.hough.instance == task.views[p.view].label.instance &&
                         p.hough.object_class == task.views[p.view].label.object_class;
      items[p.view].counts[entry_name(candidate, storage)] = {right ? 1.0 : 0.0, 1.0};
    }
  }
  return with_counts(std::move(items));
}

}  // namespace shortshot_bench::tradeoff
