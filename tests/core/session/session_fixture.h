#pragma once
/// A folder of its own with a small mesh, for tests of sessions.
#include <filesystem>
#include <string>

#include <doctest/doctest.h>
#include <unistd.h>

#include "core/mesh/load.h"
#include "core/session/session.h"
#include "tests/support/solids.h"

namespace hewn::testing {

class SessionFolder {
 public:
  explicit SessionFolder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() /
              ("hewn-session-" + name + "-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~SessionFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  SessionFolder(const SessionFolder&) = delete;
  SessionFolder& operator=(const SessionFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  /// A 40 x 20 x 8 plate about the origin with a hole of radius 3: seven groups.
  std::filesystem::path plate() const {
    auto file = path_ / "plate.off";
    static_cast<void>(save_mesh(solids::plate_with_hole(Vec3(40, 20, 8), 3, 32), file));
    return file;
  }

 private:
  std::filesystem::path path_;
};

/// A context with one thread: small work, many tests side by side.
inline RunContext one_thread() {
  RunContext run;
  run.threads = 1;
  return run;
}

/// A session on the plate, read and ready.
struct OpenSession {
  SessionFolder folder{"run"};
  Session session{one_thread()};
  OpenSession() {
    session.set_views(false);
    REQUIRE(session.execute(OpenFile{folder.plate()}));
    session.wait();
    REQUIRE(session.document().is_ready());
  }
};

/// The group on the hole's wall of `SessionFolder::plate`.
inline std::vector<GroupRef> hole() { return {{Vec3(3, 0, 0), -1}}; }

}  // namespace hewn::testing
