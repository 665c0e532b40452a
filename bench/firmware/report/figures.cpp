#include "firmware/report/figures.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "firmware/report/call_graph.hpp"

namespace shortshot_bench::firmware {
namespace {

bool starts_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

/// Bytes of all sections whose names start in one of these ways.
double bytes_of(const Facts& image, std::initializer_list<const char*> starts, const char* key = "bytes") {
  double sum = 0.0;
  for (const std::string& line : image.all(key)) {
    const std::size_t end = line.find(' ');
    const bool counts = std::any_of(starts.begin(), starts.end(),
                                    [&](const char* start) { return starts_with(line.substr(0, end), start); });
    if (counts) sum += whole_number(line.substr(end + 1));
  }
  return sum;
}

double flash_of(const Facts& image, const char* key = "bytes") {
  return bytes_of(image, {".vectors", ".text", ".rodata", ".srodata", ".ARM.ex", ".init_array", ".data", ".sdata"},
                  key);
}

double ram_of(const Facts& image) { return bytes_of(image, {".data", ".sdata", ".bss", ".sbss"}); }

class Builder {
 public:
  explicit Builder(const std::vector<Facts>& images) {
    for (const Facts& image : images) {
      if (image.text("program") == "size" && image.text("configuration").empty()) startup_[place(image)] = &image;
    }
    for (const Facts& image : images) {
      const std::string program = image.text("program");
      if (program == "size" && !image.text("configuration").empty()) add_size(image);
      if (program == "work") add_work(image);
      const bool is_board = program == "recognition" || program == "small_sensor";
      const bool is_host = program == "recognition_on_host" || program == "small_sensor_on_host";
      if (program == "bits" || is_board || is_host) add_bits(image);
      if (is_board) add_work(image);
      if (is_host) add_facts(image);
      if (program == "small_sensor") add_whole(image);
      if (program == "recognizer_code") {
        figures(image, image.text("configuration"))["recognizer_code"] = flash_of(image) - flash_of(image, "alone");
      }
      if (program == "skipped") measured_.skipped.push_back(image.text("configuration"));
    }
    for (Row& row : measured_.rows) derive(row.figures);
    derive_further();
  }

  Measured take() { return std::move(measured_); }

 private:
  static std::string place(const Facts& image) { return image.text("target") + " " + image.text("level"); }

  Row& row(const std::string& target, const std::string& level, const std::string& configuration,
           const std::string& workspace) {
    for (Row& row : measured_.rows) {
      if (row.target == target && row.level == level && row.configuration == configuration &&
          row.workspace == workspace) {
        return row;
      }
    }
    measured_.rows.push_back({target, level, configuration, workspace, {}});
    return measured_.rows.back();
  }

  std::map<std::string, double>& figures(const Facts& image, const std::string& configuration) {
    return row(image.text("target"), image.text("level"), configuration, image.text("workspace")).figures;
  }

  static void raise(double& figure, double value) { figure = std::max(figure, value); }

  void add_size(const Facts& image) {
    const std::string second = image.text("second");
    if (!second.empty()) {
      figures(image, second)["flash_further"] = flash_of(image);  // less that of the first one, at the end
      further_.push_back({&image, second});
      return;
    }
    auto& out = figures(image, image.text("configuration"));
    const std::string search = image.text("search");
    if (image.text("image") == "yes") {
      const Facts* const startup = startup_.at(place(image));
      out["flash_" + search] = flash_of(image);
      out["flash_startup"] = flash_of(*startup);
      raise(out["static_bytes"], ram_of(image) - ram_of(*startup));
    } else {
      out["object_" + search] = bytes_of(image, {".text", ".rodata"});
    }
    const std::string path = image.text("callgraph");
    if (path.empty()) return;
    std::ifstream in(path);
    if (!in) throw std::runtime_error(path + ": cannot be read");
    const CallGraph graph(in);
    raise(out["stack_graph"], graph.deepest("describe_" + search));
    if (graph.has("build_" + search)) raise(out["stack_graph"], graph.deepest("build_" + search));
  }

  void add_work(const Facts& image) {
    auto& out = figures(image, image.text("configuration"));
    const std::vector<std::string> sections = image.all("section");
    const std::vector<std::string> counts = image.all("count");
    if (image.text("exit") != "0") return;  // reported as broken
    if (sections.size() != counts.size() || sections.empty()) {
      throw std::runtime_error(image.name() + ": " + std::to_string(sections.size()) + " sections, but " +
                               std::to_string(counts.size()) + " counts");
    }
    for (std::size_t i = 0; i < sections.size(); ++i) out["work_" + sections[i]] = whole_number(counts[i]);
    add_facts(image);
  }

  void add_facts(const Facts& image) {
    auto& out = figures(image, image.text("configuration"));
    for (const std::string& fact : image.all("fact")) {
      const std::size_t end = fact.find(' ');
      out[fact.substr(0, end)] = whole_number(fact.substr(end + 1));
    }
  }

  /// Of a whole program, start-up and all: its memory with the stack, and its flash but for the model.
  void add_whole(const Facts& image) {
    auto& out = figures(image, image.text("configuration"));
    if (image.all("bytes").empty() || out.count("model_bytes") == 0) return;
    out["code_bytes"] = flash_of(image) - out["model_bytes"];
    out["ram_bytes"] = ram_of(image) + out["stack_painted"];
  }

  void add_bits(const Facts& image) {
    const std::vector<Hash> hashes = hashes_of(image);
    measured_.hashes.insert(measured_.hashes.end(), hashes.begin(), hashes.end());
    if (!image.text("compiler").empty()) measured_.compilers[image.text("target")] = image.text("compiler");
  }

  static void derive(std::map<std::string, double>& f) {
    const auto has = [&](const char* name) { return f.count(name) != 0; };
    if (has("work_describe_and_match") && has("work_match")) {
      f["work_describe"] = f["work_describe_and_match"] - f["work_match"];
      f["work_view"] = f["work_index"] + f["work_colors"] + f["work_describe_and_match"] + f["work_find"];
    }
    if (has("work_points") && has("work_describe") && has("work_match") && has("work_find")) {
      f["work_view"] = f["work_points"] + f["work_describe"] + f["work_match"] + f["work_find"];
    }
    if (has("views") && has("work_view")) f["wrong_views"] = f["views"] - f["right"];
    if (has("flash_brute") && has("flash_grid")) f["flash_grid_extra"] = f["flash_grid"] - f["flash_brute"];
    for (const std::string kind : {"", "lab_"}) {
      const std::string less = "work_given_" + kind + "250";
      const std::string more = "work_given_" + kind + "500";
      if (f.count(less) == 0 || f.count(more) == 0) continue;
      f["work_" + kind + "per_neighbor"] = (f[more] - f[less]) / 250.0;
      f["work_" + kind + "fixed"] = 2.0 * f[less] - f[more];
    }
    if (has("chunk_bytes") && (has("stack_graph") || has("stack_painted"))) {
      const double stack =
          std::max(has("stack_graph") ? f["stack_graph"] : 0.0, has("stack_painted") ? f["stack_painted"] : 0.0);
      f["stack_outside_chunk"] = stack - f["chunk_bytes"];
    }
    for (const std::string unit : {"neighbor", "point", "cell"}) {
      const std::string of = (unit == "neighbor" ? "workspace" : "index") + std::string("_bytes_per_");
      const auto hundred = f.find(of + "100_" + unit + "s");
      if (hundred == f.end()) continue;
      f[of + unit] = hundred->second / 100.0;
      f.erase(hundred);
    }
  }

  void derive_further() {
    for (const auto& [image, second] : further_) {
      figures(*image, second)["flash_further"] -= figures(*image, image->text("configuration")).at("flash_brute");
    }
  }

  Measured measured_;
  std::map<std::string, const Facts*> startup_;
  std::vector<std::pair<const Facts*, std::string>> further_;
};

}  // namespace

std::vector<Hash> hashes_of(const Facts& image) {
  std::vector<Hash> hashes;
  for (const std::string& line : image.all("hash")) {
    const std::size_t end = line.find(' ');
    hashes.push_back({image.text("target"), image.text("level"), line.substr(0, end), line.substr(end + 1)});
  }
  return hashes;
}

Measured measure(const std::vector<Facts>& images) { return Builder(images).take(); }

}  // namespace shortshot_bench::firmware
