#include "tradeoff/items.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "paper/claims.hpp"

namespace shortshot_bench::tradeoff {
namespace {

using campaign::Fraction;
using campaign::Interval;

/// What `of` makes of each item, by groups.
template <class Value>
std::vector<std::vector<Value>> by_group(const std::vector<Item>& items, const std::function<Value(const Item&)>& of) {
  std::map<std::string, std::size_t> places;
  std::vector<std::vector<Value>> groups;
  for (const Item& item : items) {
    const auto [place, is_new] = places.emplace(item.group, groups.size());
    if (is_new) groups.emplace_back();
    groups[place->second].push_back(of(item));
  }
  return groups;
}

}  // namespace

nlohmann::ordered_json to_json(const std::vector<Item>& items) {
  auto list = nlohmann::ordered_json::array();
  for (const Item& item : items) {
    nlohmann::ordered_json counts;
    for (const auto& [entry, count] : item.counts) counts[entry] = {count.numerator, count.denominator};
    list.push_back({{"measure", item.measure}, {"name", item.name}, {"group", item.group}, {"counts", counts}});
  }
  return list;
}

std::vector<Item> items_of(const nlohmann::ordered_json& json) {
  std::vector<Item> items;
  for (const auto& j : json) {
    Item item{j.at("measure"), j.at("name"), j.at("group"), {}};
    for (const auto& [entry, count] : j.at("counts").items()) item.counts[entry] = {count.at(0), count.at(1)};
    items.push_back(std::move(item));
  }
  return items;
}

bool Measure::has(const std::string& entry) const {
  return !items.empty() &&
         std::all_of(items.begin(), items.end(), [&](const Item& item) { return item.counts.count(entry) != 0; });
}

double Measure::pooled(const std::string& entry) const {
  Fraction sum;
  for (const Item& item : items) {
    sum.numerator += item.counts.at(entry).numerator;
    sum.denominator += item.counts.at(entry).denominator;
  }
  return sum.numerator / sum.denominator;
}

Interval Measure::share(const std::string& entry) const {
  const auto count = [&](const Item& item) { return item.counts.at(entry); };
  return campaign::bootstrap_ratio(by_group<Fraction>(items, count), paper::bootstrap_seed);
}

Interval Measure::paired(const std::string& entry, const std::string& baseline,
                         Fraction (*combine)(const Fraction& one, const Fraction& other)) const {
  const auto count = [&](const Item& item) {
    const Fraction& one = item.counts.at(entry);
    const Fraction& other = item.counts.at(baseline);
    if (one.denominator != other.denominator) throw std::logic_error(info.name + ": not counted of the same");
    return combine(one, other);
  };
  return campaign::bootstrap_ratio(by_group<Fraction>(items, count), paper::bootstrap_seed);
}

Interval Measure::ratio(const std::string& entry, const std::string& baseline) const {
  return paired(entry, baseline, [](const Fraction& one, const Fraction& other) {
    return Fraction{one.numerator, other.numerator};
  });
}

Interval Measure::difference(const std::string& entry, const std::string& baseline) const {
  return paired(entry, baseline, [](const Fraction& one, const Fraction& other) {
    return Fraction{one.numerator - other.numerator, one.denominator};
  });
}

void to_json(nlohmann::ordered_json& json, const MeasureInfo& info) {
  json = {{"name", info.name},
          {"figure", static_cast<int>(info.figure)},
          {"baseline", info.baseline},
          {"scored", info.scored},
          {"at_rest", info.at_rest}};
}

void from_json(const nlohmann::ordered_json& json, MeasureInfo& info) {
  info = {json.at("name"), static_cast<Figure>(json.at("figure").get<int>()), json.at("baseline"), json.at("scored"),
          json.at("at_rest")};
}

std::vector<Measure> measures_of(const nlohmann::ordered_json& parameters, const paper::UnitResults& results) {
  std::vector<Measure> measures;
  std::map<std::string, std::size_t> place_of;
  for (const auto& info : parameters.at("measures")) {
    place_of[info.at("name")] = measures.size();
    measures.push_back({info.get<MeasureInfo>(), {}});
  }
  std::map<std::pair<std::string, std::string>, std::size_t> seen;
  for (const campaign::UnitResult& result : results) {
    for (Item& item : items_of(result.result)) {
      std::vector<Item>& items = measures[place_of.at(item.measure)].items;
      const auto [place, is_new] = seen.emplace(std::pair(item.measure, item.name), items.size());
      if (is_new) {
        items.push_back(std::move(item));
      } else {
        items[place->second].counts.merge(item.counts);
      }
    }
  }
  return measures;
}

}  // namespace shortshot_bench::tradeoff
