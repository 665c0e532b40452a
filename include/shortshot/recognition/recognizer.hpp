// shortshot/recognition/recognizer.hpp: what has been learned of objects: an implicit shape model, whose descriptors
// vote for the centers of objects. recognize.hpp trains and asks it. Hosted only.
//
// After B. Leibe, A. Leonardis, B. Schiele: Robust object detection with interleaved categorization and segmentation
// (IJCV 77, 2008), with local reference frames in 3-D as in F. Tombari, L. Di Stefano: Object recognition in 3D scenes
// with occlusions and clutter by Hough voting (PSIVT 2010).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "../config.hpp"
#include "codebook.hpp"
#include "hypothesis.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

struct RecognizerAccess;

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// The share that each class, and each instance, has in the codewords that were activated: 0 to 1, all of them 1
/// together, or all zero if none was.
struct ActivationShares {
  std::vector<float> classes;    ///< one per class, by number
  std::vector<float> instances;  ///< one per instance, by number
};

/// Recognizes objects by their descriptors. Every descriptor of the training views is a codeword. One of a new view
/// activates those that are nearest (L2), and each of these votes for the place where its object's center would be: as
/// it lay in the key point's local reference frame in training. Votes for a class gather at the centers of its objects;
/// mean shift finds where they are densest.
///
/// Objects have a class ("mug") and an instance ("red mug"); an instance is known by both names together. For which
/// descriptor a recognizer is, is said by the first training view: the text `layout` (layout_of(), with whatever else
/// two descriptors must have in common to be compared) and the number of values. Radii, and how frames are turned, must
/// be the same in training and afterwards.
///
/// Descriptors may be stored smaller (StoredFeatures); then they are compared as they are stored.
///
/// train() makes one, recognize() and activation_shares() ask it, save() and load() keep it. Calls that do not change
/// it may run at the same time. All may throw what extract() may; a recognizer that ran out of memory in train() can
/// only be assigned to or destroyed.
class Recognizer {
 public:
  Recognizer() = default;
  /// Not trained yet. Wrong options are bad_option when it is asked.
  explicit Recognizer(const RecognizerOptions& options) noexcept : options_(options) {}

  /// One that was moved from has its options still, and was never trained.
  Recognizer(Recognizer&& other) noexcept : options_(other.options_) { std::swap(codebook_, other.codebook_); }
  Recognizer(const Recognizer& other) = default;
  Recognizer& operator=(Recognizer other) noexcept {
    std::swap(options_, other.options_);
    std::swap(codebook_, other.codebook_);
    return *this;
  }
  ~Recognizer() = default;

  /// What it was made with, or set_options() gave.
  [[nodiscard]] const RecognizerOptions& options() const noexcept { return options_; }
  /// For calls to come; the training stays as it is.
  void set_options(const RecognizerOptions& options) noexcept { options_ = options; }

  /// Classes, instances and codewords of all training so far.
  [[nodiscard]] std::size_t class_count() const noexcept { return codebook_.classes.size(); }
  [[nodiscard]] std::size_t instance_count() const noexcept { return codebook_.instances.size(); }
  [[nodiscard]] std::size_t codeword_count() const noexcept { return codebook_.codewords.size(); }
  /// For numbers below class_count() and instance_count(), in the order of training.
  [[nodiscard]] const std::string& class_name(std::size_t object_class) const {
    return codebook_.classes[object_class];
  }
  [[nodiscard]] const std::string& instance_name(std::size_t instance) const { return codebook_.instances[instance]; }
  [[nodiscard]] std::uint32_t class_of(std::size_t instance) const { return codebook_.class_of[instance]; }

  /// What the first training view's descriptors were, and how many values they had; empty and 0 before it.
  [[nodiscard]] const std::string& layout() const noexcept { return codebook_.layout; }
  [[nodiscard]] std::size_t row_size() const noexcept { return codebook_.row_size; }

 private:
  friend struct detail::RecognizerAccess;

  RecognizerOptions options_;
  detail::Codebook codebook_;
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// The inside of a recognizer, for train(), recognize(), save() and load().
struct RecognizerAccess {
  [[nodiscard]] static const Codebook& codebook(const Recognizer& recognizer) noexcept { return recognizer.codebook_; }
  [[nodiscard]] static Codebook& codebook(Recognizer& recognizer) noexcept { return recognizer.codebook_; }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail
