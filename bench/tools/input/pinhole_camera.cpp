#include "tools/input/pinhole_camera.hpp"

#include <cmath>
#include <cstdio>
#include <vector>

#include "tools/io/input_error.hpp"
#include "tools/io/matrix_file.hpp"
#include "tools/io/require_file.hpp"

namespace shortshot_bench {

PinholeCamera read_pinhole_camera(const std::string& path) {
  const std::vector<double> m = read_matrix(path, 3, 3, "a camera matrix");
  if (!(m[0] > 0.0 && m[4] > 0.0)) throw InputError::about(path, "expected focal lengths above 0");
  const std::vector<double> expected{m[0], 0.0, m[2], 0.0, m[4], m[5], 0.0, 0.0, 1.0};
  if (m != expected) throw InputError::about(path, "expected the rows fx 0 cx, 0 fy cy, 0 0 1");
  return {m[0], m[4], m[2], m[5]};
}

PinholeCamera parse_pinhole_camera(const std::string& text) {
  if (is_file(text)) return read_pinhole_camera(text);
  PinholeCamera c;
  int read = -1;
  const int numbers =
      std::sscanf(text.c_str(), "%lf,%lf,%lf,%lf%n", &c.focal_x, &c.focal_y, &c.center_x, &c.center_y, &read);
  const bool is_whole = numbers == 4 && static_cast<std::size_t>(read) == text.size();
  if (!is_whole || !std::isfinite(c.focal_x + c.focal_y + c.center_x + c.center_y) || c.focal_x <= 0.0 ||
      c.focal_y <= 0.0) {
    throw InputError::about("--camera " + text,
                            "expected FX,FY,CX,CY in pixels, with focal lengths above 0, or a file with the "
                            "rows fx 0 cx, 0 fy cy, 0 0 1");
  }
  return c;
}

}  // namespace shortshot_bench
