// Files of recognizers and of features, damaged: a status, or what is saved again with the same bytes. Models in flash,
// damaged: a status, or the same hypotheses by both recognizers.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <shortshot/descriptor/compact.hpp>
#include <shortshot/recognition/flash_model_file.hpp>
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

File file_of_features() {
  File file;
  require(ss::save(made_features(), file) == Status::ok, "saved");
  return file;
}

/// One of ours with some changes, or the fuzzer's bytes as they are.
File made_file(fuzz::Bytes& from, std::size_t kind, bool is_raw) {
  static const File whole[] = {file_of_recognizer(),      file_of_features(),          file_of_storage<Stored>(),
                               file_of_storage<Halves>(), file_of_packed_recognizer(), flash_model()};
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

void open_flash_model(const File& file) {
  using Bytes = ss::ByteDescriptor<D>;
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
  Stored stored;
  std::vector<ss::Hypothesis> expected;
  require(ss::store(made_features(), stored) == Status::ok, "stored");
  ss::MicroRecognizer<Bytes, 2, 5, 4> recognizer;
  recognizer.start(model);
  const Status added = recognizer.add(stored.descriptors[0], stored.keypoints[0].position, stored.frames[0]);
  if (of_host != Status::ok || added != Status::ok) return;  // an order that is none; more than four activated
  ss::Hypothesis found[4];
  const std::size_t count = recognizer.finish(found);
  require(ss::recognize(loaded, stored, expected) == Status::ok, "what can be loaded recognizes");
  require(count == std::min<std::size_t>(4, expected.size()), "as many hypotheses");
  for (std::size_t i = 0; i < count; ++i) {
    require(std::memcmp(&found[i], &expected[i], sizeof found[i]) == 0, "the same ones, bit for bit");
  }
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
  const std::size_t kind = how < 224 ? how % 5 : 5;
  File file = made_file(from, kind, how % 25 / 5 == 0);
  if (how < 192 || how >= 232) seal(file);
  switch (kind) {
    case 0: load_recognizer(file, plain_layout, false); break;
    case 1: load_features<ss::Features<D>>(file); break;
    case 2: load_features<Stored>(file); break;
    case 3: load_features<Halves>(file); break;
    case 5: open_flash_model(file); break;
    default: load_recognizer(file, ss::storage_layout<ss::ByteDescriptor<D>>(), true);
  }
  return 0;
}
