// Naming the objects in views against a model, as the board does it and the host that prepares the model: the same
// code.
#pragma once

#include <cstddef>
#include <cstdint>

#if __has_include("shortshot.hpp")
#include "shortshot.hpp"  // the board's only header
#else
#include "shortshot/shortshot.hpp"
#endif

#include "hash.hpp"

namespace recognition {

using Descriptor = shortshot::ShapeColor32;
using Stored = shortshot::SumBits<Descriptor>;
using Recognizer = shortshot::MicroRecognizer<Stored, 128, 768>;
using Grid = shortshot::StaticGrid<10240, 8192>;

inline constexpr std::size_t keypoints = 100;  // of a view that is asked for, at the most
inline constexpr float least_share = 0.125f;   // of the votes, that a score must have: or it is none of these

/// The recognizer, and what belongs to the cloud: its index, and its colors, converted once, in place of 3 bytes of
/// RGB. The rest is for the measurement.
struct Memory {
  Recognizer recognizer = {};
  Grid grid = {};
  shortshot::PackedLab colors[10240] = {};
  shortshot::Workspace<768> workspace = {};
  float values[Descriptor::size] = {};
  Stored queries[keypoints] = {};
};

struct Outcome {
  std::uint32_t right = 0;  // views whose instance is named first
  std::uint32_t views = 0;
  std::uint32_t keypoints = 0;  // of the first view
  std::uint32_t failures = 0;   // what memory does not hold
  Hash hypotheses;
};

/// Turns frames towards the camera, which is the origin.
inline shortshot::Support support(float radius) {
  shortshot::Support of_radius = radius;
  of_radius.viewpoint = shortshot::Viewpoint::towards({});
  return of_radius;
}

/// Calls use(index) for `most` of the points, or fewer: evenly along their order.
template <class Use>
void for_keypoints(std::size_t points, std::size_t most, const Use& use) {
  const std::size_t stride = (points + most - 1) / most;
  for (std::size_t i = stride / 2; i < points; i += stride) use(i);
}

/// One of the views that ../recognition/task.hpp writes.
struct View {
  shortshot::CloudView cloud;
  std::uint32_t instance;
  const std::uint32_t* next;
};
inline View view_at(const std::uint32_t* words) {
  const std::size_t points = words[0];
  const auto* xyz = reinterpret_cast<const float*>(words + 2);
  const auto* rgb = reinterpret_cast<const unsigned char*>(words + 2 + 3 * points);
  return {shortshot::view_xyz_rgb(xyz, rgb, points), words[1], words + 2 + 3 * points + (3 * points + 3) / 4};
}

class Task {
 public:
  Task(const shortshot::ModelView<Stored>& model, Memory& memory) : model_(model), memory_(memory) {}

  /// Names all views; count(name, call) calls a step of the first one.
  template <class Count>
  Outcome name_all(const std::uint32_t* views, const Count& count) {
    outcome_.views = views[0];
    radius_ = *reinterpret_cast<const float*>(views + 1);
    support_ = support(radius_);
    const std::uint32_t* next = views + 2;
    for (std::uint32_t v = 0; v < outcome_.views; ++v) {
      const View view = view_at(next);
      const std::uint32_t named = v == 0 ? name_counted(view.cloud, count) : name(view.cloud, CallOnly{});
      outcome_.right += named == view.instance ? 1u : 0u;
      next = view.next;
    }
    return outcome_;
  }
  /// The first view alone.
  void name_first(const std::uint32_t* views) { static_cast<void>(name(view_at(views + 2).cloud, CallOnly{})); }

 private:
  struct CallOnly {
    template <class Call>
    void operator()(const char*, const Call& call) const {
      call();
    }
  };

  /// The instance that is named first.
  template <class Count>
  std::uint32_t name(const shortshot::CloudView& cloud, const Count& count) {
    shortshot::Hypothesis found[8];
    std::size_t hypotheses = 0;
    auto indexed = shortshot::Status::ok;
    auto converted = shortshot::Status::ok;
    count("index", [&] { indexed = memory_.grid.build(cloud, 0.5f * radius_); });
    count("colors", [&] { converted = shortshot::convert_colors<Descriptor::LabRule>(cloud, memory_.colors); });
    if (indexed != shortshot::Status::ok || converted != shortshot::Status::ok) ++outcome_.failures;
    memory_.recognizer.start(model_);
    count("describe_and_match", [&] { add_all(cloud); });
    count("find", [&] { hypotheses = memory_.recognizer.finish(found); });
    outcome_.hypotheses.add(found, hypotheses * sizeof found[0]);
    return hypotheses > 0 ? found[0].instance : 0xFFFFFFFFu;
  }

  /// The same, and what the comparisons alone take of it.
  template <class Count>
  std::uint32_t name_counted(const shortshot::CloudView& cloud, const Count& count) {
    const std::uint32_t named = name(cloud, count);
    outcome_.keypoints = described_;
    store_all(cloud);
    count("match", [&] { match_all(); });
    return named;
  }

  void add_all(const shortshot::CloudView& cloud) {
    described_ = 0;
    for_keypoints(cloud.size, keypoints, [&](std::size_t i) {
      const shortshot::Status status = memory_.recognizer.add(cloud, memory_.grid, i, support_, memory_.colors);
      if (status == shortshot::Status::ok) ++described_;
      const bool is_full =
          status == shortshot::Status::too_many_neighbors || status == shortshot::Status::out_of_memory;
      if (is_full) ++outcome_.failures;
    });
  }

  /// Descriptors of the view for match_all().
  void store_all(const shortshot::CloudView& cloud) {
    std::uint32_t stored = 0;
    for_keypoints(cloud.size, keypoints, [&](std::size_t i) {
      const shortshot::Status status = shortshot::describe_at<Descriptor>(
          cloud, memory_.grid, i, support_, memory_.workspace, memory_.values, memory_.colors);
      if (status == shortshot::Status::ok) shortshot::binarize(memory_.values, memory_.queries[stored++]);
    });
    if (stored != described_) ++outcome_.failures;
  }

  /// The comparisons with all codewords and the votes alone.
  void match_all() {
    const shortshot::Frame frame{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
    memory_.recognizer.start(model_);
    for (std::uint32_t i = 0; i < described_; ++i) {
      static_cast<void>(memory_.recognizer.add(memory_.queries[i], {0.0f, 0.0f, 0.5f}, frame));
    }
  }

  const shortshot::ModelView<Stored>& model_;
  Memory& memory_;
  float radius_ = 0.0f;
  shortshot::Support support_ = 0.0f;
  std::uint32_t described_ = 0;  // key points of the view
  Outcome outcome_;
};

}  // namespace recognition
