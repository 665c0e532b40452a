// The header beside hostile macros: BEFORE it, AFTER it, or both and once more. Used by auto, as whoever has Xlib.h in
// the same file must: `shortshot::Status` is `shortshot::int` there.
#if defined(BEFORE)
#include "hostile_macros.hpp"
#endif
#include HEADER
#if defined(AFTER)
#include "hostile_macros.hpp"
#include HEADER
#endif

#if !defined(Status) || !defined(near) || !defined(check) || min(2, 1) != 1
#error "the header must leave other headers' macros as they were"
#endif

int main() {
  static shortshot::Workspace<64> workspace;
  float xyz[60];
  for (int i = 0; i < 60; ++i) xyz[i] = 0.01f * static_cast<float>((7 * i) % 13) + (i % 3 == 2 ? 1.0f : 0.0f);
  const auto cloud = shortshot::view_xyz(xyz, 20);
  float out[shortshot::Ssh32::size];
  const auto status =
      shortshot::describe_at<shortshot::Ssh32>(cloud, shortshot::BruteSearch(cloud), 0, 0.2f, workspace, out);
  return static_cast<int>(status);
}
