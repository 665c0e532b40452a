// The smallest program that keeps the functions named by the macro CALLS: what the linker leaves of them is what they
// cost an image. Without CALLS it is the price of start-up alone.
#define CALL(name) extern "C" unsigned char name(const void* job);
CALLS
#undef CALL
#define CALL(name) +name(job)

const void* volatile somewhere;

int main() {
  [[maybe_unused]] const void* const job = somewhere;
  return 0 CALLS;
}
