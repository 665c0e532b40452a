// hashes FOLDER...: prints a line "case array hash" for whatever the library computes of each folder of golden vectors
// and of a generated scene. check_builds.sh compares these lines between compilers and machines.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "hash.hpp"
#include "shortshot/shortshot.hpp"
#include "tools/golden/case.hpp"
#include "tools/scene/tabletop.hpp"

namespace {

using namespace shortshot;
using shortshot_bits::Hash;
using shortshot_bits::Input;
using Shape = SphericalGrid<3, 4, 8>;
using Color = SphericalGrid<2, 2, 4>;

Workspace<16384> workspace;

template <class D>
void print_descriptors(const Input& input, const GridSearch& search, const char* array) {
  if (D::needs_colors && !has_colors(input.cloud)) return;
  if (D::needs_normals && !has_normals(input.cloud)) return;
  if (D::needs_intensities && !has_intensities(input.cloud)) return;
  Hash hash;
  std::vector<float> values(D::size);
  const auto add = [&](Status status) {
    hash.add(&status, 1);
    hash.add(values.data(), values.size());
  };
  for (std::size_t k = 0; k < input.keypoints.size(); ++k) {
    const std::uint32_t index = input.keypoints[k];
    add(describe_at<D>(input.cloud, search, index, input.radius, workspace, values.data()));
    if (input.frames.empty()) continue;
    add(describe_at<D>(input.cloud, search, keypoint(input.cloud, index), input.frames[k], input.radius, workspace,
                       values.data()));
  }
  hash.print(input.name, array);
}

void print_frames_and_normals(const Input& input, const GridSearch& search) {
  Hash hash, normals;
  for (const std::uint32_t index : input.keypoints) {
    Neighborhood n = neighborhood_in(workspace);
    Frame frame{};
    const Status statuses[] = {search.gather(point(input.cloud, index), input.radius, n),
                               estimate_frame(n, input.radius, frame)};
    hash.add(statuses, 2);
    hash.add(&n.found, 1);
    hash.add(&frame, 1);
    SurfaceNormal normal{};
    const Status status = estimate_normal(n, input.radius, normal);
    normals.add(&status, 1);
    normals.add(&normal, 1);
  }
  hash.print(input.name, "frames");
  normals.print(input.name, "keypoint_normals");
}

void print_fixed_lamp_frames(const Input& input, const GridSearch& search) {
  if (!has_colors(input.cloud)) return;
  Hash hash;
  for (const std::uint32_t index : input.keypoints) {
    Neighborhood n = neighborhood_in(workspace);
    Frame frame{};
    const RgbColors<PublishedLab> colors(input.cloud, Rgb{});
    const Status statuses[] = {search.gather(point(input.cloud, index), input.radius, n),
                               estimate_frame_under_fixed_lamp(n, colors, input.radius, frame, Viewpoint::towards({}))};
    hash.add(statuses, 2);
    hash.add(&frame, 1);
  }
  hash.print(input.name, "fixed_lamp_frames");
}

/// Of every point, seen from the origin.
std::vector<SurfaceNormal> print_normals(const std::string& name, const CloudView& cloud, const GridSearch& search,
                                         Radius radius) {
  std::vector<SurfaceNormal> normals;
  const Status status = estimate_normals(cloud, search, radius, Viewpoint::towards({}), normals);
  Hash hash;
  hash.add(&status, 1);
  hash.add(normals.data(), normals.size());
  hash.print(name, "normals");
  return normals;
}

/// Of a depth image, seen from the origin.
void print_image_normals(const std::string& name, const CloudView& image) {
  Hash hash;
  for (const float radius : {0.01f, 0.03f, 0.1f}) {
    std::vector<SurfaceNormal> normals;
    const Status status = estimate_image_normals(image, radius, Viewpoint::towards({}), normals, 2);
    hash.add(&status, 1);
    hash.add(normals.data(), normals.size());
  }
  hash.print(name, "image_normals");
}

template <class Rule>
void print_colors(const Input& input, const char* array) {
  if (!has_colors(input.cloud)) return;
  std::vector<Lab> lab;
  for (std::size_t i = 0; i < input.cloud.size; ++i) lab.push_back(to_lab<Rule>(color(input.cloud, i)));
  Hash hash;
  hash.add(lab.data(), lab.size());
  hash.print(input.name, array);
}

void print_all(const Input& input) {
  print_colors<PublishedLab>(input, "lab_published");
  print_colors<CshotLab>(input, "lab_cshot");
  print_colors<PclLab>(input, "lab_pcl");
  if (input.keypoints.empty()) return;
  const GridSearch search(input.cloud, input.radius.value);
  print_frames_and_normals(input, search);
  print_fixed_lamp_frames(input, search);
  print_descriptors<Ssh32>(input, search, "ssh32");
  print_descriptors<Ssh96>(input, search, "ssh96");
  print_descriptors<Scsh336>(input, search, "scsh336");
  print_descriptors<Scsh696>(input, search, "scsh696");
  print_descriptors<Scsh<Shape, Color, 15, HardVoting>>(input, search, "scsh336_hard");
  print_descriptors<Scsh<Shape, Color, 15, PublishedVoting, LinearRadius, PclLab>>(input, search, "scsh336_pcl");
  print_descriptors<Ssh<Shape, MultilinearVoting, LogRadius<>>>(input, search, "ssh96_multilinear_log");
  print_descriptors<Scsh<Shape, Color, 15, MultilinearVoting, LogRadius<>>>(input, search, "scsh336_multilinear_log");
  print_descriptors<IntensityShape336>(input, search, "intensity_shape336");
  print_descriptors<ShapeColor95>(input, search, "shape_color95");
  print_descriptors<ShapeColor32>(input, search, "shape_color32");
  print_descriptors<RoomColor95>(input, search, "room_color95");
  print_descriptors<HeightShape96>(input, search, "height_shape96");
  print_descriptors<ColorRings27>(input, search, "color_rings27");
  print_descriptors<Shot352>(input, search, "shot352");
  print_descriptors<Cshot1344>(input, search, "cshot1344");
  print_descriptors<PclShot352>(input, search, "shot352_pcl");
  print_descriptors<PclCshot1344>(input, search, "cshot1344_pcl");
  print_descriptors<Cshot<Shape, 7, 12>>(input, search, "cshot_odd");
}

/// Of rows in any format: nearest ones, and pairs by both tests.
template <class Rows>
std::vector<MatchedPair> print_matches(const Input& input, const Rows& view, const Rows& other, const char* array) {
  std::vector<Match> matches;
  std::vector<MatchedPair> mutual, distinct;
  const Status matched[] = {nearest(view, other, 3, matches), reciprocal_correspondences(view, other, mutual),
                            ratio_correspondences(view, other, 0.9f, distinct)};
  Hash hash;
  hash.add(matched, 3);
  hash.add(matches.data(), matches.size());
  hash.add(mutual.data(), mutual.size());
  hash.add(distinct.data(), distinct.size());
  hash.print(input.name, array);
  return mutual;
}

template <class D>
void print_packed_matches(const Input& input, const Features<D>& view, const Features<D>& other) {
  std::vector<ByteDescriptor<D>> bytes[2];
  std::vector<BinaryDescriptor<D>> bits[2];
  for (const int k : {0, 1}) {
    const Features<D>& features = k == 0 ? view : other;
    bytes[k].resize(features.size());
    bits[k].resize(features.size());
    for (std::size_t i = 0; i < features.size(); ++i) {
      quantize(features[i], bytes[k][i]);
      binarize(features[i], bits[k][i]);
    }
  }
  print_matches(input, rows_of(bytes[0], view.status.data()), rows_of(bytes[1], other.status.data()), "matches_bytes");
  print_matches(input, rows_of(bits[0], view.status.data()), rows_of(bits[1], other.status.data()), "matches_bits");
  std::vector<std::uint8_t> file;
  const Status saved = save(view, file);
  Hash hash;
  hash.add(&saved, 1);
  hash.add(file.data(), file.size());
  hash.print(input.name, "features_file");
}

template <class Stored, class Store>
void print_stored(const Input& input, const std::vector<float> (&views)[2], const char* name, const Store& store) {
  std::vector<Stored> stored[2];
  Hash hash;
  for (const int k : {0, 1}) {
    stored[k].resize(views[k].size() / ShapeColor95::size);
    for (std::size_t i = 0; i < stored[k].size(); ++i) store(&views[k][i * ShapeColor95::size], stored[k][i]);
    hash.add(stored[k].data(), stored[k].size());
  }
  hash.print(input.name, name);
  print_matches(input, rows_of(stored[0]), rows_of(stored[1]), (std::string("matches_") + name).c_str());
}

/// A compact descriptor in every storage, and matches of such with those of another radius.
template <class D = ShapeColor95>
void print_storages(const Input& input, const GridSearch& search, const std::vector<KeyPoint>& keypoints) {
  std::vector<float> views[2];
  for (const int k : {0, 1}) {
    Features<D> features;
    const float radius = (k == 0 ? 1.0f : 0.9f) * input.radius.value;
    if (extract(input.cloud, search, keypoints, radius, features) == Status::ok) views[k] = features.values;
  }
  const auto codes = [](const float* values, auto& out) { quantize(values, out); };
  print_stored<NibbleDescriptor<D>>(input, views, "nibbles", codes);
  print_stored<CodedDescriptor<D, 3>>(input, views, "thirds", codes);
  print_stored<ByteDescriptor<D>>(input, views, "signed_bytes", codes);
  print_stored<HalfDescriptor<D>>(input, views, "halves", codes);
  print_stored<SumBits<D>>(input, views, "sum_bits", [](const float* values, auto& out) { binarize(values, out); });
}

/// Matches of a view's key points with those seen with another radius, the motion between them, and what it shows.
void print_recognition(const Input& input) {
  std::vector<KeyPoint> keypoints;
  for (const std::uint32_t index : input.keypoints) {
    if (keypoints.size() == 60) break;  // enough for whole tiles of matching, and few for an emulated CPU
    keypoints.push_back(keypoint(input.cloud, index));
  }
  Features<Scsh336> view, other;
  const GridSearch search(input.cloud, input.radius.value);
  Hash hash;
  const Status described[] = {extract(input.cloud, search, keypoints, input.radius, view),
                              extract(input.cloud, search, keypoints, 0.9f * input.radius.value, other)};
  hash.add(described, 2);
  hash.print(input.name, "described");
  const std::vector<MatchedPair> mutual = print_matches(input, rows_of(view), rows_of(other), "matches");
  print_packed_matches(input, view, other);
  print_storages(input, search, keypoints);

  std::vector<PointPair> pairs;
  for (const MatchedPair& c : mutual) {
    const Point& p = keypoints[c.target].position;
    const float y = extend::unfused(0.8f * p.x) - extend::unfused(0.6f * p.z);
    const float z = extend::unfused(0.6f * p.x) + extend::unfused(0.8f * p.z);
    pairs.push_back({keypoints[c.source].position, {1.0f - p.y, y, z}});
  }
  Pose fitted{}, estimated{};
  std::vector<std::uint32_t> inliers;
  const Status posed[] = {fit_pose(pairs, fitted), estimate_pose(pairs, RansacOptions{}, estimated, inliers)};
  Hash pose;
  pose.add(posed, 2);
  pose.add(&fitted, 1);
  pose.add(&estimated, 1);
  pose.add(inliers.data(), inliers.size());
  pose.print(input.name, "pose");

  Recognizer recognizer(RecognizerOptions{0.05f, 2, 8});
  std::vector<Hypothesis> objects;
  const Status recognized[] = {train(recognizer, view, {0.0f, 0.0f, 1.0f}, "scene", "a"),
                               recognize(recognizer, other, objects)};
  Hash recognition;
  recognition.add(recognized, 2);
  recognition.add(objects.data(), objects.size());
  recognition.print(input.name, "recognition");
}

void print_scene() {
  const shortshot_bench::RgbdCloud scene = shortshot_bench::make_tabletop({1, 160, 120, 1.0f});
  Input input{"scene", view_xyz_rgb(scene.xyz.data(), scene.rgb.data(), scene.size()), 0.06f, {}, {}};
  Hash hash;
  hash.add(scene.xyz.data(), scene.xyz.size());
  hash.print(input.name, "points");
  Hash intensities;
  intensities.add(scene.intensity.data(), scene.intensity.size());
  intensities.print(input.name, "intensities");
  input.cloud = with_intensities(input.cloud, scene.intensity.data());
  const Status status = sample_uniform(input.cloud, 0.03f, input.keypoints);
  Hash keypoints;
  keypoints.add(&status, 1);
  keypoints.add(input.keypoints.data(), input.keypoints.size());
  keypoints.print(input.name, "keypoints");
  const GridSearch search(input.cloud, 0.03f);
  const std::vector<SurfaceNormal> normals = print_normals(input.name, input.cloud, search, 0.03f);
  print_image_normals(input.name, organized(input.cloud, scene.width, scene.height));
  input.cloud = with_normals(input.cloud, normals.data());
  print_all(input);
  print_recognition(input);
}

void print_case(const std::string& folder) {
  const shortshot_bench::golden::Case c = shortshot_bench::golden::read_case(folder);
  CloudView cloud = c.cloud();
  if (c.points.empty()) cloud = view_xyz_rgb(nullptr, c.rgb.data(), c.rgb.size() / 3);  // a table of colors
  Input input{std::filesystem::path(folder + "/").parent_path().filename().string(), cloud,
              Radius::from_double(c.radius.value_or(1.0)), c.keypoints, std::vector<Frame>(c.frames.size() / 9)};
  static_assert(sizeof(Frame) == 9 * sizeof(float), "a frame is its three axes");
  if (!c.frames.empty()) std::memcpy(input.frames.data(), c.frames.data(), c.frames.size() * sizeof(float));
  print_all(input);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    print_scene();
    for (int i = 1; i < argc; ++i) print_case(argv[i]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
