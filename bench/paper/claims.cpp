#include "paper/claims.hpp"

#include <cstdio>

#include "paper/experiment.hpp"

namespace shortshot_bench::paper {
namespace {

std::string limit_text(double limit) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", limit);
  return text;
}

}  // namespace

std::string verdict(const Claim& claim) {
  const auto keeps = [&](double value) { return claim.above ? value > claim.at_least : value >= claim.at_least; };
  if (keeps(claim.interval.low)) return "holds";
  return keeps(claim.interval.high) ? "undecided" : "does not hold";
}

campaign::Section section_of(const std::vector<Claim>& claims) {
  campaign::Table table("Claims", {"claim", "figure", "measured", "limit", "verdict"});
  std::string reasons;
  for (const Claim& c : claims) {
    table.add({c.text, c.figure, text_of(c.interval, 3), (c.above ? "above " : "at least ") + limit_text(c.at_least),
               verdict(c)});
    if (verdict(c) == "does not hold")
      reasons += "\n* " + c.text + ": does not hold. Likely reason: " + c.likely_reason;
  }
  return {"The paper's claims",
          claims.empty() ? "These data can say nothing about them."
                         : "Undecided: the interval holds the limit; more data would tell." + reasons,
          {{"claims", table}},
          {}};
}

}  // namespace shortshot_bench::paper
