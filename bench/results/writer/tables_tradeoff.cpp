#include "results/writer/tables.hpp"

namespace shortshot_bench::results {

std::string tradeoff_headline(const nlohmann::ordered_json& json) { return json.at("headline").at("markdown"); }

std::string tradeoff_tables(const nlohmann::ordered_json& json, const std::string& plots) {
  std::string text;
  for (const char* plot : {"score_by_bytes", "score_by_time"}) {
    text += "![" + std::string(plot) + "](" + plots + "/tradeoff_" + plot + ".svg)\n\n";
  }
  for (const auto& [name, table] : json.items()) {
    if (name == "headline") continue;
    text += "**" + table.at("title").get<std::string>() + "**\n\n" + table.at("markdown").get<std::string>() + "\n";
  }
  return text;
}

}  // namespace shortshot_bench::results
