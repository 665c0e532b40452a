// The task of the boards with small depth sensors: which frames a recognizer learns, and which it is asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware/programs/small_sensor.hpp"
#include "shortshot/shortshot.hpp"

namespace shortshot_bench::firmware {

struct Frame {
  std::vector<std::uint16_t> depths;  // see measured()
  std::size_t thing_class;
  double distance;  // of its middle, meters
};

struct SensorTask {
  small_sensor::Sensor sensor;
  std::vector<Frame> training;
  std::vector<Frame> test;
};

/// Frames of things that are drawn anew for each: no two are alike. What a sensor is tested with comes from other
/// seeds, and from a little closer and farther away, than what it learns.
struct FrameDraw {
  std::uint32_t seed;
  std::size_t views;  // of each class
  double nearest;     // meters
  double farthest;
};
inline constexpr FrameDraw training_frames{100000000, 80, 0.14, 0.46};
inline constexpr FrameDraw test_frames{300000000, 20, 0.12, 0.50};
std::vector<Frame> draw_frames(const small_sensor::Sensor& sensor, const FrameDraw& draw);
SensorTask sensor_task(const small_sensor::Sensor& sensor);

/// A recognizer of all training frames, one descriptor each. Throws std::runtime_error with what is wrong.
shortshot::Recognizer train_stored(const SensorTask& task);

/// How many of the test frames are named rightly by a hosted recognizer of SHOT-352 in floats, with normals and 16 key
/// points a frame, that has learned the same ones. Throws std::runtime_error.
std::size_t right_with_shot(const SensorTask& task);

/// Frames as programs/small_sensor.cpp reads them: 4-byte count; for each 4 bytes class, 4 bytes distance in
/// millimeters, then its depths, 2 bytes each; little-endian.
std::string frames_of(const SensorTask& task);

}  // namespace shortshot_bench::firmware
