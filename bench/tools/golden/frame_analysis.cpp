#include "frame_analysis.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace shortshot_bench::golden {
namespace {

// What float rounding does to the entries of a scatter matrix, over its largest eigenvalue, and to a dot
// product, over the length of the vector. Some ten float epsilons: 1e-6.
constexpr double rounding = 1e-6;

// Below this the middle eigenvalue is as good as zero.
constexpr double collinear_spread = 1e-5;

struct Member {
  Eigen::Vector3d v;
  float d2;
  std::uint32_t index;
};

// All neighbors that make the frame, by distance.
std::vector<Member> members_of(const shortshot::Neighborhood& n, shortshot::Radius radius) {
  std::vector<Member> members;
  for (std::uint32_t i = 0; i < n.size; ++i) {
    const Eigen::Vector3d v = Eigen::Vector3f(n.dx[i], n.dy[i], n.dz[i]).cast<double>();
    if (n.d2[i] < radius.squared && !v.isZero(0.0)) members.push_back({v, n.d2[i], n.index[i]});
  }
  std::sort(members.begin(), members.end(),
            [](const Member& a, const Member& b) { return std::tie(a.d2, a.index) < std::tie(b.d2, b.index); });
  return members;
}

Eigen::Matrix3d scatter_of(const std::vector<Member>& members, double radius) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Member& member : members) {
    const double weight = radius - std::sqrt(static_cast<double>(member.d2));
    sum += weight * member.v * member.v.transpose();
  }
  return sum;
}

// Votes over the sign of an axis: those that are sure, and those that rounding decides.
struct Votes {
  std::size_t plus = 0, minus = 0, unsure = 0;
};

Votes count_votes(const std::vector<Member>& members, std::size_t begin, std::size_t end, const Eigen::Vector3d& axis,
                  double slack) {
  Votes votes;
  for (std::size_t i = begin; i < end; ++i) {
    const double along = members[i].v.dot(axis);
    const double margin = members[i].v.norm() * std::min(1.0, slack + rounding);
    ++(along > margin ? votes.plus : along < -margin ? votes.minus : votes.unsure);
  }
  return votes;
}

// A tie is no excuse by itself: it is settled by the five members in the middle, unless rounding settles those.
bool is_open(const std::vector<Member>& members, const Votes& votes, const Eigen::Vector3d& axis, double slack) {
  const std::size_t size = members.size();
  bool may_stay = 2 * (votes.plus + votes.unsure) > size;
  bool may_turn = 2 * votes.plus < size;
  const bool may_tie = size % 2 == 0 && 2 * votes.plus <= size && 2 * votes.minus <= size;
  if (may_tie && size >= 5) {
    const std::size_t middle = size / 2;
    const Votes decisive = count_votes(members, middle - 2, middle + 3, axis, slack);
    may_stay = may_stay || decisive.plus + decisive.unsure >= 3;
    may_turn = may_turn || decisive.plus < 3;
  }
  return may_stay && may_turn;
}

AxisAnalysis analyze_axis(const std::vector<Member>& members, const Eigen::Vector3d& axis, double gap) {
  AxisAnalysis analysis{};
  analysis.gap = gap;
  // Davis and Kahan: an error E of a symmetric matrix turns its eigenvectors by |E| / gap.
  analysis.slack = gap > 0.0 ? rounding / gap : HUGE_VAL;
  const Votes votes = count_votes(members, 0, members.size(), axis, analysis.slack);
  analysis.open_vote = is_open(members, votes, axis, analysis.slack);
  analysis.no_vote = votes.unsure == members.size();
  return analysis;
}

}  // namespace

FrameAnalysis analyze_frame(const shortshot::Neighborhood& n, shortshot::Radius radius) {
  const std::vector<Member> members = members_of(n, radius);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter_of(members, static_cast<double>(radius.value)));
  const Eigen::Vector3d& values = solver.eigenvalues();  // ascending
  const double largest = values[2];
  const auto relative = [&](double value) { return largest > 0.0 ? value / largest : 0.0; };
  FrameAnalysis analysis{};
  analysis.x = analyze_axis(members, solver.eigenvectors().col(2), relative(values[2] - values[1]));
  analysis.z = analyze_axis(members, solver.eigenvectors().col(0), relative(values[1] - values[0]));
  analysis.collinear = relative(values[1]) < collinear_spread;
  return analysis;
}

}  // namespace shortshot_bench::golden
