#include "firmware/host/host_facts.hpp"

#include <cstdio>

#include "tools/io/binary_file.hpp"

namespace shortshot_bench::firmware {

HostFacts::HostFacts(const std::string& program, const std::string& target, const std::string& configuration)
    : text_("program " + program + "\ntarget " + target + "\nlevel O2\nconfiguration " + configuration +
            "\nworkspace full\n") {}

void HostFacts::add(const std::string& name, std::size_t value) {
  text_ += "fact " + name + " " + std::to_string(value) + "\n";
}

void HostFacts::add_hash(const std::string& configuration, std::uint32_t value) {
  char digits[9];
  std::snprintf(digits, sizeof digits, "%08x", static_cast<unsigned>(value));
  text_ += "hash " + configuration + " " + digits + "\n";
}

void HostFacts::write_to(const std::string& path) const { write_file(path, text_ + "exit 0\n"); }

}  // namespace shortshot_bench::firmware
