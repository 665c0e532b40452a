// shortshot/status.hpp: the one way in which the library reports that something is wrong.
#ifndef SHORTSHOT_STATUS_HPP
#define SHORTSHOT_STATUS_HPP

#include <cstdint>

#include "config.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Result of every call that can fail. Whatever is not `ok` comes with a zeroed output, never with NaN; unread_channel
/// alone comes with a view of all the rest.
// (version 14 of it does not know attributes of enumerations)
// clang-format off
enum class [[nodiscard]] Status : std::uint8_t {
  ok,                  ///< nothing is wrong
  empty_cloud,         ///< the cloud has no point, or no point with three finite coordinates
  bad_view,            ///< the view's memory cannot be what it says (null pointer, field outside the point, too short)
  bad_radius,          ///< a radius is not a finite number above zero, or its square leaves the range of float
  bad_keypoint,        ///< a key point's index lies outside the cloud
  invalid_keypoint,    ///< a key point's position is not finite
  missing_colors,      ///< the descriptor needs colors and the cloud has none
  missing_normals,     ///< the descriptor needs normals and the cloud has none
  too_few_neighbors,   ///< no neighbor to describe, or fewer than five for a local reference frame or for SHOT
  too_many_neighbors,  ///< the neighborhood does not fit the workspace; Neighborhood::found says what it takes
  ambiguous_frame,     ///< collinear or symmetric neighborhood: two principal axes cannot be told apart
  bad_frame,           ///< a given frame is not orthonormal, or not finite
  bad_viewpoint,       ///< a viewpoint is not finite
  bad_leaf,            ///< a voxel size is not a finite number above zero
  out_of_memory,       ///< caller-provided memory is too small for the cloud
  not_organized,       ///< the cloud is no image of a pinhole camera, so it has no image window to search
  bad_rows,            ///< rows of descriptors that do not fit each other, or null pointers
  bad_option,          ///< an option is outside of the range that its docstring gives
  too_few_pairs,       ///< fewer than three correspondences
  no_pose,             ///< no rigid motion that at least three correspondences agree on
  not_trained,         ///< the recognizer has no training view with a descriptor
  not_a_model,         ///< the bytes are no recognizer's, or no features', whichever was asked for
  other_version,       ///< the file was written by a version with another format
  other_descriptor,    ///< descriptors of another layout than the recognizer or the file has
  damaged_model,       ///< the file is truncated, or its checksum or contents are wrong
  no_file,             ///< a file cannot be read or written
  missing_intensities,  ///< the descriptor needs intensities and the cloud, or the key point, has none
  unsure_frame,         ///< left out by keep_best_frames(): others have surer frames
  sizes_differ,         ///< a view's channels have not as many elements as it has points
  no_coordinates,       ///< a message has no fields x, y and z
  field_outside,        ///< a message's field ends behind its point
  short_data,           ///< a message has less data than its width, height and steps say
  padded_rows,          ///< a message's rows are longer than their points: copy_point_cloud2()
  other_byte_order,     ///< a message's numbers have the other byte order: copy_point_cloud2()
  needs_conversion,     ///< a message's field is no FLOAT32: copy_point_cloud2()
  unread_channel,       ///< a message has colors, normals or intensities that are not read; the view has the rest
  bad_field,            ///< a message's field x, y or z is of no type that there is, or several numbers
  no_point_step,        ///< a message's points are of no byte
  too_many_points,      ///< a message has 2^32 points or more
  short_rows,           ///< a message's rows are shorter than their points, and its data is not as long as all points
  other_cloud,          ///< the search is over another cloud than the one that is described
  coarse_coordinates,   ///< coordinates so large that floats lie farther apart than a 64th of the radius
  not_written,          ///< a memory does not hold what was written to it: it was not erased, or is worn out
};
// clang-format on

/// Number of statuses.
inline constexpr int status_count = static_cast<int>(Status::not_written) + 1;

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// One English sentence for a status. Static storage; never null.
[[nodiscard]] constexpr const char* message(Status status) noexcept {
  switch (status) {
    case Status::ok: return "ok";
    case Status::empty_cloud: return "the cloud has no valid point";
    case Status::bad_view: return "the cloud view does not fit its memory";
    case Status::bad_radius: return "a radius must be finite and above zero";
    case Status::bad_keypoint: return "the key point's index lies outside the cloud";
    case Status::invalid_keypoint: return "the key point is not finite";
    case Status::missing_colors: return "the descriptor needs colors and the cloud has none";
    case Status::missing_normals: return "the descriptor needs normals and the cloud has none";
    case Status::too_few_neighbors: return "too few neighbors within the radius";
    case Status::too_many_neighbors: return "more neighbors than the workspace can hold";
    case Status::ambiguous_frame: return "the neighborhood is too symmetric for a local reference frame";
    case Status::bad_frame: return "the given frame is not orthonormal";
    case Status::bad_viewpoint: return "the viewpoint is not finite";
    case Status::bad_leaf: return "a voxel size must be finite and above zero";
    case Status::out_of_memory: return "the memory provided is too small";
    case Status::not_organized: return "the cloud is not an image of a pinhole camera";
    case Status::bad_rows: return "the rows of descriptors do not fit each other";
    case Status::bad_option: return "an option is out of its range";
    case Status::too_few_pairs: return "a pose takes three correspondences or more";
    case Status::no_pose: return "no rigid motion fits three correspondences or more";
    case Status::not_trained: return "the recognizer has no training view";
    case Status::not_a_model: return "not a file of this kind";
    case Status::other_version: return "the file's format is of another version";
    case Status::other_descriptor: return "the file or the recognizer is of another descriptor";
    case Status::damaged_model: return "the file is damaged";
    case Status::no_file: return "the file cannot be read or written";
    case Status::missing_intensities: return "the descriptor needs intensities and there are none";
    case Status::unsure_frame: return "other key points have surer frames";
    case Status::sizes_differ: return "the view's channels have not as many elements as it has points";
    case Status::no_coordinates: return "the message has no fields x, y and z";
    case Status::field_outside: return "a field of the message lies outside of its point";
    case Status::short_data: return "the message has less data than its width, height, point_step and row_step say";
    case Status::padded_rows: return "the message's rows are padded: copy_point_cloud2() reads them";
    case Status::other_byte_order: return "the message has the other byte order: copy_point_cloud2() reads it";
    case Status::needs_conversion: return "a field of the message is not FLOAT32: copy_point_cloud2() reads it";
    case Status::unread_channel: return "the message's colors, normals or intensities are not of types that are read";
    case Status::bad_field: return "x, y and z of the message are not one number each";
    case Status::no_point_step: return "the message's point_step is 0";
    case Status::too_many_points: return "the message has 2^32 points or more";
    case Status::short_rows: return "the message's row_step is less than width * point_step";
    case Status::other_cloud: return "the search was built over another cloud";
    case Status::coarse_coordinates:
      return "the coordinates are too large: float rounds them to steps that are not small against the radius";
    case Status::not_written: return "the memory does not hold what was written to it";
  }
  return "unknown status";
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_STATUS_HPP
