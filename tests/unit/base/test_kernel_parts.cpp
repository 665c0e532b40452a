// Parts of the kernel that its results do not show one by one: how neighbors come into chunks, and the unit of votes.
#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "fixtures.hpp"

namespace test_kernel_parts {

using namespace unit;
namespace detail = ss::detail;

namespace {

template <std::uint32_t ChunkSize>
void check_chunks() {
  for (std::uint32_t size = 0; size <= 5 * ChunkSize; ++size) {
    std::vector<int> taken(size, 0);
    for (std::uint32_t chunk = 0; chunk * ChunkSize < size; ++chunk) {
      const detail::Stretches stretches = detail::stretches_of_chunk<ChunkSize>(chunk, size);
      REQUIRE(stretches.count <= 4);
      REQUIRE(stretches.count * stretches.length <= ChunkSize);
      for (std::uint32_t k = 0; k < stretches.count; ++k) {
        for (std::uint32_t i = 0; i < stretches.length; ++i) {
          ++taken.at(stretches.first + k * stretches.stride + i);
        }
      }
    }
    for (const int times : taken) REQUIRE(times == 1);
  }
}

}  // namespace

TEST_CASE("kernel parts: chunks take every neighbor exactly once, in at most four stretches") {
  check_chunks<ss::default_chunk_size>();
  check_chunks<1>();
  check_chunks<8>();
  check_chunks<24>();
}

TEST_CASE("kernel parts: the votes of as many neighbors as there may be fit int32, and positions are finer") {
  for (const std::uint32_t n : {1u, 2u, 3u, 549u, 1u << 16, (1u << 16) + 1, ss::max_neighbors}) {
    const ss::extend::VoteUnit unit = detail::vote_unit(n, ss::Scsh336::position_bits, 2);
    CHECK(unit.one == std::int32_t{1} << unit.bits);
    CHECK(std::int64_t{4} * unit.one * n <= std::int64_t{1} << 30);
    CHECK(unit.bits < ss::Scsh336::position_bits);
    CHECK(unit.bits >= 4);
  }
  using Finest = ss::Ssh<ss::SphericalGrid<1024, 1, 1>>;
  CHECK(Finest::position_bits == 20);
  CHECK(detail::vote_unit(1, Finest::position_bits, 2).bits == 19);
}

TEST_CASE("kernel parts: tied votes of neighbors at one distance, with one index, stay inside the neighborhood") {
  // Pairs of opposite points at one distance: all votes are tied, all ranks have the same d2.
  constexpr std::uint32_t pairs = 20000;
  Room room(2 * pairs);
  ss::Neighborhood n = room.neighborhood();
  Random random(3);
  for (std::uint32_t k = 0; k < pairs; ++k) {
    const float x = random.between(0.1f, 0.5f), y = random.between(0.01f, 0.3f), z = random.between(0.001f, 0.1f);
    for (const float sign : {1.0f, -1.0f}) {
      n.dx[n.size] = sign * x;
      n.dy[n.size] = sign * y;
      n.dz[n.size] = sign * z;
      n.d2[n.size] = 0.25f;
      n.index[n.size] = 0;  // not even the index tells them apart
      ++n.size;
    }
  }
  ss::Frame frame{};
  CHECK(ss::estimate_frame(n, 1.0f, frame) == ss::Status::ok);
}

TEST_CASE("kernel parts: the upper half of a product is added, rounded towards minus infinity") {
  const std::int32_t numbers[] = {-2147483647 - 1, -2147483647, -65537, -3, -1, 0, 1, 2, 65536, 2147483647};
  for (const std::int32_t a : numbers) {
    for (const std::int32_t b : numbers) {
      CAPTURE(a);
      CAPTURE(b);
      const std::int64_t product = std::int64_t{a} * b;
      const std::int64_t rest = (product % 4294967296 + 4294967296) % 4294967296;
      CHECK(detail::add_high_product(-7, a, b) == (product - rest) / 4294967296 - 7);
    }
  }
}

}  // namespace test_kernel_parts
