// What this machine says where boards print theirs: a file of facts for ../report.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace shortshot_bench::firmware {

class HostFacts {
 public:
  HostFacts(const std::string& program, const std::string& target, const std::string& configuration);
  void add(const std::string& name, std::size_t value);
  void add_hash(const std::string& configuration, std::uint32_t value);
  void write_to(const std::string& path) const;  // throws InputError

 private:
  std::string text_;
};

}  // namespace shortshot_bench::firmware
