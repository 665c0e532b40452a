#include "tools/match_pairs/pairs.hpp"

#include <algorithm>
#include <cctype>
#include <set>

namespace shortshot_bench {
namespace {

using datasets::PairSet;

/// From each list in turn, until there are `count`.
std::vector<PairToTry> in_turn(const std::vector<std::vector<PairToTry>>& lists, std::size_t count) {
  std::vector<std::vector<PairToTry>> chosen(lists.size());
  std::vector<std::size_t> shares(lists.size(), 0);
  for (bool grows = true; grows && count > 0;) {
    grows = false;
    for (std::size_t i = 0; i < lists.size() && count > 0; ++i) {
      if (shares[i] == lists[i].size()) continue;
      ++shares[i];
      --count;
      grows = true;
    }
  }
  std::vector<PairToTry> all;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    for (std::size_t k = 0; k < shares[i]; ++k) all.push_back(lists[i][k * lists[i].size() / shares[i]]);
  }
  return all;
}

std::string first_word(const std::string& name) { return name.substr(0, name.find(' ')); }
std::string last_word(const std::string& name) { return name.substr(name.rfind(' ') + 1); }
std::string letters_of(const std::string& word) { return word.substr(0, word.find_first_of("0123456789-_")); }

/// What the source of a pair shows, and the target.
std::string source_subject(const PairSet& set, std::size_t pair) {
  const std::string& name = set.pair_names[pair];
  return set.name == "object-scene" ? last_word(name) : letters_of(first_word(name));
}
std::string target_subject(const PairSet& set, std::size_t pair) {
  const std::string& name = set.pair_names[pair];
  return set.name == "object-scene" ? first_word(name) : letters_of(last_word(name));
}

PairToTry wrong_pair(const std::vector<PairSet>& sets, std::size_t s, std::size_t i, std::size_t t, std::size_t j) {
  return {source_subject(sets[s], i) + " " + std::to_string(i) + " / " + target_subject(sets[t], j) + " " +
              std::to_string(j),
          {s, sets[s].sources[i]},
          {t, sets[t].targets[j]},
          false,
          {},
          0.0};
}

/// "PeterRabbit" and "peterrabbit" are the same.
bool same_subject(const std::string& a, const std::string& b) {
  const auto same = [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

/// Sources of a set, each with a target of another, none of the same name.
std::vector<PairToTry> wrong_between(const std::vector<PairSet>& sets, std::size_t s, std::size_t t) {
  std::vector<PairToTry> wrong;
  for (std::size_t i = 0; i < sets[s].size(); ++i) {
    std::size_t j = i * sets[t].size() / sets[s].size();
    std::size_t tries = 0;
    for (; tries < sets[t].size(); ++tries, j = (j + 1) % sets[t].size()) {
      if (!same_subject(source_subject(sets[s], i), target_subject(sets[t], j))) break;
    }
    if (tries < sets[t].size()) wrong.push_back(wrong_pair(sets, s, i, t, j));
  }
  return wrong;
}

/// Sources with targets of the same set in which they are not.
std::vector<PairToTry> wrong_within(const std::vector<PairSet>& sets, std::size_t s) {
  const PairSet& set = sets[s];
  std::set<std::pair<std::string, std::string>> together;  // subjects that some pair has
  for (std::size_t i = 0; i < set.size(); ++i) together.insert({source_subject(set, i), target_subject(set, i)});
  std::set<std::pair<std::size_t, std::size_t>> known;  // clouds
  std::vector<PairToTry> wrong;
  for (std::size_t i = 0; i < set.size(); ++i) {
    for (std::size_t k = 1; k < set.size(); ++k) {
      const std::size_t j = (i + k) % set.size();
      if (together.count({source_subject(set, i), target_subject(set, j)}) > 0) continue;
      if (known.insert({set.sources[i], set.targets[j]}).second) wrong.push_back(wrong_pair(sets, s, i, s, j));
    }
  }
  return wrong;
}

}  // namespace

std::vector<PairToTry> right_pairs(const std::vector<PairSet>& sets, std::size_t count, double most_degrees) {
  std::vector<std::vector<PairToTry>> lists;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    lists.emplace_back();
    for (const std::size_t i : every_nth_by_rotation(sets[s], 1)) {
      if (sets[s].rotation_deg[i] > most_degrees) continue;
      lists.back().push_back({sets[s].pair_names[i],
                              {s, sets[s].sources[i]},
                              {s, sets[s].targets[i]},
                              true,
                              sets[s].truths[i],
                              sets[s].rotation_deg[i]});
    }
  }
  return in_turn(lists, count);
}

std::vector<PairToTry> wrong_pairs(const std::vector<PairSet>& sets, std::size_t count) {
  std::vector<std::vector<PairToTry>> lists;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    lists.push_back(wrong_within(sets, s));
    if (sets.size() > 1) lists.push_back(wrong_between(sets, s, (s + 1) % sets.size()));
  }
  return in_turn(lists, count);
}

}  // namespace shortshot_bench
