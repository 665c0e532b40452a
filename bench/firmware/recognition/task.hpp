// The tasks of the programs that recognize on microcontrollers: which views a recognizer learns, and which it is asked
// for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware/programs/recognition.hpp"
#include "shortshot/shortshot.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench::firmware {

struct LabeledView {
  RgbdCloud cloud;
  shortshot::Point center;
  std::string object_class;
  std::string instance;
};

/// Meters.
struct RecognitionTask {
  std::vector<LabeledView> training;
  std::vector<LabeledView> test;
  float radius;
  float normal_radius;             // for descriptors that need normals
  std::size_t training_keypoints;  // of a view that is learned, at the most
};

/// Generated objects: four views of each are learned, and two others, from another height and with other noise, asked
/// for.
RecognitionTask generated_task();

/// Descriptors of a view at up to `most` of its points. Throws std::runtime_error with what is wrong.
template <class D>
shortshot::Features<D> described(const RecognitionTask& task, const LabeledView& view, std::size_t most);
extern template shortshot::Features<shortshot::Cshot1344> described(const RecognitionTask&, const LabeledView&,
                                                                    std::size_t);

/// The same as the board stores them.
shortshot::StoredFeatures<recognition::Stored> stored(const RecognitionTask& task, const LabeledView& view,
                                                      std::size_t most);

/// The recognizer's options in all tasks.
shortshot::RecognizerOptions recognizer_options();

/// A recognizer of all training views, as the board stores them. Throws std::runtime_error with what is wrong.
shortshot::Recognizer train_stored(const RecognitionTask& task);

/// How many of the test views' instances are named by a hosted recognizer of CSHOT-1344 in floats that has learned the
/// same views. Throws std::runtime_error.
std::size_t right_with_cshot(const RecognitionTask& task);

/// Is it the view's instance that is named first?
bool is_right(const shortshot::Recognizer& recognizer, const LabeledView& view,
              const std::vector<shortshot::Hypothesis>& found);

/// Test views as programs/recognition.hpp reads them: 4-byte numbers, little-endian: count, the radius as a float; for
/// each view points and instance of the recognizer, then 3 floats for each point, then 3 bytes of color for each,
/// filled up to 4.
std::vector<std::uint32_t> views_of(const RecognitionTask& task, const shortshot::Recognizer& recognizer);

}  // namespace shortshot_bench::firmware
