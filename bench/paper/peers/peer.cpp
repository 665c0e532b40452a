#include "peer.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include "speed/timing/clock.hpp"

namespace shortshot_bench::paper {
namespace {

constexpr double voxels_in_radius = 10.0;  // twice as fine as in Open3D's tutorial of registration

std::vector<float> read_floats(std::istream& stream, std::size_t count) {
  std::vector<float> values(count);
  stream.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(float)));
  if (!stream) throw std::runtime_error("the question is too short");
  return values;
}

PeerQuestion read_question(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string head;
  std::getline(stream, head);
  std::istringstream numbers(head);
  std::size_t points = 0, keypoints = 0;
  PeerQuestion question;
  numbers >> points >> keypoints >> question.radius;
  if (!numbers) throw std::runtime_error(path + " is no question");
  const std::vector<float> all = read_floats(stream, 6 * points);
  question.keypoints = read_floats(stream, 3 * keypoints);
  for (std::size_t i = 0; i < points; ++i) {
    const float* const p = all.data() + 6 * i;
    bool finite = true;
    for (std::size_t k = 0; k < 6; ++k) finite = finite && std::isfinite(p[k]);
    if (finite) question.points.insert(question.points.end(), p, p + 6);
  }
  return question;
}

/// The means of the points and of the normals in each voxel: what FPFH is computed of, whose cost grows with the square
/// of the density.
PeerQuestion averaged(const PeerQuestion& question, double voxel) {
  struct Sum {
    double values[6] = {};
    double count = 0.0;
  };
  std::map<std::array<long, 3>, Sum> voxels;
  for (std::size_t i = 0; i < question.size(); ++i) {
    const float* const p = question.point(i);
    std::array<long, 3> cell{};
    for (std::size_t k = 0; k < 3; ++k) cell[k] = std::lround(std::floor(static_cast<double>(p[k]) / voxel));
    Sum& sum = voxels[cell];
    for (std::size_t k = 0; k < 6; ++k) sum.values[k] += static_cast<double>(p[k]);
    sum.count += 1.0;
  }
  PeerQuestion result{question.radius, {}, question.keypoints};
  for (const auto& [cell, sum] : voxels) {
    const double* const n = sum.values + 3;
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (length == 0.0) continue;
    for (std::size_t k = 0; k < 6; ++k) {
      result.points.push_back(static_cast<float>(sum.values[k] / (k < 3 ? sum.count : length)));
    }
  }
  return result;
}

void write_answer(const std::string& path, const PeerAnswer& answer, std::size_t count, double microseconds) {
  std::ofstream stream(path, std::ios::binary);
  stream << count << ' ' << answer.size << ' ' << microseconds << '\n';
  stream.write(reinterpret_cast<const char*>(answer.values.data()),
               static_cast<std::streamsize>(answer.values.size() * sizeof(float)));
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + path);
}

}  // namespace

int answer_as_peer(int argc, char** argv, const std::function<PeerAnswer(const PeerQuestion&)>& describe) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s IN OUT; bench/paper/peer_program.hpp says what these hold\n", argv[0]);
    return 2;
  }
  try {
    const PeerQuestion question = read_question(argv[1]);
    const double start = now_seconds(Clock::thread_cpu);
    const PeerAnswer answer = describe(averaged(question, question.radius / voxels_in_radius));
    write_answer(argv[2], answer, question.keypoint_count(), 1e6 * (now_seconds(Clock::thread_cpu) - start));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 2;
  }
}

}  // namespace shortshot_bench::paper
