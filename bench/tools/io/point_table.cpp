#include "point_table.hpp"

namespace shortshot_bench {

std::string type_name(const ScalarType& type) {
  const char letter = "IUF"[static_cast<std::size_t>(type.kind)];
  return letter + std::to_string(int{type.size_bytes});
}

void assign_roles(PointTable& table, const std::string& path, std::uint64_t line, const std::string& kind,
                  const std::string& where) {
  for (Channel& channel : table.channels) {
    if (channel.named.role == Role::none && channel.count == 1) channel.named = role_of_name(channel.name);
    if (channel.named.role == Role::none) continue;
    const Channel*& chosen = table.of_role[static_cast<std::size_t>(channel.named.role)];
    if (chosen == nullptr || channel.named.rank < chosen->named.rank) chosen = &channel;
  }
  for (const Role axis : {Role::x, Role::y, Role::z}) {
    if (table.channel(axis) != nullptr) continue;
    throw InputError::at_line(
        path, line, "expected a " + kind + " " + "xyz"[static_cast<std::size_t>(axis)] + where + ", found none");
  }
}

void set_text_columns(PointTable& table, const std::vector<Channel*>& channels) {
  const double* next = table.own_values.data();  // null without points
  for (Channel* const channel : channels) {
    channel->values.first = reinterpret_cast<const char*>(next);
    if (next != nullptr) ++next;
    channel->values.stride_bytes = channels.size() * sizeof(double);
    channel->values.type = {ScalarKind::floating, sizeof(double)};
    channel->values.order = host_order();
  }
}

void note_rest_of_file(const ByteSource& source, PointTable& table) {
  const std::string_view rest = source.rest();
  if (rest.find_first_not_of(std::string_view(" \t\r\n\0\x1a", 6)) == std::string_view::npos) return;
  table.unused.push_back(std::to_string(rest.size()) + " bytes behind the last point");
}

}  // namespace shortshot_bench
