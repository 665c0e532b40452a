// Calls what the README's firmware example exports, with a patch of a paraboloid: a descriptor of length 1, and a
// status and zeros where there is nothing to describe.
#include <cstdio>

extern "C" int describe_patch(const float* xyz, unsigned count, unsigned index, float radius, float* out);

int main() {
  constexpr unsigned side = 40;
  static float cloud[side * side][3];
  for (unsigned i = 0; i < side * side; ++i) {
    const float x = 0.005f * static_cast<float>(i % side) - 0.1f;
    const float y = 0.005f * static_cast<float>(i / side) - 0.1f;
    cloud[i][0] = x;
    cloud[i][1] = y;
    cloud[i][2] = 1.0f + 2.0f * x * x + 0.7f * y * y + 0.3f * x;
  }
  const auto squared_length = [](const float(&values)[32]) {
    float sum = 0.0f;
    for (const float value : values) sum += value * value;
    return sum;
  };

  float descriptor[32];
  const int described = describe_patch(cloud[0], side * side, side * side / 2 + 17, 0.04f, descriptor);
  const float length = squared_length(descriptor);
  const int outside = describe_patch(cloud[0], side * side, side * side, 0.04f, descriptor);
  const float nothing = squared_length(descriptor);
  for (float& value : descriptor) value = 7.0f;
  const int no_radius = describe_patch(cloud[0], side * side, 0, -1.0f, descriptor);
  const float still_nothing = squared_length(descriptor);
  std::printf("status %d, squared length %f; index outside: status %d, squared length %f; no radius: %d, %f\n",
              described, static_cast<double>(length), outside, static_cast<double>(nothing), no_radius,
              static_cast<double>(still_nothing));
  const bool good = described == 0 && length > 0.999f && length < 1.001f;
  const bool refused = outside != 0 && nothing == 0.0f && no_radius != 0 && still_nothing == 0.0f;
  return good && refused ? 0 : 1;
}
