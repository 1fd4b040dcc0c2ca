// Two million triangles: bounded memory, bounded time, a prompt stop.
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "core/base/rng.h"
#include "core/mesh/load.h"
#include "tests/cli/program.h"
#include "tests/support/solids.h"

namespace hewn::cli {
namespace {

#ifdef HEWN_SANITIZED
constexpr int kSides = 280,
              kTubeSides = 143;  // instrumented code is some ten times slower and larger
constexpr double kMostMemory_mb = 4000;
constexpr double kPatience = 3;
#else
constexpr int kSides = 1400, kTubeSides = 715;
constexpr double kMostMemory_mb = 1200;
constexpr double kPatience = 0.5;  // giving back the memory takes its time on a busy machine
#endif

constexpr int kTriangles = 2 * kSides * kTubeSides;

/// A torus of `kTriangles`.
std::string write_torus(const Folder& folder) {
  const std::string path = folder / "torus.stl";
  REQUIRE(save_mesh(solids::torus(30, 10, kSides, kTubeSides), path));
  return path;
}

TEST_CASE("a torus of two million triangles becomes a torus") {
  const Folder folder;
  const std::string report = folder / "report.json";
  const Outcome outcome = run_hewn({"reconstruct", write_torus(folder), "-o", folder / "out.scad",
                                    "--report", report, "--picture", folder / "out.png"});
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  const auto json = nlohmann::json::parse(content_of(report));
  CHECK(json.at("input").at("triangles") == kTriangles);
  CHECK(json.at("tree").at("literals") == 1);
  CHECK(content_of(folder / "out.scad").find("rotate_extrude()") != std::string::npos);
  MESSAGE(outcome.seconds << " s, " << outcome.peak_mb << " MB");
  CHECK(outcome.peak_mb < kMostMemory_mb);
}

TEST_CASE("Ctrl-C stops every stage on two million triangles") {
  const Folder folder;
  const std::string torus = write_torus(folder);
  for (const std::string stage : {"reading", "repairing", "segment"}) {
    CAPTURE(stage);
    const StageInterrupt stopped =
        interrupt_at(stage, {"reconstruct", torus, "-o", folder / "out.scad"});
    CHECK_MESSAGE(stopped.has_reached, stopped.outcome.err);
    CHECK(stopped.outcome.exit_code == 130);
    CHECK(stopped.outcome.seconds < kPatience);
    CHECK(folder.files() == std::vector<std::string>{"torus.stl"});
  }
}

TEST_CASE("debris of loose triangles is refused in bounded time") {
  // Each triangle a part of its own: what is quadratic in parts shows here.
  Rng rng(7);
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (int t = 0; t < kTriangles; ++t) {
    const auto draw = [&rng](double reach) {
      Vec3 p;
      for (double& c : p) c = rng.uniform(0, reach);
      return p;
    };
    const Vec3 place = draw(100);
    for (int k = 0; k < 3; ++k) vertices.push_back(place + draw(0.1));
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const Folder folder;
  const std::string path = folder / "debris.stl";
  REQUIRE(save_mesh(make_mesh(std::move(vertices), std::move(triangles)), path));
  const Outcome outcome = run_hewn({"reconstruct", path, "-o", folder / "out.scad"});
  CHECK(outcome.exit_code == 1);
  CHECK_MESSAGE(outcome.says("The surface is open"), outcome.err);
  CHECK_MESSAGE(outcome.says("separate parts"), outcome.err);
  MESSAGE(outcome.seconds << " s, " << outcome.peak_mb << " MB");
  CHECK(outcome.peak_mb < 2 * kMostMemory_mb);
  CHECK(folder.files() == std::vector<std::string>{"debris.stl"});
}

}  // namespace
}  // namespace hewn::cli
