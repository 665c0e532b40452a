#include "tools/demo/hints.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "shortshot/status.hpp"
#include "tools/demo/advice.hpp"
#include "tools/demo/diagnose.hpp"
#include "tools/io/view_of_cloud.hpp"

namespace shortshot_bench {

std::vector<std::string> hints(const RgbdCloud& cloud, const DemoOptions& options, const DemoResult& result) {
  const auto described = std::count(result.status.begin(), result.status.end(), shortshot::Status::ok);
  const std::uint32_t most = *std::max_element(result.neighbors.begin(), result.neighbors.end());
  const bool is_odd = 2 * static_cast<std::size_t>(described) < result.status.size() || most >= valid_points_of(cloud);
  if (!is_odd) return {};
  return advice_on(diagnosis_of(cloud, options), view_of_cloud(cloud), options);
}

}  // namespace shortshot_bench
