#include "paper/peer_program.hpp"

#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <sstream>
#include <stdexcept>

namespace shortshot_bench::paper {
namespace {

void append(std::string& bytes, const float* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(float));
}

std::string question_about(const View& view) {
  std::ostringstream head;
  head << view.cloud().size() << ' ' << view.keypoints().size() << ' ' << view.settings().radius << ' '
       << view.settings().normal_radius << '\n';
  std::string bytes = head.str();
  for (std::size_t i = 0; i < view.cloud().size(); ++i) {
    const shortshot::SurfaceNormal& n = view.normals()[i];
    const float normal[3] = {n.x, n.y, n.z};
    append(bytes, view.cloud().xyz.data() + 3 * i, 3);
    append(bytes, normal, 3);
  }
  for (const shortshot::KeyPoint& k : view.keypoints()) {
    const float place[3] = {k.position.x, k.position.y, k.position.z};
    append(bytes, place, 3);
  }
  return bytes;
}

TimedRows rows_of_answer(const std::string& file, const std::string& program, const View& view) {
  std::ifstream stream(file, std::ios::binary);
  std::string head;
  std::getline(stream, head);
  std::istringstream numbers(head);
  std::size_t count = 0;
  TimedRows answer;
  Described& rows = answer.rows;
  numbers >> count >> rows.size >> answer.microseconds;
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  const bool is_answer =
      numbers && count == view.keypoints().size() && rows.size > 0 && bytes.size() == count * rows.size * sizeof(float);
  if (!is_answer) throw std::runtime_error(program + " did not write a row for each key point");
  rows.values.resize(count * rows.size);
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(rows.values.data()));
  rows.keypoints = view.keypoints();
  rows.frames.resize(count);
  for (std::size_t row = 0; row < count; ++row) {
    const auto first = rows.values.begin() + static_cast<std::ptrdiff_t>(row * rows.size);
    const bool finite =
        std::all_of(first, first + static_cast<std::ptrdiff_t>(rows.size), [](float x) { return std::isfinite(x); });
    rows.status.push_back(finite ? shortshot::Status::ok : shortshot::Status::too_few_neighbors);
    if (!finite) std::fill_n(first, rows.size, 0.0f);
  }
  return answer;
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

TimedRows ask(const std::string& program, const std::string& question, const View& view) {
  static std::atomic<unsigned> number{0};
  const std::string files = (std::filesystem::temp_directory_path() / "shortshot-peer-").string() +
                            std::to_string(getpid()) + "-" + std::to_string(number++);
  const std::string in = files + ".in", out = files + ".out";
  std::ofstream(in, std::ios::binary) << question;
  const int failed = std::system((quoted(program) + ' ' + in + ' ' + out).c_str());
  const auto remove_both = [&] {
    std::filesystem::remove(in);
    std::filesystem::remove(out);
  };
  try {
    if (failed != 0) throw std::runtime_error(program + " failed");
    TimedRows answer = rows_of_answer(out, program, view);
    remove_both();
    return answer;
  } catch (...) {
    remove_both();
    throw;
  }
}

}  // namespace

TimedRows describe_by(const std::string& program, const View& view) {
  static std::mutex mutex;
  static std::map<std::pair<std::string, std::string>, TimedRows> answers;
  const std::string question = question_about(view);
  const std::pair<std::string, std::string> key{program, std::to_string(std::hash<std::string>{}(question))};
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (const auto place = answers.find(key); place != answers.end()) return place->second;
  }
  TimedRows answer = ask(program, question, view);
  const std::lock_guard<std::mutex> lock(mutex);
  return answers.emplace(key, std::move(answer)).first->second;
}

}  // namespace shortshot_bench::paper
