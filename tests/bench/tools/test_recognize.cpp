// learn and recognize: objects are told from each other, and from what was never learned.

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "shortshot/shortshot.hpp"
#include "tools/picture/marks.hpp"
#include "tools/recognize/objects.hpp"
#include "tools/recognize/options.hpp"
#include "tools/recognize/run.hpp"
#include "tools/scene/object_views.hpp"

namespace test_recognize {
namespace {

using namespace shortshot_bench;

RgbdCloud view_of(std::size_t object, double turn, std::uint32_t seed) {
  ObjectViewOptions options;
  options.turn = turn;
  options.seed = seed;
  options.width = 480;
  return make_object_view(object, options).cloud;
}

int exit_code_of(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "recognize");
  RecognizeCommand command;
  int exit_code = 0;
  const bool goes_on =
      parse_recognize_options(static_cast<int>(arguments.size()), arguments.data(), command, exit_code);
  return goes_on ? (command.learns ? -1 : -2) : exit_code;
}

}  // namespace

TEST_CASE("recognize: command lines") {
  CHECK(exit_code_of({"learn", "a.model", "mug", "a.ply", "b.ply"}) == -1);
  CHECK(exit_code_of({"recognize", "a.model", "a.ply"}) == -2);
  CHECK(exit_code_of({"learn", "--help"}) == 0);
  CHECK(exit_code_of({}) == 2);
  CHECK(exit_code_of({"learn", "a.model", "mug"}) == 2);
  CHECK(exit_code_of({"recognize", "a.model"}) == 2);
  CHECK(exit_code_of({"recognize", "a.model", "a.ply", "b.ply"}) == 2);
  CHECK(exit_code_of({"recognize", "a.model", "a.ply", "--expected", "0"}) == 2);
}

TEST_CASE("recognize: learned objects by name, others as none of these, and a model keeps its radius") {
  constexpr float radius = 0.03f;
  shortshot::Recognizer recognizer(recognizer_options(radius));
  CHECK(radius_of(recognizer) == radius);
  const std::vector<std::size_t> learned{0, 1, 4};  // a box, a can, a mug
  for (const std::size_t object : learned) {
    for (const double turn : {0.0, 0.3}) {
      learn(recognizer, view_of(object, turn, 1), generated_instance(object), 1);
    }
  }
  CHECK(recognizer.class_count() == 3);
  for (const std::size_t object : learned) {
    const RgbdCloud cloud = view_of(object, 0.15, 2);
    const auto features = describe_object(cloud, radius_of(recognizer), 1);
    const std::vector<Recognized> all = recognize_objects(recognizer, features, 1);
    REQUIRE_FALSE(all.empty());
    CHECK(recognizer.class_name(all[0].hypothesis.object_class) == generated_instance(object));
    CHECK(all[0].log10_expected < -2.0);
    CHECK(all[0].voters.size() > 20);
  }
  const auto features = describe_object(view_of(7, 0.0, 3), radius_of(recognizer), 1);
  for (const Recognized& r : recognize_objects(recognizer, features, 1)) CHECK(r.log10_expected > -2.0);

  const std::string path = std::string(SHORTSHOT_TEST_OUTPUT) + "/objects.model";
  REQUIRE(shortshot::save(recognizer, path) == shortshot::Status::ok);
  shortshot::Recognizer loaded;
  REQUIRE(shortshot::load(path, shortshot::layout_of<ObjectDescriptor>(), loaded) == shortshot::Status::ok);
  CHECK(radius_of(loaded) == radius);
}

TEST_CASE("recognize: a file that is no model, or no cloud, is named") {
  const std::string folder = std::string(SHORTSHOT_TEST_OUTPUT) + "/";
  std::ofstream(folder + "no.model") << "nonsense";
  RecognizeCommand command;
  command.model = folder + "no.model";
  command.clouds = {folder + "none.ply"};
  CHECK_THROWS_WITH(run_recognize(command), doctest::Contains("no.model: "));
  CHECK_THROWS_WITH(run_learn(command), doctest::Contains("no.model: "));
  command.model = folder + "new.model";
  CHECK_THROWS_WITH(run_learn(command), doctest::Contains("none.ply"));
  CHECK_FALSE(std::ifstream(command.model).good());
}

TEST_CASE("recognize: the picture has its marks, and a cloud without colors is refused") {
  const RgbdCloud cloud = view_of(0, 0.0, 1);
  picture::MarkedCloud marked;
  marked.title = "box";
  const auto point_at = [&](std::size_t i) {
    return shortshot::Point{cloud.xyz[3 * i], cloud.xyz[3 * i + 1], cloud.xyz[3 * i + 2]};
  };
  const auto greens = [&] {
    const picture::Canvas canvas = draw_marked({"a view", cloud}, marked, 500);
    CHECK(canvas.width() == 500);
    std::size_t count = 0;
    for (std::size_t i = 0; i < canvas.width() * canvas.height(); ++i) {
      const picture::Color c = canvas.pixel(i % canvas.width(), i / canvas.width());
      count += c.g > 225 && c.r < 110 && c.b < 140 ? 1u : 0u;
    }
    return count;
  };
  const std::size_t without = greens();
  marked.marks = {point_at(cloud.size() / 3)};
  marked.targets = {point_at(2 * cloud.size() / 3)};
  CHECK(greens() > without);

  RgbdCloud gray = cloud;
  gray.rgb.clear();
  CHECK_THROWS(describe_object(gray, 0.03f, 1));
}

}  // namespace test_recognize
