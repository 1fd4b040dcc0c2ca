#pragma once
/// A file that lives as long as the object; for tests that read what they wrote.
#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

namespace hewn {

class ScratchFile {
 public:
  ScratchFile(std::string_view content, std::string_view extension) : ScratchFile(extension) {
    std::ofstream(path_, std::ios::binary)
        .write(content.data(), static_cast<std::streamsize>(content.size()));
  }
  /// Only a name: nothing is at the path yet.
  explicit ScratchFile(std::string_view extension) {
    static std::atomic<int> counter{0};
    path_ = std::filesystem::temp_directory_path() /
            ("hewn-test-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) +
             std::string(extension));
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  ~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace hewn
