// A file is there as a whole, or as it was: on a full disk, too.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fixtures.hpp"
#include "temporary_folder.hpp"

namespace test_replace_file {
namespace {

using namespace unit;
using ss::Status;
using Bytes = std::vector<std::uint8_t>;
namespace fs = std::filesystem;

Bytes some_bytes(std::uint32_t seed, std::size_t size) {
  Random random(seed);
  Bytes bytes(size);
  for (std::uint8_t& byte : bytes) byte = random.byte();
  return bytes;
}

Status replace(const std::string& path, const Bytes& bytes) { return ss::detail::replace_file(path, bytes); }

/// No file can grow beyond `bytes` meanwhile: what a disk does that has no more room. Nothing may be printed then.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

Status replace_on_small_disk(const std::string& path, const Bytes& bytes, rlim_t room) {
  const SmallDisk disk(room);
  return replace(path, bytes);
}

}  // namespace

TEST_CASE("file: new bytes take the place of the old ones, more or fewer, and nothing else is left") {
  const TemporaryFolder folder;
  const std::string path = folder / "a";
  for (const std::size_t size : {5000u, 100000u, 4096u, 0u, 1u}) {
    const Bytes bytes = some_bytes(1, size);
    REQUIRE(replace(path, bytes) == Status::ok);
    CHECK(bytes_of_file(path) == bytes);
    Bytes read(3);
    REQUIRE(ss::detail::read_file(path, read) == Status::ok);
    CHECK(read == bytes);
    CHECK(folder.files() == 1);
  }
}

TEST_CASE("file: a disk that is full leaves the old file as it was") {
  const TemporaryFolder folder;
  const std::string path = folder / "a";
  const Bytes old = some_bytes(2, 50000);
  REQUIRE(replace(path, old) == Status::ok);
  for (const rlim_t room : {rlim_t{0}, rlim_t{1}, rlim_t{4096}, rlim_t{99999}}) {
    const Status status = replace_on_small_disk(path, some_bytes(3, 100000), room);
    CHECK(status == Status::no_file);
    CHECK(bytes_of_file(path) == old);
    CHECK(folder.files() == 1);
    const Status without_old = replace_on_small_disk(folder / "b", some_bytes(4, 100000), room);
    CHECK(without_old == Status::no_file);
    CHECK(folder.files() == 1);
  }
  CHECK(replace_on_small_disk(path, some_bytes(3, 100000), 100000) == Status::ok);
  CHECK(bytes_of_file(path) == some_bytes(3, 100000));
}

TEST_CASE("file: what an interrupted program has left is not touched") {
  const TemporaryFolder folder;
  const Bytes left = some_bytes(5, 10);
  REQUIRE(replace(folder / "a.tmp-00", left) == Status::ok);
  REQUIRE(replace(folder / "a.tmp-01", left) == Status::ok);
  CHECK(replace(folder / "a", some_bytes(6, 20)) == Status::ok);
  CHECK(bytes_of_file(folder / "a.tmp-00") == left);
  CHECK(bytes_of_file(folder / "a.tmp-01") == left);
  CHECK(folder.files() == 3);
}

TEST_CASE("file: places where there can be none") {
  const TemporaryFolder folder;
  Bytes bytes{1, 2, 3};
  CHECK(replace(folder / "no/folder", bytes) == Status::no_file);
  CHECK(replace("", bytes) == Status::no_file);
  CHECK(replace(folder.path.string(), bytes) == Status::no_file);  // would replace a folder
  CHECK(replace(folder.path.string() + "/", bytes) == Status::no_file);
  CHECK(replace("/dev/full", bytes) == Status::no_file);  // and not a device, whoever may
  CHECK(fs::is_character_file("/dev/full"));
  CHECK_FALSE(fs::exists("/dev/full.tmp-00"));
  CHECK(fs::is_empty(folder.path));
  CHECK_FALSE(fs::exists(folder.path.string() + ".tmp-00"));

  REQUIRE(replace(folder / "a", bytes) == Status::ok);
  fs::permissions(folder.path, fs::perms::owner_read | fs::perms::owner_exec);
  if (geteuid() != 0) CHECK(replace(folder / "a", {4}) == Status::no_file);  // root may write anywhere
  fs::permissions(folder.path, fs::perms::owner_all);
  if (geteuid() != 0) CHECK(bytes_of_file(folder / "a") == bytes);
  CHECK(folder.files() == 1);

  CHECK(ss::detail::read_file(folder / "none", bytes) == Status::no_file);
  CHECK(ss::detail::read_file(folder.path.string(), bytes) == Status::no_file);
}

TEST_CASE("file: whoever could not read the old file cannot read the new one") {
  const TemporaryFolder folder;
  const std::string path = folder / "a";
  REQUIRE(replace(path, {1}) == Status::ok);
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  REQUIRE(replace(path, {2}) == Status::ok);
  CHECK(fs::status(path).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
  CHECK(bytes_of_file(path) == Bytes{2});
}

}  // namespace test_replace_file
