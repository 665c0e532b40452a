#include "paper/contenders.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "paper/peer_program.hpp"
#include "paper/storage.hpp"
#include "speed/timing/clock.hpp"

namespace shortshot_bench::paper {
namespace {

using Storages = std::vector<Storage>;

/// Whole numbers of steps, coarser and coarser, and halves.
template <class D>
Storages codes_of() {
  return {packed_storage<shortshot::HalfDescriptor<D>>("half", D::size),
          packed_storage<shortshot::ByteDescriptor<D>>("8bit", D::size),
          packed_storage<shortshot::NibbleDescriptor<D>>("4bit", D::size),
          packed_storage<shortshot::CodedDescriptor<D, 3>>("3bit", D::size)};
}

template <class D>
Storages with_bits(Storages storages) {
  storages.push_back(packed_storage<shortshot::BinaryDescriptor<D>>("bshot", D::size));
  return storages;
}

template <class D>
Storages with_sum_bits(Storages storages) {
  storages.push_back(packed_storage<shortshot::SumBits<D>>("sums44", 352));
  storages.push_back(packed_storage<shortshot::SumBits<D, 256, 6>>("sums32", 256));
  return storages;
}

/// Of the descriptors in known_configurations().
const std::map<std::string, Storages>& known_storages() {
  using namespace shortshot;
  static const std::map<std::string, Storages> storages = {
      {"cshot1344", with_bits<PclCshot1344>(codes_of<PclCshot1344>())},
      {"shot352", with_bits<PclShot352>(codes_of<PclShot352>())},
      {"scsh336", with_bits<Scsh336>(codes_of<Scsh336>())},
      {"scsh696", with_bits<Scsh696>(codes_of<Scsh696>())},
      {"ssh96", with_bits<Ssh96>(codes_of<Ssh96>())},
      {"ssh32", with_bits<Ssh32>(codes_of<Ssh32>())},
      {"shapecolor95", with_sum_bits<ShapeColor95>(codes_of<ShapeColor95>())},
      {"shapecolor32", codes_of<ShapeColor32>()},
      {"roomcolor95", codes_of<RoomColor95>()},
      {"heightshape96", codes_of<HeightShape96>()},
      {"colorrings27", codes_of<ColorRings27>()},
  };
  return storages;
}

constexpr const char* root_suffix = "-root";

std::size_t bytes_of_floats(const Described& rows) { return rows.size * sizeof(float); }

Form floats_named(const std::string& name) {
  return {name, bytes_of_floats, [](const Described& rows) { return rows; }};
}
Form roots_of(const std::string& method) { return {method + root_suffix, bytes_of_floats, rooted}; }

/// All forms of a method of ours.
std::vector<Form> forms_of(const std::string& method) {
  std::vector<Form> forms = {floats_named(method), roots_of(method)};
  for (const Storage& storage : known_storages().at(method)) {
    forms.push_back({method + "-" + storage.name, [size = storage.size_bytes](const Described&) { return size; },
                     [storage](const Described& rows) { return coded(rows, storage); }});
  }
  return forms;
}

Contender contender_of(const Configuration& configuration) {
  const auto describe = [configuration](const View& view) {
    const double start = now_seconds(Clock::thread_cpu);
    Described rows = view.describe(configuration);
    return TimedRows{std::move(rows), 1e6 * (now_seconds(Clock::thread_cpu) - start)};
  };
  return {configuration.name, configuration.needs_colors, describe, {}};
}

std::runtime_error no_form(const std::string& name) {
  std::string list;
  for (const Configuration& c : known_configurations()) {
    for (const Form& form : forms_of(c.name)) list += (list.empty() ? "" : ", ") + form.name;
  }
  return std::runtime_error("no descriptor \"" + name + "\"; there are " + list);
}

}  // namespace

std::vector<Contender> contenders_named(const std::vector<std::string>& names) {
  std::vector<Contender> contenders;
  std::map<std::string, std::size_t> places;  // of methods among the contenders
  for (const std::string& name : names) {
    const std::string method = name.substr(0, name.find('-'));
    if (known_storages().count(method) == 0) throw no_form(name);
    const std::vector<Form> forms = forms_of(method);
    const auto form = std::find_if(forms.begin(), forms.end(), [&](const Form& f) { return f.name == name; });
    if (form == forms.end()) throw no_form(name);
    const auto [place, is_new] = places.try_emplace(method, contenders.size());
    if (is_new) contenders.push_back(contender_of(configurations_named({method}).front()));
    contenders[place->second].forms.push_back(*form);
  }
  return contenders;
}

std::vector<std::string> registration_names(bool quick) {
  if (quick) return {"cshot1344", "shot352", "shot352-bshot", "scsh336", "ssh96", "shapecolor95-4bit"};
  return {"cshot1344",
          "cshot1344-root",
          "cshot1344-bshot",
          "shot352",
          "shot352-root",
          "shot352-bshot",
          "scsh336",
          "scsh336-root",
          "scsh696",
          "scsh696-root",
          "ssh96",
          "ssh96-root",
          "ssh32",
          "ssh32-root",
          "shapecolor95",
          "shapecolor95-root",
          "shapecolor95-4bit",
          "shapecolor95-sums32",
          "shapecolor32",
          "shapecolor32-root",
          "shapecolor32-4bit",
          "roomcolor95",
          "roomcolor95-root",
          "roomcolor95-4bit",
          "heightshape96",
          "heightshape96-root",
          "heightshape96-4bit"};
}

Contender peer_contender(const std::string& peer) {
  const std::size_t equals = peer.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == peer.size()) {
    throw std::runtime_error("\"" + peer + "\" is not NAME=PROGRAM");
  }
  const std::string name = peer.substr(0, equals);
  const std::string program = peer.substr(equals + 1);
  return {name,
          false,
          [program](const View& view) { return describe_by(program, view); },
          {floats_named(name), roots_of(name)}};
}

}  // namespace shortshot_bench::paper
