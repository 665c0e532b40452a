// same_bits DIRECTORY: what the C interface gives has the bits of the C++ interface: rows in each storage, statuses,
// frames, normals, matches, poses, hypotheses, files. And where memory runs out, wherever that is, it says so: operator
// new is this program's, for the library, too. Prints what differs; the exit code is 1 then.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <new>
#include <string>
#include <vector>

#include "shortshot.h"
#include "shortshot.hpp"

namespace {
long news_left = -1;  // before one fails; negative: none does
}  // namespace

void* operator new(std::size_t size) {
  if (news_left == 0) throw std::bad_alloc();
  if (news_left > 0) --news_left;
  void* const memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

namespace ss = shortshot;
bool good = true;

void expect(bool condition, const std::string& what) {
  if (!condition) std::printf("differs: %s\n", what.c_str());
  good = good && condition;
}

void ok(ss::Status status) { expect(status == ss::Status::ok, ss::message(status)); }
void ok(shortshot_status status) { expect(status == SHORTSHOT_OK, shortshot_message(status)); }

template <class A, class B>
bool same(const std::vector<A>& a, const B* b, std::size_t count) {
  static_assert(sizeof(A) == sizeof(B), "the same layout");
  return a.size() == count && count > 0 && std::memcmp(a.data(), b, count * sizeof(A)) == 0;
}

/// Are the numbers of C those of C++?
// clang-format off
#define SAME(cpp, c) (int(ss::Status::cpp) == SHORTSHOT_##c)
constexpr bool same_numbers =
    SAME(ok, OK) && SAME(empty_cloud, EMPTY_CLOUD) && SAME(bad_view, BAD_VIEW) && SAME(bad_radius, BAD_RADIUS) &&
    SAME(bad_keypoint, BAD_KEYPOINT) && SAME(invalid_keypoint, INVALID_KEYPOINT) &&
    SAME(missing_colors, MISSING_COLORS) && SAME(missing_normals, MISSING_NORMALS) &&
    SAME(too_few_neighbors, TOO_FEW_NEIGHBORS) && SAME(too_many_neighbors, TOO_MANY_NEIGHBORS) &&
    SAME(ambiguous_frame, AMBIGUOUS_FRAME) && SAME(bad_frame, BAD_FRAME) && SAME(bad_viewpoint, BAD_VIEWPOINT) &&
    SAME(bad_leaf, BAD_LEAF) && SAME(out_of_memory, OUT_OF_MEMORY) && SAME(not_organized, NOT_ORGANIZED) &&
    SAME(bad_rows, BAD_ROWS) && SAME(bad_option, BAD_OPTION) && SAME(too_few_pairs, TOO_FEW_PAIRS) &&
    SAME(no_pose, NO_POSE) && SAME(not_trained, NOT_TRAINED) && SAME(not_a_model, NOT_A_MODEL) &&
    SAME(other_version, OTHER_VERSION) && SAME(other_descriptor, OTHER_DESCRIPTOR) &&
    SAME(damaged_model, DAMAGED_MODEL) && SAME(no_file, NO_FILE) && SAME(missing_intensities, MISSING_INTENSITIES) &&
    SAME(unsure_frame, UNSURE_FRAME) && SAME(other_cloud, OTHER_CLOUD) &&
    SAME(coarse_coordinates, COARSE_COORDINATES) && SAME(not_written, NOT_WRITTEN);
// clang-format on
static_assert(same_numbers, "shortshot_status");

struct Cloud {
  std::vector<float> xyz;
  std::vector<std::uint8_t> rgb;
  bool out_of_memory = false;  // is it described where there is none, too?

  explicit Cloud(float bend) {
    for (int i = 0; i < 60 * 60; ++i) {
      const float x = 0.004f * float(i % 60) + 0.002f, y = 0.004f * float(i / 60) + 0.002f;
      xyz.insert(xyz.end(), {x, y, 1.0f + bend * x * y * (0.15f - x)});
      rgb.insert(rgb.end(), {std::uint8_t(900.0f * x), std::uint8_t(1000.0f * y), std::uint8_t(i % 7)});
    }
  }
  [[nodiscard]] std::size_t size() const { return xyz.size() / 3; }
};

/// A cloud described by both: rows of C, and the floats of C++.
template <class D>
struct Both {
  ss::Features<D> features;
  std::vector<shortshot_keypoint> keypoints;
  std::vector<std::uint8_t> rows, status;
  std::vector<shortshot_frame> frames;
  shortshot_features c{};

  Both(const Cloud& cloud, shortshot_descriptor descriptor) {
    ss::CloudOptions options;
    options.viewpoint = ss::Viewpoint::towards({0.1f, 0.0f, 0.0f});
    options.frame_radius = 0.03f;
    options.best_frames = 0.75f;
    shortshot_options c_options;
    shortshot_cloud c_cloud;
    ok(shortshot_default_options(&c_options, sizeof c_options));
    c_options.viewpoint_side = SHORTSHOT_TOWARDS;
    c_options.viewpoint[0] = 0.1f;
    c_options.frame_radius = 0.03f;
    c_options.best_frames = 0.75f;
    c_options.threads = 2;
    ok(shortshot_view_xyz_rgb(cloud.xyz.data(), cloud.rgb.data(), cloud.size(), &c_cloud, sizeof c_cloud));
    const ss::CloudView view = ss::view_xyz_rgb(cloud.xyz.data(), cloud.rgb.data(), cloud.size());

    std::vector<ss::SurfaceNormal> normals;
    std::vector<float> c_normals(3 * cloud.size());
    ok(ss::estimate_normals(view, ss::GridSearch(view, 0.01f), 0.01f, options.viewpoint, normals));
    ok(shortshot_estimate_normals(&c_cloud, 0.01f, &c_options, c_normals.data()));
    expect(same(normals, reinterpret_cast<const ss::SurfaceNormal*>(c_normals.data()), cloud.size()), "normals");
    c_cloud.normal_x = c_normals.data();
    c_cloud.normal_y = c_normals.data() + 1;
    c_cloud.normal_z = c_normals.data() + 2;
    c_cloud.normal_stride_bytes = 12;

    ok(ss::describe_cloud(ss::with_normals(view, normals.data()), options, features));
    std::size_t count = 0;
    keypoints.resize(cloud.size());
    ok(shortshot_sample_centroids(&c_cloud, 0.5f * options.radius, keypoints.data(), keypoints.size(), &count));
    rows.resize(count * shortshot_row_bytes(descriptor, SHORTSHOT_FLOATS));
    status.resize(count);
    frames.resize(count);
    c = {sizeof c, descriptor, SHORTSHOT_FLOATS, 0, count, keypoints.data(), rows.data(), status.data(), frames.data()};
    ok(shortshot_describe(&c_cloud, &c_options, &c));
    expect(same(features.status, status.data(), count), "statuses");
    expect(same(features.frames, frames.data(), count), "frames");
    expect(same(features.values, static_cast<const float*>(c.rows), count * std::size_t{D::size}), "rows of floats");
    for (std::size_t i = 0; i < count; ++i) {
      const ss::KeyPoint& key = features.keypoints[i];
      expect(std::memcmp(&key.position, &keypoints[i], 12) == 0 && std::memcmp(&key.color, &keypoints[i].r, 3) == 0 &&
                 keypoints[i].has == SHORTSHOT_HAS_COLOR,
             "key points");
    }
    if (cloud.out_of_memory) without_memory(c_cloud, c_options, c);
  }

  /// Whichever of the allocations fails: the status says so, all rows are zeros, and the next call is as ever.
  static void without_memory(const shortshot_cloud& cloud, const shortshot_options& options, shortshot_features c) {
    const std::vector<std::uint8_t> rows(static_cast<std::uint8_t*>(c.rows),
                                         static_cast<std::uint8_t*>(c.rows) + c.count * sizeof(float) * D::size);
    shortshot_options alone = options;
    alone.threads = 1;
    shortshot_status status = SHORTSHOT_OUT_OF_MEMORY;
    long news = 0;
    for (; status != SHORTSHOT_OK && news < 1000; ++news) {
      news_left = news;
      status = shortshot_describe(&cloud, &alone, &c);
      news_left = -1;
      if (status == SHORTSHOT_OK) break;
      expect(status == SHORTSHOT_OUT_OF_MEMORY && c.status[c.count - 1] == status, shortshot_message(status));
      expect(static_cast<float*>(c.rows)[c.count * std::size_t{D::size} - 1] == 0.0f, "rows without memory");
    }
    expect(news > 5 && news < 1000, "allocations");
    expect(same(rows, static_cast<std::uint8_t*>(c.rows), rows.size()), "rows after memory ran out");
  }
};

std::string file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Rows, matches, recognizers of two clouds, in floats or stored: C++ has a type for what C has a number for.
template <class Features, class Rows, class D>
void compare(const Features& a, const Features& b, const Rows& rows_a, const Rows& rows_b, shortshot_storage storage,
             const Both<D>& both_a, const Both<D>& both_b, const std::string& path) {
  const std::string name = "storage " + std::to_string(storage) + ": ";
  shortshot_features c[2] = {both_a.c, both_b.c};
  std::vector<std::uint8_t> stored[2];
  for (shortshot_features& f : c) {
    std::vector<std::uint8_t>& rows = stored[&f - c];
    rows.resize(f.count * shortshot_row_bytes(f.descriptor, storage));
    ok(shortshot_store(f.descriptor, storage, static_cast<const float*>(f.rows), f.count, rows.data()));
    f.rows = rows.data();
    f.storage = storage;
  }
  if constexpr (!std::is_same<Features, ss::Features<D>>::value) {
    const auto* const row = reinterpret_cast<const std::uint8_t*>(a.descriptors.data());
    expect(same(stored[0], row, a.size() * sizeof a.descriptors[0]), name + "rows");
  }

  std::vector<ss::MatchedPair> pairs;
  std::vector<shortshot_pair> c_pairs(c[0].count);
  std::vector<ss::Match> matches;
  std::vector<shortshot_match> c_matches(3 * c[0].count);
  std::size_t count = 0;
  ok(ss::reciprocal_correspondences(rows_a, rows_b, pairs));
  ok(shortshot_reciprocal_correspondences(&c[0], &c[1], 2, c_pairs.data(), &count));
  expect(same(pairs, c_pairs.data(), count), name + "pairs");
  ok(ss::nearest(rows_a, rows_b, 3, matches));
  ok(shortshot_nearest(&c[0], &c[1], 3, 1, c_matches.data()));
  expect(same(matches, c_matches.data(), c_matches.size()), name + "nearest");

  std::vector<ss::PointPair> places;
  for (const ss::MatchedPair& m : pairs)
    places.push_back({a.keypoints[m.source].position, b.keypoints[m.target].position});
  ss::Pose pose;
  shortshot_pose c_pose;
  std::vector<std::uint32_t> inliers, c_inliers(places.size());
  ok(ss::estimate_pose(places, ss::RansacOptions{}, pose, inliers));
  ok(shortshot_estimate_pose(reinterpret_cast<const shortshot_point_pair*>(places.data()), places.size(), nullptr,
                             &c_pose, c_inliers.data(), &count));
  expect(std::memcmp(&pose, &c_pose, sizeof pose) == 0 && same(inliers, c_inliers.data(), count), name + "pose");

  const float center[3] = {0.1f, 0.1f, 1.0f};
  ss::Recognizer recognizer;
  std::vector<ss::Hypothesis> found;
  ok(train(recognizer, a, {0.1f, 0.1f, 1.0f}, "sheet", "a"));
  ok(train(recognizer, b, {0.1f, 0.1f, 1.0f}, "sheet", "b"));
  ok(recognize(recognizer, a, found));
  ok(ss::save(recognizer, path + "/cpp.model"));
  shortshot_recognizer *trained = nullptr, *loaded = nullptr;
  shortshot_hypothesis c_found[8];
  ok(shortshot_recognizer_create(nullptr, &trained));
  ok(shortshot_recognizer_train(trained, &c[0], center, "sheet", "a"));
  ok(shortshot_recognizer_train(trained, &c[1], center, "sheet", "b"));
  ok(shortshot_recognizer_save(trained, (path + "/c.model").c_str()));
  expect(file(path + "/c.model") == file(path + "/cpp.model") && file(path + "/c.model").size() > 1000, name + "file");
  ok(shortshot_recognizer_load((path + "/cpp.model").c_str(), c[0].descriptor, storage, &loaded));
  ok(shortshot_recognizer_recognize(loaded, &c[0], 2, c_found, 8, &count));
  expect(same(found, c_found, count), name + "hypotheses");
  shortshot_recognizer_destroy(trained);
  shortshot_recognizer_destroy(loaded);
}

template <class Stored, class D>
void compare_stored(shortshot_storage storage, const Both<D>& a, const Both<D>& b, const std::string& path) {
  ss::StoredFeatures<Stored> stored_a, stored_b;
  ok(ss::store(a.features, stored_a));
  ok(ss::store(b.features, stored_b));
  compare(stored_a, stored_b, ss::rows_of(stored_a), ss::rows_of(stored_b), storage, a, b, path);
}

/// Is the descriptor of a number, which has its name, D?
template <class D>
void check_entry(shortshot_descriptor number, const std::string& name) {
  const int needs = (D::needs_colors ? SHORTSHOT_NEEDS_COLORS : 0) + (D::needs_normals ? SHORTSHOT_NEEDS_NORMALS : 0) +
                    (D::needs_intensities ? SHORTSHOT_NEEDS_INTENSITIES : 0);
  expect(shortshot_row_bytes(number, SHORTSHOT_FLOATS) == D::size_bytes &&
             shortshot_needs(number) == static_cast<std::uint32_t>(needs) && shortshot_descriptor_name(number) == name,
         name);
}

}  // namespace

int main(int, char** arguments) {
  const std::string path = arguments[1];
#define CHECK_ENTRY(number, name) check_entry<ss::name>(SHORTSHOT_##number, #name)
  CHECK_ENTRY(SSH32, Ssh32);
  CHECK_ENTRY(SSH96, Ssh96);
  CHECK_ENTRY(SCSH336, Scsh336);
  CHECK_ENTRY(SCSH696, Scsh696);
  CHECK_ENTRY(SHOT352, Shot352);
  CHECK_ENTRY(CSHOT1344, Cshot1344);
  CHECK_ENTRY(PCL_SHOT352, PclShot352);
  CHECK_ENTRY(PCL_CSHOT1344, PclCshot1344);
  CHECK_ENTRY(INTENSITY_SHAPE336, IntensityShape336);
  CHECK_ENTRY(SHAPE_COLOR95, ShapeColor95);
  CHECK_ENTRY(SHAPE_COLOR32, ShapeColor32);
  CHECK_ENTRY(ROOM_COLOR95, RoomColor95);
  CHECK_ENTRY(HEIGHT_SHAPE96, HeightShape96);
  CHECK_ENTRY(COLOR_RINGS27, ColorRings27);
  Cloud bent(20.0f), flatter(15.0f);
  flatter.out_of_memory = true;
  const Both<ss::Shot352> shot(bent, SHORTSHOT_SHOT352);
  using D = ss::ShapeColor95;
  const Both<D> a(bent, SHORTSHOT_SHAPE_COLOR95), b(flatter, SHORTSHOT_SHAPE_COLOR95);
  compare(a.features, b.features, ss::rows_of(a.features), ss::rows_of(b.features), SHORTSHOT_FLOATS, a, b, path);
  compare_stored<ss::HalfDescriptor<D>>(SHORTSHOT_HALVES, a, b, path);
  compare_stored<ss::ByteDescriptor<D>>(SHORTSHOT_BYTES, a, b, path);
  compare_stored<ss::NibbleDescriptor<D>>(SHORTSHOT_NIBBLES, a, b, path);
  compare_stored<ss::CodedDescriptor<D, 3>>(SHORTSHOT_OCTALS, a, b, path);
  compare_stored<ss::BinaryDescriptor<D>>(SHORTSHOT_BITS, a, b, path);
  compare_stored<ss::SumBits<D>>(SHORTSHOT_SUM_BITS, a, b, path);
  return good ? 0 : 1;
}
