#include "read_cloud.hpp"

#include <string_view>
#include <vector>

#include "byte_source.hpp"
#include "pcd_header.hpp"
#include "pcd_reader.hpp"
#include "ply_reader.hpp"
#include "text_rows.hpp"

namespace shortshot_bench {
namespace {

bool is_ply(std::string_view bytes) { return bytes.substr(0, 4) == "ply\n" || bytes.substr(0, 4) == "ply\r"; }

// PCD has no magic bytes: a comment usually says ".PCD", and the first entry is one of the header's.
bool is_pcd(ByteSource& source) {
  bool found = false;
  bool is_comment = true;
  std::vector<std::string_view> words;
  while (!found && is_comment && next_row(source, words)) {
    is_comment = words.front().front() == '#';
    found = is_comment ? words.size() > 1 && words[1] == ".PCD" : is_pcd_keyword(words.front());
  }
  source.rewind();
  return found;
}

}  // namespace

RgbdCloud read_cloud(const std::string& path) {
  ByteSource source(path);
  if (is_ply(source.rest())) return read_ply(source);
  if (is_pcd(source)) return read_pcd(source);
  const std::string expected = "expected a PLY file ('ply') or a PCD header ('VERSION', 'FIELDS'), found ";
  std::string_view line;
  if (!source.next_line(line)) throw source.line_error(expected + "an empty file");
  throw source.line_error(expected + quoted(line));
}

}  // namespace shortshot_bench
