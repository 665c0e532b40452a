// How much work and stack a descriptor takes: calls subject.cpp's functions on the generated patch, each between two
// marks at which the emulator's plugin counts instructions. Prints a line "section NAME" for each counted call, in
// order, and lines "fact NAME NUMBER".
#include "board.hpp"
#include "marks.hpp"
#include "patch.hpp"
#include "subject.hpp"

using shortshot::Status;

namespace {

patch::Memory memory;
Workspace workspace;
shortshot::Workspace<most_neighbors> other_workspace;  // for what is not measured
Grid grid;
float descriptor[Configuration::size];
shortshot::Lab colors[patch::points];
int failures;

void expect_ok(const char* name, Status status) {
  if (status == Status::ok) return;
  board::print(name);
  board::print(": ");
  board::print(shortshot::message(status));
  board::print("\n");
  ++failures;
}

template <class Call>
void count(const char* name, const Call& call) {
  mark_begin();
  const Status status = call();
  mark_end();
  board::print("section ");
  board::print(name);
  board::print("\n");
  expect_ok(name, status);
}

/// A radius with `wanted` neighbors, to the point.
float radius_of(std::uint32_t wanted, const shortshot::CloudView& cloud, std::size_t index) {
  const shortshot::Point center = shortshot::point(cloud, index);
  float low = 0.0f;
  float high = 1.0f;
  for (int i = 0; i < 24; ++i) {
    const float middle = (low + high) * 0.5f;
    auto n = shortshot::neighborhood_in(other_workspace);
    static_cast<void>(shortshot::BruteSearch{cloud}.gather(center, middle, n));
    if (n.found == wanted) return middle;
    (n.found > wanted ? high : low) = middle;
  }
  board::print("no radius has the wanted number of neighbors\n");
  ++failures;
  return low;
}

}  // namespace

int main() {
  constexpr int step = 877;  // so that any 250 of the gathered neighbors lie all around
  shortshot::CloudView cloud = patch::make(memory, step);
  if constexpr (Configuration::needs_normals) cloud = patch::with_normals(cloud, 0.0625f, memory, other_workspace);
  Job job{};
  job.cloud = cloud;
  job.index = (patch::points / 2 + patch::width / 2) * step % patch::points;
  job.radius = radius_of(500, cloud, job.index);
  job.workspace = &workspace;
  job.grid = &grid;
  job.colors = colors;
  job.out = descriptor;

  count("build_grid", [&] { return build_grid(&job); });
  count("gather_grid", [&] { return gather_grid(&job); });
  count("describe_grid", [&] { return describe_grid(&job); });
  count("gather_brute", [&] { return gather_brute(&job); });  // what describe_given() finds in the workspace
  for (const std::uint32_t neighbors : {250u, 500u}) {
    job.gathered = neighbors;
    count(neighbors == 250 ? "given_250" : "given_500", [&] { return describe_given(&job); });
  }
  if constexpr (Configuration::needs_colors) {
    expect_ok("colors", shortshot::convert_colors<typename Configuration::LabRule>(cloud, colors));
    for (const std::uint32_t neighbors : {250u, 500u}) {
      job.gathered = neighbors;
      count(neighbors == 250 ? "given_lab_250" : "given_lab_500", [&] { return describe_given_lab(&job); });
    }
  }
  board::print_fact("fact", "chunk_bytes", shortshot::chunk_bytes<Configuration, chunk_size>);
  board::print_fact("fact", "workspace_bytes", sizeof(Workspace));
  board::print_fact("fact", "workspace_bytes_per_100_neighbors", 100 * sizeof(Workspace) / most_neighbors);
  using shortshot::StaticGrid;
  constexpr std::size_t fixed = sizeof(StaticGrid<2, 2>) - 4 * sizeof(StaticGrid<2, 2>::Index);
  board::print_fact("fact", "index_bytes_fixed", fixed);
  board::print_fact("fact", "index_bytes_per_100_points",
                    (sizeof(StaticGrid<1002, 2>) - sizeof(StaticGrid<2, 2>)) / 10);
  board::print_fact("fact", "index_bytes_per_100_cells", (sizeof(StaticGrid<2, 1002>) - sizeof(StaticGrid<2, 2>)) / 10);
#if !defined(__unix__)
  const auto in_grid = board::stack_of([&] { expect_ok("describe_grid", describe_grid(&job)); });
  board::print_fact("fact", "stack_painted", in_grid);
#endif
  return failures;
}
