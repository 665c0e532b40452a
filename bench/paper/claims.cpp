#include "paper/claims.hpp"

#include "paper/experiment.hpp"

namespace shortshot_bench::paper {

std::string verdict(const Claim& claim) {
  if (claim.interval.low >= claim.at_least) return "holds";
  return claim.interval.high < claim.at_least ? "does not hold" : "undecided";
}

campaign::Section section_of(const std::vector<Claim>& claims) {
  campaign::Table table("Claims", {"claim", "figure", "measured", "at least", "verdict"});
  std::string reasons;
  for (const Claim& c : claims) {
    table.add({c.text, c.figure, text_of(c.interval, 3), campaign::Cell(c.at_least, 3), verdict(c)});
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
