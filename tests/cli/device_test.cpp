// The choice of the device: what is said, and that it leaves no trace in the tree.
#include <string>

#include <doctest/doctest.h>

#include "tests/cli/program.h"

namespace hewn::cli {
namespace {

constexpr int kUsage = 2;
const std::string kPart = HEWN_ASSETS "/bracket.off";

TEST_CASE("every device gives the same tree; only one that is asked for and missing is told of") {
  const Folder folder;
  const auto run = [&](const std::string& device, const std::string& name) {
    Outcome outcome = run_hewn({"reconstruct", kPart, "-o", folder / name, "--device", device});
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    return outcome;
  };
  CHECK(run("cpu", "cpu.scad").err.empty());
  CHECK(run("auto", "auto.scad").err.empty());
  // No machine has so many.
  const Outcome missing = run("cuda:250", "cuda.scad");
  CHECK(missing.says("hewn: warning: "));
  CHECK(missing.says("CUDA"));
  CHECK(missing.says("; the processor does the work"));
  CHECK(missing.err.find("warning") == missing.err.rfind("warning"));
  const std::string expected = content_of(folder / "cpu.scad");
  CHECK(expected.size() > 100);
  CHECK(content_of(folder / "auto.scad") == expected);
  CHECK(content_of(folder / "cuda.scad") == expected);
}

TEST_CASE("a name that is no device is a usage error before any work") {
  const Folder folder;
  const Outcome outcome =
      run_hewn({"reconstruct", kPart, "-o", folder / "out.scad", "--device", "gpu"});
  CHECK(outcome.exit_code == kUsage);
  CHECK(outcome.says("'gpu' is no device; give auto, cpu, cuda or cuda:NUMBER"));
  CHECK(folder.files().empty());
}

TEST_CASE("a quiet run keeps quiet about a missing device, and the flag overrides the project") {
  const Folder folder;
  const std::string project =
      folder.write("part.json", R"({"hewn-project": 1, "mesh": ")" + kPart +
                                    R"(", "options": {"device": {"kind": "cuda", "index": 250}}})");
  const Outcome loud = run_hewn({"reconstruct", project, "-o", folder / "a.scad"});
  REQUIRE_MESSAGE(loud.exit_code == 0, loud.err);
  CHECK(loud.says("; the processor does the work"));
  const Outcome quiet = run_hewn({"reconstruct", project, "-o", folder / "b.scad", "-q"});
  CHECK(quiet.exit_code == 0);
  CHECK(quiet.err.empty());
  const Outcome other =
      run_hewn({"reconstruct", project, "-o", folder / "c.scad", "--device", "cpu"});
  CHECK(other.exit_code == 0);
  CHECK(other.err.empty());
}

}  // namespace
}  // namespace hewn::cli
