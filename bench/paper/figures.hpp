// The figures that an experiment ends with, and the bands in which they must lie on known data.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "paper/campaign/report.hpp"
#include "paper/campaign/statistics.hpp"

namespace shortshot_bench::paper {

struct FigureValue {
  std::string data;  // set or task
  std::string descriptor;
  std::string figure;
  campaign::Interval interval;
};

/// A report, and its figures for programs.
struct Findings {
  campaign::Report report{};
  std::vector<FigureValue> figures{};
};

/// A section with one row for each figure.
campaign::Section section_of(const std::vector<FigureValue>& figures);

/// What lies outside of its band, or is not there; a sentence each. `bands` is a list of objects with data, descriptor,
/// figure, at_least and at_most. Only bands of data that the figures have are looked at; if there are none, that is a
/// sentence as well.
std::vector<std::string> broken_bands(const std::vector<FigureValue>& figures, const nlohmann::ordered_json& bands);

}  // namespace shortshot_bench::paper
