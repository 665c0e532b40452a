// Calls what the firmware page's example of a small sensor defines: a ball and a plate are learned at some distances,
// and named at others; a frame without measurements, and one between the two, are not.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "shortshot.hpp"

using Nibbles = shortshot::NibbleDescriptor<
    shortshot::Descriptor<shortshot::MultilinearVoting, shortshot::HeightPart<shortshot::SphericalGrid<2, 4, 8>>>>;
extern shortshot::ModelView<Nibbles> model;
shortshot::Status describe_frame(const std::uint16_t* millimeters, shortshot::Point& middle, Nibbles& out);
const char* what_is_held(const std::uint16_t* millimeters, shortshot::Point middle, Nibbles nibbles);

namespace {

/// A plate or, by how far it bulges out, a ball of 8 cm, at some distance in millimeters.
std::vector<std::uint16_t> frame_of(float bulge, int distance) {
  std::vector<std::uint16_t> frame;
  for (int i = 0; i < 64; ++i) {
    const float zone = 2.0f * 0.414f / 8.0f * static_cast<float>(distance);
    const float x = (static_cast<float>(i % 8) - 3.5f) * zone;
    const float y = (static_cast<float>(i / 8) - 3.5f) * zone;
    const float inside = 40.0f * 40.0f - x * x - y * y;
    const float depth = static_cast<float>(distance) - (inside > 0.0f ? bulge * std::sqrt(inside) : 0.0f);
    frame.push_back(inside > 0.0f ? static_cast<std::uint16_t>(depth) : 0);
  }
  return frame;
}

}  // namespace

int main() {
  using shortshot::Status;
  shortshot::Recognizer recognizer(shortshot::RecognizerOptions{0.03f, 3, 8});
  for (int distance = 140; distance <= 240; distance += 8) {
    for (const bool is_ball : {false, true}) {
      shortshot::StoredFeatures<Nibbles> row;
      row.descriptors.resize(1);
      row.keypoints.resize(1);
      row.frames = {{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
      shortshot::Point& middle = row.keypoints[0].position;
      row.status = {describe_frame(frame_of(is_ball ? 1.0f : 0.0f, distance).data(), middle, row.descriptors[0])};
      const char* const name = is_ball ? "ball" : "plate";
      if (row.status[0] != Status::ok || train(recognizer, row, middle, name, name) != Status::ok) return 1;
    }
  }
  std::vector<std::uint8_t> bytes;
  if (shortshot::save_for_flash<Nibbles>(recognizer, bytes) != Status::ok ||
      model.open(bytes.data(), bytes.size()) != Status::ok)
    return 2;
  std::vector<std::string> answers;
  for (const int distance : {150, 190, 230}) {
    answers.emplace_back(what_is_held(frame_of(1.0f, distance).data(), {}, {}));
    answers.emplace_back(what_is_held(frame_of(0.0f, distance).data(), {}, {}));
  }
  answers.emplace_back(what_is_held(std::vector<std::uint16_t>(64).data(), {}, {}));
  bool is_ever_unsure = false;
  for (float bulge = 0.05f; bulge < 1.0f; bulge += 0.01f) {
    for (int distance = 150; distance <= 230; distance += 10)
      is_ever_unsure =
          is_ever_unsure || what_is_held(frame_of(bulge, distance).data(), {}, {}) == std::string("not sure");
  }
  for (const std::string& answer : answers) std::printf("%s, ", answer.c_str());
  std::printf("%s\n", is_ever_unsure ? "not always sure" : "always sure");
  const std::vector<std::string> wanted{"ball", "plate", "ball", "plate", "ball", "plate", "nothing"};
  return answers == wanted && is_ever_unsure ? 0 : 3;
}
