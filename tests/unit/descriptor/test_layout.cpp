// layout_of(): the text that says what a descriptor's values mean.
#include <doctest/doctest.h>

#include <set>
#include <string>

#include "fixtures.hpp"

namespace {

using namespace unit;
using Shape = ss::SphericalGrid<3, 4, 8>;
using Color = ss::SphericalGrid<2, 2, 4>;

struct OwnVoting : ss::HardVoting {
  static constexpr const char* name = "own voting";
};

struct Derived : ss::Ssh32 {};

}  // namespace

TEST_CASE("layout: everything that a descriptor is made of") {
  CHECK(ss::layout_of<ss::Ssh96>() == "published voting, published cells: occupancy 3x4x8 equal shells");
  CHECK(ss::layout_of<ss::Scsh336>() ==
        "published voting, published cells: occupancy 3x4x8 equal shells | "
        "color distance 15 bins (published Lab) 2x2x4 equal shells");
  CHECK(ss::layout_of<ss::Cshot1344>() ==
        "SHOT voting, SHOT cells: normal cosine 10 bins 2x2x8 equal shells | "
        "color distance 30 bins (CSHOT Lab) 2x2x8 equal shells");
  CHECK(ss::layout_of<ss::PclCshot1344>() ==
        "PCL voting, SHOT cells: normal cosine 10 bins 2x2x8 equal shells | "
        "color distance 30 bins (PCL Lab) 2x2x8 equal shells");
  CHECK(ss::layout_of<ss::Ssh<Shape, ss::HardVoting, ss::LogRadius<1, 4>>>() ==
        "hard voting, published cells: occupancy 3x4x8 logarithmic shells from 1/4");
}

TEST_CASE("layout: types that differ in any one thing have texts of their own") {
  const std::vector<std::string> texts{
      ss::layout_of<ss::Scsh<Shape, Color, 15>>(),
      ss::layout_of<ss::Scsh<Color, Color, 15>>(),
      ss::layout_of<ss::Scsh<Shape, Shape, 15>>(),
      ss::layout_of<ss::Scsh<ss::SphericalGrid<4, 3, 8>, Color, 15>>(),
      ss::layout_of<ss::Scsh<Shape, Color, 16>>(),
      ss::layout_of<ss::Scsh<Shape, Color, 15, ss::AdditiveVoting<false>>>(),
      ss::layout_of<ss::Scsh<Shape, Color, 15, ss::HardVoting>>(),
      ss::layout_of<ss::Scsh<Shape, Color, 15, ss::MultilinearVoting>>(),
      ss::layout_of<ss::Scsh<Shape, Color, 15, ss::ShotVoting>>(),
      ss::layout_of<ss::Scsh<Shape, Color, 15, ss::PclVoting>>(),
      ss::layout_of<ss::Scsh<Shape, Color, 15, ss::PublishedVoting, ss::LogRadius<1, 4>>>(),
      ss::layout_of<ss::Scsh<Shape, Color, 15, ss::PublishedVoting, ss::LogRadius<1, 5>>>(),
      ss::layout_of<ss::Scsh<Shape, Color, 15, ss::PublishedVoting, ss::LinearRadius, ss::PclLab>>(),
      ss::layout_of<ss::Scsh<Shape, Color, 15, ss::PublishedVoting, ss::LinearRadius, ss::CshotLab>>(),
      ss::layout_of<ss::Descriptor<ss::PublishedVoting, ss::Part<Shape, ss::Occupancy, ss::LinearRadius, ss::ShotCells>,
                                   ss::Part<Color, ss::ColorDistance<15>, ss::LinearRadius, ss::ShotCells>>>(),
      ss::layout_of<ss::Ssh<Shape>>(),
      ss::layout_of<ss::Shot<Color, 15>>()};
  CHECK(std::set<std::string>(texts.begin(), texts.end()).size() == texts.size());
}

TEST_CASE("layout: types with the same values have the same text") {
  CHECK(ss::layout_of<ss::Scsh<Shape, Color, 15>>() == ss::layout_of<ss::Scsh336>());
  CHECK(ss::layout_of<Derived>() == ss::layout_of<ss::Ssh32>());
  CHECK(ss::layout_of<ss::Ssh<Shape, ss::PublishedVoting, ss::LogRadius<2, 8>>>() ==
        ss::layout_of<ss::Ssh<Shape, ss::PublishedVoting, ss::LogRadius<1, 4>>>());
}

TEST_CASE("layout: a policy of one's own has a name of its own") {
  CHECK(ss::layout_of<ss::Ssh<Shape, OwnVoting>>() == "own voting, published cells: occupancy 3x4x8 equal shells");
}
