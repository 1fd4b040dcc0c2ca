// Ctrl-C ends the program quickly and leaves no half-written file.
#include <string>

#include <doctest/doctest.h>

#include "tests/cli/program.h"

namespace hewn::cli {
namespace {

#ifdef HEWN_SANITIZED
constexpr double kPatience = 3;  // instrumented code polls as often, but runs slower
#else
constexpr double kPatience = 0.35;  // 0.1 s on an idle machine; tests run side by side
#endif

TEST_CASE("Ctrl-C at any time ends within a moment and leaves nothing behind") {
  const std::string input = HEWN_ASSETS "/knob.ply";
  for (const double after : {0.01, 0.05, 0.15, 0.4}) {
    CAPTURE(after);
    const Folder folder;
    const Outcome outcome =
        run_hewn({"reconstruct", input, "-o", folder / "out.scad", "--tree-neighbourhood-steps",
                  "1000000", "--tree-starts", "64"},
                 after);
    // A fast machine may be done before the signal.
    if (outcome.exit_code == 0) continue;
    CHECK(outcome.exit_code == 130);
    CHECK(outcome.seconds < kPatience);
    CHECK(folder.files().empty());
  }
}

TEST_CASE("an older result survives an interrupted run") {
  const Folder folder;
  folder.write("out.scad", "older");
  const Outcome outcome =
      run_hewn({"reconstruct", HEWN_ASSETS "/knob.ply", "-o", folder / "out.scad",
                "--tree-neighbourhood-steps", "1000000", "--tree-starts", "64"},
               0.1);
  if (outcome.exit_code != 0) CHECK(content_of(folder / "out.scad") == "older");
  CHECK(folder.files() == std::vector<std::string>{"out.scad"});
}

}  // namespace
}  // namespace hewn::cli
