// One hash for each configuration, over the status and the bits of every descriptor of the committed golden case (ties,
// borders of cells, copies, degenerate neighborhoods), in frames of their own and in given ones, and of the generated
// patch. Every search, workspace and chunk size must give the same.
#include "board.hpp"
#include "hash.hpp"
#include "patch.hpp"

extern "C" {
extern const float golden_points[], golden_points_end[], golden_frames[], golden_frames_end[];
extern const shortshot::SurfaceNormal golden_normals[];
extern const unsigned char golden_rgb[];
extern const std::int32_t golden_keypoints[], golden_keypoints_end[];
}

namespace {

using shortshot::Status;

constexpr std::size_t most_neighbors = 2500;
constexpr float patch_radius = 0.1875f;

/// One cloud, its searches, and what is described of it.
struct Input {
  shortshot::CloudView cloud;
  shortshot::StaticGrid<2500, 4096> grid;
  float radius;
  const std::int32_t* keypoints;
  std::size_t count;
  const shortshot::Lab* colors;  ///< one per point
  const float* frames;           ///< nine floats per key point; null: none are given
};

patch::Memory memory;
Input inputs[2];
shortshot::Lab colors[2][2500];
shortshot::Workspace<most_neighbors> workspace;
#if defined(COMPACT)
shortshot::CompactWorkspace<most_neighbors> compact_workspace;
#endif
float descriptor[696];

void add(Hash& hash, Status status, int size) {
  const auto number = static_cast<std::uint32_t>(status);
  hash.add(&number, sizeof number);
  hash.add(descriptor, static_cast<std::size_t>(size) * sizeof descriptor[0]);
}

/// Every key point of an input by one search. `describe(search, where...)` calls the library.
template <class D, class Search, class Describe>
void add_all(Hash& hash, const Input& input, const Search& search, const Describe& describe) {
  for (std::size_t i = 0; i < input.count; ++i) {
    const auto index = static_cast<std::size_t>(input.keypoints[i]);
    add(hash, describe(input, search, index, shortshot::Support(input.radius)), D::size);
    if (input.frames == nullptr) continue;
    shortshot::Frame frame{};
    __builtin_memcpy(&frame, input.frames + 9 * i, sizeof frame);
    add(hash, describe(input, search, shortshot::keypoint(input.cloud, index), frame, shortshot::Radius(input.radius)),
        D::size);
  }
}

template <class D, class Describe>
std::uint32_t hash_by_grid(const Describe& describe) {
  Hash hash;
  for (const Input& input : inputs) add_all<D>(hash, input, input.grid, describe);
  return hash.value();
}

template <class D, class Describe>
std::uint32_t hash_by_other_searches(const Describe& describe) {
  Hash hash;
  add_all<D>(hash, inputs[0], shortshot::BruteSearch{inputs[0].cloud}, describe);
  shortshot::OrganizedSearch image;
  static_cast<void>(image.build(inputs[1].cloud));  // describe_at() asks the search how that went
  add_all<D>(hash, inputs[1], image, describe);
  return hash.value();
}

bool same(const char* name, std::uint32_t hash, const char* what, std::uint32_t other) {
  if (hash == other) return true;
  board::print("different bits: ");
  board::print(name);
  board::print(" by ");
  board::print(what);
  board::print("\n");
  return false;
}

/// describe_at() with a chunk size and a workspace.
template <class D, std::uint32_t Chunk, class Scratch>
auto describe_with(Scratch& scratch) {
  return [&scratch](const Input& input, const auto& search, const auto&... where) {
    return shortshot::describe_at<D, Chunk>(input.cloud, search, where..., scratch, descriptor);
  };
}

template <class D, std::uint32_t Chunk>
bool same_in_chunks(const char* name, std::uint32_t hash) {
  if constexpr (Chunk % shortshot::extend::simd::lanes != 0) {
    return true;  // on this machine there is no such size
  } else {
    bool good = same(name, hash, "chunk size", hash_by_grid<D>(describe_with<D, Chunk>(workspace)));
#if defined(COMPACT)
    good = same(name, hash, "compact workspace", hash_by_grid<D>(describe_with<D, Chunk>(compact_workspace))) && good;
#endif
    return good;
  }
}

/// Prints the hash; false if there is more than one.
template <class D>
bool check(const char* name) {
  const auto describe = describe_with<D, shortshot::default_chunk_size>(workspace);
  const std::uint32_t hash = hash_by_grid<D>(describe);
  board::print_hash(name, hash);
  bool good = same(name, hash, "other searches", hash_by_other_searches<D>(describe));
  good = same_in_chunks<D, 1>(name, hash) && good;
  good = same_in_chunks<D, 4>(name, hash) && good;
  good = same_in_chunks<D, 16>(name, hash) && good;
  if constexpr (D::needs_colors) {
    for (int i = 0; i < 2; ++i) {
      good = shortshot::convert_colors<typename D::LabRule>(inputs[i].cloud, colors[i]) == Status::ok && good;
    }
    const auto converted = [](const Input& input, const auto& search, const auto&... where) {
      return shortshot::describe_at<D>(input.cloud, search, where..., workspace, descriptor, input.colors);
    };
    good = same(name, hash, "converted colors", hash_by_grid<D>(converted)) && good;
  }
  return good;
}

}  // namespace

int main() {
  const auto golden_size = static_cast<std::size_t>(golden_points_end - golden_points) / 3;
  const auto golden_count = static_cast<std::size_t>(golden_keypoints_end - golden_keypoints);
  inputs[0].cloud =
      shortshot::with_normals(shortshot::view_xyz_rgb(golden_points, golden_rgb, golden_size), golden_normals);
  inputs[0].radius = GOLDEN_RADIUS;
  inputs[0].keypoints = golden_keypoints;
  inputs[0].count = golden_count;
  inputs[0].frames = golden_frames;

  static const std::int32_t patch_keypoints[] = {0, 49, 525, 777, 1025, 1131, 1480, 1999};
  inputs[1].cloud = patch::with_normals(patch::make(memory), 0.0625f, memory, workspace);
  inputs[1].radius = patch_radius;
  inputs[1].keypoints = patch_keypoints;
  inputs[1].count = sizeof patch_keypoints / sizeof patch_keypoints[0];

  for (int i = 0; i < 2; ++i) inputs[i].colors = colors[i];
  bool good = golden_count > 0 && golden_frames_end - golden_frames == static_cast<std::ptrdiff_t>(9 * golden_count);
  for (Input& input : inputs) good = input.grid.build(input.cloud, input.radius) == Status::ok && good;
  if (!good) board::print("the inputs cannot be used\n");
  good = check<shortshot::Ssh32>("Ssh32") && good;
  good = check<shortshot::Ssh96>("Ssh96") && good;
  good = check<shortshot::Scsh336>("Scsh336") && good;
  good = check<shortshot::Scsh696>("Scsh696") && good;
  good = check<shortshot::Shot352>("Shot352") && good;
  good = check<shortshot::ShapeColor95>("ShapeColor95") && good;
  good = check<shortshot::ShapeColor32>("ShapeColor32") && good;
  return good ? 0 : 1;
}
