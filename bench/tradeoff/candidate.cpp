#include "tradeoff/candidate.hpp"

#include <memory>

#include "tradeoff/family/family.hpp"

namespace shortshot_bench::tradeoff {
namespace {

/// Published ones in the frame that published them: z by SHOT's vote.
template <class D>
Candidate published(std::string name, std::string board_name = {}) {
  Candidate c = candidate<D>(std::move(name), Kind::published, std::move(board_name));
  with_codes<D>(c);
  return with_format<shortshot::BinaryDescriptor<D>>(c, "bshot", D::size);
}

template <class D>
Candidate compact(std::string name, std::string board_name = {}) {
  Candidate c = candidate<D>(std::move(name), Kind::compact, std::move(board_name));
  return with_codes<D>(c);
}

/// With bits of sparse sums, in 44 and in 32 bytes.
template <class D>
Candidate with_sums(Candidate c) {
  with_format<shortshot::SumBits<D>>(c, "sums44", 352);
  return with_format<shortshot::SumBits<D, 256, 6>>(c, "sums32", 256);
}

/// The same in a frame whose x axis a lamp turns.
template <class D>
Candidate under_fixed_lamp(Candidate c) {
  c.configuration.name += "-fixedlamp";
  c.configuration.describe = c.describe_alone = describe_under_fixed_lamp<D>;
  c.board_name.clear();
  return c;
}

/// The same in a frame whose z axis is turned to the camera.
Candidate towards_camera(Candidate c) {
  c.configuration.name += "-view";
  c.configuration.wants_viewpoint = true;
  return c;
}

constexpr std::size_t most_neighbors = 20000;

}  // namespace

FixedLampFrames fixed_lamp_frames(const shortshot::CloudView& cloud, const shortshot::GridSearch& search,
                                  const std::vector<shortshot::KeyPoint>& keypoints,
                                  const shortshot::Support& support) {
  const auto workspace = std::make_unique<shortshot::Workspace<most_neighbors>>();
  FixedLampFrames result;
  for (const shortshot::KeyPoint& key : keypoints) {
    shortshot::Neighborhood n = shortshot::neighborhood_in(*workspace);
    shortshot::Frame frame{};
    shortshot::Status status = search.gather(key.position, support.frame_radius, n);
    if (status == shortshot::Status::ok) {
      const shortshot::RgbColors<shortshot::PublishedLab> colors(cloud, key.color);
      status = shortshot::estimate_frame_under_fixed_lamp(n, colors, support.frame_radius, frame, support.viewpoint);
    }
    result.frames.push_back(frame);
    result.status.push_back(status);
  }
  return result;
}

std::vector<Candidate> candidates(bool quick) {
  using namespace shortshot;
  std::vector<Candidate> all = {
      published<PclCshot1344>("cshot1344"),
      published<PclShot352>("shot352", "Shot352"),
      published<Scsh336>("scsh336", "Scsh336"),
      towards_camera(published<PclShot352>("shot352", "Shot352")),
      with_sums<ShapeColor95>(compact<ShapeColor95>("shapecolor95", "ShapeColor95")),
      compact<ShapeColor32>("shapecolor32", "ShapeColor32"),
  };
  if (quick) return all;
  all.push_back(towards_camera(published<PclCshot1344>("cshot1344")));
  all.push_back(towards_camera(published<Scsh336>("scsh336", "Scsh336")));
  all.push_back(published<Scsh696>("scsh696", "Scsh696"));
  all.push_back(published<Ssh96>("ssh96", "Ssh96"));
  all.push_back(published<Ssh32>("ssh32", "Ssh32"));
  all.push_back(compact<RoomColor95>("roomcolor95"));
  all.push_back(compact<HeightShape96>("heightshape96"));
  all.push_back(compact<ColorRings27>("colorrings27"));
  all.push_back(under_fixed_lamp<ShapeColor95>(compact<ShapeColor95>("shapecolor95")));
  for (Candidate& member : family()) all.push_back(std::move(member));
  return all;
}

}  // namespace shortshot_bench::tradeoff
