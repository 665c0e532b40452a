#include "speed/peers/instruction_goals.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace shortshot_bench::peers {

std::optional<double> committed_instructions(Stage stage, const std::string& build) {
  std::ifstream file(SHORTSHOT_INSTRUCTIONS_FILE);
  if (!file) return {};
  const std::string isa = build == "O2" ? " sse2" : " " + build;
  try {
    const auto figures = nlohmann::json::parse(file).at("instructions_per_neighbor");
    const auto figure = [&](const std::string& name) { return figures.at(name + isa).get<double>(); };
    return stage == Stage::kernel ? figure("kernel Scsh336") : figure("search grid") + figure("frame");
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(SHORTSHOT_INSTRUCTIONS_FILE + std::string(": ") + error.what());
  }
}

}  // namespace shortshot_bench::peers
