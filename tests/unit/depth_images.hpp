// Depth images of surfaces that a formula gives, and the normals of windows of them, summed up one by one.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "fixtures.hpp"

namespace unit {

struct DepthImage {
  static constexpr std::size_t width = 160, height = 120;
  static constexpr float focal = 150.0f;
  TestCloud cloud;
  [[nodiscard]] ss::CloudView view() const { return ss::organized(cloud.view(), width, height); }
};

/// depth_of(ray) for each pixel's ray, whose z is 1; no point where that is 0.
template <class DepthOf>
DepthImage depth_image(DepthOf depth_of) {
  DepthImage image;
  for (std::size_t v = 0; v < DepthImage::height; ++v) {
    for (std::size_t u = 0; u < DepthImage::width; ++u) {
      const ss::Point ray{(static_cast<float>(u) - 79.5f) / DepthImage::focal,
                          (static_cast<float>(v) - 59.5f) / DepthImage::focal, 1.0f};
      const float z = depth_of(ray);
      if (z > 0.0f) image.cloud.add(ray.x * z, ray.y * z, z);
      if (!(z > 0.0f)) image.cloud.add(not_a_number, not_a_number, not_a_number);
    }
  }
  return image;
}

/// 0 behind the camera, and farther than twice the plane.
inline float depth_of_plane(const ss::SurfaceNormal& n, float distance, const ss::Point& ray) {
  const float depth = distance / (n.x * ray.x + n.y * ray.y + n.z * ray.z);
  return depth > 0.0f && depth < -2.0f * distance ? depth : 0.0f;
}

/// A ball of 20 cm before a wall, with noise along the rays.
inline DepthImage noisy_ball(std::uint32_t seed, float noise) {
  Random random(seed);
  return depth_image([&](const ss::Point& ray) {
    const float squared = ray.x * ray.x + ray.y * ray.y + 1.0f;
    const float root = 0.8f * 0.8f - squared * (0.8f * 0.8f - 0.2f * 0.2f);
    const float z = root > 0.0f ? (0.8f - std::sqrt(root)) / squared : 1.1f + 0.4f * ray.x;
    return z + random.between(-noise, noise);
  });
}

/// One point in `of` is missing.
inline DepthImage with_holes(DepthImage image, std::uint32_t seed, std::size_t of) {
  Random random(seed);
  for (std::size_t i = 0; i < image.cloud.size(); ++i) {
    if (random.below(of) == 0)
      image.cloud.xyz[3 * i + random.below(3)] = random.below(2) == 0 ? not_a_number : infinity;
  }
  return image;
}

struct Silhouette {
  DepthImage image;
  std::vector<ss::SurfaceNormal> truth;
};

/// A slanted board, cut along a slanted line, before a wall that is slanted otherwise; with the shadow that the
/// projector of a depth camera leaves beside the board, if wanted.
inline Silhouette silhouette(bool with_shadow) {
  const ss::SurfaceNormal board = unit_normal(0.4f, 0.2f, -1.0f), wall = unit_normal(-0.3f, 0.3f, -1.0f);
  Silhouette scene;
  scene.image = depth_image([&](const ss::Point& ray) {
    const float beside = ray.x + 0.3f * ray.y;
    const bool on_board = beside > -0.2f && beside < 0.15f && ray.y > -0.2f && ray.y < 0.25f;
    const bool in_shadow = with_shadow && !on_board && beside >= 0.15f && beside < 0.18f;
    scene.truth.push_back(on_board ? board : wall);
    return in_shadow ? 0.0f : on_board ? depth_of_plane(board, -0.7f, ray) : depth_of_plane(wall, -1.1f, ray);
  });
  return scene;
}

inline double degrees_between(const ss::SurfaceNormal& a, const ss::SurfaceNormal& b) {
  const Eigen::Vector3d u = Eigen::Vector3f(a.x, a.y, a.z).cast<double>();
  const Eigen::Vector3d v = Eigen::Vector3f(b.x, b.y, b.z).cast<double>();
  return 57.29577951308232 * std::atan2(u.cross(v).norm(), std::abs(u.dot(v)));
}

/// estimate_image_normals() as its documentation has it: no running sums, no registers, double precision.
class WindowOracle {
 public:
  WindowOracle(const DepthImage& image, float radius) : image_(image), radius_(radius) {
    const std::size_t size = image.cloud.size();
    filled_.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t column = i % DepthImage::width;
      if (is_point(i)) {
        filled_[i] = z(i);
      } else if (column > 0) {
        filled_[i] = filled_[i - 1];
      } else {
        std::size_t next = i;
        while (!is_point(next)) ++next;  // no row is empty here
        filled_[i] = z(next);
      }
    }
    edges_.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
      const double limit = std::max(32.0, 8.0 * std::abs(filled_[i]) / static_cast<double>(DepthImage::focal));
      edges_[i] = (i % DepthImage::width > 0 && std::abs(filled_[i] - filled_[i - 1]) > limit) ||
                  (i >= DepthImage::width && std::abs(filled_[i] - filled_[i - DepthImage::width]) > limit);
    }
  }

  /// False if it has none, or if it hangs on a rounding of the window's size or of what is near.
  bool normal(std::size_t i, ss::SurfaceNormal& result, double& ratio) const {
    if (!is_point(i)) return false;
    const double size = 0.8660254 * static_cast<double>(radius_) * static_cast<double>(DepthImage::focal) /
                            static_cast<double>(image_.cloud.at(i).z) -
                        0.5;
    if (std::abs(size - std::floor(size) - 0.5) < 0.01) return false;
    const long half = std::min(29L, std::max(1L, std::lround(size)));
    const long third = (2 * half + 1) / 6;
    const long bounds[4] = {-half, -third, third + 1, half + 1};
    Sums all, near;
    add(i, bounds[0], bounds[3], bounds[0], bounds[3], all);
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        Sums part;
        add(i, bounds[c], bounds[c + 1], bounds[r], bounds[r + 1], part);
        const double mean = part.moments.trace() / std::max(part.count, 1.0) / 1024.0;
        const double limit = part.edges ? 0.5 : 1.0;
        if (all.edges && std::abs(mean - limit) < 0.002) return false;
        if (mean <= limit) near += part;
      }
    }
    const Sums& sums = all.edges ? near : all;
    if (sums.count < 3.0) return false;
    const Eigen::Matrix3d scatter = sums.moments - sums.first * sums.first.transpose() / sums.count;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
    ratio = std::abs(solver.eigenvalues()[0]) / solver.eigenvalues()[1];
    const Eigen::Vector3f axis = solver.eigenvectors().col(0).cast<float>();
    result = {axis.x(), axis.y(), axis.z()};
    return solver.eigenvalues()[1] > 1.5 * sums.count;
  }

 private:
  struct Sums {
    double count = 0.0;
    bool edges = false;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    void operator+=(const Sums& other) {
      count += other.count;
      first += other.first;
      moments += other.moments;
    }
  };

  [[nodiscard]] bool is_point(std::size_t i) const { return ss::is_finite(image_.cloud.at(i)); }
  [[nodiscard]] Eigen::Vector3d steps(std::size_t i) const {
    const ss::Point p = image_.cloud.at(i);
    const float scale = 32.0f / radius_;
    return {std::nearbyint(static_cast<double>(p.x * scale)), std::nearbyint(static_cast<double>(p.y * scale)),
            std::nearbyint(static_cast<double>(p.z * scale))};
  }
  [[nodiscard]] double z(std::size_t i) const { return steps(i).z(); }

  /// Columns and rows from the middle, the end excluded, cut at the image's rim.
  void add(std::size_t i, long left, long right, long top, long bottom, Sums& sums) const {
    const auto u = static_cast<long>(i % DepthImage::width), v = static_cast<long>(i / DepthImage::width);
    const Eigen::Vector3d center = steps(i);
    for (long y = std::max(0L, v + top); y < std::min(static_cast<long>(DepthImage::height), v + bottom); ++y) {
      for (long x = std::max(0L, u + left); x < std::min(static_cast<long>(DepthImage::width), u + right); ++x) {
        const auto k = static_cast<std::size_t>(y) * DepthImage::width + static_cast<std::size_t>(x);
        sums.edges = sums.edges || edges_[k];
        if (!is_point(k)) continue;
        const Eigen::Vector3d d = steps(k) - center;
        sums.count += 1.0;
        sums.first += d;
        sums.moments += d * d.transpose();
      }
    }
  }

  const DepthImage& image_;
  float radius_;
  std::vector<double> filled_;
  std::vector<bool> edges_;
};

}  // namespace unit
