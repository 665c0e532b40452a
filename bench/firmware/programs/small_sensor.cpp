// A board with a small depth sensor names what is held in front of it. Frames were linked in and stand for the sensor;
// each is copied to memory first, as from a bus. Prints a hash of all hypotheses, which must be the same everywhere,
// how many frames are named rightly, what it takes of stack, and for the first frame a line "section NAME" for each
// counted call; see work.cpp.
#include "small_sensor.hpp"

#include "board.hpp"
#include "hash.hpp"
#include "marks.hpp"

using shortshot::Status;

extern "C" {
extern const unsigned char model_begin[], model_end[];
extern const std::uint32_t views_begin[];
}

namespace {

using small_sensor::Stored;

constexpr const small_sensor::Sensor& sensor = small_sensor::sensors[SENSOR];
constexpr std::size_t zones = std::size_t{sensor.width} * sensor.height;
constexpr std::size_t most_points = zones < small_sensor::most_points ? zones : small_sensor::most_points;

shortshot::ModelView<Stored> model;
shortshot::MicroRecognizer<Stored, 1, 5, small_sensor::activated> recognizer;  // what it is given is described already
std::uint16_t depths[zones];
small_sensor::Points<most_points> points;
shortshot::CompactWorkspace<most_points> workspace;
Stored described;
shortshot::Hypothesis found[1];

bool counted;  // the first frame
template <class Call>
void count(const char* name, const Call& call) {
  if (counted) return call();
  count_section(name, call);
}

std::uint32_t failures;  // of memory

/// Whether there is a hypothesis, in `found`.
bool recognize() {
  Status status = Status::ok;
  std::size_t hypotheses = 0;
  count("points", [] { small_sensor::to_points(depths, sensor, points); });
  count("describe", [&] { status = small_sensor::describe<sensor.has_few_points>(points, workspace, described); });
  if (status == Status::too_many_neighbors) ++failures;
  if (status != Status::ok) return false;
  recognizer.start(model);
  count("match", [&] { status = recognizer.add(described, points.middle, small_sensor::own_axes); });
  if (status != Status::ok) ++failures;
  count("find", [&] { hypotheses = recognizer.finish(found); });
  counted = true;
  return hypotheses > 0;
}

struct Answers {
  std::uint32_t views;
  std::uint32_t right;
  std::uint32_t right_kind;
};
Answers all, best, sure;

void add_answer(Answers& to, std::uint32_t wanted, bool is_there) {
  ++to.views;
  if (!is_there) return;
  to.right += found[0].instance == wanted ? 1u : 0u;
  to.right_kind += small_sensor::kinds[found[0].instance] == small_sensor::kinds[wanted] ? 1u : 0u;
}

void recognize_all(Hash& hash) {
  const std::uint32_t* next = views_begin + 1;
  for (std::uint32_t view = 0; view < *views_begin; ++view) {
    const std::uint32_t wanted = next[0];
    const bool is_best = next[1] >= small_sensor::best_distances[0] && next[1] <= small_sensor::best_distances[1];
    const auto* const frame = reinterpret_cast<const std::uint16_t*>(next + 2);
    for (std::size_t i = 0; i < zones; ++i) depths[i] = frame[i];
    const bool is_there = recognize();
    if (is_there) hash.add(found, sizeof found);
    add_answer(all, wanted, is_there);
    if (is_best) add_answer(best, wanted, is_there);
    if (is_there && found[0].score > 0.5f + small_sensor::activated - 1) add_answer(sure, wanted, true);
    if (view == 0) board::print_fact("fact", "points", points.size);  // around one key point
    next += 2 + zones / 2;
  }
}

}  // namespace

int main() {
  const auto model_bytes = static_cast<std::size_t>(model_end - model_begin);
  if (const Status opened = model.open(model_begin, model_bytes); opened != Status::ok) {
    return static_cast<int>(opened);  // its message() would be a kilobyte of texts
  }
  Hash hash;
#if defined(__unix__)
  recognize_all(hash);
#else
  board::print_fact("fact", "stack_painted", board::stack_of([&] { recognize_all(hash); }));
#endif
  board::print("configuration ");
  board::print(sensor.name);
  board::print("\n");
  board::print_hash(sensor.name, hash.value());
  board::print_fact("fact", "model_bytes", model_bytes);
  board::print_fact("fact", "codewords", model.codeword_count());
  board::print_fact("fact", "names", model.instance_count());
  board::print_fact("fact", "keypoints", 1);
  board::print_fact("fact", "views", all.views);
  board::print_fact("fact", "right", all.right);
  board::print_fact("fact", "right_kind", all.right_kind);
  board::print_fact("fact", "best", best.views);
  board::print_fact("fact", "right_best", best.right);
  board::print_fact("fact", "sure", sure.views);
  board::print_fact("fact", "right_sure", sure.right);
  if (failures > 0) board::print("the memory is too small for a frame\n");
  return failures > 0 ? 1 : 0;
}
