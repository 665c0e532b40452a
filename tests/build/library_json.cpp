// PlatformIO's manifest: does it say what is so, and by the rules that PlatformIO's documentation gives for
// library.json? Each rule has a copy of the manifest that breaks it.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <shortshot/version.hpp>
#include <string>
#include <vector>

namespace {

using Json = nlohmann::json;
using Faults = std::vector<std::string>;

const std::filesystem::path root = SHORTSHOT_SOURCE_DIR;

const std::string version = std::to_string(shortshot::version_major) + "." + std::to_string(shortshot::version_minor) +
                            "." + std::to_string(shortshot::version_patch);

std::string text_of(const char* file) {
  std::ifstream in(root / file);
  REQUIRE_MESSAGE(in, file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A string, or an array of them, as most of the manifest's fields may be; empty if it is neither.
std::vector<std::string> strings(const Json& value) {
  if (value.is_string()) return {value.get<std::string>()};
  if (!value.is_array() || !std::all_of(value.begin(), value.end(), [](const Json& v) { return v.is_string(); }))
    return {};
  return value.get<std::vector<std::string>>();
}

std::vector<std::string> strings(const Json& object, const char* key) {
  return object.contains(key) ? strings(object[key]) : std::vector<std::string>{};
}

void check_keys(const Json& object, std::initializer_list<std::string> known, Faults& faults) {
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) faults.push_back("unknown key " + key);
  }
}

enum class Number { one, any };

/// A field of one string, or of any number from one on, which all match.
void check_field(const Json& object, const char* key, const char* pattern, Number number, Faults& faults) {
  const std::vector<std::string> values = strings(object, key);
  const std::regex rule(pattern);
  const bool match =
      std::all_of(values.begin(), values.end(), [&](const auto& v) { return std::regex_match(v, rule); });
  const bool one_string = object.contains(key) && object[key].is_string();
  if (values.empty() || !match || (number == Number::one && !one_string)) faults.push_back(std::string("bad ") + key);
}

void check_fields(const Json& manifest, Faults& faults) {
  check_keys(manifest,
             {"name", "version", "description", "keywords", "homepage", "repository", "authors", "license",
              "frameworks", "platforms", "headers", "examples", "dependencies", "export", "scripts", "build"},
             faults);
  check_field(manifest, "name", "[^:;/,@<>]{1,100}", Number::one, faults);
  check_field(manifest, "version", R"(\d+\.\d+\.\d+)", Number::one, faults);
  check_field(manifest, "description", ".{1,255}", Number::one, faults);
  check_field(manifest, "keywords", R"([a-z\d_+. -]{1,50})", Number::any, faults);
  check_field(manifest, "license", R"([A-Za-z\d.-]+)", Number::one, faults);  // SPDX
  check_field(manifest, "frameworks", R"(\*|[a-z\d_-]+)", Number::any, faults);
  check_field(manifest, "platforms", R"(\*|[a-z\d_-]+)", Number::any, faults);
  check_field(manifest, "headers", R"([\w./]+\.(h|hpp))", Number::any, faults);
}

/// What the fields say of the project.
void check_facts(const Json& manifest, Faults& faults) {
  if (strings(manifest, "version") != std::vector{version}) faults.push_back("version is not " + version);
  const bool bsd = text_of("LICENSE").rfind("BSD 3-Clause License\n", 0) == 0;
  if (!bsd || strings(manifest, "license") != std::vector<std::string>{"BSD-3-Clause"})
    faults.push_back("license is not LICENSE's");
}

/// Headers and exported files exist, and nothing of the project is compiled: PlatformIO would take bench/ and tests/.
void check_files(const Json& manifest, Faults& faults) {
  const Json build = manifest.value("build", Json::object());
  const Json exported = manifest.value("export", Json::object());
  if (!build.is_object() || !exported.is_object()) return faults.push_back("build or export is no object");
  check_keys(build,
             {"flags", "unflags", "includeDir", "srcDir", "srcFilter", "extraScript", "libArchive", "libLDFMode",
              "libCompatMode", "builder"},
             faults);
  check_keys(exported, {"include", "exclude"}, faults);
  if (strings(build, "srcFilter") != std::vector<std::string>{"-<*>"}) faults.push_back("sources are compiled");
  const std::vector<std::string> directory = strings(build, "includeDir");
  const std::vector<std::string> packed = strings(exported, "include");
  if (directory.size() != 1 || packed.size() < 2)  // one folder alone would become the package's root
    return faults.push_back("bad includeDir or export");
  for (const std::string& file : packed) {
    if (!std::filesystem::exists(root / file)) faults.push_back("no file " + file);
  }
  for (const std::string& header : strings(manifest, "headers")) {
    const std::string file = directory[0] + "/" + header;
    if (!std::filesystem::is_regular_file(root / file)) faults.push_back("no file " + file);
    if (std::find(packed.begin(), packed.end(), file) == packed.end()) faults.push_back("not exported: " + file);
  }
}

Faults faults_of(const std::string& text) {
  const Json manifest = Json::parse(text, nullptr, false);
  if (!manifest.is_object()) return {"no JSON object"};
  Faults faults;
  check_fields(manifest, faults);
  check_facts(manifest, faults);
  check_files(manifest, faults);
  return faults;
}

/// The manifest with another value at a place; without that place if the value is null.
Faults faults_with(const char* place, const Json& value) {
  Json manifest = Json::parse(text_of("library.json"));
  Json change = {{"op", value.is_null() ? "remove" : "add"}, {"path", place}};
  if (!value.is_null()) change["value"] = value;
  return faults_of(manifest.patch(Json::array({change})).dump());
}

}  // namespace

TEST_CASE("library.json: by the rules, and true") { CHECK(faults_of(text_of("library.json")) == Faults{}); }

TEST_CASE("library.json: what is no JSON is refused") {
  std::string text = text_of("library.json");
  CHECK(faults_of("") == Faults{"no JSON object"});
  CHECK(faults_of("[]") == Faults{"no JSON object"});
  CHECK(faults_of(text.substr(0, text.rfind('}'))) == Faults{"no JSON object"});
  text.insert(text.rfind('}'), ",");
  CHECK(faults_of(text) == Faults{"no JSON object"});
}

TEST_CASE("library.json: each rule notices a copy that breaks it") {
  CHECK(faults_with("/name", nullptr) == Faults{"bad name"});
  CHECK(faults_with("/name", "short/shot") == Faults{"bad name"});
  CHECK(faults_with("/name", Json::array({"shortshot"})) == Faults{"bad name"});
  CHECK(faults_with("/version", "0.1") == Faults{"bad version", "version is not " + version});
  CHECK(faults_with("/version", "9.9.9") == Faults{"version is not " + version});
  CHECK(faults_with("/description", "") == Faults{"bad description"});
  CHECK(faults_with("/keywords", Json::array()) == Faults{"bad keywords"});
  CHECK(faults_with("/keywords", Json::array({"Point Cloud"})) == Faults{"bad keywords"});
  CHECK(faults_with("/keywords", Json::array({1})) == Faults{"bad keywords"});
  CHECK(faults_with("/license", "MIT") == Faults{"license is not LICENSE's"});
  CHECK(faults_with("/frameworks", true) == Faults{"bad frameworks"});
  CHECK(faults_with("/platforms", nullptr) == Faults{"bad platforms"});
  CHECK(faults_with("/plattforms", "*") == Faults{"unknown key plattforms"});
  CHECK(faults_with("/headers", nullptr) == Faults{"bad headers"});
  CHECK(faults_with("/headers", "shot.hpp") ==
        Faults{"no file single_include/shot.hpp", "not exported: single_include/shot.hpp"});
  CHECK(faults_with("/build", "single_include") == Faults{"build or export is no object"});
  CHECK(faults_with("/build/includedir", "include") == Faults{"unknown key includedir"});
  CHECK(faults_with("/build/includeDir", nullptr) == Faults{"bad includeDir or export"});
  CHECK(faults_with("/build/srcFilter", nullptr) == Faults{"sources are compiled"});
  CHECK(faults_with("/export/files", "README.md") == Faults{"unknown key files"});
  CHECK(faults_with("/export/include", "single_include") == Faults{"bad includeDir or export"});
  CHECK(faults_with("/export/include/-", "READ.me") == Faults{"no file READ.me"});
  CHECK(faults_with("/export/include/0", nullptr) == Faults{"not exported: single_include/shortshot.hpp"});
}
