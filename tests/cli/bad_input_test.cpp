// Every kind of bad input through the real binary: exit code, and a message that says what is
// wrong, where, and what to do.
#include <string>

#include <doctest/doctest.h>

#include "tests/cli/program.h"

namespace hewn::cli {
namespace {

/// Reconstructs `input` and checks that nothing was written.
Outcome refused(const Folder& folder, const std::string& input) {
  const auto before = folder.files();
  Outcome outcome = run_hewn({"reconstruct", input, "-o", folder / "out.scad"});
  CHECK(folder.files() == before);
  CHECK_MESSAGE(outcome.says(input), outcome.err);
  CHECK(outcome.out.empty());
  return outcome;
}

constexpr int kUsage = 2, kNoInput = 3, kBadInput = 4;

TEST_CASE("a missing file") {
  const Folder folder;
  const Outcome outcome = refused(folder, folder / "nothing.stl");
  CHECK(outcome.exit_code == kNoInput);
  CHECK_MESSAGE(outcome.says("No such file"), outcome.err);
}

TEST_CASE("a folder instead of a file") {
  const Folder folder;
  const Outcome outcome = run_hewn({"info", folder / ""});
  CHECK(outcome.exit_code == kNoInput);
  CHECK_MESSAGE(outcome.says("folder"), outcome.err);
}

TEST_CASE("an empty file") {
  const Folder folder;
  const Outcome outcome = refused(folder, folder.write("empty.stl", ""));
  CHECK(outcome.exit_code == kBadInput);
  CHECK_MESSAGE(outcome.says("empty"), outcome.err);
}

TEST_CASE("a truncated file") {
  const Folder folder;
  const std::string whole = cube_off();
  const Outcome outcome = refused(folder, folder.write("cut.off", whole.substr(0, 60)));
  CHECK(outcome.exit_code == kBadInput);
}

TEST_CASE("binary garbage") {
  const Folder folder;
  std::string garbage;
  unsigned state = 12345;
  for (int i = 0; i < 5000; ++i) {
    state = state * 1664525u + 1013904223u;
    garbage.push_back(static_cast<char>(state >> 24));
  }
  for (const char* name : {"noise.stl", "noise.off", "noise.obj", "noise.ply"}) {
    CAPTURE(name);
    CHECK(refused(folder, folder.write(name, garbage)).exit_code == kBadInput);
  }
}

TEST_CASE("a wrongly named file is read by its content") {
  const Folder folder;
  const std::string input = folder.write("cube.stl", cube_off());
  const Outcome outcome = run_hewn({"info", input});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.find("OFF") != std::string::npos);
}

TEST_CASE("coordinates that are not finite") {
  const Folder folder;
  for (const char* value : {"nan", "inf", "-inf", "1e999"}) {
    CAPTURE(value);
    std::string text = cube_off();
    const auto at = text.find("10 0 0");
    REQUIRE(at != std::string::npos);
    text.replace(at, 2, value);
    CHECK(refused(folder, folder.write("bad.off", text)).exit_code == kBadInput);
  }
}

TEST_CASE("one triangle bounds no solid") {
  const Folder folder;
  const std::string input = folder.write("one.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const Outcome outcome = run_hewn({"reconstruct", input, "-o", folder / "out.scad"});
  CHECK(outcome.exit_code == kBadInput);
  CHECK_MESSAGE(outcome.says("open"), outcome.err);
  CHECK(folder.files() == std::vector<std::string>{"one.off"});
}

TEST_CASE("a mesh turned inside out is repaired with a warning") {
  const Folder folder;
  std::string text = "OFF\n8 12 0\n";
  const std::string cube = cube_off();
  text += cube.substr(text.size(), cube.find("3 0 2 3") - text.size());
  text +=
      "3 0 3 2\n3 0 1 3\n3 4 7 5\n3 4 6 7\n3 0 5 1\n3 0 4 5\n"
      "3 2 7 6\n3 2 3 7\n3 0 6 4\n3 0 2 6\n3 1 7 3\n3 1 5 7\n";
  const std::string input = folder.write("inside_out.off", text);
  const Outcome outcome = run_hewn({"reconstruct", input, "-o", folder / "out.scad"});
  CHECK(outcome.exit_code == 0);
  CHECK_MESSAGE(outcome.says("inside"), outcome.err);
  CHECK(content_of(folder / "out.scad").find("cube(") != std::string::npos);
}

TEST_CASE("an open mesh is reported with its holes and still tried") {
  const Folder folder;
  std::string text = cube_off();
  text.replace(text.find("8 12 0"), 6, "8 11 0");
  text.erase(text.rfind("3 1 7 5"));
  const std::string input = folder.write("open.off", text);
  const Outcome outcome = run_hewn({"reconstruct", input, "-o", folder / "out.scad"});
  CHECK_MESSAGE(outcome.says("hole"), outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(content_of(folder / "out.scad").find("cube(") != std::string::npos);
}

TEST_CASE("unknown flags and values are usage errors that name the allowed ones") {
  const Folder folder;
  const std::string input = folder.write("cube.off", cube_off());
  const std::string out = folder / "out.scad";
  CHECK(run_hewn({}).exit_code == kUsage);
  const Outcome unknown = run_hewn({"optimize", input});
  CHECK(unknown.exit_code == kUsage);
  CHECK_MESSAGE(unknown.says("no command 'optimize'"), unknown.err);
  CHECK(run_hewn({"reconstruct", input}).exit_code == kUsage);
  CHECK(run_hewn({"reconstruct", input, "-o", out, "--nonsense"}).exit_code == kUsage);
  CHECK(run_hewn({"reconstruct", input, "-o", out, "--search", "magic"}).exit_code == kUsage);
  const Outcome bad = run_hewn({"reconstruct", input, "-o", out, "--tree-starts", "0"});
  CHECK(bad.exit_code == kUsage);
  CHECK_MESSAGE(bad.says("whole number from 1 to"), bad.err);
  const Outcome extension = run_hewn({"reconstruct", input, "-o", folder / "out.doc"});
  CHECK(extension.exit_code == kUsage);
  CHECK_MESSAGE(extension.says(".scad"), extension.err);
  CHECK(folder.files() == std::vector<std::string>{"cube.off"});
}

TEST_CASE("a project with a mistake is refused by file and key") {
  const Folder folder;
  folder.write("cube.off", cube_off());
  const std::string input = folder.write(
      "p.json", R"({"hewn-project": 1, "mesh": "cube.off", "partition": {"groups": [99]}})");
  const Outcome outcome = run_hewn({"reconstruct", input, "-o", folder / "out.scad"});
  CHECK(outcome.exit_code == kUsage);
  CHECK_MESSAGE(outcome.says("no group 99"), outcome.err);
  const Outcome broken =
      run_hewn({"reconstruct", folder.write("q.json", "{"), "-o", folder / "out.scad"});
  CHECK(broken.exit_code == kBadInput);
  CHECK_MESSAGE(broken.says("q.json"), broken.err);
}

}  // namespace
}  // namespace hewn::cli
