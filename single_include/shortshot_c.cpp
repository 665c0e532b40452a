// SPDX-License-Identifier: BSD-3-Clause
// shortshot_c.cpp: the functions of shortshot.h, which says what each of them does. The one file to compile:
//
//     g++ -std=c++17 -O2 -shared -fPIC -fvisibility=hidden shortshot_c.cpp -o libshortshot.so
//
// Most of the time goes into the table of descriptors in shortshot_c.hpp: without the lines of those that you do not
// need it is less, and so is the library.
#include "shortshot_c.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

extern "C" {

std::uint32_t shortshot_abi(void) { return SHORTSHOT_ABI; }

const char* shortshot_version(void) {
#define SHORTSHOT_TEXT_(number) #number
#define SHORTSHOT_TEXT(number) SHORTSHOT_TEXT_(number)
  return SHORTSHOT_TEXT(SHORTSHOT_VERSION_MAJOR) "." SHORTSHOT_TEXT(SHORTSHOT_VERSION_MINOR) "." SHORTSHOT_TEXT(
      SHORTSHOT_VERSION_PATCH);
}

const char* shortshot_message(shortshot_status status) {
  return ss::message(status >= 0 && status < ss::status_count ? Status(status) : Status(255));
}

shortshot_status shortshot_find_descriptor(const char* name, shortshot_descriptor* descriptor) {
  if (name == nullptr || descriptor == nullptr) return SHORTSHOT_BAD_OPTION;
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; };
  for (const Entry& entry : table) {
    std::size_t i = 0;
    while (name[i] != 0 && lower(name[i]) == lower(entry.name[i])) ++i;
    if (name[i] != 0 || entry.name[i] != 0) continue;
    *descriptor = entry.number;
    return SHORTSHOT_OK;
  }
  return SHORTSHOT_BAD_OPTION;
}

const char* shortshot_descriptor_name(shortshot_descriptor descriptor) {
  const Entry* const entry = find(descriptor);
  return entry == nullptr ? nullptr : entry->name;
}

std::uint32_t shortshot_needs(shortshot_descriptor descriptor) {
  const Entry* const entry = find(descriptor);
  return entry == nullptr ? 0 : entry->needs;
}

std::size_t shortshot_row_bytes(shortshot_descriptor descriptor, shortshot_storage storage) {
  const Storage* const found = find(descriptor, storage);
  return found == nullptr ? 0 : found->row_bytes;
}

shortshot_status shortshot_view_xyz_rgb(const float* xyz, const std::uint8_t* rgb, std::size_t count,
                                        shortshot_cloud* cloud, std::size_t size_bytes) {
  shortshot_cloud view{};
  view.count = count;
  if (xyz == nullptr) return SHORTSHOT_BAD_VIEW;
  view.x = xyz, view.y = xyz + 1, view.z = xyz + 2, view.xyz_stride_bytes = 3 * sizeof(float);
  if (rgb != nullptr) view.r = rgb, view.g = rgb + 1, view.b = rgb + 2, view.rgb_stride_bytes = 3;
  return write_sized(view, cloud, size_bytes) ? SHORTSHOT_OK : SHORTSHOT_BAD_VIEW;
}

shortshot_status shortshot_default_options(shortshot_options* options, std::size_t size_bytes) {
  return write_sized(options_of({}), options, size_bytes) ? SHORTSHOT_OK : SHORTSHOT_BAD_OPTION;
}

shortshot_status shortshot_sample_centroids(const shortshot_cloud* cloud, float leaf, shortshot_keypoint* keypoints,
                                            std::size_t capacity, std::size_t* count) {
  if (count != nullptr) *count = 0;
  if (count == nullptr || (keypoints == nullptr && capacity > 0)) return SHORTSHOT_BAD_OPTION;
  return guarded([&] {
    std::vector<ss::KeyPoint> found;
    const Status status = ss::sample_centroids(view_of(cloud), leaf, found);
    *count = found.size();
    for (std::size_t i = 0; i < found.size() && i < capacity; ++i) keypoints[i] = keypoint_of(found[i]);
    return found.size() > capacity ? Status::out_of_memory : status;
  });
}

shortshot_status shortshot_estimate_normals(const shortshot_cloud* cloud, float radius,
                                            const shortshot_options* options, float* normals) {
  return guarded([&] {
    ss::CloudOptions given;
    if (normals == nullptr || read(options, given) != Status::ok) return Status::bad_option;
    const ss::CloudView view = view_of(cloud);
    std::vector<ss::SurfaceNormal> found;
    const ss::GridSearch search(view, radius);
    const Status status = ss::estimate_normals(view, search, radius, given.viewpoint, found, given.threads);
    if (!found.empty()) std::memcpy(normals, found.data(), found.size() * sizeof found[0]);
    return status;
  });
}

shortshot_status shortshot_describe(const shortshot_cloud* cloud, const shortshot_options* options,
                                    const shortshot_features* features) {
  if (!has_size(features) || features->reserved != 0) return SHORTSHOT_BAD_ROWS;
  if (features->count > 0 && (features->rows == nullptr || features->keypoints == nullptr)) return SHORTSHOT_BAD_ROWS;
  const Storage* const storage = find(features->descriptor, features->storage);
  if (storage == nullptr) return SHORTSHOT_BAD_ROWS;
  const shortshot_status status = guarded([&] {
    ss::CloudOptions given;
    if (read(options, given) != Status::ok) return Status::bad_option;
    std::vector<ss::KeyPoint> keypoints(features->count);
    for (std::size_t i = 0; i < features->count; ++i) keypoints[i] = keypoint_of(features->keypoints[i]);
    return find(features->descriptor)->describe(view_of(cloud), keypoints, given, *storage, *features);
  });
  for (std::size_t i = 0; status != SHORTSHOT_OK && i < features->count; ++i) {
    storage->make(no_values, static_cast<unsigned char*>(features->rows) + i * storage->row_bytes);
    if (features->status != nullptr) features->status[i] = static_cast<std::uint8_t>(status);
    if (features->frames != nullptr) features->frames[i] = {};
  }
  return status;
}

shortshot_status shortshot_store(shortshot_descriptor descriptor, shortshot_storage storage, const float* values,
                                 std::size_t count, void* rows) {
  const Storage* const to = find(descriptor, storage);
  if (to == nullptr) return SHORTSHOT_BAD_OPTION;
  if (count > 0 && (values == nullptr || rows == nullptr)) return SHORTSHOT_BAD_ROWS;
  const std::size_t row_size = find(descriptor)->storages[SHORTSHOT_FLOATS].row_bytes / sizeof(float);
  for (std::size_t i = 0; i < count; ++i)
    to->make(values + i * row_size, static_cast<unsigned char*>(rows) + i * to->row_bytes);
  return SHORTSHOT_OK;
}

shortshot_status shortshot_nearest(const shortshot_features* queries, const shortshot_features* database, std::size_t k,
                                   std::uint32_t threads, shortshot_match* matches) {
  return match_rows(queries, database, [&](const auto& from, const auto& to) {
    if (from.count > 0 && matches == nullptr) return Status::bad_rows;
    std::vector<ss::Match> found;
    const Status status = ss::nearest(from, to, k, found, threads);
    copy(found.data(), found.size(), matches);
    return status;
  });
}

shortshot_status shortshot_reciprocal_correspondences(const shortshot_features* source,
                                                      const shortshot_features* target, std::uint32_t threads,
                                                      shortshot_pair* pairs, std::size_t* count) {
  if (count == nullptr) return SHORTSHOT_BAD_ROWS;
  *count = 0;
  return match_rows(source, target, [&](const auto& from, const auto& to) {
    if (from.count > 0 && pairs == nullptr) return Status::bad_rows;
    std::vector<ss::MatchedPair> found;
    const Status status = ss::reciprocal_correspondences(from, to, found, threads);
    copy(found.data(), found.size(), pairs);
    *count = found.size();
    return status;
  });
}

shortshot_status shortshot_default_ransac_options(shortshot_ransac_options* options, std::size_t size_bytes) {
  const ss::RansacOptions from;
  const shortshot_ransac_options to{0, from.iterations, from.inlier_distance, from.edge_similarity, from.seed};
  return write_sized(to, options, size_bytes) ? SHORTSHOT_OK : SHORTSHOT_BAD_OPTION;
}

shortshot_status shortshot_estimate_pose(const shortshot_point_pair* pairs, std::size_t count,
                                         const shortshot_ransac_options* options, shortshot_pose* pose,
                                         std::uint32_t* inliers, std::size_t* inlier_count) {
  if (pose != nullptr) *pose = {};
  if (inlier_count != nullptr) *inlier_count = 0;
  if (pose == nullptr || (pairs == nullptr && count > 0)) return SHORTSHOT_BAD_ROWS;
  if (options != nullptr && !has_size(options)) return SHORTSHOT_BAD_OPTION;
  return guarded([&] {
    ss::RansacOptions given;
    if (options != nullptr) {
      given = {options->iterations, options->inlier_distance, options->edge_similarity, options->seed};
    }
    std::vector<ss::PointPair> copied(count);
    copy(pairs, count, copied.data());
    ss::Pose found;
    std::vector<std::uint32_t> agreeing;
    const Status status = ss::estimate_pose(copied, given, found, agreeing);
    copy(&found, 1, pose);
    if (inliers != nullptr) copy(agreeing.data(), agreeing.size(), inliers);
    if (inlier_count != nullptr) *inlier_count = agreeing.size();
    return status;
  });
}

shortshot_status shortshot_default_recognizer_options(shortshot_recognizer_options* options, std::size_t size_bytes) {
  const ss::RecognizerOptions from;
  const shortshot_recognizer_options to{0, from.bandwidth, from.neighbors, from.most};
  return write_sized(to, options, size_bytes) ? SHORTSHOT_OK : SHORTSHOT_BAD_OPTION;
}

shortshot_status shortshot_recognizer_create(const shortshot_recognizer_options* options,
                                             shortshot_recognizer** recognizer) {
  if (recognizer == nullptr) return SHORTSHOT_BAD_OPTION;
  *recognizer = nullptr;
  if (options != nullptr && !has_size(options)) return SHORTSHOT_BAD_OPTION;
  return guarded([&] {
    ss::RecognizerOptions given;
    if (options != nullptr) given = {options->bandwidth, options->neighbors, options->most};
    const Status status = ss::validate(given);
    if (status == Status::ok) *recognizer = new shortshot_recognizer{ss::Recognizer(given)};
    return status;
  });
}

void shortshot_recognizer_destroy(shortshot_recognizer* recognizer) { delete recognizer; }

shortshot_status shortshot_recognizer_train(shortshot_recognizer* recognizer, const shortshot_features* view,
                                            const float* center, const char* object_class, const char* instance) {
  if (recognizer == nullptr || center == nullptr || object_class == nullptr || instance == nullptr)
    return SHORTSHOT_BAD_OPTION;
  return guarded([&] {
    return with_places(view, [&](const auto& rows, const std::string& layout) {
      const ss::Point at{center[0], center[1], center[2]};
      return ss::detail::train_rows(recognizer->is, rows, layout, at, object_class, instance);
    });
  });
}

shortshot_status shortshot_recognizer_recognize(const shortshot_recognizer* recognizer, const shortshot_features* view,
                                                std::uint32_t threads, shortshot_hypothesis* hypotheses,
                                                std::size_t capacity, std::size_t* count) {
  if (count != nullptr) *count = 0;
  if (recognizer == nullptr || count == nullptr || (hypotheses == nullptr && capacity > 0)) return SHORTSHOT_BAD_OPTION;
  return guarded([&] {
    return with_places(view, [&](const auto& rows, const std::string& layout) {
      std::vector<ss::Hypothesis> found;
      const Status status = ss::detail::recognize_rows(recognizer->is, rows, layout, found, threads);
      *count = std::min(found.size(), capacity);
      copy(found.data(), *count, hypotheses);
      return status;
    });
  });
}

const char* shortshot_recognizer_class_name(const shortshot_recognizer* recognizer, std::uint32_t number) {
  if (recognizer == nullptr || number >= recognizer->is.class_count()) return nullptr;
  return recognizer->is.class_name(number).c_str();
}

const char* shortshot_recognizer_instance_name(const shortshot_recognizer* recognizer, std::uint32_t number) {
  if (recognizer == nullptr || number >= recognizer->is.instance_count()) return nullptr;
  return recognizer->is.instance_name(number).c_str();
}

shortshot_status shortshot_recognizer_save(const shortshot_recognizer* recognizer, const char* path) {
  if (recognizer == nullptr || path == nullptr) return SHORTSHOT_BAD_OPTION;
  return guarded([&] { return ss::save(recognizer->is, std::string(path)); });
}

shortshot_status shortshot_recognizer_load(const char* path, shortshot_descriptor descriptor, shortshot_storage storage,
                                           shortshot_recognizer** recognizer) {
  if (recognizer != nullptr) *recognizer = nullptr;
  const Storage* const of = find(descriptor, storage);
  if (path == nullptr || recognizer == nullptr || of == nullptr) return SHORTSHOT_BAD_OPTION;
  return guarded([&] {
    ss::Recognizer loaded;
    const Status status = ss::load(std::string(path), of->layout(), loaded);
    if (status == Status::ok) *recognizer = new shortshot_recognizer{std::move(loaded)};
    return status;
  });
}

}  // extern "C"
