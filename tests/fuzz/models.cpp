// Files of recognizers and of features, damaged: a status, or what is saved again with the same bytes. Models in flash,
// damaged: a status, or the same hypotheses by both recognizers. What was learned on the spot, damaged: passed over, or
// the same hypotheses, and more can be learned behind it.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <shortshot/descriptor/compact.hpp>
#include <shortshot/recognition/flash_model_file.hpp>
#include <shortshot/recognition/learned_objects.hpp>
#include <shortshot/recognition/micro_recognizer.hpp>
#include <shortshot/recognition/recognize_stored.hpp>
#include <shortshot/recognition/recognizer_model.hpp>
#include <shortshot/store/features_file.hpp>
#include <shortshot/store/stored_features.hpp>

#include "bytes.hpp"

namespace {

namespace ss = shortshot;
using fuzz::require;
using ss::Status;
using File = std::vector<std::uint8_t>;
using D = ss::ShapeColor32;
using Stored = ss::StoredFeatures<ss::ByteDescriptor<D>>;
using Halves = ss::StoredFeatures<ss::HalfDescriptor<D>>;

constexpr const char* plain_layout = "two values";

ss::Features<D> made_features() {
  ss::Features<D> features;
  ss::detail::clear_rows(features, 2, Status::ok);
  features.status[1] = Status::too_few_neighbors;
  features.keypoints[0] = ss::KeyPoint({1.0f, 2.0f, 3.0f}, {4, 5, 6});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    features.frames[0].x[0] = features.frames[0].y[1] = features.frames[0].z[2] = 1.0f;
  }
  for (std::size_t i = 0; i < std::size_t{D::size}; ++i) features.values[i] = 0.01f * static_cast<float>(i);
  return features;
}

template <class Storage>
File file_of_storage() {
  Storage stored;
  File file;
  require(ss::store(made_features(), stored) == Status::ok && ss::save(stored, file) == Status::ok, "saved");
  return file;
}

File file_of_recognizer() {
  const float values[4] = {0.5f, 0.25f, -1.0f, 2.0f};
  const ss::Features<D> places = made_features();
  const std::vector<ss::Frame> frames(2, places.frames[0]);
  const ss::FeatureRows rows{{values, 2, 2, nullptr}, places.keypoints.data(), frames.data()};
  ss::Recognizer recognizer;
  File file;
  require(ss::train(recognizer, rows, plain_layout, {}, "mug", "red") == Status::ok, "trained");
  require(ss::train(recognizer, rows, plain_layout, {}, "can", "blue") == Status::ok, "trained");
  require(ss::save(recognizer, file) == Status::ok, "saved");
  return file;
}

/// Of stored descriptors, which are compared as they are stored.
ss::Recognizer packed_recognizer() {
  Stored stored;
  ss::Recognizer recognizer;
  require(ss::store(made_features(), stored) == Status::ok, "stored");
  require(ss::train(recognizer, stored, {}, "mug", "red") == Status::ok, "trained");
  return recognizer;
}
File file_of_packed_recognizer() {
  File file;
  require(ss::save(packed_recognizer(), file) == Status::ok, "saved");
  return file;
}

File flash_model() {
  ss::Recognizer recognizer = packed_recognizer();
  Stored stored;
  File file;
  require(ss::store(made_features(), stored) == Status::ok, "stored");
  require(ss::train(recognizer, stored, {0.1f, 0.0f, 0.0f}, "can", "blue") == Status::ok, "trained");
  require(ss::save_for_flash<ss::ByteDescriptor<D>>(recognizer, file) == Status::ok, "saved");
  return file;
}

/// Memory in units of 4 bytes, which are programmed once.
struct Memory {
  static constexpr std::size_t unit_bytes = 4;
  File file;

  const std::uint8_t* bytes() const { return file.data(); }
  std::size_t size_bytes() const { return file.size(); }
  bool write(std::size_t place, const std::uint8_t* unit) {
    for (std::size_t k = place; k < place + 4; ++k) require(file.at(k) == 0xFF, "no unit is programmed twice");
    std::copy(unit, unit + 4, file.begin() + static_cast<std::ptrdiff_t>(place));
    return true;
  }
};
using Bytes = ss::ByteDescriptor<D>;
using Learned = ss::LearnedObjects<Bytes, Memory, 4>;
const ss::ModelView<Bytes> nothing({0.03f, 1, 8});

ss::StoredKeyPoint<Bytes> made_key() {
  Stored stored;
  require(ss::store(made_features(), stored) == Status::ok, "stored");
  return {stored.descriptors[0], stored.keypoints[0].position, stored.frames[0]};
}

/// One object, and nothing behind it: its checksum is where files have theirs.
File learned_object() {
  Memory memory{File(1024, 0xFF)};
  Learned learned;
  require(learned.open(nothing, memory) == Status::ok, "opened");
  require(learned.add(made_key(), {1.0f, 2.0f, 3.1f}) == Status::ok, "added");
  require(learned.commit("mug", "red") == Status::ok, "learned");
  memory.file.resize(memory.file.size() - learned.bytes_left());
  return memory.file;
}

File file_of_features() {
  File file;
  require(ss::save(made_features(), file) == Status::ok, "saved");
  return file;
}

/// One of ours with some changes, or the fuzzer's bytes as they are.
File made_file(fuzz::Bytes& from, std::size_t kind, bool is_raw) {
  static const File whole[] = {file_of_recognizer(),      file_of_features(),          file_of_storage<Stored>(),
                               file_of_storage<Halves>(), file_of_packed_recognizer(), flash_model(),
                               learned_object()};
  if (is_raw) return File(from.data(), from.data() + from.left());
  File file = whole[kind];
  while (from.left() > 0 && !file.empty()) {
    const std::uint8_t change = from.byte();
    const std::size_t at = from.number<std::uint16_t>() % file.size();
    const auto place = file.begin() + static_cast<std::ptrdiff_t>(at);
    switch (change % 4) {
      case 0: file.resize(at); break;
      case 1: file.insert(place, 1 + change / 4, from.byte()); break;
      case 2: file.erase(place, std::min(place + 1 + change / 4, file.end())); break;
      default: *place = from.byte();
    }
  }
  return file;
}

/// Checksums keep all damage out: most is done before they are written.
void seal(File& file) {
  constexpr std::size_t size = ss::detail::checksum_bytes;
  if (file.size() < size) return;
  std::uint64_t sum = ss::detail::checksum(file.data(), file.size() - size);
  for (std::size_t k = file.size() - size; k < file.size(); ++k, sum >>= 8) file[k] = static_cast<std::uint8_t>(sum);
}

void require_saved_again(Status status, const File& saved, const File& loaded) {
  require(status == Status::ok, "what was loaded can be saved");
  require(saved == loaded, "with the same bytes");
}

void check_hypotheses(const ss::Recognizer& recognizer, Status status, const std::vector<ss::Hypothesis>& objects) {
  require(status == Status::ok || objects.empty(), "no hypothesis without ok");
  for (const ss::Hypothesis& object : objects) {
    require(object.object_class < recognizer.class_count() && object.instance < recognizer.instance_count(), "a name");
    require(ss::is_finite(object.center) && object.score >= 0.0f, "hypotheses are finite");
  }
}

void load_recognizer(const File& file, const std::string& layout, bool is_packed) {
  ss::Recognizer recognizer;
  if (ss::load(file.data(), file.size(), layout, recognizer) != Status::ok) {
    require(recognizer.codeword_count() == 0 && recognizer.layout().empty(), "what is refused changes nothing");
    return;
  }
  File again;
  require_saved_again(ss::save(recognizer, again), again, file);
  require(recognizer.codeword_count() > 0, "it was trained");
  for (std::size_t i = 0; i < recognizer.instance_count(); ++i) {
    require(recognizer.class_of(i) < recognizer.class_count(), "each instance has a class");
  }
  if (recognizer.row_size() > 64 || recognizer.codeword_count() > 64) return;
  if (is_packed) {
    Stored stored;
    std::vector<ss::Hypothesis> objects;
    require(ss::store(made_features(), stored) == Status::ok, "stored");
    check_hypotheses(recognizer, ss::recognize(recognizer, stored, objects), objects);
    return;
  }
  const std::vector<float> values(recognizer.row_size(), 0.25f);
  const ss::Frame frame{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
  const ss::KeyPoint origin{ss::Point{}};
  std::vector<ss::Hypothesis> objects;
  const ss::FeatureRows row{{values.data(), 1, values.size(), nullptr}, &origin, &frame};
  check_hypotheses(recognizer, ss::recognize(recognizer, row, layout, objects), objects);
}

void require_same_hypotheses(const ss::ModelView<Bytes>& model, const ss::Recognizer* hosted) {
  Stored stored;
  std::vector<ss::Hypothesis> expected;
  require(ss::store(made_features(), stored) == Status::ok, "stored");
  ss::MicroRecognizer<Bytes, 2, 5, 4> recognizer;
  recognizer.start(model);
  const Status added = recognizer.add(stored.descriptors[0], stored.keypoints[0].position, stored.frames[0]);
  if (hosted == nullptr || added != Status::ok) return;  // more than four activated
  ss::Hypothesis found[4];
  const std::size_t count = recognizer.finish(found);
  require(ss::recognize(*hosted, stored, expected) == Status::ok, "what can be loaded recognizes");
  require(count == std::min<std::size_t>(4, expected.size()), "as many hypotheses");
  for (std::size_t i = 0; i < count; ++i) {
    require(std::memcmp(&found[i], &expected[i], sizeof found[i]) == 0, "the same ones, bit for bit");
  }
}

void open_flash_model(const File& file) {
  ss::ModelView<Bytes> model;
  ss::Recognizer loaded;
  const Status status = model.open(file.data(), file.size());
  const Status of_host = ss::load_from_flash<Bytes>(file.data(), file.size(), loaded);
  require((status == Status::ok) || model.codeword_count() == 0, "what is refused changes nothing");
  require(status == Status::ok || of_host == status, "both refuse it for the same reason");
  if (status != Status::ok || model.codeword_count() > 64) return;
  for (std::uint32_t i = 0; i < model.instance_count(); ++i) {
    require(model.class_of(i) < model.class_count() && std::strlen(model.instance_name(i)) < file.size(), "a name");
  }
  for (std::uint32_t i = 0; i < model.class_count(); ++i)
    require(std::strlen(model.class_name(i)) < file.size(), "a name");
  require_same_hypotheses(model, of_host == Status::ok ? &loaded : nullptr);  // null: another text of the layout
}

void open_learned(const File& file) {
  Memory memory{file};
  memory.file.resize((file.size() + 3) / 4 * 4 + 512, 0xFF);
  Learned learned;
  const Status status = learned.open(nothing, memory);
  if (status != Status::ok) return;
  const std::uint32_t before = learned.model().codeword_count();
  if (before > 64) return;
  Status added = learned.add(made_key(), {1.0f, 2.0f, 3.0f});
  if (added == Status::ok) added = learned.commit("can", "blue");
  require(added == Status::ok || added == Status::out_of_memory, "there is room behind it");
  ss::Recognizer loaded;
  if (learned.model().codeword_count() == 0) return;
  require(ss::load_from_flash(learned.model(), loaded) == Status::ok, "it can be loaded");
  require_same_hypotheses(learned.model(), &loaded);
  Learned again;
  require(again.open(nothing, memory) == Status::ok, "it is found again");
  require(again.model().codeword_count() == before + (added == Status::ok ? 1 : 0), "as it was");
}

template <class Some>
void load_features(const File& file) {
  Some features;
  if (ss::load(file.data(), file.size(), features) != Status::ok) {
    require(features.size() == 0 && features.keypoints.empty(), "what is refused changes nothing");
    return;
  }
  File again;
  require_saved_again(ss::save(features, again), again, file);
  require(features.frames.size() == features.size() && features.neighbors.size() == features.size(), "whole rows");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes from(data, size);
  const std::uint8_t how = from.byte();
  const std::size_t kind = how < 224 ? how % 5 : how < 240 ? 5 : 6;
  File file = made_file(from, kind, how % 25 / 5 == 0);
  if (how < 192 || (how >= 232 && how < 248)) seal(file);
  switch (kind) {
    case 0: load_recognizer(file, plain_layout, false); break;
    case 1: load_features<ss::Features<D>>(file); break;
    case 2: load_features<Stored>(file); break;
    case 3: load_features<Halves>(file); break;
    case 5: open_flash_model(file); break;
    case 6: open_learned(file); break;
    default: load_recognizer(file, ss::storage_layout<ss::ByteDescriptor<D>>(), true);
  }
  return 0;
}
