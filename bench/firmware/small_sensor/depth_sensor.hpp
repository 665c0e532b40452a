// A time-of-flight sensor of few zones: what it measures of a thing that is held in front of it, and where.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "firmware/small_sensor/things.hpp"
#include "tools/scene/random.hpp"

namespace shortshot_bench::firmware {

struct DepthSensor {
  std::size_t width;
  std::size_t height;
  double half_width;  // of what it sees at a distance of 1: the tangent of half the angle
};

struct View {
  Thing thing;
  Vec3 eye, right, down, forward;  // the sensor in the thing's frame
};

/// A thing of a class, upright within some 20 degrees, aimed at within a tenth of the distance. Hands are seen from in
/// front, shapes from above, by 15 to 40 degrees.
View draw_view(Random& random, std::size_t thing_class, double distance);

/// Row by row, millimeters along the optical axis, 0 where nothing was measured. A zone sees the mean of all surfaces
/// in it, if they fill a third of it; with a noise of 1 % of the distance, and two zones in a hundred missing.
std::vector<std::uint16_t> measured(const DepthSensor& sensor, const View& view, Random& noise);

}  // namespace shortshot_bench::firmware
