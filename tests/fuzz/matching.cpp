// Nearest rows in every format, against the loop over all pairs.
#include <algorithm>
#include <shortshot/recognition/l2_distance.hpp>
#include <shortshot/recognition/match.hpp>

#include "bytes.hpp"

namespace {

namespace ss = shortshot;
using fuzz::require;
using ss::Status;

constexpr float infinity = std::numeric_limits<float>::infinity();

struct Sizes {
  std::size_t queries, database, values, neighbors;
};

std::vector<Status> made_statuses(fuzz::Bytes& from, std::size_t count) {
  std::vector<Status> statuses(count, Status::ok);
  const std::uint8_t bits = from.byte();
  for (std::size_t i = 0; i < count; ++i) {
    if ((bits >> (i % 8) & 1) != 0 && i % 3 == 0) statuses[i] = Status::too_few_neighbors;
  }
  return statuses;
}

template <class Rows>
bool is_ok(const Rows& rows, std::size_t row) {
  return rows.status[row] == Status::ok;
}

/// How rows are compared, and which ones take part.
template <class Rows>
struct Plain {
  static bool takes_part(const Rows& rows, std::size_t row) { return is_ok(rows, row); }
  static float compare(const Rows& a, std::size_t i, const Rows& b, std::size_t k) {
    return static_cast<float>(a.compare(i, b, k));  // below 2^24 here
  }
  static float distance(const Rows& rows, float compared) {
    return rows.distance(static_cast<std::uint32_t>(compared));
  }
};
template <>
struct Plain<ss::DescriptorRows> {
  using Rows = ss::DescriptorRows;
  static bool takes_part(const Rows& rows, std::size_t row) {
    const std::vector<float> origin(rows.size);
    const float norm = ss::squared_l2_distance(rows.values + row * rows.size, origin.data(), rows.size);
    return is_ok(rows, row) && std::isfinite(8.0f * norm);
  }
  static float compare(const Rows& a, std::size_t i, const Rows& b, std::size_t k) {
    return ss::squared_l2_distance(a.values + i * a.size, b.values + k * b.size, a.size);
  }
  static float distance(const Rows&, float compared) { return std::sqrt(compared); }
};

struct Near {
  std::uint32_t row;
  float compared;
};

/// The rows of the database in the order of their distance from one query.
template <class Rows>
std::vector<Near> in_order(const Rows& queries, std::size_t query, const Rows& database) {
  std::vector<Near> order;
  if (!Plain<Rows>::takes_part(queries, query)) return order;
  for (std::size_t row = 0; row < database.count; ++row) {
    if (!Plain<Rows>::takes_part(database, row)) continue;
    order.push_back({static_cast<std::uint32_t>(row), Plain<Rows>::compare(queries, query, database, row)});
  }
  std::stable_sort(order.begin(), order.end(), [](const Near& a, const Near& b) { return a.compared < b.compared; });
  return order;
}

template <class Rows>
void check_pairs(const Rows& a, const Rows& b, const std::vector<std::vector<Near>>& orders, float ratio) {
  std::vector<ss::MatchedPair> reciprocal, distinct, expected_reciprocal, expected_distinct;
  require(ss::reciprocal_correspondences(a, b, reciprocal) == Status::ok, "reciprocal ok");
  require(ss::ratio_correspondences(a, b, ratio, distinct) == Status::ok, "ratio ok");
  for (std::size_t i = 0; i < a.count; ++i) {
    const auto& order = orders[i];
    if (order.empty()) continue;
    const auto source = static_cast<std::uint32_t>(i);
    const float distance = Plain<Rows>::distance(a, order[0].compared);
    const auto back = in_order(b, order[0].row, a);
    if (!back.empty() && back[0].row == i) expected_reciprocal.push_back({source, order[0].row, distance});
    if (order.size() > 1 && distance < ratio * Plain<Rows>::distance(a, order[1].compared)) {
      expected_distinct.push_back({source, order[0].row, distance});
    }
  }
  require(fuzz::same_bits(reciprocal, expected_reciprocal), "reciprocal pairs of all pairs' loop");
  require(fuzz::same_bits(distinct, expected_distinct), "distinct pairs of all pairs' loop");
}

template <class Rows>
void check(const Rows& queries, const Rows& database, std::size_t neighbors, float ratio) {
  std::vector<ss::Match> matches;
  require(ss::nearest(queries, database, neighbors, matches) == Status::ok, "nearest ok");
  require(matches.size() == queries.count * neighbors, "as many matches as were asked for");
  std::vector<std::vector<Near>> orders;
  for (std::size_t q = 0; q < queries.count; ++q) {
    orders.push_back(in_order(queries, q, database));
    for (std::size_t k = 0; k < neighbors; ++k) {
      const ss::Match& match = matches[q * neighbors + k];
      if (k < orders[q].size()) {
        require(match.row == orders[q][k].row, "the row of all pairs' loop");
        require(match.distance == Plain<Rows>::distance(queries, orders[q][k].compared), "and its distance");
      } else {
        require(match.row == ss::no_row && match.distance == infinity, "none where there is none");
      }
    }
  }
  check_pairs(queries, database, orders, ratio);
}

void check_floats(fuzz::Bytes& from, const Sizes& sizes, const std::vector<Status>& statuses, float ratio) {
  std::vector<float> values((sizes.queries + sizes.database) * sizes.values);
  const bool is_strange = from.byte() % 2 == 1;
  for (float& value : values) value = is_strange ? from.real() : static_cast<float>(from.small()) / 64.0f;
  const ss::DescriptorRows queries{values.data(), sizes.queries, sizes.values, statuses.data()};
  const ss::DescriptorRows database{values.data() + sizes.queries * sizes.values, sizes.database, sizes.values,
                                    statuses.data() + sizes.queries};
  check(queries, database, sizes.neighbors, ratio);
}

/// Halves are matched as the floats that they stand for.
void check_halves(fuzz::Bytes& from, const Sizes& sizes, const std::vector<Status>& statuses) {
  std::vector<std::uint16_t> halves((sizes.queries + sizes.database) * sizes.values);
  std::vector<float> floats;
  for (std::uint16_t& half : halves) {
    half = from.number<std::uint16_t>();
    floats.push_back(ss::detail::float_of_half(half));
  }
  const std::size_t first = sizes.queries * sizes.values;
  const Status* const status = statuses.data();
  std::vector<ss::Match> of_halves, of_floats;
  const Status matched =
      ss::nearest(ss::HalfRows{halves.data(), sizes.queries, sizes.values, status},
                  ss::HalfRows{halves.data() + first, sizes.database, sizes.values, status + sizes.queries},
                  sizes.neighbors, of_halves);
  require(matched == Status::ok, "nearest ok");
  const Status expected =
      ss::nearest(ss::DescriptorRows{floats.data(), sizes.queries, sizes.values, status},
                  ss::DescriptorRows{floats.data() + first, sizes.database, sizes.values, status + sizes.queries},
                  sizes.neighbors, of_floats);
  require(expected == Status::ok && fuzz::same_bits(of_halves, of_floats), "halves as floats");
}

template <class Rows>
void check_bytes(fuzz::Bytes& from, const Sizes& sizes, const std::vector<Status>& statuses, float ratio, Rows like) {
  std::vector<std::uint8_t> bytes((sizes.queries + sizes.database) * sizes.values);
  for (std::uint8_t& byte : bytes) byte = from.byte();
  Rows queries = like, database = like;
  queries.bytes = bytes.data();
  queries.count = sizes.queries;
  database.bytes = bytes.data() + sizes.queries * sizes.values;
  database.count = sizes.database;
  queries.size = database.size = sizes.values;
  queries.status = statuses.data();
  database.status = statuses.data() + sizes.queries;
  check(queries, database, sizes.neighbors, ratio);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes from(data, size);
  const std::size_t format = from.below(5);
  const Sizes sizes{from.below(12), from.below(24), 1 + from.below(36), 1 + from.below(5)};
  const float ratio = 0.01f * static_cast<float>(1 + from.below(100));
  const std::vector<Status> statuses = made_statuses(from, sizes.queries + sizes.database);
  switch (format) {
    case 0: check_floats(from, sizes, statuses, ratio); break;
    case 1: check_bytes(from, sizes, statuses, ratio, ss::ByteRows{nullptr, 0, 0, 1.0f / 256.0f, nullptr}); break;
    case 2: check_bytes(from, sizes, statuses, ratio, ss::NibbleRows{nullptr, 0, 0, 1.0f / 16.0f, nullptr}); break;
    case 3: check_halves(from, sizes, statuses); break;
    default: check_bytes(from, sizes, statuses, ratio, ss::BitRows{});
  }
  return 0;
}
