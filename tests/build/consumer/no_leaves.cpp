// A program on a machine without nanoflann and Eigen.
#include <shortshot/shortshot.hpp>

#if defined(HAS_EIGEN)
#error "this is to be compiled without the optional libraries"
#endif

int main() {
  const float xyz[3] = {1.0f, 2.0f, 3.0f};
  const shortshot::GridSearch search(shortshot::view_xyz(xyz, 1), 0.1f);
  return search.status() == shortshot::Status::ok ? 0 : 1;
}
