// What a route to the library must bring about: this compiles, and runs.
#include <shortshot/kernel.hpp>
#include <shortshot/version.hpp>

int main() {
  const float xyz[3] = {1.0f, 2.0f, 3.0f};
  static shortshot::Workspace<8> workspace;
  static float row[shortshot::Ssh32::size];
  const auto cloud = shortshot::view_xyz(xyz, 1);
  const shortshot::BruteSearch search{cloud};
  const auto status = shortshot::describe_at<shortshot::Ssh32>(cloud, search, 0, 0.1f, workspace, row);
  return status == shortshot::Status::too_few_neighbors ? 0 : 1;
}
