// What was counted: how often each entry of the map was right.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "paper/campaign/statistics.hpp"
#include "paper/experiment.hpp"

namespace shortshot_bench::tradeoff {

/// One pair of views, or one view, with what was right of how much for each entry.
struct Item {
  std::string measure;  // "apc_shelf views, R 45 mm"
  std::string name;
  std::string group;  // items of one group share a cloud or an object
  std::map<std::string, campaign::Fraction> counts;
};

nlohmann::ordered_json to_json(const std::vector<Item>& items);
std::vector<Item> items_of(const nlohmann::ordered_json& json);

/// What a measure is about.
enum class Figure { match_rate, inlier_ratio, right_instance, hough_instance };

struct MeasureInfo {
  std::string name;
  Figure figure;
  std::string baseline;  // the entry that others are compared with
  bool scored;           // it counts in an entry's score
  std::string at_rest;   // the measure to compare with, under the same light; empty: none
};

/// All items of a measure, in the order in which they were first met.
struct Measure {
  MeasureInfo info;
  std::vector<Item> items;

  bool has(const std::string& entry) const;
  double pooled(const std::string& entry) const;  ///< right of all
  /// The same with its interval.
  campaign::Interval share(const std::string& entry) const;
  /// The one's share over the other's; the interval, by groups, is paired. Both must have() counts.
  campaign::Interval ratio(const std::string& entry, const std::string& baseline) const;
  /// The one's share less the other's, item by item.
  campaign::Interval difference(const std::string& entry, const std::string& baseline) const;

 private:
  campaign::Interval paired(const std::string& entry, const std::string& baseline,
                            campaign::Fraction (*combine)(const campaign::Fraction&, const campaign::Fraction&)) const;
};

void to_json(nlohmann::ordered_json& json, const MeasureInfo& info);
void from_json(const nlohmann::ordered_json& json, MeasureInfo& info);

/// The measures of the parameters, with the results' items.
std::vector<Measure> measures_of(const nlohmann::ordered_json& parameters, const paper::UnitResults& results);

}  // namespace shortshot_bench::tradeoff
