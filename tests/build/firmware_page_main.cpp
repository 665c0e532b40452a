// Calls what the firmware page's example exports, with a colored patch of a paraboloid: bytes of a descriptor of
// length 1, or zeros and a sentence where there is nothing to describe.
#include <cstdint>
#include <cstdio>

extern "C" const char* describe_patch(const float* xyz, const std::uint8_t* rgb, unsigned count, unsigned index,
                                      const std::uint8_t** out);

int main() {
  constexpr unsigned side = 40;
  static float xyz[side * side][3];
  static std::uint8_t rgb[side * side][3];
  for (unsigned i = 0; i < side * side; ++i) {
    const float x = 0.004f * static_cast<float>(i % side) - 0.08f;
    const float y = 0.004f * static_cast<float>(i / side) - 0.08f;
    xyz[i][0] = x;
    xyz[i][1] = y;
    xyz[i][2] = 1.0f + 2.0f * x * x + 0.7f * y * y + 0.3f * x;
    for (unsigned k = 0; k < 3; ++k) rgb[i][k] = static_cast<std::uint8_t>(i * (k + 3) % 251);
  }
  const auto length = [](const std::uint8_t* bytes) {  // squared
    float sum = 0.0f;
    for (unsigned i = 0; i < 336; ++i) sum += static_cast<float>(bytes[i]) * static_cast<float>(bytes[i]);
    return sum / (512.0f * 512.0f);
  };
  const std::uint8_t* bytes = nullptr;
  const char* described = describe_patch(xyz[0], rgb[0], side * side, side * side / 2 + 17, &bytes);
  const float one = length(bytes);
  const char* outside = describe_patch(xyz[0], rgb[0], side * side, side * side, &bytes);
  const float nothing = length(bytes);
  std::printf("%s: squared length %f; %s: %f\n", described, static_cast<double>(one), outside,
              static_cast<double>(nothing));
  return one > 0.98f && one < 1.02f && described[0] == 'o' && nothing == 0.0f && outside[0] != 'o' ? 0 : 1;
}
