// A pose that is nearly right, made better: surfaces are laid on each other, point to plane.
#pragma once

#include "shortshot/shortshot.hpp"

namespace shortshot_bench {

struct Fit {
  float share = 0.0f;      // of the source's points that lie within `reach` of the target's surface
  float deviation = 0.0f;  // of these, root mean square, across the surface
};

struct RefineOptions {
  float plane_radius = 0.01f;  // of the target's planes
  float reach = 0.01f;         // in the end farther points have no partner
  float first_reach = 0.04f;   // in the first step; in each one 7 tenths of that before
  int steps = 15;
  std::size_t samples = 3000;  // of the source's points, spread over the cloud
};

/// How well source and target fit under a pose: target = pose * source.
Fit fit_under(const shortshot::CloudView& source, const shortshot::CloudView& target, const shortshot::Pose& pose,
              const RefineOptions& options);

/// Gauss-Newton steps (Y. Chen, G. Medioni: Object modelling by registration of multiple range images, 1992). The pose
/// stays as it is if that brings fewer points onto the surface.
Fit refine(const shortshot::CloudView& source, const shortshot::CloudView& target, const RefineOptions& options,
           shortshot::Pose& pose);

}  // namespace shortshot_bench
