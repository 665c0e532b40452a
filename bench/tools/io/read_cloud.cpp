#include "read_cloud.hpp"

#include <string_view>
#include <utility>
#include <vector>

#include "byte_source.hpp"
#include "lower_case.hpp"
#include "pcd_header.hpp"
#include "pcd_reader.hpp"
#include "ply_reader.hpp"
#include "text_rows.hpp"

namespace shortshot_bench {
namespace {

bool is_ply(ByteSource& source) {
  std::vector<std::string_view> words;
  const bool found = next_row(source, words) && words.size() == 1 && lower_case(words.front()) == "ply";
  source.rewind();
  return found;
}

bool is_utf16(std::string_view bytes) { return bytes.substr(0, 2) == "\xff\xfe" || bytes.substr(0, 2) == "\xfe\xff"; }

// PCD has no magic bytes: a comment usually says ".PCD", and the first entry is one of the header's.
bool is_pcd(ByteSource& source) {
  bool found = false;
  bool is_comment = true;
  std::vector<std::string_view> words;
  while (!found && is_comment && next_row(source, words)) {
    is_comment = words.front().front() == '#';
    found = is_comment ? words.size() > 1 && lower_case(words[1]) == ".pcd" : is_pcd_keyword(words.front());
  }
  source.rewind();
  return found;
}

RgbdCloud read_source(ByteSource& source) {
  if (is_utf16(source.rest())) {
    throw source.byte_error("expected ASCII or UTF-8, found the byte order mark of UTF-16: save the text anew");
  }
  if (is_ply(source)) return read_ply(source);
  if (is_pcd(source)) return read_pcd(source);
  const std::string expected = "expected a PLY file ('ply') or a PCD header ('VERSION', 'FIELDS'), found ";
  std::string_view line;
  if (!source.next_line(line)) throw source.line_error(expected + "an empty file");
  throw source.line_error(expected + quoted(line));
}

}  // namespace

RgbdCloud read_cloud(const std::string& path) {
  ByteSource source(path);
  return read_source(source);
}

RgbdCloud read_cloud(const std::string& name, std::string bytes) {
  ByteSource source(name, std::move(bytes));
  return read_source(source);
}

}  // namespace shortshot_bench
