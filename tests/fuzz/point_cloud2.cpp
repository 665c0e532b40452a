// PointCloud2 messages that say anything of themselves: views stay within the data, and a copy is what its view is.
#include <shortshot/batch/copy_point_cloud2.hpp>
#include <shortshot/cloud/read.hpp>
#include <shortshot/cloud/view_point_cloud2.hpp>
#include <string>

#include "bytes.hpp"

namespace {

namespace ss = shortshot;
using fuzz::require;
using ss::Status;

struct Message {
  struct Field {
    std::string name;
    std::uint32_t offset;
    std::uint8_t datatype;
    std::uint32_t count;
  };
  std::uint32_t height, width, point_step, row_step;
  bool is_bigendian;
  std::vector<Field> fields;
  std::vector<std::uint8_t> data;
};

std::uint32_t length(fuzz::Bytes& from) {
  const std::uint8_t kind = from.byte();
  return kind < 250 ? kind : kind < 253 ? from.number<std::uint32_t>() : 0u - from.byte();
}

Message made_message(fuzz::Bytes& from) {
  constexpr const char* names[] = {"x",     "y",    "z",  "rgb", "normal_x", "normal_y", "normal_z", "intensity",
                                   "rgba",  "r",    "g",  "b",   "X",        "Y",        "Z",        "red",
                                   "green", "blue", "nx", "ny",  "nz",       "ring"};
  Message message{length(from), length(from), length(from), length(from), from.byte() % 4 == 3, {}, {}};
  const std::uint8_t common = from.byte();
  for (std::size_t k = 0; k < 3 && common % 2 == 0; ++k) {
    message.fields.push_back({names[k], static_cast<std::uint32_t>(4 * k), 7, 1});
  }
  for (std::size_t fields = from.below(10); fields > 0; --fields) {
    const char* const name = names[from.below(sizeof names / sizeof names[0])];
    message.fields.push_back({name, length(from), static_cast<std::uint8_t>(from.byte() % 10), length(from)});
  }
  if (common % 4 < 2) message.row_step = message.width * message.point_step;
  message.data.assign(from.data(), from.data() + from.left());
  return message;
}

/// All that a view says of its points, each in its bits.
std::vector<std::uint32_t> read_all(const ss::CloudView& view) {
  require(ss::validate(view) == Status::ok, "the view can be read");
  require(view.size == view.width * view.height, "rows and columns hold all points");
  std::vector<std::uint32_t> bits;
  const auto add = [&](const ss::Point& p) {
    for (const float value : {p.x, p.y, p.z}) bits.push_back(ss::extend::math::bits_of(value));
  };
  for (std::size_t i = 0; i < view.size; ++i) {
    add(ss::point(view, i));
    if (ss::has_normals(view)) add({ss::normal(view, i).x, ss::normal(view, i).y, ss::normal(view, i).z});
    if (ss::has_intensities(view)) bits.push_back(ss::extend::math::bits_of(ss::intensity(view, i)));
    if (!ss::has_colors(view)) continue;
    const ss::Rgb c = ss::color(view, i);
    bits.push_back(c.r * 0x10000u + c.g * 0x100u + c.b);
  }
  return bits;
}

bool is_view(Status status) { return status == Status::ok || status == Status::unread_channel; }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes from(data, size);
  const Message message = made_message(from);
  ss::CloudView view{}, copied{};
  ss::CloudCopy storage;
  const Status viewed = ss::view_point_cloud2(message, view);
  const Status status = ss::copy_point_cloud2(message, storage, copied);
  require(is_view(viewed) || view.size == 0, "no view of what is refused");
  require(is_view(status) || (copied.size == 0 && storage.xyz.empty()), "no copy of what is refused");
  require(!is_view(viewed) || is_view(status), "what can be viewed can be copied");
  const auto of_copy = is_view(status) ? read_all(copied) : std::vector<std::uint32_t>{};
  const auto of_view = is_view(viewed) ? read_all(view) : std::vector<std::uint32_t>{};
  const ss::PointCloud2Channels channels = ss::point_cloud2_channels(message);
  if (is_view(viewed)) require(channels.coordinates == Status::ok, "coordinates are read in place");
  // Where no channel needs a conversion, both read the same.
  if (viewed == Status::ok) require(fuzz::same_bits(of_copy, of_view), "a copy is what its view is");
  return 0;
}
