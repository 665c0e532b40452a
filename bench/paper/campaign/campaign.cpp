#include "paper/campaign/campaign.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>

#include "paper/campaign/progress.hpp"

namespace shortshot_bench::campaign {
namespace {

void refuse_repeated_keys(const std::vector<Unit>& units) {
  std::set<std::string> keys;
  for (const Unit& unit : units) {
    if (!keys.insert(unit.key).second) throw std::invalid_argument("two units have the key '" + unit.key + "'");
  }
}

/// Runs units and records them, from several threads.
class Recorder {
 public:
  Recorder(Journal& journal, Progress& progress) : journal_(journal), progress_(progress) {}

  void run(const Unit& unit) {
    try {
      const nlohmann::ordered_json result = unit.run();
      const std::lock_guard<std::mutex> one_at_a_time(mutex_);
      journal_.append(unit.key, result);
      progress_.finished(unit.key);
    } catch (const std::exception& error) {
      throw std::runtime_error(unit.key + ": " + error.what());
    }
  }

 private:
  Journal& journal_;
  Progress& progress_;
  std::mutex mutex_;
};

/// Each unit is a task of its own: they may take very different times. An exception ends what is not yet begun.
void run_all(const std::vector<const Unit*>& units, Recorder& recorder, unsigned threads) {
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads));
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, units.size(), 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t i = range.begin(); i != range.end(); ++i) recorder.run(*units[i]);
        },
        tbb::simple_partitioner());
  });
}

}  // namespace

void run_campaign(const std::vector<Unit>& units, const nlohmann::ordered_json& parameters,
                  const std::string& directory, Shard shard, unsigned threads, std::FILE* progress) {
  refuse_repeated_keys(units);
  Journal journal(directory, parameters);
  std::vector<const Unit*> waiting;
  std::size_t done = 0;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (!shard.contains(i)) continue;
    if (journal.has(units[i].key)) {
      ++done;
    } else {
      waiting.push_back(&units[i]);
    }
  }
  const unsigned at_work = threads == 0 ? static_cast<unsigned>(tbb::this_task_arena::max_concurrency()) : threads;
  Progress shown(progress, done + waiting.size(), done, at_work);
  Recorder recorder(journal, shown);
  run_all(waiting, recorder, threads);
}

Results results_of(const JournalContent& content, const std::vector<std::string>& keys) {
  Results results;
  for (const std::string& key : keys) {
    const auto found = content.results.find(key);
    if (found == content.results.end()) {
      results.missing.push_back(key);
    } else {
      results.finished.push_back({key, found->second});
    }
  }
  return results;
}

Results read_results(const std::string& directory, const std::vector<Unit>& units,
                     const nlohmann::ordered_json& parameters) {
  const std::optional<JournalContent> content = read_journal(directory);
  if (content) check_parameters(directory, content->parameters, parameters);
  std::vector<std::string> keys;
  for (const Unit& unit : units) keys.push_back(unit.key);
  return results_of(content.value_or(JournalContent{}), keys);
}

}  // namespace shortshot_bench::campaign
