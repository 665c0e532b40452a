// match: what is found, what is not, how sure that is, and the pictures of it.

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "shortshot/shortshot.hpp"
#include "tools/match/chance.hpp"
#include "tools/match/match.hpp"
#include "tools/match/options.hpp"
#include "tools/match/pictures.hpp"
#include "tools/match/report.hpp"
#include "tools/match/run.hpp"
#include "tools/picture/canvas.hpp"
#include "tools/picture/panel.hpp"
#include "tools/scene/object_views.hpp"
#include "tools/scene/tabletop.hpp"

namespace test_match {
namespace {

using namespace shortshot_bench;
using picture::Canvas;

RgbdCloud small_scene(std::uint32_t seed, double turn) {
  TabletopOptions options;
  options.seed = seed;
  options.turn = turn;
  options.width = 320;
  options.height = 240;
  return make_tabletop(options);
}

/// The exit code of a command line, or -1 if match would go on.
int exit_code_of(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "match");
  MatchCommand command;
  int exit_code = 0;
  const bool goes_on = parse_match_options(static_cast<int>(arguments.size()), arguments.data(), command, exit_code);
  return goes_on ? -1 : exit_code;
}

/// Pixels that are nearer to the green of inliers' lines than to anything else that is drawn, in the gap between both
/// clouds.
std::size_t green_in_the_middle(const Canvas& canvas) {
  std::size_t count = 0;
  for (std::size_t y = 0; y < canvas.height(); ++y) {
    const picture::Color c = canvas.pixel(canvas.width() / 2, y);
    count += c.g > 150 && c.r < 150 && c.b < 170 ? 1u : 0u;
  }
  return count;
}

/// As text, with colors.
std::string write_ply(const std::string& path, const RgbdCloud& cloud) {
  std::ofstream file(path);
  file << "ply\nformat ascii 1.0\nelement vertex " << cloud.size()
       << "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
          "property uchar blue\nend_header\n";
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) file << cloud.xyz[3 * i + k] << ' ';
    for (std::size_t k = 0; k < 3; ++k) file << int{cloud.rgb[3 * i + k]} << (k < 2 ? ' ' : '\n');
  }
  return path;
}

/// n choose k p^k (1 - p)^(n - k), added up.
double tail_by_hand(int n, int least, double p) {
  double sum = 0.0;
  for (int k = least; k <= n; ++k) {
    double term = 1.0;
    for (int i = 0; i < k; ++i) term *= p * (n - i) / (i + 1);
    sum += term * std::pow(1.0 - p, n - k);
  }
  return sum;
}

}  // namespace

TEST_CASE("match: command lines") {
  CHECK(exit_code_of({}) == -1);
  CHECK(exit_code_of({"a.pcd", "b.ply", "--radius", "0.1", "--out", "x"}) == -1);
  CHECK(exit_code_of({"a.pcd", "b.ply", "--whole", "both"}) == -1);
  CHECK(exit_code_of({"a.pcd", "b.ply", "--whole", "c"}) == 2);
  CHECK(exit_code_of({"--help"}) == 0);
  for (const char* wrong : {"--radius=0", "--leaf=nan", "--expected=-1", "--threads=0", "--width=10", "--nothing"}) {
    CHECK(exit_code_of({wrong}) == 2);
  }
  CHECK(exit_code_of({"a.pcd"}) == 2);
  CHECK(exit_code_of({"a.pcd", "b.pcd", "c.pcd"}) == 2);
}

TEST_CASE("match: another view of a scene is found, with the angle that it was turned by") {
  const RgbdCloud a = small_scene(1, 0.0);
  const RgbdCloud b = small_scene(1, 0.25);
  const MatchResult result = match_clouds(a, b, {});
  REQUIRE(result.is_found);
  CHECK(result.chance.log10_expected < -20.0);
  CHECK(degrees_of(result.pose) == doctest::Approx(std::atan2(0.25, 0.75) * 57.29578).epsilon(0.02));
  CHECK(result.fit.share > 0.7f);
  const std::string line = quiet_line(result);
  CHECK(line.substr(0, 2) == "1 ");

  const NamedCloud of_a{"one", a}, of_b{"two", b};
  for (const std::size_t width : {std::size_t{400}, std::size_t{1000}}) {
    const Canvas lines = draw_matches(of_a, of_b, result, width);
    CHECK(lines.width() == width);
    CHECK(lines.height() > width / 3);
    CHECK(lines.height() < width);
    CHECK(green_in_the_middle(lines) > 5);
    CHECK(draw_moved(of_a, of_b, result, width).width() == width);
  }
}

TEST_CASE("match: what has nothing in common is not found, and no line says so") {
  const RgbdCloud a = make_object_view(0, {}).cloud;
  const RgbdCloud b = make_object_view(9, {}).cloud;
  const MatchResult result = match_clouds(a, b, {});
  CHECK_FALSE(result.is_found);
  CHECK(result.chance.log10_expected > -2.0);
  CHECK(verdict_of(result).substr(0, 9) == "NOT FOUND");
  CHECK(quiet_line(result).substr(0, 2) == "0 ");
  CHECK(green_in_the_middle(draw_matches({"one", a}, {"two", b}, result, 600)) == 0);
}

TEST_CASE("match: files that it reads and writes, and what is wrong with one, with its name and place") {
  const std::string folder = std::string(SHORTSHOT_TEST_OUTPUT) + "/";
  const auto exists = [](const std::string& path) { return std::ifstream(path).good(); };
  MatchCommand command;
  command.out = folder + "matched";
  command.width = 400;
  command.clouds = {write_ply(folder + "a.ply", make_object_view(0, {}).cloud),
                    write_ply(folder + "b.ply", make_object_view(9, {}).cloud)};
  std::remove((command.out + ".png").c_str());
  command.quiet = true;
  CHECK_FALSE(run_match(command));
  CHECK_FALSE(exists(command.out + ".png"));
  command.quiet = false;
  std::ofstream(command.out + "-pose.txt") << "of an earlier run";
  CHECK_FALSE(run_match(command));
  CHECK(exists(command.out + ".png"));
  CHECK_FALSE(exists(command.out + "-pose.txt"));
  command.clouds[1] = command.clouds[0];
  CHECK(run_match(command));
  CHECK(exists(command.out + "-moved.png"));
  double number = 0.0;
  std::vector<double> pose;
  for (std::ifstream file(command.out + "-pose.txt"); file >> number;) pose.push_back(number);
  REQUIRE(pose.size() == 16);
  for (std::size_t k = 0; k < 16; ++k) CHECK(std::fabs(pose[k] - (k % 5 == 0 ? 1.0 : 0.0)) < 0.02);

  std::ofstream(folder + "broken.ply")
      << "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
         "property float z\nend_header\n0 0 1\n0 zero 1\n";
  command.clouds[1] = folder + "broken.ply";
  CHECK_THROWS_WITH(run_match(command), doctest::Contains("broken.ply:9:"));
  std::ofstream(folder + "short.ply", std::ios::binary) << "ply\nformat binary_little_endian 1.0\nelement vertex 2\n"
                                                           "property float x\nproperty float y\nproperty float z\n"
                                                           "end_header\n1234";
  command.clouds[1] = folder + "short.ply";
  CHECK_THROWS_WITH(run_match(command), doctest::Contains("short.ply: byte "));
  command.clouds[1] = folder + "none.ply";
  CHECK_THROWS_WITH(run_match(command), doctest::Contains("none.ply"));
}

TEST_CASE("match: a cloud that cannot be described is refused in the library's words") {
  const RgbdCloud a = make_object_view(0, {}).cloud;
  CHECK_THROWS_WITH(match_clouds(a, RgbdCloud{}, {}), "the cloud has no valid point");
}

TEST_CASE("chance: the binomial tail, and what it makes of pairs") {
  CHECK(log10_binomial_tail(10, 0, 0.3) == 0.0);
  CHECK(std::pow(10.0, log10_binomial_tail(10, 4, 0.3)) == doctest::Approx(tail_by_hand(10, 4, 0.3)));
  CHECK(std::pow(10.0, log10_binomial_tail(40, 1, 0.01)) == doctest::Approx(tail_by_hand(40, 1, 0.01)));
  CHECK(log10_binomial_tail(3, 4, 0.5) < -200.0);

  // 20 pairs far apart, each led to the right one of 20 targets: 17 of 17 that agree by chance with 1 in 20.
  std::vector<shortshot::PointPair> pairs;
  std::vector<shortshot::Point> targets;
  std::vector<std::uint32_t> all;
  Places places;
  for (std::uint32_t i = 0; i < 20; ++i) {
    const shortshot::Point p{static_cast<float>(i), static_cast<float>(i * i % 7), 0.0f};
    pairs.push_back({p, p});
    targets.push_back(p);
    all.push_back(i);
  }
  const shortshot::Pose still{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
  places.nearest = places.of = all;
  const Chance sure = chance_of(pairs, all, places, still, targets, 0.1f, 1000);
  CHECK(sure.agreement == doctest::Approx(0.05));
  CHECK(sure.at.any == 20);
  CHECK(sure.log10_expected == doctest::Approx(3.0 + std::log10(2.0) + 17.0 * std::log10(0.05)));
  // Three pairs always agree.
  CHECK(chance_of(pairs, {0, 1, 2}, places, still, targets, 0.1f, 1000).log10_expected == doctest::Approx(3.0));
}

TEST_CASE("chance: points that are near to each other are one place, and two ways to agree count twice") {
  const std::vector<shortshot::Point> points{{0, 0, 0}, {0.5f, 0, 0}, {1.2f, 0, 0}, {5, 0, 0}};
  const Places one = places_of(points, {3, 1, 2, 4}, 1.0f);
  CHECK(one.nearest == std::vector<std::uint32_t>{1, 3});
  CHECK(one.of == std::vector<std::uint32_t>{0, 0, 0, 1});
  CHECK(places_of(points, {1, 3, 2, 4}, 1.0f).nearest == std::vector<std::uint32_t>{0, 2, 3});
  CHECK(places_of(points, {1, 3, 2, 4}, 0.1f).nearest.size() == 4);
  CHECK(places_of({}, {}, 1.0f).nearest.empty());

  // At the first place not the nearest one agrees: any of three does with 1 - 0.9^2 (four points at two places).
  const Agreement at = agreement_at(one, {0, 3}, 0.1, 0);
  CHECK(at.nearest == 1);
  CHECK(at.any == 2);
  CHECK(std::pow(10.0, at.log10_probability) == doctest::Approx(2.0 * 0.19 * 0.19));
  CHECK(std::pow(10.0, agreement_at(one, {1, 3}, 0.1, 0).log10_probability) == doctest::Approx(2.0 * 0.1 * 0.1));
  CHECK(agreement_at(one, {1, 3}, 0.1, 2).log10_probability == 0.0);
  CHECK(agreement_at(one, {}, 0.1, 0).log10_probability == 0.0);
}

TEST_CASE("refine: a pose that is nearly right becomes right") {
  const RgbdCloud cloud = make_object_view(0, {}).cloud;
  const shortshot::CloudView view{shortshot::view_xyz(cloud.xyz.data(), cloud.size())};
  shortshot::Pose pose{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0.004f, -0.003f, 0.002f}};
  const float before = fit_under(view, view, pose, {}).deviation;
  const Fit after = refine(view, view, {}, pose);
  CHECK(after.deviation < before);
  for (const float t : pose.translation) CHECK(std::fabs(t) < 0.001f);  // less than the depth's noise
}

TEST_CASE("pictures: smooth edges, text, the nearer point in front, and a PNG file") {
  Canvas canvas(60, 40);
  canvas.line({5, 5}, {55, 30}, 2.0f, picture::black);
  std::size_t grays = 0;
  for (std::size_t i = 0; i < 60 * 40; ++i) {
    const picture::Color c = canvas.pixel(i % 60, i / 60);
    grays += c.r > 0 && c.r < 255 ? 1u : 0u;
  }
  CHECK(grays > 20);
  CHECK(Canvas::text_width(12.0f, "match") > Canvas::text_width(12.0f, "at"));

  RgbdCloud two;
  two.xyz = {0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 2.0f, 0.3f, 0.2f, 1.0f, -0.3f, -0.2f, 1.0f};
  two.rgb = {255, 0, 0, 0, 0, 255, 9, 9, 9, 9, 9, 9};
  two.width = 4;
  two.height = 1;
  picture::Panel panel(canvas, {0, 0, 60, 40}, picture::best_viewing(two), two);
  panel.draw(two, picture::Paint::own);
  CHECK(canvas.pixel(30, 20).r == 255);
  CHECK(canvas.pixel(30, 20).b == 0);

  const std::string path = std::string(SHORTSHOT_TEST_OUTPUT) + "/picture.png";
  canvas.write_png(path);
  std::ifstream file(path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  REQUIRE(bytes.size() > 33);
  CHECK(bytes.substr(1, 3) == "PNG");
  CHECK(bytes.substr(16, 8) == std::string("\0\0\0\x3c\0\0\0\x28", 8));
  CHECK_THROWS(canvas.write_png(std::string(SHORTSHOT_TEST_OUTPUT) + "/no such folder/picture.png"));
}

}  // namespace test_match
