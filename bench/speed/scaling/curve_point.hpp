// One measured point of a scaling curve, and the JSON file of many.
#pragma once

#include <string>
#include <vector>

namespace shortshot_bench::scaling {

/// What shortshot costs at one size of one thing, all else fixed.
struct CurvePoint {
  std::string curve;   // "points", "neighbors", "keypoints" or "threads": what the curve varies
  double x = 0.0;      // how much of it
  std::string x_name;  // the same in words, for people
  std::string series;  // what is measured: "index build", "whole frame", ...
  double value = 0.0;  // median of the repetitions
  std::string unit;
  double extra_bytes = 0.0;  // allocated at the peak, beyond the cloud, the key points and the rows that come out
  int repetitions = 0;
};

/// Writes a list of objects with the members' names as keys. Throws InputError if the file cannot be written.
void write_curves(const std::string& path, const std::vector<CurvePoint>& points);

/// Reads what write_curves() wrote. Throws std::runtime_error with the file's name for anything else.
std::vector<CurvePoint> read_curves(const std::string& path);

/// The different values of a text member, in the order in which they come: curves of points, series of a curve.
std::vector<std::string> distinct(const std::vector<CurvePoint>& points, std::string CurvePoint::*member);

/// The points whose text member has a value: of one curve, or of one series.
std::vector<CurvePoint> with(const std::vector<CurvePoint>& points, std::string CurvePoint::*member,
                             const std::string& value);

}  // namespace shortshot_bench::scaling
