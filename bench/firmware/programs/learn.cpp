// Learns two objects in RAM, with no model from elsewhere, and names each of them; exit code 0 if that is right, also
// after the memory was opened again, and after the second one was torn.
#include "board.hpp"
#include "patch.hpp"
#include "shortshot.hpp"

using shortshot::Status;

namespace {

using Stored = shortshot::SumBits<shortshot::ShapeColor95>;
using Memory = shortshot::RamMemory<8192>;
constexpr float radius = 0.08f;
constexpr shortshot::Point center{0.0f, 0.0f, 1.0f};

patch::Memory points;
Memory memory;
shortshot::LearnedObjects<Stored, Memory, 2> learned;
shortshot::MicroRecognizer<Stored, 64, 256> recognizer;
shortshot::StaticGrid<patch::points, 1024> grid;

/// The patch, or its mirror image in other colors; all points a little to the right.
shortshot::CloudView object(bool is_mirrored, float shift) {
  const shortshot::CloudView cloud = patch::make(points);
  for (std::size_t i = 0; i < patch::points; ++i) {
    if (is_mirrored) {
      points.xyz[i][0] = -points.xyz[i][0];
      points.rgb[i][0] = static_cast<unsigned char>(255 - points.rgb[i][0]);
    }
    points.xyz[i][0] += shift;
  }
  return cloud;
}

/// use(index) for some 50 points.
template <class Use>
void for_keypoints(const Use& use) {
  for (std::size_t i = 7; i < patch::points; i += 41) use(i);
}

bool learn(bool is_mirrored, const char* name) {
  const shortshot::CloudView cloud = object(is_mirrored, 0.0f);
  if (grid.build(cloud, radius) != Status::ok) return false;
  bool is_added = true;
  for_keypoints([&](std::size_t i) {
    shortshot::StoredKeyPoint<Stored> key;
    if (recognizer.describe(cloud, grid, i, radius, key) == Status::ok)
      is_added = learned.add(key, center) == Status::ok && is_added;
  });
  return is_added && learned.commit("patch", name) == Status::ok;
}

/// Is the first hypothesis the object of this number?
bool is_named(bool is_mirrored, std::uint32_t instance) {
  const shortshot::CloudView cloud = object(is_mirrored, 0.0625f);
  if (grid.build(cloud, radius) != Status::ok) return false;
  recognizer.start(learned.model());
  for_keypoints([&](std::size_t i) { static_cast<void>(recognizer.add(cloud, grid, i, radius)); });
  shortshot::Hypothesis found[1];
  return recognizer.finish(found) == 1 && found[0].instance == instance && found[0].score > 10.0f;
}

bool open() { return learned.open(shortshot::ModelView<Stored>({0.02f, 1, 8}), memory) == Status::ok; }
std::uint32_t known() { return learned.model().instance_count(); }

bool learns() {
  memory.erase();
  if (!open() || !learn(false, "one")) return false;
  if (!learn(true, "two") || !is_named(false, 0) || !is_named(true, 1)) return false;
  board::print_fact("fact", "learned_bytes", memory.size_bytes() - learned.bytes_left());
  if (!open() || known() != 2 || !is_named(true, 1)) return false;
  const std::uint8_t torn = 0;
  static_cast<void>(memory.write(memory.size_bytes() - learned.bytes_left() - 1, &torn));
  return open() && known() == 1 && is_named(false, 0) && !is_named(true, 1);
}

}  // namespace

int main() {
  const bool right = learns();
  board::print_fact("fact", "learned_objects_bytes", sizeof learned);
  return right ? 0 : 1;
}
