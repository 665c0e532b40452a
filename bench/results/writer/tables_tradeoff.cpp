#include "results/writer/tables.hpp"

namespace shortshot_bench::results {

std::string tradeoff_tables(const nlohmann::ordered_json& json, const std::string& plots) {
  static_cast<void>(json.at("headline"));  // throws for what is no map
  std::string text;
  for (const char* plot : {"score_by_bytes", "score_by_time"}) {
    text += "![" + std::string(plot) + "](" + plots + "/tradeoff_" + plot + ".svg)\n\n";
  }
  for (const auto& table : json) {
    text += "**" + table.at("title").get<std::string>() + "**\n\n" + table.at("markdown").get<std::string>() + "\n";
  }
  return text;
}

}  // namespace shortshot_bench::results
