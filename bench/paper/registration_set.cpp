#include "paper/registration_set.hpp"

#include <algorithm>
#include <optional>

#include "paper/claims.hpp"

namespace shortshot_bench::paper {
namespace {

/// `of_pair(place)`: a pair's value.
template <class OfPair>
campaign::Interval mean_over_groups(const RegistrationSet& set, const OfPair& of_pair) {
  std::vector<std::vector<double>> groups;
  for (const std::vector<std::size_t>& group : set.groups) {
    std::vector<double>& values = groups.emplace_back();
    for (const std::size_t pair : group) values.push_back(of_pair(pair));
  }
  return campaign::bootstrap(groups, campaign::Statistic::mean, bootstrap_seed);
}

/// Places of the pairs by their groups' names.
std::vector<std::vector<std::size_t>> groups_of(const nlohmann::ordered_json& pairs) {
  std::map<std::string, std::size_t> numbers;
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto [place, is_new] = numbers.try_emplace(pairs[i].at("group").get<std::string>(), groups.size());
    if (is_new) groups.emplace_back();
    groups[place->second].push_back(i);
  }
  return groups;
}

}  // namespace

const FormResults* RegistrationSet::floats_of(const std::string& method) const {
  const auto place = std::find_if(forms.begin(), forms.end(), [&](const FormResults& f) { return f.name == method; });
  return place == forms.end() ? nullptr : &*place;
}

std::vector<RegistrationSet> registration_sets(const nlohmann::ordered_json& parameters, const UnitResults& results) {
  std::map<std::string, std::vector<Registration>> of_unit;
  for (const campaign::UnitResult& r : results) of_unit[r.key] = registrations_of(r.result);
  std::vector<RegistrationSet> sets;
  for (const auto& json : parameters.at("sets")) {
    RegistrationSet& set = sets.emplace_back();
    set.name = json.at("name");
    set.groups = groups_of(json.at("pairs"));
    std::map<std::string, std::vector<Registration>> of_form;
    for (const auto& pair : json.at("pairs")) {
      set.rotation_deg.push_back(pair.at("rotation_deg"));
      for (const Registration& r : of_unit.at(pair.at("key"))) of_form[r.descriptor].push_back(r);
    }
    for (const auto& d : parameters.at("descriptors")) {
      const auto form = of_form.find(d.at("name"));
      if (form != of_form.end()) set.forms.push_back({form->first, d.at("method"), form->second});
    }
  }
  return sets;
}

campaign::Interval mean_of(const RegistrationSet& set, const FormResults& form, const PairFigure& figure) {
  return mean_over_groups(set, [&](std::size_t pair) { return figure.of(form.pairs[pair]); });
}

campaign::Interval difference_of(const RegistrationSet& set, const FormResults& a, const FormResults& b,
                                 const PairFigure& figure) {
  return mean_over_groups(set, [&](std::size_t pair) { return figure.of(a.pairs[pair]) - figure.of(b.pairs[pair]); });
}

RatioCurve curve_of(const FormResults& form) {
  RatioCurve sum;
  for (const Registration& r : form.pairs) sum += r.curve;
  return sum;
}

campaign::Interval area_of(const RegistrationSet& set, const FormResults& form) {
  std::vector<RatioCurve> of_groups;
  for (const std::vector<std::size_t>& group : set.groups) {
    RatioCurve& sum = of_groups.emplace_back();
    for (const std::size_t pair : group) sum += form.pairs[pair].curve;
  }
  const auto area = [&](const std::vector<std::size_t>& drawn) -> std::optional<double> {
    RatioCurve sum;
    for (const std::size_t group : drawn) sum += of_groups[group];
    return sum.area();
  };
  return campaign::bootstrap_of(of_groups.size(), area, bootstrap_seed);
}

}  // namespace shortshot_bench::paper
