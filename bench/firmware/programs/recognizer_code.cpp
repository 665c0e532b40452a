// A program that recognizes; with KERNEL_ALONE, one that describes by the same search and does no more. What the first
// weighs more are the recognizer's code and constants.
#include "recognition.hpp"

namespace {

const shortshot::CloudView* volatile somewhere;
const std::uint8_t* volatile somewhere_else;
recognition::Memory memory;
shortshot::ModelView<recognition::Stored> model;

}  // namespace

int main() {
  const shortshot::CloudView& cloud = *somewhere;
  const shortshot::Support support = recognition::support(0.04f);
  int failures = memory.grid.build(cloud, 0.02f) != shortshot::Status::ok;
#if defined(KERNEL_ALONE)
  failures += shortshot::describe_at<recognition::Descriptor>(cloud, memory.grid, 1u, support, memory.workspace,
                                                              memory.values) != shortshot::Status::ok;
  return failures;
#else
  shortshot::Hypothesis found[8];
  failures += model.open(somewhere_else, cloud.size) != shortshot::Status::ok;
  memory.recognizer.start(model);
  failures += memory.recognizer.add(cloud, memory.grid, 1u, support) != shortshot::Status::ok;
  return failures + static_cast<int>(memory.recognizer.finish(found));
#endif
}
