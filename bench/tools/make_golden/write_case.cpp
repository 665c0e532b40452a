#include "write_case.hpp"

#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tools/io/binary_file.hpp"

namespace shortshot_bench::make_golden {
namespace {

// Files of a folder, and their list.
class Arrays {
 public:
  explicit Arrays(std::string folder) : folder_(std::move(folder)) { std::filesystem::create_directories(folder_); }

  void add(const std::string& name, const std::vector<float>& values, const std::vector<std::size_t>& shape) {
    BinaryFile file(listed(name, "<f4", shape));
    file.write_floats(values.data(), values.size());
    file.close();
  }
  void add(const std::string& name, const std::vector<std::int32_t>& values, const std::vector<std::size_t>& shape) {
    std::string bytes;
    for (const std::int32_t value : values) {
      for (unsigned shift = 0; shift < 32; shift += 8) {
        bytes.push_back(static_cast<char>(static_cast<std::uint32_t>(value) >> shift & 0xffU));
      }
    }
    write(listed(name, "<i4", shape), bytes);
  }
  void add(const std::string& name, const std::vector<std::uint8_t>& values, const std::vector<std::size_t>& shape) {
    write(listed(name, "u1", shape), std::string(values.begin(), values.end()));
  }
  void write_list(nlohmann::ordered_json description) {
    description["arrays"] = list_;
    write(folder_ + "/case.json", description.dump(1) + "\n");
  }

 private:
  std::string listed(const std::string& name, const char* dtype, const std::vector<std::size_t>& shape) {
    list_.push_back({{"name", name}, {"dtype", dtype}, {"shape", shape}, {"file", name + ".bin"}});
    return folder_ + "/" + name + ".bin";
  }
  static void write(const std::string& path, const std::string& bytes) {
    BinaryFile file(path);
    file.write(bytes);
    file.close();
  }

  std::string folder_;
  nlohmann::ordered_json list_ = nlohmann::ordered_json::array();
};

}  // namespace

void write_case(const std::string& folder, const Cloud& cloud, const Frames& frames, const std::vector<Rows>& rows) {
  const std::size_t points = cloud.points.size() / 3;
  const std::size_t keypoints = cloud.keypoints.size();
  Arrays arrays(folder);
  arrays.add("points", cloud.points, {points, 3});
  arrays.add("rgb", cloud.rgb, {points, 3});
  arrays.add("keypoints", cloud.keypoints, {keypoints});
  arrays.add("neighbor_count", frames.neighbors, {keypoints});
  arrays.add("frames", frames.axes, {keypoints, 3, 3});
  for (const Rows& made : rows) {
    arrays.add(made.name, std::vector<float>(made.values.begin(), made.values.end()), {keypoints, made.size});
    arrays.add(made.name + "_nibbles", made.nibbles, {keypoints, (made.size + 1) / 2});
  }
  arrays.write_list({{"name", cloud.name},
                     {"source", "made by ./run golden --make"},
                     {"note", cloud.note},
                     {"endian", "little"},
                     {"radius", 0.05},
                     {"frames_are_pcl_lrf", false},
                     {"keypoint_kind", cloud.keypoint_kind}});
}

}  // namespace shortshot_bench::make_golden
