// Calls what the firmware page's examples of recognition export: two objects are learned, and told from each other in
// other views; a damaged model and a view of nothing are named. A third one is learned on the spot, in flash that is
// read again after a restart.
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "shortshot.hpp"

extern "C" const char* what_is_it(const std::uint8_t* in_flash, unsigned size_bytes, const float* xyz,
                                  const std::uint8_t* rgb, unsigned count);
shortshot::Status learn(shortshot::Recognizer& recognizer, const shortshot::CloudView& view,
                        const shortshot::Point& center, const char* name);
std::string header_of(const shortshot::Recognizer& recognizer);
using Program = bool (*)(const std::uint8_t* place, const std::uint8_t* double_word);
extern "C" const char* begin(const std::uint8_t* in_flash, unsigned size_bytes, const std::uint8_t* pages,
                             Program program);
extern "C" const char* learn_it(const float* xyz, const std::uint8_t* rgb, unsigned count, const float* center,
                                const char* name);
extern "C" const char* which_is_it(const float* xyz, const std::uint8_t* rgb, unsigned count);

namespace {

constexpr unsigned side = 40;
struct View {
  std::vector<float> xyz;
  std::vector<std::uint8_t> rgb;
  shortshot::CloudView cloud() const { return shortshot::view_xyz_rgb(xyz.data(), rgb.data(), side * side); }
};

/// A patch of 16 cm, curved and colored by what object it is, `shift` meters to the right.
View view_of(unsigned object, float shift) {
  View view;
  for (unsigned i = 0; i < side * side; ++i) {
    const float u = 0.004f * static_cast<float>(i % side) - 0.08f;
    const float v = 0.004f * static_cast<float>(i / side) - 0.08f;
    const float bends[] = {2.0f * u * u + 0.7f * v * v + 9.0f * u * u * u, 5.0f * u * v - 1.5f * v * v,
                           7.0f * u * u - 20.0f * v * v * v};
    view.xyz.insert(view.xyz.end(), {u + shift, v, 1.0f + bends[object]});
    const unsigned square = (i % side / 5 * (object + 2) + i / side / 7) % 3;
    for (unsigned k = 0; k < 3; ++k)
      view.rgb.push_back(static_cast<std::uint8_t>(k == square ? 200 : 30 * (object + 1)));
  }
  return view;
}

std::vector<std::uint8_t> flash_memory(32 * 1024, 0xFF);
bool program_flash(const std::uint8_t* place, const std::uint8_t* double_word) {
  for (std::size_t k = 0; k < 8; ++k) {
    std::uint8_t& byte = flash_memory[static_cast<std::size_t>(place - flash_memory.data()) + k];
    if (byte != 0xFF) return false;
    byte = double_word[k];
  }
  return true;
}

/// The third object is learned; it is known, also after a restart, and the others still are.
bool learns(const std::vector<std::uint8_t>& model) {
  const auto answer = [](unsigned object, float shift) {
    const View view = view_of(object, shift);
    return std::string(which_is_it(view.xyz.data(), view.rgb.data(), side * side));
  };
  const auto open = [&] {
    return std::string(begin(model.data(), static_cast<unsigned>(model.size()), flash_memory.data(), program_flash));
  };
  const float center[3] = {0.0f, 0.0f, 1.0f};
  const View wave = view_of(2, 0.0f);
  const std::string opened = open();
  const std::string learned = learn_it(wave.xyz.data(), wave.rgb.data(), side * side, center, "wave");
  const std::string after = answer(2, 0.1f);
  const std::string opened_again = open();
  const std::string again = answer(2, -0.1f);
  const std::string others = answer(0, -0.1f) + " " + answer(1, 0.1f);
  std::printf("%s; %s: %s; %s: %s %s\n", opened.c_str(), learned.c_str(), after.c_str(), opened_again.c_str(),
              again.c_str(), others.c_str());
  return opened == "ok" && learned == "ok" && after == "wave" && opened_again == "ok" && again == "wave" &&
         others == "bowl saddle";
}

}  // namespace

int main() {
  shortshot::Recognizer recognizer;
  for (unsigned object = 0; object < 2; ++object) {
    const auto status =
        learn(recognizer, view_of(object, 0.0f).cloud(), {0.0f, 0.0f, 1.0f}, object == 0 ? "bowl" : "saddle");
    if (status != shortshot::Status::ok) return 1;
  }
  std::vector<std::uint8_t> model;
  if (shortshot::save_for_flash<shortshot::NibbleDescriptor<shortshot::ShapeColor95>>(recognizer, model) !=
      shortshot::Status::ok)
    return 2;
  const auto answer = [&](const View& view) {
    return std::string(
        what_is_it(model.data(), static_cast<unsigned>(model.size()), view.xyz.data(), view.rgb.data(), side * side));
  };
  const std::string bowl = answer(view_of(0, 0.1f));
  const std::string saddle = answer(view_of(1, -0.2f));
  View empty = view_of(0, 0.0f);
  for (float& coordinate : empty.xyz) coordinate = std::numeric_limits<float>::quiet_NaN();
  const std::string nothing = answer(empty);
  if (!learns(model)) return 4;
  model[model.size() / 2] ^= 1u;
  const std::string damaged = answer(empty);
  const std::string header = header_of(recognizer);
  std::printf("%s, %s, %s, %s, a header of %zu characters\n", bowl.c_str(), saddle.c_str(), nothing.c_str(),
              damaged.c_str(), header.size());
  const bool told =
      bowl == "bowl" && saddle == "saddle" && nothing == "none of these" && damaged == "the file is damaged";
  return told && header.find(" cups[] = {") != std::string::npos ? 0 : 3;
}
