// shortshot/cloud/view_eigen_missing.hpp: what stands for view_eigen() until <Eigen/Core> is there.
#pragma once

#include "../config.hpp"
#include "cloud.hpp"

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The worst of all matches: where Eigen is there, view_eigen.hpp's is taken.
template <class... Arguments>
CloudView view_eigen(const Arguments&...) noexcept {
  static_assert(sizeof...(Arguments) > 999,
                "view_eigen() needs <Eigen/Core> included before shortshot.hpp (which may be included again)");
  return {};
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
