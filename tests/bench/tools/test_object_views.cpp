// Views of generated objects: around their centers, the same bytes every time, and others from elsewhere.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>

#include "tools/scene/object_views.hpp"

namespace test_object_views {
namespace {

using namespace shortshot_bench;

double distance_from(const shortshot::Point& center, const float* p) {
  return std::hypot(std::hypot(static_cast<double>(p[0] - center.x), static_cast<double>(p[1] - center.y)),
                    static_cast<double>(p[2] - center.z));
}

}  // namespace

TEST_CASE("object views: some hundred points or more, all of them around the center, with colors") {
  std::set<std::string> instances, classes;
  for (std::size_t object = 0; object < generated_objects; ++object) {
    instances.insert(generated_instance(object));
    classes.insert(generated_class(object));
    const ObjectView view = make_object_view(object, {});
    CAPTURE(generated_instance(object));
    CHECK(view.cloud.size() > 400);
    REQUIRE(view.cloud.rgb.size() == view.cloud.xyz.size());
    double farthest = 0.0;
    for (std::size_t i = 0; i < view.cloud.size(); ++i) {
      farthest = std::max(farthest, distance_from(view.center, view.cloud.xyz.data() + 3 * i));
    }
    CHECK((farthest > 0.02 && farthest < 0.2));
  }
  CHECK((instances.size() == generated_objects && classes.size() == 5));
}

TEST_CASE("object views: the same options give the same bytes, a turn or other noise gives others") {
  const ObjectView view = make_object_view(4, {0.5, 0.36, 1, 320});  // a mug, whose handle turns
  const ObjectView again = make_object_view(4, {0.5, 0.36, 1, 320});
  CHECK((view.cloud.xyz == again.cloud.xyz && view.cloud.rgb == again.cloud.rgb));
  CHECK(view.cloud.xyz != make_object_view(4, {1.5, 0.36, 1, 320}).cloud.xyz);
  CHECK(view.cloud.xyz != make_object_view(4, {0.5, 0.36, 2, 320}).cloud.xyz);
  CHECK(make_object_view(4, {0.5, 0.36, 1, 160}).cloud.size() < view.cloud.size() / 3);
}

}  // namespace test_object_views
