#include "tools/match/refine.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace shortshot_bench {
namespace {

using shortshot::CloudView;
using shortshot::Point;
using shortshot::Pose;
using shortshot::Status;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// A point of the source, where it is now, and the plane of the target that is nearest to it.
struct Contact {
  Eigen::Vector3d at;
  Eigen::Vector3d normal;
  double offset;  // across the plane
};

Eigen::Vector3d vector_of(const Point& p) { return Eigen::Vector3f(p.x, p.y, p.z).cast<double>(); }

class Surface {
 public:
  Surface(const CloudView& source, const CloudView& target, const RefineOptions& options)
      : options_(options), search_(target, options.plane_radius) {
    std::vector<Point> valid;
    for (std::size_t i = 0; i < source.size; ++i) {
      const Point p = shortshot::point(source, i);
      if (shortshot::is_finite(p)) valid.push_back(p);
    }
    const std::size_t count = std::min(options.samples, valid.size());
    for (std::size_t k = 0; k < count; ++k) samples_.push_back(valid[k * valid.size() / count]);
  }

  std::size_t samples() const { return samples_.size(); }

  std::vector<Contact> contacts(const Pose& pose, float reach) const {
    std::vector<Contact> found;
    Contact contact;
    for (const Point& p : samples_) {
      if (touches(shortshot::transform_point(pose, p), reach, contact)) found.push_back(contact);
    }
    return found;
  }

 private:
  bool touches(const Point& at, float reach, Contact& contact) const {
    static thread_local shortshot::Workspace<8192> workspace;
    shortshot::Neighborhood n = shortshot::neighborhood_in(workspace);
    const float radius = std::max(options_.plane_radius, reach);
    if (search_.gather(at, radius, n) != Status::ok || n.size < 5) return false;
    const auto nearest = static_cast<std::uint32_t>(std::min_element(n.d2, n.d2 + n.size) - n.d2);
    if (!(n.d2[nearest] < reach * reach)) return false;
    const Point foot{at.x + n.dx[nearest], at.y + n.dy[nearest], at.z + n.dz[nearest]};
    if (search_.gather(foot, options_.plane_radius, n) != Status::ok) return false;
    shortshot::SurfaceNormal normal;
    if (shortshot::estimate_normal(n, options_.plane_radius, normal) != Status::ok) return false;
    contact.at = vector_of(at);
    contact.normal = Eigen::Vector3f(normal.x, normal.y, normal.z).cast<double>();
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();  // of the neighbors' offsets from the foot
    for (std::uint32_t i = 0; i < n.size; ++i) mean += Eigen::Vector3f(n.dx[i], n.dy[i], n.dz[i]).cast<double>();
    contact.offset = contact.normal.dot(contact.at - vector_of(foot) - mean / static_cast<double>(n.size));
    return std::abs(contact.offset) < static_cast<double>(reach);
  }

  RefineOptions options_;
  shortshot::GridSearch search_;
  std::vector<Point> samples_;
};

Fit fit_of(const std::vector<Contact>& contacts, std::size_t samples) {
  if (contacts.empty()) return {};
  double squares = 0.0;
  for (const Contact& c : contacts) squares += c.offset * c.offset;
  const auto count = static_cast<double>(contacts.size());
  return {static_cast<float>(count / static_cast<double>(samples)), static_cast<float>(std::sqrt(squares / count))};
}

/// The motion that takes offsets away, to first order; false if the planes leave it open.
bool take_step(const std::vector<Contact>& contacts, Pose& pose) {
  Matrix6 normal_matrix = Matrix6::Zero();
  Vector6 right = Vector6::Zero();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Contact& c : contacts) middle += c.at / static_cast<double>(contacts.size());
  double reach = 1e-300;  // what turns are measured with, so that no unit matters
  for (const Contact& c : contacts) reach = std::max(reach, (c.at - middle).norm());
  for (const Contact& c : contacts) {
    Vector6 row;
    row << (c.at - middle).cross(c.normal) / reach, c.normal;
    normal_matrix += row * row.transpose();
    right -= row * c.offset;
  }
  const Eigen::LDLT<Matrix6> solver(normal_matrix);
  if (contacts.size() < 6 || solver.info() != Eigen::Success || !(solver.rcond() > 1e-9)) return false;
  const Vector6 step = solver.solve(right);
  const Eigen::Vector3d turn = step.head<3>() / reach;
  const double angle = turn.norm();
  const Eigen::Vector3d axis = angle > 0.0 ? Eigen::Vector3d(turn / angle) : Eigen::Vector3d::UnitX();
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  using Rows = Eigen::Matrix<float, 3, 3, Eigen::RowMajor>;
  Eigen::Map<Rows> r(pose.rotation);
  Eigen::Map<Eigen::Vector3f> t(pose.translation);
  const Eigen::Vector3d moved = rotation * (t.cast<double>() - middle) + middle + step.tail<3>();
  const Eigen::Quaterniond turned(Eigen::Matrix3d(rotation * r.cast<double>()));
  r = turned.normalized().toRotationMatrix().cast<float>();
  t = moved.cast<float>();
  return true;
}

}  // namespace

Fit fit_under(const CloudView& source, const CloudView& target, const Pose& pose, const RefineOptions& options) {
  const Surface surface(source, target, options);
  return fit_of(surface.contacts(pose, options.reach), surface.samples());
}

Fit refine(const CloudView& source, const CloudView& target, const RefineOptions& options, Pose& pose) {
  const Surface surface(source, target, options);
  const auto fit_at = [&](const Pose& at) { return fit_of(surface.contacts(at, options.reach), surface.samples()); };
  Pose best = pose;
  Fit best_fit = fit_at(pose);
  float reach = options.first_reach;
  for (int step = 0; step < options.steps; ++step, reach = std::max(options.reach, 0.7f * reach)) {
    if (!take_step(surface.contacts(pose, reach), pose)) break;
    const Fit fit = fit_at(pose);
    const bool is_as_wide = fit.share == best_fit.share;
    if (fit.share < best_fit.share || (is_as_wide && fit.deviation >= best_fit.deviation)) continue;
    best = pose;
    best_fit = fit;
  }
  pose = best;
  return best_fit;
}

}  // namespace shortshot_bench
