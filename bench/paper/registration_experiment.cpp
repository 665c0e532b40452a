#include "paper/registration_experiment.hpp"

#include <set>
#include <stdexcept>

#include "paper/pair_units.hpp"
#include "paper/registration.hpp"

namespace shortshot_bench::paper {

Experiment registration_experiment(const PaperOptions& options) {
  std::vector<Contender> contenders = contenders_named(options.descriptors);
  for (const std::string& peer : options.peers) contenders.push_back(peer_contender(peer));
  std::set<std::string> names;
  auto descriptors = nlohmann::ordered_json::array();
  for (const Contender& contender : contenders) {
    for (const Form& form : contender.forms) {
      if (!names.insert(form.name).second) throw std::runtime_error("two descriptors are called " + form.name);
      descriptors.push_back({{"name", form.name}, {"method", contender.method}});
    }
  }
  const auto work = [contenders](const datasets::ViewPair& pair, const MatchingSettings& settings) {
    return to_json(register_pair(pair, settings, contenders));
  };
  return pair_experiment("registration", descriptors, options, 1, work);
}

}  // namespace shortshot_bench::paper
