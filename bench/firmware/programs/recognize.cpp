// Names the objects in views that were linked in, against a model that lies in flash. Prints a hash of all hypotheses,
// which must be the same everywhere, how many views are named rightly, and for the first view a line "section NAME" for
// each counted call; see work.cpp.
#include "board.hpp"
#include "hash.hpp"
#include "recognition.hpp"
#include "shortshot.hpp"

using shortshot::Status;

extern "C" {
extern const unsigned char model_begin[], model_end[];
extern const std::uint32_t views_begin[];
[[gnu::noinline]] void mark_begin() { __asm__ volatile("" ::: "memory"); }
[[gnu::noinline]] void mark_end() { __asm__ volatile("" ::: "memory"); }
}

namespace {

using recognition::Descriptor;
using recognition::Stored;

shortshot::ModelView<Stored> model;
shortshot::MicroRecognizer<Stored, 128, 768> recognizer;
shortshot::StaticGrid<10240, 8192> grid;

struct View {
  shortshot::CloudView cloud;
  std::uint32_t instance;
  const std::uint32_t* next;
};

/// As views_of() in recognition/task.hpp has written it.
View view_at(const std::uint32_t* words) {
  const std::size_t points = words[0];
  const auto* xyz = reinterpret_cast<const float*>(words + 2);
  const auto* rgb = reinterpret_cast<const unsigned char*>(words + 2 + 3 * points);
  return {shortshot::view_xyz_rgb(xyz, rgb, points), words[1], words + 2 + 3 * points + (3 * points + 3) / 4};
}

bool counted;  // the first view
template <class Call>
void count(const char* name, const Call& call) {
  if (counted) return call();
  mark_begin();
  call();
  mark_end();
  board::print("section ");
  board::print(name);
  board::print("\n");
}

std::uint32_t failures;   // what memory does not hold
std::uint32_t described;  // key points
void add_all(const shortshot::CloudView& cloud) {
  const shortshot::Support support = recognition::support();
  recognition::for_keypoints(cloud.size, recognition::keypoints, [&](std::size_t i) {
    const Status status = recognizer.add(cloud, grid, i, support);
    if (status == Status::ok) ++described;
    if (status == Status::too_many_neighbors || status == Status::out_of_memory) ++failures;
  });
}

Stored queries[recognition::keypoints];

/// Descriptors of the view for match_all().
void store_all(const shortshot::CloudView& cloud) {
  static shortshot::Workspace<768> workspace;
  static float values[Descriptor::size];
  const shortshot::Support support = recognition::support();
  std::uint32_t stored = 0;
  recognition::for_keypoints(cloud.size, recognition::keypoints, [&](std::size_t i) {
    const Status status = shortshot::describe_at<Descriptor>(cloud, grid, i, support, workspace, values);
    if (status == Status::ok) shortshot::binarize(values, queries[stored++]);
  });
  if (stored != described) ++failures;
}

/// The comparisons with all codewords and the votes alone.
void match_all() {
  const shortshot::Frame frame{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
  recognizer.start(model);
  for (std::uint32_t i = 0; i < described; ++i) {
    static_cast<void>(recognizer.add(queries[i], {0.0f, 0.0f, 0.5f}, frame));
  }
}

/// The instance that is named first.
std::uint32_t recognize(const shortshot::CloudView& cloud, Hash& hash) {
  shortshot::Hypothesis found[8];
  std::size_t hypotheses = 0;
  Status indexed = Status::ok;
  count("index", [&] { indexed = grid.build(cloud, 0.5f * recognition::radius); });
  if (indexed != Status::ok) ++failures;
  recognizer.start(model);
  count("describe_and_match", [&] { add_all(cloud); });
  count("find", [&] { hypotheses = recognizer.finish(found); });
  hash.add(found, hypotheses * sizeof found[0]);
  if (!counted) {
    store_all(cloud);
    count("match", match_all);
  }
  counted = true;
  return hypotheses > 0 ? found[0].instance : 0xFFFFFFFFu;
}

}  // namespace

int main() {
  Status opened = Status::ok;
  const auto model_bytes = static_cast<std::size_t>(model_end - model_begin);
  count("open", [&] { opened = model.open(model_begin, model_bytes); });
  if (opened != Status::ok) {
    board::print(shortshot::message(opened));
    board::print("\n");
    return 1;
  }
  const std::uint32_t* next = views_begin + 1;
  Hash hash;
  std::uint32_t right = 0;
  std::uint32_t of_first = 0;
  for (std::uint32_t v = 0; v < *views_begin; ++v) {
    const View view = view_at(next);
    right += recognize(view.cloud, hash) == view.instance ? 1u : 0u;
    if (v == 0) of_first = described;
    next = view.next;
  }
  board::print_hash("Recognition", hash.value());
  board::print_fact("fact", "views", *views_begin);
  board::print_fact("fact", "right", right);
  board::print_fact("fact", "keypoints", of_first);
  board::print_fact("fact", "codewords", model.codeword_count());
  board::print_fact("fact", "model_bytes", model_bytes);
  board::print_fact("fact", "recognizer_bytes", sizeof recognizer);
  board::print_fact("fact", "objects", model.instance_count());
  if (failures > 0) board::print("the memory is too small for a view\n");
  return failures > 0 ? 1 : 0;
}
