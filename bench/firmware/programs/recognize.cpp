// Names the objects in views that were linked in, against a model that lies in flash. Prints a hash of all hypotheses,
// which must be the same everywhere, how many views are named rightly, and for the first view a line "section NAME" for
// each counted call; see work.cpp.
#include "board.hpp"
#include "shortshot.hpp"

using shortshot::Status;

extern "C" {
extern const unsigned char model_begin[], model_end[];
extern const std::uint32_t views_begin[];
[[gnu::noinline]] void mark_begin() { __asm__ volatile("" ::: "memory"); }
[[gnu::noinline]] void mark_end() { __asm__ volatile("" ::: "memory"); }
}

namespace {

using Stored = shortshot::SumBits<shortshot::ShapeColor95>;

constexpr float radius = 0.025f;
constexpr std::size_t keypoints = 100;
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

/// FNV-1a.
std::uint32_t hash;
void add(const void* bytes, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * 16777619u;
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
template <class Use>
void for_keypoints(const shortshot::CloudView& cloud, const Use& use) {
  shortshot::Support support = radius;
  support.viewpoint = shortshot::Viewpoint::towards({});
  const std::size_t stride = (cloud.size + keypoints - 1) / keypoints;
  for (std::size_t i = stride / 2; i < cloud.size; i += stride) use(i, support);
}

void add_all(const shortshot::CloudView& cloud) {
  for_keypoints(cloud, [&](std::size_t i, const shortshot::Support& support) {
    const Status status = recognizer.add(cloud, grid, i, support);
    if (status == Status::ok) ++described;
    if (status == Status::too_many_neighbors || status == Status::out_of_memory) ++failures;
  });
}

Stored queries[keypoints];

/// Descriptors of the view for match_all().
void store_all(const shortshot::CloudView& cloud) {
  static shortshot::Workspace<768> workspace;
  static float values[shortshot::ShapeColor95::size];
  std::uint32_t stored = 0;
  for_keypoints(cloud, [&](std::size_t i, const shortshot::Support& support) {
    const Status status = shortshot::describe_at<shortshot::ShapeColor95>(cloud, grid, i, support, workspace, values);
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
std::uint32_t recognize(const shortshot::CloudView& cloud) {
  shortshot::Hypothesis found[8];
  std::size_t hypotheses = 0;
  Status indexed = Status::ok;
  count("index", [&] { indexed = grid.build(cloud, 0.5f * radius); });
  if (indexed != Status::ok) ++failures;
  recognizer.start(model);
  count("describe_and_match", [&] { add_all(cloud); });
  count("find", [&] { hypotheses = recognizer.finish(found); });
  add(found, hypotheses * sizeof found[0]);
  if (!counted) {
    store_all(cloud);
    count("match", match_all);
  }
  counted = true;
  return hypotheses > 0 ? found[0].instance : 0xFFFFFFFFu;
}

}  // namespace

int main() {
  hash = 2166136261u;
  Status opened = Status::ok;
  const auto model_bytes = static_cast<std::size_t>(model_end - model_begin);
  count("open", [&] { opened = model.open(model_begin, model_bytes); });
  if (opened != Status::ok) {
    board::print(shortshot::message(opened));
    board::print("\n");
    return 1;
  }
  const std::uint32_t* next = views_begin + 1;
  std::uint32_t right = 0;
  std::uint32_t of_first = 0;
  for (std::uint32_t v = 0; v < *views_begin; ++v) {
    const View view = view_at(next);
    right += recognize(view.cloud) == view.instance ? 1u : 0u;
    if (v == 0) of_first = described;
    next = view.next;
  }
  board::print_hash("Recognition", hash);
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
