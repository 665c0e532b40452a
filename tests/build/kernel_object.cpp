// Firmware-style code that uses all of the kernel. The tests compile it for several machines and look at the object: it
// may take nothing from elsewhere but memset and memcpy (check_symbols.sh).
#include <shortshot/kernel.hpp>

namespace {

constexpr std::size_t max_points = 500;
constexpr std::size_t max_neighbors = 128;

shortshot::Workspace<max_neighbors> workspace;
shortshot::StaticGrid<max_points, 1024> grid;
shortshot::OrganizedSearch image;
float descriptor[shortshot::Cshot1344::size];
shortshot::PackedLab colors[max_points];
shortshot::SurfaceNormal normals[max_points];
shortshot::BinaryDescriptor<shortshot::Shot352> bits, last_bits;
shortshot::ByteDescriptor<shortshot::Scsh336> bytes, last_bytes;
volatile int bits_apart;
shortshot::NibbleDescriptor<shortshot::ShapeColor95> nibbles, last_nibbles;
volatile std::uint32_t bytes_apart;
shortshot::CodedDescriptor<shortshot::ShapeColor95, 3> thirds;
shortshot::HalfDescriptor<shortshot::ShapeColor95> halves;
shortshot::SumBits<shortshot::ShapeColor95> sums;

using Nibbles = shortshot::NibbleDescriptor<shortshot::ShapeColor95>;
using Sums = shortshot::SumBits<shortshot::ShapeColor95>;
shortshot::ModelView<Nibbles> model_of_nibbles;
shortshot::ModelView<Sums> model_of_sums;
shortshot::MicroRecognizer<Nibbles, 32, max_neighbors> of_nibbles;
shortshot::MicroRecognizer<Sums, 32, max_neighbors, 2> of_sums;
shortshot::Hypothesis found[2];
shortshot::RamMemory<4096> ram;
shortshot::LearnedObjects<Sums, shortshot::RamMemory<4096>> learned;

using Multilinear = shortshot::Ssh<shortshot::SphericalGrid<2, 2, 8>, shortshot::MultilinearVoting>;
using Hard = shortshot::Ssh<shortshot::SphericalGrid<2, 2, 8>, shortshot::HardVoting, shortshot::LogRadius<>>;
using Pcl = shortshot::Scsh<shortshot::SphericalGrid<2, 2, 8>, shortshot::SphericalGrid<2, 2, 4>, 15,
                            shortshot::PublishedVoting, shortshot::LinearRadius, shortshot::PclLab>;

template <class D, class Search>
shortshot::Status describe(const shortshot::CloudView& cloud, const Search& search, std::size_t index, float radius) {
  return shortshot::describe_at<D>(cloud, search, index, radius, workspace, descriptor);
}

/// With colors that were converted before, in a frame for things that stay under their lamp.
shortshot::Status describe_packed(const shortshot::CloudView& cloud, std::size_t index, float radius) {
  using shortshot::Status;
  using Rule = shortshot::PublishedLab;
  const shortshot::KeyPoint key = shortshot::keypoint(cloud, index);
  shortshot::Frame frame;
  shortshot::Neighborhood n = shortshot::neighborhood_in(workspace);
  Status status = shortshot::convert_colors<Rule>(cloud, colors);
  if (status == Status::ok) status = grid.gather(key.position, radius, n);
  if (status != Status::ok) return status;
  const shortshot::PackedColors source{colors, shortshot::to_lab<Rule>(key.color)};
  status = shortshot::estimate_frame_under_fixed_lamp(n, source, radius, frame, shortshot::Viewpoint::towards({}));
  if (status != Status::ok) return status;
  return shortshot::describe<shortshot::Scsh336>(n, source, frame, radius, descriptor);
}

/// A descriptor in bytes, and how far it is from the one before.
shortshot::Status describe_in_bytes(const shortshot::CloudView& cloud, std::size_t index, float radius) {
  const shortshot::Status status = describe<shortshot::Scsh336>(cloud, grid, index, radius);
  if (status != shortshot::Status::ok) return status;
  last_bytes = bytes;
  shortshot::quantize(descriptor, bytes);
  bytes_apart = shortshot::squared_distance(bytes, last_bytes);
  return status;
}

/// A compact one in nibbles.
shortshot::Status describe_in_nibbles(const shortshot::CloudView& cloud, std::size_t index, float radius) {
  const shortshot::Status status = describe<shortshot::ShapeColor95>(cloud, grid, index, radius);
  if (status != shortshot::Status::ok) return status;
  last_nibbles = nibbles;
  shortshot::quantize(descriptor, nibbles);
  shortshot::quantize(descriptor, thirds);
  shortshot::quantize(descriptor, halves);
  shortshot::binarize(nibbles, sums);
  bytes_apart = shortshot::squared_distance(nibbles, last_nibbles);
  return status;
}

/// SHOT, CSHOT and B-SHOT, with normals of this cloud's own.
shortshot::Status describe_with_normals(const shortshot::CloudView& points, std::size_t index, float radius) {
  using shortshot::Status;
  for (std::size_t i = 0; i < points.size; ++i) {
    shortshot::Neighborhood n = shortshot::neighborhood_in(workspace);
    const shortshot::Point p = shortshot::point(points, i);
    Status status = grid.gather(p, radius, n);
    if (status == Status::ok)
      status = shortshot::estimate_normal(n, radius, normals[i], shortshot::Viewpoint::towards({}));
    if (status != Status::ok) return status;
  }
  const shortshot::CloudView cloud = shortshot::with_normals(points, normals);
  Status status = describe<shortshot::PclShot352>(cloud, grid, index, radius);
  if (status == Status::ok) status = describe<shortshot::PclCshot1344>(cloud, grid, index, radius);
  if (status == Status::ok) status = describe<shortshot::Cshot1344>(cloud, grid, index, radius);
  if (status == Status::ok) status = describe<shortshot::Shot352>(cloud, grid, index, radius);
  if (status == Status::ok) shortshot::binarize(descriptor, bits);
  if (status == Status::ok) bits_apart = shortshot::hamming_distance(bits, last_bits);
  last_bits = bits;
  return status;
}

template <class Model, class Recognizer>
shortshot::Status recognize(Model& model, Recognizer& recognizer, const shortshot::CloudView& cloud, float radius,
                            const unsigned char* in_flash, std::size_t size, const char** name) {
  using shortshot::Status;
  Status status = model.open(in_flash, size);
  if (status != Status::ok) return status;
  recognizer.start(model);
  for (std::size_t i = 0; i < cloud.size && status == Status::ok; i += 7) {
    status = recognizer.add(cloud, grid, i, radius);
  }
  if (recognizer.finish(found) > 0) *name = model.instance_name(found[0].instance);
  return status;
}

}  // namespace

extern "C" const char* recognize_patch(const float* xyz, const unsigned char* rgb, std::size_t count, float radius,
                                       const unsigned char* in_flash, std::size_t size) {
  const shortshot::CloudView cloud = shortshot::view_xyz_rgb(xyz, rgb, count);
  const char* name = nullptr;
  shortshot::Status status = grid.build(cloud, radius);
  if (status == shortshot::Status::ok)
    status = recognize(model_of_nibbles, of_nibbles, cloud, radius, in_flash, size, &name);
  if (status == shortshot::Status::other_descriptor) {
    status = recognize(model_of_sums, of_sums, cloud, radius, in_flash, size, &name);
  }
  return status == shortshot::Status::ok ? name : shortshot::message(status);
}

extern "C" const char* learn_patch(const float* xyz, const unsigned char* rgb, std::size_t count, float radius,
                                   const char* name) {
  using shortshot::Status;
  const shortshot::CloudView cloud = shortshot::view_xyz_rgb(xyz, rgb, count);
  shortshot::StoredKeyPoint<Sums> key;
  ram.erase();
  Status status = learned.open(model_of_sums, ram);
  if (status == Status::ok) status = grid.build(cloud, radius);
  for (std::size_t i = 0; i < cloud.size && status == Status::ok; i += 7) {
    status = of_sums.describe(cloud, grid, i, radius, key);
    if (status == Status::ok) status = learned.add(key, {0.0f, 0.0f, 1.0f});
  }
  if (status == Status::ok) status = learned.commit(name, name);
  of_sums.start(learned.model());
  return shortshot::message(status);
}

extern "C" const float* describe_patch(const float* xyz, const unsigned char* rgb, std::size_t count, std::size_t width,
                                       std::size_t index, float radius, const char** message) {
  using shortshot::Status;
  const shortshot::CloudView cloud = shortshot::view_xyz_rgb(xyz, rgb, count);
  Status status = grid.build(cloud, radius);
  if (status == Status::ok) status = describe<shortshot::Ssh32>(cloud, grid, index, radius);
  if (status == Status::ok) status = describe_in_bytes(cloud, index, radius);
  if (status == Status::ok) status = describe_packed(cloud, index, radius);
  if (status == Status::ok) status = describe_with_normals(cloud, index, radius);
  if (status == Status::ok) status = describe_in_nibbles(cloud, index, radius);
  if (status == Status::ok) status = describe<shortshot::ShapeColor32>(cloud, grid, index, radius);
  if (status == Status::ok) status = describe<shortshot::RoomColor95>(cloud, grid, index, radius);
  if (status == Status::ok) status = describe<shortshot::Scsh696>(cloud, shortshot::BruteSearch{cloud}, index, radius);
  if (status == Status::ok) status = image.build(shortshot::organized(cloud, width, count / width));
  if (status == Status::ok) status = describe<Multilinear>(cloud, image, index, radius);
  if (status == Status::ok) status = describe<Hard>(cloud, image, index, radius);
  if (status == Status::ok) status = describe<Pcl>(cloud, image, index, radius);
  *message = shortshot::message(status);
  return descriptor;
}
