#include "results/writer/project.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "results/writer/machine.hpp"
#include "results/writer/markdown.hpp"
#include "results/writer/tables.hpp"

namespace shortshot_bench::results {
namespace {

Document read_document(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  if (!file) throw std::runtime_error(path + ": cannot read the file");
  return {path, text.str(), text.str()};
}

void generate_block(Document& document, const std::string& name, const std::string& content) {
  document.generated = with_block(document.generated, name, content, document.path);
}

/// make() of a JSON file; what it misses is said with the file's name.
template <class Make>
std::string made_of(const std::string& path, const Make& make) {
  try {
    return make();
  } catch (const nlohmann::ordered_json::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}  // namespace

std::string machine_path(const std::string& root) { return root + "/bench/results/machine.json"; }

std::vector<Document> generate(const std::string& root) {
  const std::string results = root + "/bench/results/";
  const std::string instructions = root + "/bench/speed/instructions/expected.json";
  const Machine machine = read_machine(machine_path(root));
  const std::vector<JsonRow> peers = scaling::read_rows(results + "peers.json");
  const std::vector<JsonRow> registration = scaling::read_rows(results + "registration.json");
  const nlohmann::ordered_json firmware = scaling::read_json(results + "firmware.json");

  Document readme = read_document(root + "/README.md");
  generate_block(readme, "headline", headline(results + "peers.json", peers, registration, machine));

  const std::string firmware_path = results + "firmware.json";
  generate_block(readme, "firmware",
                 made_of(firmware_path, [&] { return firmware_headline(firmware_path, firmware); }));

  const std::string tradeoff_path = results + "tradeoff.json";
  const nlohmann::ordered_json tradeoff = scaling::read_json(tradeoff_path);
  Document map = read_document(root + "/bench/TRADEOFF.md");
  generate_block(map, "tradeoff", made_of(tradeoff_path, [&] { return tradeoff_tables(tradeoff, "results"); }));

  Document page = read_document(root + "/bench/firmware/README.md");
  generate_block(page, "firmware", made_of(firmware_path, [&] { return firmware_tables(firmware); }));

  Document report = read_document(root + "/bench/RESULTS.md");
  generate_block(report, "machine", machine_lines(machine));
  generate_block(report, "peers", peers_table(peers));
  generate_block(report, "micro", micro_table(results + "micro.json", scaling::read_json(results + "micro.json")));
  generate_block(report, "instructions", instructions_table(instructions, scaling::read_json(instructions)));
  generate_block(report, "scaling", scaling_tables(scaling::read_curves(results + "scaling.json"), "results"));

  Document goals = read_document(root + "/bench/GOALS.md");
  generate_block(goals, "goals", goals_table(scaling::read_rows(results + "goals.json")));
  return {readme, report, page, goals, map};
}

}  // namespace shortshot_bench::results
