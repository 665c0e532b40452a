// shortshot/color/lab_table.hpp: sRGB bytes -> CIELAB by a table of roots, for whole clouds. Hosted only: allocates.
#pragma once

#include <cstddef>
#include <vector>

#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "lab.hpp"

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// What to_lab<Rule>() gives, bit for bit: the roots are the same ones, taken once for each of the 4001 steps that a
/// ratio can have. 16 KB; filling it costs as much as to_lab() of 1300 colors.
template <class Rule>
class LabTable {
 public:
  /// To be called before the first color; does nothing where it was called before. May throw std::bad_alloc.
  void fill() {
    if (!roots_.empty()) return;
    roots_.reserve(detail::last_ratio_step + 1);
    for (int step = 0; step <= detail::last_ratio_step; ++step) roots_.push_back(detail::root_of_step<Rule>(step));
  }

  [[nodiscard]] const float* roots() const noexcept { return roots_.data(); }

  [[nodiscard]] Lab operator()(Rgb color) const noexcept {
    Lab lab;
    detail::lab_by<Rule>([roots = roots_.data()](int step) { return roots[step]; }, color, lab);
    return lab;
  }

 private:
  std::vector<float> roots_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
