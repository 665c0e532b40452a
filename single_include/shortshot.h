/* SPDX-License-Identifier: BSD-3-Clause
 * shortshot in C, for C, Python (ctypes), Rust and whatever else calls C. README.md beside this file shows how.
 *
 * What holds for every function:
 * - It returns a status: SHORTSHOT_OK, or why not, and then counts and poses are zeros and arrays as they were, if not
 *   said otherwise. No exception leaves it: SHORTSHOT_OUT_OF_MEMORY is memory, or a thread, that the system refuses.
 *   (Only what a thread other than the caller's runs out of ends the program.)
 * - Memory is the caller's, used during the call alone; only a shortshot_recognizer owns what it has. Calls allocate
 *   scratch memory and free it. Pointers have the alignment of their type, those into a cloud need none.
 * - Nothing is kept between calls: any number of them may run at the same time if none writes what another one uses;
 *   with one recognizer those to whom it is const. `threads` share one call's work, the caller's is one of them (0
 *   is 1). The results are the same, bit for bit, for any number of them, and on every machine.
 * - Meters and sRGB. A struct's size_bytes is its sizeof: a wrong one is refused, as are structs of another version. */
#ifndef SHORTSHOT_H
#define SHORTSHOT_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__) && !defined(_WIN32)
#define SHORTSHOT_API __attribute__((visibility("default")))
#else
#define SHORTSHOT_API
#endif
#ifdef __cplusplus
extern "C" {
#endif

/* ---- Version ---------------------------------------------------------------------------------------------------- */

/* Counts changes of what this header says of memory. shortshot_abi() is the library's: they must be equal. */
#define SHORTSHOT_ABI 1
SHORTSHOT_API uint32_t shortshot_abi(void);

SHORTSHOT_API const char* shortshot_version(void); /* "0.1.0"; static */

/* ---- Status: the numbers of C++'s shortshot::Status, where each is explained ------------------------------------ */

/* An int32_t, because enumerations have no size of their own; arrays of statuses are of uint8_t.
 * bad_view is a cloud that cannot be what it says (null pointers, size_bytes, intensity_type), bad_rows the same of
 * features and of arrays of results, bad_option the same of options, and a descriptor, a storage or a name that there
 * is not. Where a message speaks of PointCloud2 the status is one that nothing here returns (28 to 39). */
/* clang-format off */
typedef int32_t shortshot_status;
enum {
  SHORTSHOT_OK = 0, SHORTSHOT_EMPTY_CLOUD = 1, SHORTSHOT_BAD_VIEW = 2, SHORTSHOT_BAD_RADIUS = 3,
  SHORTSHOT_BAD_KEYPOINT = 4, SHORTSHOT_INVALID_KEYPOINT = 5, SHORTSHOT_MISSING_COLORS = 6,
  SHORTSHOT_MISSING_NORMALS = 7, SHORTSHOT_TOO_FEW_NEIGHBORS = 8, SHORTSHOT_TOO_MANY_NEIGHBORS = 9,
  SHORTSHOT_AMBIGUOUS_FRAME = 10, SHORTSHOT_BAD_FRAME = 11, SHORTSHOT_BAD_VIEWPOINT = 12, SHORTSHOT_BAD_LEAF = 13,
  SHORTSHOT_OUT_OF_MEMORY = 14, SHORTSHOT_NOT_ORGANIZED = 15, SHORTSHOT_BAD_ROWS = 16, SHORTSHOT_BAD_OPTION = 17,
  SHORTSHOT_TOO_FEW_PAIRS = 18, SHORTSHOT_NO_POSE = 19, SHORTSHOT_NOT_TRAINED = 20, SHORTSHOT_NOT_A_MODEL = 21,
  SHORTSHOT_OTHER_VERSION = 22, SHORTSHOT_OTHER_DESCRIPTOR = 23, SHORTSHOT_DAMAGED_MODEL = 24, SHORTSHOT_NO_FILE = 25,
  SHORTSHOT_MISSING_INTENSITIES = 26, SHORTSHOT_UNSURE_FRAME = 27, SHORTSHOT_OTHER_CLOUD = 40,
  SHORTSHOT_COARSE_COORDINATES = 41, SHORTSHOT_NOT_WRITTEN = 42
};

/* One English sentence for a status, of a row or of a call; any number may be asked. Static, never null. */
SHORTSHOT_API const char* shortshot_message(shortshot_status status);

/* ---- Descriptors, and how their rows are stored ----------------------------------------------------------------- */

/* The table of names: C++'s, without regard to case. Numbers stay what they are. */
typedef uint32_t shortshot_descriptor;
enum {
  SHORTSHOT_SSH32 = 0, SHORTSHOT_SSH96 = 1, SHORTSHOT_SCSH336 = 2, SHORTSHOT_SCSH696 = 3, SHORTSHOT_SHOT352 = 4,
  SHORTSHOT_CSHOT1344 = 5,
  SHORTSHOT_PCL_SHOT352 = 6, /* "PclShot352": as PCL 1.13 computes it, defects included */
  SHORTSHOT_PCL_CSHOT1344 = 7, SHORTSHOT_INTENSITY_SHAPE336 = 8,
  SHORTSHOT_SHAPE_COLOR95 = 9, /* "ShapeColor95": the one to begin with, in nibbles */
  SHORTSHOT_SHAPE_COLOR32 = 10, SHORTSHOT_ROOM_COLOR95 = 11, SHORTSHOT_HEIGHT_SHAPE96 = 12,
  SHORTSHOT_COLOR_RINGS27 = 13 /* needs no frame, and has none to recognize with */
};
/* clang-format on */

/* A row's format. Distances are L2, of bits Hamming. */
typedef uint32_t shortshot_storage;
enum {
  SHORTSHOT_FLOATS = 0,
  SHORTSHOT_HALVES = 1,  /* 16-bit floats */
  SHORTSHOT_BYTES = 2,   /* 8 bits a value */
  SHORTSHOT_NIBBLES = 3, /* 4 bits a value */
  SHORTSHOT_OCTALS = 4,  /* 3 bits a value */
  SHORTSHOT_BITS = 5,    /* B-SHOT: 1 bit a value; meant for values that have no signs: all but compact ones */
  SHORTSHOT_SUM_BITS = 6 /* 44 bytes: signs of sparse sums of the nibbles */
};

/* The number of a name, "ShapeColor95". bad_option: there is none of that name; *descriptor is unchanged. */
SHORTSHOT_API shortshot_status shortshot_find_descriptor(const char* name, shortshot_descriptor* descriptor);

/* The name of a number from 0 on, null behind the last one. Static. */
SHORTSHOT_API const char* shortshot_descriptor_name(shortshot_descriptor descriptor);

/* What a cloud must have for a descriptor besides points: a sum of these; 0 for one that there is not. */
enum { SHORTSHOT_NEEDS_COLORS = 1, SHORTSHOT_NEEDS_NORMALS = 2, SHORTSHOT_NEEDS_INTENSITIES = 4 };
SHORTSHOT_API uint32_t shortshot_needs(shortshot_descriptor descriptor);

/* Bytes of a row: of SHORTSHOT_FLOATS 4 for each value. 0 for a descriptor or a storage that there is not. */
SHORTSHOT_API size_t shortshot_row_bytes(shortshot_descriptor descriptor, shortshot_storage storage);

/* ---- Clouds ----------------------------------------------------------------------------------------------------- */

/* A borrowed cloud, of any layout: where each channel's components of point 0 lie, and how many bytes it is to those of
 * point 1. Zeros for a channel that there is not. Points that are not finite are never neighbors. */
typedef struct shortshot_cloud {
  uint32_t size_bytes;     /* sizeof(shortshot_cloud) */
  uint32_t intensity_type; /* 0: float, 1: uint8_t, 2: uint16_t */
  size_t count;            /* points, below 2^32 */
  const float *x, *y, *z;
  size_t xyz_stride_bytes;
  const uint8_t *r, *g, *b; /* sRGB */
  size_t rgb_stride_bytes;
  const float *normal_x, *normal_y, *normal_z; /* of length 1, or NaN */
  size_t normal_stride_bytes;
  const void* intensity;
  size_t intensity_stride_bytes;
} shortshot_cloud;

/* The most frequent one: `count` points x y z x y z ..., and, if `rgb` is not null, colors r g b r g b ...
 * `size_bytes` is sizeof *cloud. bad_view: another size (nothing is written then), or a null pointer. */
SHORTSHOT_API shortshot_status shortshot_view_xyz_rgb(const float* xyz, const uint8_t* rgb, size_t count,
                                                      shortshot_cloud* cloud, size_t size_bytes);

/* C++'s CloudOptions, but for the leaf. A null pointer to options means the defaults, which stand here. */
enum { SHORTSHOT_NO_VIEWPOINT = 0, SHORTSHOT_TOWARDS = 1, SHORTSHOT_AWAY_FROM = 2 };
typedef struct shortshot_options {
  uint32_t size_bytes;     /* sizeof(shortshot_options) */
  float radius;            /* 0.04: of the support */
  float frame_radius;      /* 0: of the frame; 0 is the support's */
  float best_frames;       /* 1: share of the key points that is kept, those with surest frames: above 0, at most 1 */
  uint32_t viewpoint_side; /* SHORTSHOT_NO_VIEWPOINT: whether frames and normals are turned, and how */
  float viewpoint[3];      /* 0 0 0: a camera in its own coordinates, which frames are turned towards */
  uint32_t threads;        /* 1 */
} shortshot_options;

/* Writes the defaults. `size_bytes` is sizeof *options. bad_option: another size (nothing is written), or null. */
SHORTSHOT_API shortshot_status shortshot_default_options(shortshot_options* options, size_t size_bytes);

/* A place to describe. What `has` does not name is not read. */
enum { SHORTSHOT_HAS_COLOR = 1, SHORTSHOT_HAS_INTENSITY = 2 };
typedef struct shortshot_keypoint {
  float x, y, z;
  float intensity;
  uint8_t r, g, b;
  uint8_t has; /* SHORTSHOT_HAS_COLOR + SHORTSHOT_HAS_INTENSITY */
} shortshot_keypoint;

/* One key point in each occupied voxel of `leaf` meters: its points' centroid, mean color and mean intensity. At most
 * `capacity` are written; *count says how many there are, if the status is out_of_memory, too, which says that there
 * are more than `capacity`. (count is never above cloud->count.) Also empty_cloud, bad_view, bad_leaf, bad_option (null
 * pointers; `keypoints` may be null if `capacity` is 0). */
SHORTSHOT_API shortshot_status shortshot_sample_centroids(const shortshot_cloud* cloud, float leaf,
                                                          shortshot_keypoint* keypoints, size_t capacity,
                                                          size_t* count);

/* Normals for SHOT and CSHOT, from the points within `radius`: 3 * cloud->count floats, NaN where there is none. To
 * which side they point is said by options->viewpoint; options->threads. The cloud has them when its normal_x, _y, _z
 * point to them. empty_cloud, bad_view, bad_radius, bad_viewpoint, coarse_coordinates, bad_option. */
SHORTSHOT_API shortshot_status shortshot_estimate_normals(const shortshot_cloud* cloud, float radius,
                                                          const shortshot_options* options, float* normals);

/* ---- Descriptors of a cloud ------------------------------------------------------------------------------------- */

/* A local reference frame: three axes of length 1. */
typedef struct shortshot_frame {
  float x[3], y[3], z[3];
} shortshot_frame;

/* Rows of descriptors with where they were made, in memory of the caller's: `count` of each. shortshot_describe() fills
 * it; all else reads it. */
typedef struct shortshot_features {
  uint32_t size_bytes; /* sizeof(shortshot_features) */
  shortshot_descriptor descriptor;
  shortshot_storage storage;
  uint32_t reserved; /* 0 */
  size_t count;
  shortshot_keypoint* keypoints; /* read only */
  void* rows;                    /* shortshot_row_bytes() each, one after the other */
  uint8_t* status;               /* of each row: what is not ok, all readers leave out. May be null: all are ok */
  shortshot_frame* frames;       /* may be null, but not in training and recognition */
} shortshot_features;

/* Describes the cloud at features->keypoints: fills rows, status and frames. The index over the cloud is made for this
 * call. A key point that cannot be described has a status of its own, a row of zeros (as the storage has them) and a
 * frame of zeros.
 *
 * empty_cloud, bad_view, bad_radius, bad_viewpoint, missing_colors, missing_normals, missing_intensities,
 * coarse_coordinates, bad_option, out_of_memory: all rows have that status, and zeros. bad_rows (also: no such
 * descriptor or storage): nothing is written. Allocates, besides index and scratch, the rows as floats: they are
 * copied, or stored smaller, at the end. */
SHORTSHOT_API shortshot_status shortshot_describe(const shortshot_cloud* cloud, const shortshot_options* options,
                                                  const shortshot_features* features);

/* `count` rows of floats in a storage. bad_option, bad_rows (null pointers). Allocates nothing. */
SHORTSHOT_API shortshot_status shortshot_store(shortshot_descriptor descriptor, shortshot_storage storage,
                                               const float* values, size_t count, void* rows);

/* ---- Matching and poses ----------------------------------------------------------------------------------------- */

typedef struct shortshot_match {
  uint32_t row; /* of the database; 0xFFFFFFFF: none */
  float distance;
} shortshot_match;

typedef struct shortshot_pair {
  uint32_t source, target; /* rows */
  float distance;
} shortshot_pair;

/* The k nearest rows of the database for each query, nearest first: `matches` has room for queries->count * k. Exact.
 * bad_rows (also: of another descriptor or storage), bad_option (k is 0). */
SHORTSHOT_API shortshot_status shortshot_nearest(const shortshot_features* queries, const shortshot_features* database,
                                                 size_t k, uint32_t threads, shortshot_match* matches);

/* Rows that are each other's nearest, in ascending order of the source: `pairs` has room for source->count, *count says
 * how many there are. Statuses as above. */
SHORTSHOT_API shortshot_status shortshot_reciprocal_correspondences(const shortshot_features* source,
                                                                    const shortshot_features* target, uint32_t threads,
                                                                    shortshot_pair* pairs, size_t* count);

/* Two points that may be the same one of an object, before and after its motion. */
typedef struct shortshot_point_pair {
  float source[3], target[3];
} shortshot_point_pair;
/* target = rotation * source + translation; the rotation row by row. */
typedef struct shortshot_pose {
  float rotation[9], translation[3];
} shortshot_pose;

/* C++'s RansacOptions, with its defaults. */
typedef struct shortshot_ransac_options {
  uint32_t size_bytes;   /* sizeof(shortshot_ransac_options) */
  uint32_t iterations;   /* 5000: samples of three pairs */
  float inlier_distance; /* 0.01 */
  float edge_similarity; /* 0.9: samples with an edge whose lengths differ by more are skipped, 0 to 1 */
  uint32_t seed;         /* 1 */
} shortshot_ransac_options;
SHORTSHOT_API shortshot_status shortshot_default_ransac_options(shortshot_ransac_options* options, size_t size_bytes);

/* The rigid motion that most pairs agree on. `inliers` has room for `count` numbers of pairs, ascending, of which there
 * are *inlier_count; both may be null. Three often agree by chance: judge a pose by how many they are. bad_option,
 * bad_rows (null pointers), too_few_pairs, invalid_keypoint (not finite), no_pose. */
SHORTSHOT_API shortshot_status shortshot_estimate_pose(const shortshot_point_pair* pairs, size_t count,
                                                       const shortshot_ransac_options* options, shortshot_pose* pose,
                                                       uint32_t* inliers, size_t* inlier_count);

/* ---- Recognition ------------------------------------------------------------------------------------------------ */

/* Learns objects from views, and finds them in others. One descriptor, one storage and one radius for all of them. */
typedef struct shortshot_recognizer shortshot_recognizer;

/* C++'s RecognizerOptions, with its defaults. */
typedef struct shortshot_recognizer_options {
  uint32_t size_bytes; /* sizeof(shortshot_recognizer_options) */
  float bandwidth;     /* 0.03: about how far votes miss an object's center */
  uint32_t neighbors;  /* 1: nearest codewords that each row activates, 1 to 1024 */
  uint32_t most;       /* 8: hypotheses at the most */
} shortshot_recognizer_options;
SHORTSHOT_API shortshot_status shortshot_default_recognizer_options(shortshot_recognizer_options* options,
                                                                    size_t size_bytes);

/* An untrained one, to be destroyed by shortshot_recognizer_destroy(). bad_option. */
SHORTSHOT_API shortshot_status shortshot_recognizer_create(const shortshot_recognizer_options* options,
                                                           shortshot_recognizer** recognizer);
SHORTSHOT_API void shortshot_recognizer_destroy(shortshot_recognizer* recognizer); /* null is allowed */

/* Learns a view of an object, of which `center` (3 floats) is the same place in all views. Names are copied. bad_rows,
 * bad_option (null pointers), invalid_keypoint, bad_frame, other_descriptor (or storage): nothing has changed then.
 * After out_of_memory it can only be destroyed. */
SHORTSHOT_API shortshot_status shortshot_recognizer_train(shortshot_recognizer* recognizer,
                                                          const shortshot_features* view, const float* center,
                                                          const char* object_class, const char* instance);

/* An object that may be there; names: below. */
typedef struct shortshot_hypothesis {
  uint32_t object_class, instance;
  float center[3]; /* where that of the training views is in this view */
  float score;     /* votes there: 1 for each that hits it */
} shortshot_hypothesis;

/* Finds objects, those with most votes first: at most `capacity` and options.most of them, *count in all. Statuses as
 * of training, and not_trained. */
SHORTSHOT_API shortshot_status shortshot_recognizer_recognize(const shortshot_recognizer* recognizer,
                                                              const shortshot_features* view, uint32_t threads,
                                                              shortshot_hypothesis* hypotheses, size_t capacity,
                                                              size_t* count);

/* Names of a number, null if there is none. The recognizer's, until it is trained or destroyed. */
SHORTSHOT_API const char* shortshot_recognizer_class_name(const shortshot_recognizer* recognizer, uint32_t number);
SHORTSHOT_API const char* shortshot_recognizer_instance_name(const shortshot_recognizer* recognizer, uint32_t number);

/* A file, as C++ writes and reads it. save: not_trained, no_file (what was in the file still is), bad_option. load
 * makes a new recognizer, or null: no_file, not_a_model, other_version, damaged_model, other_descriptor, bad_option. */
SHORTSHOT_API shortshot_status shortshot_recognizer_save(const shortshot_recognizer* recognizer, const char* path);
SHORTSHOT_API shortshot_status shortshot_recognizer_load(const char* path, shortshot_descriptor descriptor,
                                                         shortshot_storage storage, shortshot_recognizer** recognizer);

#ifdef __cplusplus
}
#endif
#endif /* SHORTSHOT_H */
