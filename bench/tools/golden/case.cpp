#include "case.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "known_arrays.hpp"
#include "shortshot/search/neighborhood.hpp"
#include "tools/io/input_error.hpp"

namespace shortshot_bench::golden {
namespace {

using nlohmann::json;

// case.json as text and as values. Errors name the line in which the word they are about stands first.
class Description {
 public:
  explicit Description(const std::filesystem::path& path) : path_(path.string()) {
    read_text();
    try {
      root_ = json::parse(text_);
    } catch (const json::parse_error& error) {
      throw InputError::at_byte(path_, error.byte, error.what());
    } catch (const json::exception& error) {  // numbers that no double can hold
      throw InputError::about(path_, error.what());
    }
    if (!root_.is_object()) throw InputError::at_line(path_, 1, "expected a JSON object");
  }

  const json* find(const char* key) const {
    const auto found = root_.find(key);
    return found == root_.end() ? nullptr : &*found;
  }

  InputError error(const std::string& word, const std::string& what) const {
    const std::size_t at = std::min(text_.find('"' + word + '"'), text_.size());
    const bool found = at < text_.size();
    const auto lines = std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    return InputError::at_line(path_, found ? static_cast<std::uint64_t>(lines) + 1 : 1, word + ": " + what);
  }

 private:
  void read_text() {
    constexpr std::uintmax_t most_bytes = 1U << 26;  // a million key points and their kinds
    std::error_code failed;
    if (!std::filesystem::is_regular_file(path_, failed)) {
      throw InputError::about(path_, "the folder has no such file");
    }
    if (std::filesystem::file_size(path_, failed) > most_bytes) {
      throw InputError::at_byte(path_, most_bytes, "far too large to be the description of a case");
    }
    std::ifstream file(path_, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    if (!file) throw InputError::about(path_, "cannot read the file");
    text_ = text.str();
  }

  std::string path_;
  std::string text_;
  json root_;
};

std::optional<double> radius_of(const Description& description, const char* key) {
  const json* value = description.find(key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_number()) throw description.error(key, "expected a number of meters, found " + value->dump());
  const auto radius = value->get<double>();
  // Compared in double first: a double that float cannot hold must not be converted.
  if (!(radius > 0.0 && radius < 1e18) ||
      shortshot::validate(shortshot::Radius::from_double(radius)) != shortshot::Status::ok) {
    throw description.error(key, "a radius and its square must be above zero and floats, found " + value->dump());
  }
  return radius;
}

bool flag_of(const Description& description, const char* key, bool otherwise) {
  const json* value = description.find(key);
  if (value == nullptr) return otherwise;
  if (!value->is_boolean()) throw description.error(key, "expected true or false, found " + value->dump());
  return value->get<bool>();
}

std::vector<std::string> kinds_of(const Description& description) {
  std::vector<std::string> kinds;
  const json* list = description.find("keypoint_kind");
  if (list == nullptr) return kinds;
  if (!list->is_array()) throw description.error("keypoint_kind", "expected a list of words");
  for (const json& kind : *list) {
    if (!kind.is_string()) throw description.error("keypoint_kind", "expected words, found " + kind.dump());
    kinds.push_back(kind.get<std::string>());
  }
  return kinds;
}

std::string word_of(const Description& description, const json& entry, const char* key, const std::string& owner) {
  const auto found = entry.find(key);
  if (found == entry.end() || !found->is_string() || found->get<std::string>().empty()) {
    throw description.error(owner, "an array needs a text \"" + std::string(key) + "\"");
  }
  return found->get<std::string>();
}

std::vector<std::uint64_t> shape_of(const Description& description, const json& entry, const std::string& owner) {
  const auto list = entry.find("shape");
  if (list == entry.end() || !list->is_array() || list->empty()) {
    throw description.error(owner, "an array needs a list \"shape\"");
  }
  std::vector<std::uint64_t> shape;
  for (const json& extent : *list) {
    if (!extent.is_number_unsigned()) {
      throw description.error(owner, "a shape has whole numbers from 0 on, found " + extent.dump());
    }
    shape.push_back(extent.get<std::uint64_t>());
  }
  return shape;
}

void check_file_size(const Description& description, const Array& array) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(array.path, failed)) {
    throw description.error(array.name, "there is no file " + array.path);
  }
  const std::uintmax_t size = std::filesystem::file_size(array.path, failed);
  const std::optional<std::uint64_t> needed = needed_bytes(array.dtype, array.shape);
  if (failed || !needed || size != *needed) {
    throw description.error(array.name, "shape " + shape_text(array.shape) + " of " + array.dtype + " needs " +
                                            (needed ? std::to_string(*needed) : "more than 2^64") + " bytes, " +
                                            array.path + " has " + std::to_string(size));
  }
}

Array array_of(const Description& description, const json& entry, const std::filesystem::path& folder) {
  if (!entry.is_object()) throw description.error("arrays", "expected a list of objects, found " + entry.dump());
  Array array;
  array.name = word_of(description, entry, "name", "arrays");
  array.dtype = word_of(description, entry, "dtype", array.name);
  array.shape = shape_of(description, entry, array.name);
  array.path = (folder / word_of(description, entry, "file", array.name)).string();
  const std::optional<KnownArray> known = find_known_array(array.name);
  if (item_bytes(array.dtype) == 0 || (known && known->dtype != array.dtype)) {
    throw description.error(array.name,
                            "dtype " + (known ? known->dtype : "<f4, <i4 or u1") + " expected, found " + array.dtype);
  }
  check_file_size(description, array);
  return array;
}

std::vector<Array> arrays_of(const Description& description, const std::filesystem::path& folder) {
  std::vector<Array> arrays;
  const json* list = description.find("arrays");
  if (list == nullptr || !list->is_array()) throw description.error("arrays", "expected a list of arrays");
  for (const json& entry : *list) {
    Array array = array_of(description, entry, folder);
    const bool twice = std::any_of(arrays.begin(), arrays.end(), [&](const Array& a) { return a.name == array.name; });
    if (twice) throw description.error(array.name, "this array is listed twice");
    arrays.push_back(std::move(array));
  }
  return arrays;
}

// The shape of a known array follows from the arrays that say how many points, key points or colors there
// are.
void check_shapes(const Description& description, const Case& c) {
  for (const Array& array : c.arrays) {
    const std::optional<KnownArray> known = find_known_array(array.name);
    if (!known) continue;
    const Array* counter = c.find(known->counted_by);
    std::vector<std::uint64_t> expected = {counter != nullptr ? counter->rows() : array.rows()};
    expected.insert(expected.end(), known->columns.begin(), known->columns.end());
    if (array.shape != expected) {
      throw description.error(array.name,
                              "shape " + shape_text(expected) + " expected, found " + shape_text(array.shape));
    }
  }
}

void take_keypoints(Case& c, const Array& array) {
  const std::vector<std::int32_t> indices = ints_of(array);
  const std::size_t points = c.points.size() / 3;
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const std::string what = "key point " + std::to_string(k) + " is point " + std::to_string(indices[k]);
    if (indices[k] < 0 || (c.find("points") != nullptr && static_cast<std::size_t>(indices[k]) >= points)) {
      throw InputError::at_byte(array.path, 4 * k, what + ", but there are " + std::to_string(points) + " points");
    }
    const auto index = static_cast<std::uint32_t>(indices[k]);
    if (c.find("points") != nullptr && !shortshot::is_finite(shortshot::point(c.cloud(), index))) {
      throw InputError::at_byte(array.path, 4 * k, what + ", which is not finite");
    }
    c.keypoints.push_back(index);
  }
}

void read_arrays(Case& c) {
  for (Array& array : c.arrays) {
    const std::optional<KnownArray> known = find_known_array(array.name);
    if (known && known->role != Role::later) read_bytes(array);
  }
  if (const Array* points = c.find("points")) c.points = floats_of(*points);
  if (const Array* rgb = c.find("rgb")) c.rgb = bytes_of(*rgb);
  if (const Array* normals = c.find("normals")) c.normals = floats_of(*normals);
  if (const Array* frames = c.find("frames")) c.frames = floats_of(*frames);
  if (const Array* keypoints = c.find("keypoints")) take_keypoints(c, *keypoints);
}

}  // namespace

const Array* Case::find(const std::string& name) const {
  const auto found = std::find_if(arrays.begin(), arrays.end(), [&](const Array& a) { return a.name == name; });
  return found == arrays.end() ? nullptr : &*found;
}

shortshot::CloudView Case::cloud() const {
  const std::size_t size = points.size() / 3;
  shortshot::CloudView view =
      rgb.empty() ? shortshot::view_xyz(points.data(), size) : shortshot::view_xyz_rgb(points.data(), rgb.data(), size);
  if (!normals.empty()) view.normals = shortshot::view_xyz(normals.data(), size).points;
  return view;
}

Case read_case(const std::string& folder) {
  const Description description(std::filesystem::path(folder) / "case.json");
  Case c;
  c.radius = radius_of(description, "radius");
  c.lrf_radius = radius_of(description, "lrf_radius");
  c.frames_are_pcl_lrf = flag_of(description, "frames_are_pcl_lrf", true);
  c.keypoint_kind = kinds_of(description);
  c.arrays = arrays_of(description, folder);
  check_shapes(description, c);
  const Array* keypoints = c.find("keypoints");
  if (!c.keypoint_kind.empty() && keypoints != nullptr && c.keypoint_kind.size() != keypoints->rows()) {
    throw description.error("keypoint_kind", std::to_string(c.keypoint_kind.size()) + " words for " +
                                                 std::to_string(keypoints->rows()) + " key points");
  }
  read_arrays(c);
  return c;
}

}  // namespace shortshot_bench::golden
