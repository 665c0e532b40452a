// A small model with each byte damaged in turn, and each end that is too early: refused, and where the checksum was
// made right again, refused or of no harm. Prints a hash of all that was said, which must be the same everywhere.
#include "board.hpp"
#include "recognition.hpp"

using shortshot::Status;

extern "C" {
extern const unsigned char model_begin[], model_end[];
}

namespace {

alignas(4) std::uint8_t bytes[4096];
shortshot::MicroRecognizer<recognition::Stored, 4, 8> recognizer;

class Damage {
 public:
  Hash said;
  std::uint32_t accepted = 0;  // with a checksum that was made right again

  /// Whatever the model says: all names, and a view of one key point.
  void use(const shortshot::ModelView<recognition::Stored>& model) {
    for (std::uint32_t i = 0; i < model.instance_count(); ++i) said.add(model.instance_name(i), 1);
    for (std::uint32_t i = 0; i < model.class_count(); ++i) said.add(model.class_name(i), 1);
    const shortshot::Frame frame{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
    recognizer.start(model);
    const Status status = recognizer.add(model.descriptor(0), {0.0f, 0.0f, 0.5f}, frame);
    shortshot::Hypothesis found[2];
    said.add(&status, sizeof status);
    said.add(found, recognizer.finish(found) * sizeof found[0]);
  }

  /// Is a model of so many bytes refused? If not, it is used.
  bool is_refused(std::size_t size) {
    shortshot::ModelView<recognition::Stored> model;
    const Status status = model.open(bytes, size);
    said.add(&status, sizeof status);
    if (status == Status::ok) use(model);
    return status != Status::ok;
  }

  void make_checksum_right(std::size_t size) {
    std::uint64_t sum = shortshot::detail::checksum(bytes, size - 8);
    for (std::size_t k = size - 8; k < size; ++k, sum >>= 8) bytes[k] = static_cast<std::uint8_t>(sum & 255u);
  }

  bool is_safe(std::size_t size) {
    bool safe = !is_refused(size);
    for (std::size_t cut = 0; cut < size; ++cut) safe = is_refused(cut) && safe;
    for (std::size_t i = 0; i < size; ++i) {
      const std::uint8_t before = bytes[i];
      for (const unsigned flipped : {1u, 128u, 255u}) {
        bytes[i] = static_cast<std::uint8_t>(before ^ flipped);
        safe = is_refused(size) && safe;
        if (i >= size - 8) continue;
        make_checksum_right(size);
        if (!is_refused(size)) ++accepted;
        bytes[i] = before;
        make_checksum_right(size);
      }
      bytes[i] = before;
    }
    return safe && !is_refused(size);
  }
};

}  // namespace

int main() {
  const auto size = static_cast<std::size_t>(model_end - model_begin);
  if (size > sizeof bytes) return 2;
  for (std::size_t i = 0; i < size; ++i) bytes[i] = model_begin[i];
  Damage damage;
  const bool safe = damage.is_safe(size);
  board::print_hash("DamagedModels", damage.said.value());
  board::print_fact("fact", "damaged_bytes", size);
  board::print_fact("fact", "accepted", damage.accepted);
  return safe ? 0 : 1;
}
