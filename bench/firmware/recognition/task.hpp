// The task of the programs that recognize on microcontrollers: which views a recognizer learns, which it is asked for,
// and where their key points are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shortshot/shortshot.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench::firmware {

struct LabeledView {
  RgbdCloud cloud;
  shortshot::Point center;
  std::uint32_t object;
};

struct RecognitionTask {
  std::vector<std::string> classes;  // of each object
  std::vector<std::string> instances;
  std::vector<LabeledView> training;
  std::vector<LabeledView> test;
};

/// Generated objects: four views of each are learned, and two others, from another height and with other noise, asked
/// for.
RecognitionTask generated_task();

/// A recognizer of all training views in a storage. Throws std::runtime_error with what is wrong.
shortshot::Recognizer train_stored(const RecognitionTask& task);

/// How many of the test views' instances are named by a hosted recognizer of CSHOT-1344 in floats that has learned the
/// same views. Throws std::runtime_error.
std::size_t right_with_cshot(const RecognitionTask& task);

/// Views as programs/recognize.cpp reads them: 4-byte numbers, little-endian: count; for each view points and instance,
/// then 3 floats for each point, then 3 bytes of color for each, filled up to 4.
std::string views_of(const RecognitionTask& task);

}  // namespace shortshot_bench::firmware
