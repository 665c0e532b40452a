// A copy of a golden folder to be tampered with.
#pragma once

#include <doctest/doctest.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "cloud_file_samples.hpp"

namespace golden_test {

const std::string test_data = SHORTSHOT_TEST_DATA;

class CaseCopy {
 public:
  explicit CaseCopy(const std::string& name) : path_(directory_.file(name)) {
    std::filesystem::copy(test_data + "/" + name, path_);
  }

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }

  void replace_in_json(const std::string& from, const std::string& to) const {
    std::string text = cloud_file_test::read_bytes(file("case.json"));
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    cloud_file_test::write_bytes(file("case.json"), text.replace(at, from.size(), to));
  }

  template <class Value>
  std::vector<Value> values(const std::string& array) const {
    const std::string bytes = cloud_file_test::read_bytes(file(array + ".bin"));
    std::vector<Value> values(bytes.size() / sizeof(Value));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }

  template <class Value>
  void write_values(const std::string& array, const std::vector<Value>& values) const {
    std::string bytes(values.size() * sizeof(Value), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    cloud_file_test::write_bytes(file(array + ".bin"), bytes);
  }

 private:
  cloud_file_test::TemporaryDirectory directory_;
  std::string path_;
};

}  // namespace golden_test
