#include "frames.hpp"

#include <algorithm>
#include <cmath>

#include "frame_analysis.hpp"

namespace shortshot_bench::golden {
namespace {

// Eigenvalues this close, over the largest, are no grounds for a frame: what a refusal is excused by.
constexpr double refusable_gap = 1e-5;

constexpr double degrees_per_radian = 57.295779513082321;

struct Vector {
  double x, y, z;
};

Vector vector_of(const float* v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double length(const Vector& v) { return std::sqrt(dot(v, v)); }

// By atan2, since the arc cosine of a dot product of floats is rough around 0. Infinite if one is no unit vector.
double angle_between(const Vector& a, const Vector& b) {
  const auto is_unit = [](const Vector& v) { return std::fabs(length(v) - 1.0) < 1e-3; };
  if (!is_unit(a) || !is_unit(b)) return HUGE_VAL;
  return std::atan2(length(cross(a, b)), dot(a, b)) * degrees_per_radian;
}

// An axis is a line and a sign, and each needs a cause of its own.
Cause cause_of_axis(const AxisAnalysis& axis, double angle_degrees) {
  const double line_angle = std::min(angle_degrees, 180.0 - angle_degrees);
  if (line_angle > max_angle_degrees || axis.slack >= 1.0) {
    return std::sin(line_angle / degrees_per_radian) <= axis.slack ? Cause::equal_eigenvalues : Cause::none;
  }
  if (axis.no_vote) return Cause::planar;
  return axis.open_vote ? Cause::tie : Cause::none;
}

// The cause of the whole frame's deviation; none if any part of it has none. y has no say of its own: it
// follows from x and z, and collects the small errors of both.
Cause cause_of_angles(const FrameAnalysis& analysis, double x_degrees, double y_degrees, double z_degrees) {
  const bool x_off = x_degrees > max_angle_degrees;
  const bool z_off = z_degrees > max_angle_degrees;
  if (!x_off && !z_off) return cause_of_axis(analysis.x.slack > analysis.z.slack ? analysis.x : analysis.z, y_degrees);
  const Cause x_cause = x_off ? cause_of_axis(analysis.x, x_degrees) : Cause::none;
  const Cause z_cause = z_off ? cause_of_axis(analysis.z, z_degrees) : Cause::none;
  if (x_off && z_off && (x_cause == Cause::none || z_cause == Cause::none)) return Cause::none;
  const Cause cause = x_off ? x_cause : z_cause;
  return cause == Cause::equal_eigenvalues && analysis.collinear ? Cause::collinear : cause;
}

Cause cause_of_refusal(const FrameAnalysis& analysis, shortshot::Status status) {
  if (status != shortshot::Status::ambiguous_frame) return Cause::none;
  if (analysis.collinear) return Cause::collinear;
  return std::min(analysis.x.gap, analysis.z.gap) < refusable_gap ? Cause::equal_eigenvalues : Cause::none;
}

bool is_zero(const shortshot::Frame& frame) {
  const auto zero = [](const float(&axis)[3]) {
    return std::all_of(axis, axis + 3, [](float v) { return v >= 0.0F && v <= 0.0F; });
  };
  return zero(frame.x) && zero(frame.y) && zero(frame.z);
}

}  // namespace

const char* name_of(Cause cause) {
  switch (cause) {
    case Cause::none: return "unexplained";
    case Cause::tie: return "tie";
    case Cause::planar: return "planar";
    case Cause::collinear: return "collinear";
    case Cause::equal_eigenvalues: return "near-equal eigenvalues";
  }
  return "unknown cause";
}

FrameComparison compare_frames(const shortshot::Neighborhood& n, shortshot::Radius radius, shortshot::Status status,
                               const shortshot::Frame& ours, const float* reference) {
  const Vector given_x = vector_of(reference);
  const Vector given_y = vector_of(reference + 3);
  const Vector given_z = vector_of(reference + 6);
  // An explanation is for two right answers: what is no frame at all has none.
  const bool is_frame = angle_between(cross(given_z, given_x), given_y) <= max_angle_degrees;
  if (status != shortshot::Status::ok) {
    const bool none_expected = std::all_of(reference, reference + 9, [](float v) { return std::isnan(v); });
    if (none_expected && is_zero(ours)) return {0.0, true, Cause::none};
    if (!is_frame || !is_zero(ours)) return {HUGE_VAL, false, Cause::none};
    return {HUGE_VAL, false, cause_of_refusal(analyze_frame(n, radius), status)};
  }
  const double x = angle_between(vector_of(ours.x), given_x);
  const double y = angle_between(vector_of(ours.y), given_y);
  const double z = angle_between(vector_of(ours.z), given_z);
  const double largest = std::max({x, y, z});
  if (largest <= max_angle_degrees) return {largest, true, Cause::none};
  if (!is_frame || !std::isfinite(largest)) return {largest, false, Cause::none};
  return {largest, false, cause_of_angles(analyze_frame(n, radius), x, y, z)};
}

}  // namespace shortshot_bench::golden
