// layout_of(): the text that says what a descriptor's values mean.
#include <doctest/doctest.h>

#include <set>
#include <string>
#include <vector>

#include "fixtures.hpp"

namespace test_layout {
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

TEST_CASE("layout: compact descriptors, as compact.hpp says") {
  const auto rings = [](const char* size) {
    std::string text;
    for (const char* axis : {"lightness", "a", "b"}) {
      text += std::string(" | ") + axis + " offset " + size + " equal shells, root of shares, length 866/1000";
    }
    return text;
  };
  const std::string begin = "multilinear voting, height cells: ";
  const std::string points = " equal shells, root of shares, length 1000/1000";
  const std::string means = " (published Lab from mean color) shrunk by 30/100 ";
  const std::string roots = " equal shells, signed roots, length 700/1000, floor ";
  const std::string offsets = "means of lightness offset & a offset & b offset" + means;
  CHECK(ss::layout_of<ss::ShapeColor95>() == begin + "occupancy 2x4x8" + points + " | " + offsets + "3x1x8" + roots +
                                                 "100/100, noise 10/1000" +
                                                 rings("6 bins (published Lab from mean color) 3x1x1"));
  CHECK(ss::layout_of<ss::ShapeColor32>() == begin + offsets + "2x1x4" + roots + "49/100, noise 10/1000" +
                                                 rings("4 bins (published Lab from mean color) 2x1x1") +
                                                 " | occupancy 1x4x4" + points);
  CHECK(ss::layout_of<ss::RoomColor95>() ==
        begin + "occupancy 2x4x8" + points +
            " | means of lightness above & lightness below & a above & a below & b above & b below" + means + "2x1x8" +
            roots + "100/100, noise 10/1000" + rings("5 bins (published Lab from mean color) 2x1x1"));
  CHECK(ss::layout_of<ss::HeightShape96>() == begin + "occupancy 3x8x8" + points);
  CHECK(ss::layout_of<ss::ColorRings27>() == begin + rings("6 bins (published Lab from mean color) 3x1x1").substr(3));
}

TEST_CASE("layout: the parts of compact descriptors lie where compact.hpp says") {
  const auto begins = [](auto descriptor) {
    using D = decltype(descriptor);
    std::vector<int> offsets;
    for (int i = 0; i < D::parts; ++i) offsets.push_back(D::offset(i));
    return offsets;
  };
  using Offsets = std::vector<int>;
  CHECK(begins(ss::ShapeColor95{}) == Offsets{0, 64, 136, 154, 172});
  CHECK(begins(ss::ShapeColor32{}) == Offsets{0, 24, 32, 40, 48});
  CHECK(begins(ss::RoomColor95{}) == Offsets{0, 64, 160, 170, 180});
  CHECK(begins(ss::ColorRings27{}) == Offsets{0, 18, 36});
  CHECK(ss::HeightPart<ss::SphericalGrid<2, 4, 8>>::index(1, 3, 7) == 1 + 2 * (3 + 4 * 7));
  CHECK(ss::ColorMeansPart<ss::SphericalGrid<3, 1, 8>, 100>::index(2, 0, 5, 1) == 1 + 3 * (2 + 3 * 5));
  CHECK(ss::ColorExcessPart<ss::SphericalGrid<2, 1, 8>, 100>::index(1, 0, 5, 4) == 4 + 6 * (1 + 2 * 5));
  CHECK(ss::ColorRingsPart<3, ss::LabAxis::a, 6>::index(2, 0, 0, 4) == 4 + 6 * 2);
}

}  // namespace test_layout
