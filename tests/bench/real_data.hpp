// Real recordings lie beside the project, on some machines.
#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

/// The path of ../shared/NAME. Where it is not there: nothing, and a line that says so; or a failure if
/// SHORTSHOT_REQUIRE_REAL_DATA is set, as it is where changes are merged.
inline std::string real_data(const std::string& name) {
  const std::string path = std::string(SHORTSHOT_TEST_DATA) + "/../../../shared/" + name;
  if (std::filesystem::exists(path)) return path;
  if (std::getenv("SHORTSHOT_REQUIRE_REAL_DATA") != nullptr) FAIL("SHORTSHOT_REQUIRE_REAL_DATA is set: no ", path);
  MESSAGE("skipped: no ../shared/", name);
  return {};
}
