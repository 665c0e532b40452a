// shortshot/color/lab_table.hpp: sRGB bytes -> CIELAB by tables, for whole clouds. Hosted only: allocates.
#pragma once

#include <cstddef>
#include <vector>

#include "../base/quad.hpp"
#include "../base/unfused.hpp"
#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "lab.hpp"
#include "srgb.hpp"

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// to_lab<Rule>() with the same bits and without its powers: what each byte adds to the three CIE ratios of a color is
/// in a table, and so is the root of each step that a ratio can have. 28 KB. Reentrant once it is filled.
template <class Rule>
class LabTable {
 public:
  /// To be called before the first color; does nothing where it was called before. May throw std::bad_alloc.
  void fill() {
    if (!roots_.empty()) return;
    std::vector<Ratios> shares(3 * std::size_t{bytes});
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t byte = 0; byte < bytes; ++byte) {
        const float linear = detail::srgb_to_linear[byte];
        for (int ratio = 0; ratio < 3; ++ratio) {
          shares[c * bytes + byte][ratio] = extend::unfused(linear * detail::xyz_of_rgb[ratio][c]);
        }
      }
    }
    std::vector<float> roots;
    roots.reserve(detail::last_ratio_step + 1);
    for (int step = 0; step <= detail::last_ratio_step; ++step) roots.push_back(detail::root_of_step<Rule>(step));
    shares_.swap(shares);
    roots_.swap(roots);
  }

  /// What to_lab<Rule>() gives, bit for bit; after fill().
  [[nodiscard]] Lab operator()(Rgb color) const noexcept {
    constexpr Ratios white{detail::white_xyz[0], detail::white_xyz[1], detail::white_xyz[2], 1.0f};
    const Ratios* const shares = shares_.data();
    const Ratios sum = (shares[color.r] + shares[bytes + color.g]) + shares[2 * bytes + color.b];
    const auto steps = __builtin_convertvector(sum / white * 4000.0f, extend::simd::Quad);  // as ratio_step() has them
    const float* const roots = roots_.data();
    const float f[3] = {roots[steps[0]], roots[steps[1]], roots[steps[2]]};
    Lab lab;
    detail::lab_of_roots<Rule>(f, lab);
    return lab;
  }

 private:
  using Ratios = extend::simd::FloatQuad;
  static constexpr std::size_t bytes = 256;

  std::vector<Ratios> shares_;  // of red, of green, of blue
  std::vector<float> roots_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
