// Private to the readers: what a PCD and a PLY file have in common, a table of points with named channels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "byte_source.hpp"
#include "channel_roles.hpp"
#include "input_error.hpp"
#include "scalar_type.hpp"
#include "value_column.hpp"

namespace shortshot_bench {

struct Channel {
  std::string name;         // as the file spells it
  ScalarType type;          // as the header declares it; of text, too
  std::uint64_t count = 1;  // values per point; a list: 0
  bool is_text = false;     // read from text: the column holds doubles
  ValueColumn values;       // set for channels with a role alone
  NamedRole named;          // count 1: what the name means; of a triple: of the value
};

struct PointTable {
  std::vector<Channel> channels;
  std::array<const Channel*, role_count> of_role{};  // nullptr: the file has none
  std::size_t width = 0;
  std::size_t height = 1;
  std::array<double, 3> viewpoint{};
  std::vector<std::string> notes;
  std::vector<std::string> unused;  // what is ignored besides channels
  std::vector<char> own_bytes;      // what columns may refer to in place of the file
  std::vector<double> own_values;   // the same, of text

  std::size_t size() const { return width * height; }
  const Channel* channel(Role role) const { return of_role[static_cast<std::size_t>(role)]; }
  bool uses(const Channel& channel) const {
    return channel.named.role != Role::none && of_role[static_cast<std::size_t>(channel.named.role)] == &channel;
  }
};

/// The channel as a note names its type: "U1", "F8".
std::string type_name(const ScalarType& type);

/// Decides which channel has which role. Channels must not be added afterwards. Throws InputError, at that line, where
/// a coordinate is missing; `kind` and `where` are words of the message: "expected a KIND x WHERE, found none".
void assign_roles(PointTable& table, const std::string& path, std::uint64_t line, const std::string& kind,
                  const std::string& where);

/// table.own_values has those of these channels, point by point: sets the channels' columns to them.
void set_text_columns(PointTable& table, const std::vector<Channel*>& channels);

/// Bytes behind the last point that are more than white space go to what is said to be ignored.
void note_rest_of_file(const ByteSource& source, PointTable& table);

}  // namespace shortshot_bench
