#include "speed/peers/instruction_goals.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace shortshot_bench::peers {

std::optional<double> committed_instructions(const std::string& stage, const std::string& per,
                                             const std::string& build) {
  std::ifstream file(SHORTSHOT_INSTRUCTIONS_FILE);
  if (!file) return {};
  const std::string name = stage + (build == "O2" ? " sse2" : " " + build);
  try {
    const auto figures = nlohmann::json::parse(file).at("instructions_per_" + per);
    const auto figure = figures.find(name);
    if (figure == figures.end()) return {};
    return figure->get<double>();
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(SHORTSHOT_INSTRUCTIONS_FILE + std::string(": ") + error.what());
  }
}

}  // namespace shortshot_bench::peers
