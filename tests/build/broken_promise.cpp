// Negative controls for check_symbols.sh: one broken promise for each value of CASE. A check that cannot fail is none.
#include <cmath>
#include <cstdio>
#include <shortshot/kernel.hpp>
#include <vector>

#if CASE == 1  // no heap
float* broken() { return new float[shortshot::Ssh32::size]; }
#elif CASE == 2   // no heap, by a container
std::size_t broken(std::size_t count) { return std::vector<float>(count).capacity(); }
#elif CASE == 3   // no exceptions
void broken(shortshot::Status status) {
  if (status != shortshot::Status::ok) throw status;
}
#elif CASE == 4   // no double
float broken(float radius) { return static_cast<float>(static_cast<double>(radius) * 1.1); }
#elif CASE == 5   // no function-local statics
float make();
float broken() {
  static const float made = make();
  return made;
}
#elif CASE == 6   // no printing
void broken(shortshot::Status status) { std::printf("%s %d\n", shortshot::message(status), static_cast<int>(status)); }
#elif CASE == 7   // no static initializers
volatile int source = 1;
int broken = source;
#elif CASE == 8   // no writable constants
float broken[] = {0.1f, 0.2f};
#elif CASE == 9   // no RTTI
struct Base {
  virtual int size() const { return 1; }
};
struct Derived : Base {};
bool broken(const Base* base) { return dynamic_cast<const Derived*>(base) != nullptr; }
#elif CASE == 10  // no calls to other code
float broken(float angle) { return std::sin(angle); }
#elif CASE == 11  // no fused multiply-add
float broken(float a, float b, float c) { return a * b + c; }
#endif
