#include <doctest/doctest.h>

#include "tests/cli/program.h"

namespace hewn::cli {
namespace {

TEST_CASE("a log is carried out without a window, and twice gives the same bytes") {
  const Folder folder;
  const std::string mesh = folder.write("cube.off", cube_off());
  const std::string out = folder / "out.scad";
  const std::string log = folder.write("work.log", R"({"command": "open", "path": ")" + mesh +
                                                       R"("}
{"command": "cut", "normal": [0, 0, 1], "offset": 4, "groups": []}
{"command": "undo"}
{"command": "export", "path": ")" + out + R"(", "match-facets": false}
)");
  const Outcome first = run_hewn({"replay", log});
  REQUIRE_MESSAGE(first.exit_code == 0, first.err);
  const std::string design = content_of(out);
  CHECK(design.find("cube(") != std::string::npos);
  REQUIRE(run_hewn({"replay", log, "--threads", "1"}).exit_code == 0);
  CHECK(content_of(out) == design);
}

TEST_CASE("the failing line of a log is named") {
  const Folder folder;
  const std::string log = folder.write("bad.log", "{\"command\": \"undo\"}\n");
  const Outcome outcome = run_hewn({"replay", log});
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.says("bad.log:1"));
  CHECK(outcome.says("open a mesh first"));
}

}  // namespace
}  // namespace hewn::cli
