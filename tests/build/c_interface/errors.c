/* errors: what the C interface refuses, and with which status; its tables. C99. Prints what is wrong. */
#include <stdio.h>
#include <string.h>

#include "shortshot.h"

static int wrong = 0;
static void expect(int line, shortshot_status got, shortshot_status wanted) {
  if (got == wanted) return;
  printf("errors.c:%d: %s (%d), not %s\n", line, shortshot_message(got), (int)got, shortshot_message(wanted));
  wrong = 1;
}
static void check(int line, int good) {
  if (good) return;
  printf("errors.c:%d: is not so\n", line);
  wrong = 1;
}
#define EXPECT(call, status) expect(__LINE__, (call), SHORTSHOT_##status)
#define CHECK(condition) check(__LINE__, (condition) != 0)

enum { points = 400, most = 16 };
static float xyz[points][3];
static uint8_t rgb[points][3];
static shortshot_keypoint keypoints[most];
static uint8_t rows[most * 1408], row_status[most];
static shortshot_frame frames[most];

static void check_tables(void) {
  shortshot_descriptor d = 99, count = 0;
  shortshot_status s;
  CHECK(shortshot_abi() == SHORTSHOT_ABI);
  CHECK(strcmp(shortshot_version(), PROJECT_VERSION) == 0);
  CHECK(strcmp(shortshot_message(SHORTSHOT_OK), "ok") == 0);
  for (s = SHORTSHOT_OK; s <= SHORTSHOT_NOT_WRITTEN; ++s)
    CHECK(strcmp(shortshot_message(s), shortshot_message(-1)) != 0);
  CHECK(strcmp(shortshot_message(s), shortshot_message(-1)) == 0);
  CHECK(strcmp(shortshot_message(256), shortshot_message(-1)) == 0);

  EXPECT(shortshot_find_descriptor("Ssh3", &d), BAD_OPTION);
  EXPECT(shortshot_find_descriptor("Ssh322", &d), BAD_OPTION);
  EXPECT(shortshot_find_descriptor("", &d), BAD_OPTION);
  EXPECT(shortshot_find_descriptor(NULL, &d), BAD_OPTION);
  EXPECT(shortshot_find_descriptor("Ssh32", NULL), BAD_OPTION);
  CHECK(d == 99);
  EXPECT(shortshot_find_descriptor("shapeCOLOR95", &d), OK);
  CHECK(d == SHORTSHOT_SHAPE_COLOR95);
  for (; shortshot_descriptor_name(count) != NULL; ++count) {
    EXPECT(shortshot_find_descriptor(shortshot_descriptor_name(count), &d), OK);
    CHECK(d == count && shortshot_row_bytes(d, SHORTSHOT_FLOATS) > shortshot_row_bytes(d, SHORTSHOT_OCTALS));
  }
  CHECK(count == SHORTSHOT_COLOR_RINGS27 + 1);
  CHECK(shortshot_row_bytes(count, SHORTSHOT_FLOATS) == 0 && shortshot_needs(count) == 0);
  CHECK(shortshot_row_bytes(SHORTSHOT_SSH32, SHORTSHOT_SUM_BITS + 1) == 0);
  CHECK(shortshot_row_bytes(SHORTSHOT_CSHOT1344, SHORTSHOT_FLOATS) == 5376);
  CHECK(shortshot_row_bytes(SHORTSHOT_SCSH336, SHORTSHOT_HALVES) == 672);
  CHECK(shortshot_row_bytes(SHORTSHOT_SCSH336, SHORTSHOT_BYTES) == 336);
  CHECK(shortshot_row_bytes(SHORTSHOT_SHAPE_COLOR95, SHORTSHOT_NIBBLES) == 95);
  CHECK(shortshot_row_bytes(SHORTSHOT_SHAPE_COLOR32, SHORTSHOT_OCTALS) == 24);
  CHECK(shortshot_row_bytes(SHORTSHOT_SHOT352, SHORTSHOT_BITS) == 44);
  CHECK(shortshot_row_bytes(SHORTSHOT_SHAPE_COLOR95, SHORTSHOT_SUM_BITS) == 44);
  CHECK(shortshot_needs(SHORTSHOT_SSH32) == 0 && shortshot_needs(SHORTSHOT_SHOT352) == SHORTSHOT_NEEDS_NORMALS);
  CHECK(shortshot_needs(SHORTSHOT_CSHOT1344) == SHORTSHOT_NEEDS_NORMALS + SHORTSHOT_NEEDS_COLORS);
  CHECK(shortshot_needs(SHORTSHOT_INTENSITY_SHAPE336) == SHORTSHOT_NEEDS_INTENSITIES);
}

/* The cloud, and key points of it. */
static shortshot_cloud check_cloud(size_t* count) {
  shortshot_cloud cloud, other;
  int i;
  for (i = 0; i < points; ++i) {
    xyz[i][0] = 0.005f * (float)(i % 20), xyz[i][1] = 0.005f * (float)(i / 20);
    xyz[i][2] = 1 + 9 * xyz[i][0] * xyz[i][0] * xyz[i][1];
  }
  EXPECT(shortshot_view_xyz_rgb(xyz[0], rgb[0], points, &cloud, sizeof cloud - 1), BAD_VIEW);
  EXPECT(shortshot_view_xyz_rgb(NULL, rgb[0], points, &cloud, sizeof cloud), BAD_VIEW);
  EXPECT(shortshot_view_xyz_rgb(xyz[0], rgb[0], points, NULL, sizeof cloud), BAD_VIEW);
  EXPECT(shortshot_view_xyz_rgb(xyz[0], rgb[0], points, &cloud, sizeof cloud), OK);

  *count = 7;
  EXPECT(shortshot_sample_centroids(NULL, 0.04f, keypoints, most, count), BAD_VIEW);
  CHECK(*count == 0);
  EXPECT(shortshot_sample_centroids(&cloud, 0.0f, keypoints, most, count), BAD_LEAF);
  EXPECT(shortshot_sample_centroids(&cloud, 0.04f, NULL, most, count), BAD_OPTION);
  EXPECT(shortshot_sample_centroids(&cloud, 0.04f, keypoints, most, NULL), BAD_OPTION);
  other = cloud, other.size_bytes += 8;
  EXPECT(shortshot_sample_centroids(&other, 0.04f, keypoints, most, count), BAD_VIEW);
  other = cloud, other.y = NULL;
  EXPECT(shortshot_sample_centroids(&other, 0.04f, keypoints, most, count), BAD_VIEW);
  other = cloud, other.intensity_type = 3;
  EXPECT(shortshot_sample_centroids(&other, 0.04f, keypoints, most, count), BAD_VIEW);
  other = cloud, other.count = 0;
  EXPECT(shortshot_sample_centroids(&other, 0.04f, keypoints, most, count), EMPTY_CLOUD);
  EXPECT(shortshot_sample_centroids(&cloud, 0.04f, NULL, 0, count), OUT_OF_MEMORY);
  CHECK(*count == 9);
  EXPECT(shortshot_sample_centroids(&cloud, 0.04f, keypoints, *count - 1, count), OUT_OF_MEMORY);
  EXPECT(shortshot_sample_centroids(&cloud, 0.04f, keypoints, *count, count), OK);
  CHECK(*count == 9 && keypoints[0].has == SHORTSHOT_HAS_COLOR);
  return cloud;
}

/* Do all rows say why there is none? */
static void check_rows(int line, size_t count, size_t row_bytes, shortshot_status status) {
  size_t i;
  for (i = 0; i < count; ++i) check(line, row_status[i] == status && frames[i].x[0] == 0.0f);
  for (i = 0; i < count * row_bytes; ++i) check(line, rows[i] == 0);
}

static shortshot_features check_describe(shortshot_cloud cloud, size_t count) {
  const shortshot_features all = {sizeof all, SHORTSHOT_SSH32, SHORTSHOT_FLOATS, 0, count, keypoints, rows,
                                  row_status, frames};
  shortshot_features f = all;
  shortshot_options options;
  static float normals[points][3];
  EXPECT(shortshot_default_options(&options, sizeof options + 1), BAD_OPTION);
  EXPECT(shortshot_default_options(NULL, sizeof options), BAD_OPTION);
  EXPECT(shortshot_default_options(&options, sizeof options), OK);

  memset(rows, 1, sizeof rows), memset(frames, 1, sizeof frames);
  f.descriptor = SHORTSHOT_SHOT352;
  EXPECT(shortshot_describe(&cloud, &options, &f), MISSING_NORMALS);
  check_rows(__LINE__, count, 1408, SHORTSHOT_MISSING_NORMALS);
  memset(rows, 1, sizeof rows);
  options.radius = -1.0f;
  EXPECT(shortshot_describe(&cloud, &options, &all), BAD_RADIUS);
  EXPECT(shortshot_estimate_normals(&cloud, -1.0f, NULL, normals[0]), BAD_RADIUS);
  options.radius = 0.04f, options.viewpoint_side = 3;
  EXPECT(shortshot_describe(&cloud, &options, &all), BAD_OPTION);
  check_rows(__LINE__, count, 128, SHORTSHOT_BAD_OPTION);
  EXPECT(shortshot_estimate_normals(&cloud, 0.02f, &options, normals[0]), BAD_OPTION);
  options.viewpoint_side = SHORTSHOT_AWAY_FROM, options.best_frames = 2.0f;
  EXPECT(shortshot_describe(&cloud, &options, &all), BAD_OPTION);
  options.size_bytes = 0;
  EXPECT(shortshot_describe(&cloud, &options, &all), BAD_OPTION);
  EXPECT(shortshot_describe(NULL, NULL, &all), BAD_VIEW);
  EXPECT(shortshot_describe(&cloud, NULL, NULL), BAD_ROWS);
  f = all, f.size_bytes = 1;
  EXPECT(shortshot_describe(&cloud, NULL, &f), BAD_ROWS);
  f = all, f.reserved = 1;
  EXPECT(shortshot_describe(&cloud, NULL, &f), BAD_ROWS);
  f = all, f.keypoints = NULL;
  EXPECT(shortshot_describe(&cloud, NULL, &f), BAD_ROWS);
  f = all, f.rows = NULL;
  EXPECT(shortshot_describe(&cloud, NULL, &f), BAD_ROWS);
  f = all, f.storage = SHORTSHOT_SUM_BITS + 1;
  EXPECT(shortshot_describe(&cloud, NULL, &f), BAD_ROWS);
  f = all, f.descriptor = 1000;
  EXPECT(shortshot_describe(&cloud, NULL, &f), BAD_ROWS);

  EXPECT(shortshot_estimate_normals(&cloud, 0.02f, NULL, NULL), BAD_OPTION);
  EXPECT(shortshot_estimate_normals(NULL, 0.02f, NULL, normals[0]), BAD_VIEW);
  EXPECT(shortshot_estimate_normals(&cloud, 0.02f, NULL, normals[0]), OK);
  cloud.normal_x = &normals[0][0], cloud.normal_y = &normals[0][1], cloud.normal_z = &normals[0][2];
  cloud.normal_stride_bytes = sizeof normals[0];
  f = all, f.descriptor = SHORTSHOT_SHOT352, f.count = 1, f.status = NULL, f.frames = NULL;
  EXPECT(shortshot_describe(&cloud, NULL, &f), OK);

  keypoints[1].x = 5.0f; /* far from all points: that row alone has none */
  EXPECT(shortshot_describe(&cloud, NULL, &all), OK);
  CHECK(row_status[0] == SHORTSHOT_OK && row_status[1] == SHORTSHOT_TOO_FEW_NEIGHBORS && row_status[2] == SHORTSHOT_OK);
  EXPECT(shortshot_store(SHORTSHOT_SSH32, 7, (float*)(void*)rows, 1, rows), BAD_OPTION);
  EXPECT(shortshot_store(99, SHORTSHOT_BYTES, (float*)(void*)rows, 1, rows), BAD_OPTION);
  EXPECT(shortshot_store(SHORTSHOT_SSH32, SHORTSHOT_BYTES, NULL, 1, rows), BAD_ROWS);
  EXPECT(shortshot_store(SHORTSHOT_SSH32, SHORTSHOT_BYTES, (float*)(void*)rows, 1, NULL), BAD_ROWS);
  return all;
}

static void check_matches(shortshot_features f) {
  shortshot_match matches[most];
  shortshot_pair pairs[most];
  shortshot_pose pose;
  shortshot_ransac_options options;
  static shortshot_point_pair places[3];
  shortshot_features other = f;
  uint32_t inliers[3];
  size_t count = 5, i;
  EXPECT(shortshot_nearest(&f, &f, 0, 1, matches), BAD_OPTION);
  EXPECT(shortshot_nearest(&f, &f, 1, 1, NULL), BAD_ROWS);
  EXPECT(shortshot_nearest(&f, NULL, 1, 1, matches), BAD_ROWS);
  EXPECT(shortshot_nearest(&f, &f, 1, 3, matches), OK);
  for (i = 0; i < f.count; ++i) CHECK(matches[i].row == (i == 1 ? 0xFFFFFFFFu : i)); /* 1 has no descriptor */
  other.storage = SHORTSHOT_BYTES;
  EXPECT(shortshot_reciprocal_correspondences(&f, &other, 1, pairs, &count), BAD_ROWS);
  CHECK(count == 0);
  other.storage = 7;
  EXPECT(shortshot_reciprocal_correspondences(&f, &other, 1, pairs, &count), BAD_OPTION);
  other = f, other.descriptor = SHORTSHOT_SSH96;
  EXPECT(shortshot_reciprocal_correspondences(&f, &other, 1, pairs, &count), BAD_ROWS);
  EXPECT(shortshot_reciprocal_correspondences(&f, &f, 1, NULL, &count), BAD_ROWS);
  EXPECT(shortshot_reciprocal_correspondences(&f, &f, 1, pairs, NULL), BAD_ROWS);

  EXPECT(shortshot_default_ransac_options(&options, 1), BAD_OPTION);
  EXPECT(shortshot_default_ransac_options(&options, sizeof options), OK);
  memset(&pose, 1, sizeof pose);
  EXPECT(shortshot_estimate_pose(places, 2, &options, &pose, inliers, &count), TOO_FEW_PAIRS);
  CHECK(pose.rotation[4] == 0.0f && pose.translation[2] == 0.0f && count == 0);
  EXPECT(shortshot_estimate_pose(NULL, 3, &options, &pose, inliers, &count), BAD_ROWS);
  EXPECT(shortshot_estimate_pose(places, 3, &options, NULL, inliers, &count), BAD_ROWS);
  EXPECT(shortshot_estimate_pose(places, 3, NULL, &pose, NULL, NULL), NO_POSE);
  options.iterations = 0;
  EXPECT(shortshot_estimate_pose(places, 3, &options, &pose, NULL, NULL), BAD_OPTION);
  options.size_bytes = 0;
  EXPECT(shortshot_estimate_pose(places, 3, &options, &pose, NULL, NULL), BAD_OPTION);
}

static void check_recognizer(shortshot_features f) {
  const float center[3] = {0.0f, 0.0f, 1.0f};
  shortshot_recognizer *r = NULL, *loaded = NULL;
  shortshot_recognizer_options options;
  shortshot_hypothesis found[2];
  shortshot_features other = f;
  size_t count = 0;
  EXPECT(shortshot_default_recognizer_options(&options, 1), BAD_OPTION);
  EXPECT(shortshot_default_recognizer_options(&options, sizeof options), OK);
  options.bandwidth = 0.0f;
  EXPECT(shortshot_recognizer_create(&options, &r), BAD_OPTION);
  options.size_bytes = 0;
  EXPECT(shortshot_recognizer_create(&options, &r), BAD_OPTION);
  EXPECT(shortshot_recognizer_create(NULL, NULL), BAD_OPTION);
  EXPECT(shortshot_recognizer_create(NULL, &r), OK);
  EXPECT(shortshot_recognizer_save(r, "never.model"), NOT_TRAINED);
  EXPECT(shortshot_recognizer_recognize(r, &f, 1, found, 2, &count), NOT_TRAINED);
  EXPECT(shortshot_recognizer_train(NULL, &f, center, "mug", "red"), BAD_OPTION);
  EXPECT(shortshot_recognizer_train(r, &f, NULL, "mug", "red"), BAD_OPTION);
  EXPECT(shortshot_recognizer_train(r, &f, center, NULL, "red"), BAD_OPTION);
  EXPECT(shortshot_recognizer_train(r, &f, center, "mug", NULL), BAD_OPTION);
  EXPECT(shortshot_recognizer_train(r, NULL, center, "mug", "red"), BAD_ROWS);
  other.frames = NULL;
  EXPECT(shortshot_recognizer_train(r, &other, center, "mug", "red"), BAD_ROWS);
  CHECK(shortshot_recognizer_class_name(r, 0) == NULL && shortshot_recognizer_instance_name(r, 0) == NULL);
  EXPECT(shortshot_recognizer_train(r, &f, center, "mug", "red"), OK);
  other = f, other.storage = SHORTSHOT_BITS;
  EXPECT(shortshot_recognizer_train(r, &other, center, "mug", "red"), OTHER_DESCRIPTOR);
  EXPECT(shortshot_recognizer_recognize(r, &other, 1, found, 2, &count), OTHER_DESCRIPTOR);
  EXPECT(shortshot_recognizer_recognize(r, &f, 1, NULL, 2, &count), BAD_OPTION);
  EXPECT(shortshot_recognizer_recognize(r, &f, 1, found, 2, NULL), BAD_OPTION);
  EXPECT(shortshot_recognizer_recognize(r, &f, 1, found, 2, &count), OK);
  CHECK(count >= 1 && strcmp(shortshot_recognizer_class_name(r, found[0].object_class), "mug") == 0);
  CHECK(strcmp(shortshot_recognizer_instance_name(r, found[0].instance), "red") == 0);
  EXPECT(shortshot_recognizer_recognize(r, &f, 1, NULL, 0, &count), OK);
  CHECK(count == 0);
  EXPECT(shortshot_recognizer_save(r, NULL), BAD_OPTION);
  EXPECT(shortshot_recognizer_save(r, "no such folder/x.model"), NO_FILE);
  EXPECT(shortshot_recognizer_load("no such file", f.descriptor, f.storage, &loaded), NO_FILE);
  EXPECT(shortshot_recognizer_load(NULL, f.descriptor, f.storage, &loaded), BAD_OPTION);
  EXPECT(shortshot_recognizer_load("never.model", f.descriptor, 7, &loaded), BAD_OPTION);
  EXPECT(shortshot_recognizer_load("never.model", f.descriptor, f.storage, NULL), BAD_OPTION);
  CHECK(loaded == NULL);
  shortshot_recognizer_destroy(r);
  shortshot_recognizer_destroy(NULL);
}

int main(void) {
  size_t count;
  const shortshot_cloud cloud = check_cloud(&count);
  const shortshot_features features = check_describe(cloud, count);
  check_tables();
  check_matches(features);
  check_recognizer(features);
  return wrong;
}
