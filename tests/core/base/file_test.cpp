#include "core/base/file.h"

#include <filesystem>
#include <string>

#include <doctest/doctest.h>

namespace hewn {
namespace {

namespace fs = std::filesystem;

/// A folder of its own, removed at the end.
class Folder {
 public:
  explicit Folder(const char* name) : path_(fs::temp_directory_path() / name) {
    fs::remove_all(path_);
    fs::create_directory(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path operator/(const char* name) const { return path_ / name; }
  long files() const { return std::distance(fs::directory_iterator(path_), {}); }

 private:
  fs::path path_;
};

TEST_CASE("what is written is read back, byte for byte") {
  const Folder folder("hewn_file_test");
  const std::string content("a\0b\r\n\xff", 6);
  REQUIRE(write_file(folder / "x", content));
  const auto back = read_file(folder / "x");
  REQUIRE(back);
  CHECK(*back == content);
}

TEST_CASE("writing replaces the old file and leaves nothing beside it") {
  const Folder folder("hewn_file_test");
  REQUIRE(write_file(folder / "x", "a long first version"));
  REQUIRE(write_file(folder / "x", "short"));
  CHECK(*read_file(folder / "x") == "short");
  CHECK(folder.files() == 1);
}

TEST_CASE("a full disk is reported") {
  const auto written = write_file("/dev/full", std::string(100000, 'x'));
  REQUIRE(!written);
  CHECK(written.error().code == ErrorCode::FileWrite);
  CHECK(written.error().message.find("No space left") != std::string::npos);
}

TEST_CASE("a path below a file cannot be written and leaves the file alone") {
  const Folder folder("hewn_file_test");
  REQUIRE(write_file(folder / "x", "keep"));
  const auto written = write_file((folder / "x") / "y", "z");
  REQUIRE(!written);
  CHECK(written.error().code == ErrorCode::FileWrite);
  CHECK(written.error().where.find("hewn_file_test") != std::string::npos);
  CHECK(*read_file(folder / "x") == "keep");
}

TEST_CASE("a missing file and a folder are told apart") {
  const Folder folder("hewn_file_test");
  const auto missing = read_file(folder / "nothing");
  REQUIRE(!missing);
  CHECK(missing.error().code == ErrorCode::FileNotFound);
  const auto directory = read_file(fs::temp_directory_path());
  REQUIRE(!directory);
  CHECK(directory.error().message.find("folder") != std::string::npos);
}

}  // namespace
}  // namespace hewn
