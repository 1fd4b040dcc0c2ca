// Readable meshes that are wrong as surfaces: what is repaired, what is said, what is refused.
#include <cmath>
#include <numbers>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace hewn::cli {
namespace {

constexpr int kFailed = 1, kBadInput = 4;

struct Rebuilt {
  Outcome outcome;
  nlohmann::json report;

  int literals() const { return report.at("tree").at("literals"); }
  double iou() const { return report.at("geometry").at("iou"); }
  const nlohmann::json& input() const { return report.at("input"); }
};

/// Reconstructs a mesh that can be; every warning on the console is in the report too.
Rebuilt rebuilt(const TextMesh& mesh) {
  const Folder folder;
  const std::string report = folder / "report.json";
  Rebuilt out;
  out.outcome = run_hewn({"reconstruct", folder.write("in.off", mesh.off()), "-o",
                          folder / "out.scad", "--report", report});
  REQUIRE_MESSAGE(out.outcome.exit_code == 0, out.outcome.err);
  out.report = nlohmann::json::parse(content_of(report));
  for (const auto& warning : out.report.at("warnings")) {
    CHECK_MESSAGE(out.outcome.says(warning.get<std::string>()), out.outcome.err);
  }
  return out;
}

/// Reconstructs a mesh that cannot be; nothing is written.
Outcome refused(const TextMesh& mesh) {
  const Folder folder;
  const std::string input = folder.write("in.off", mesh.off());
  Outcome outcome = run_hewn({"reconstruct", input, "-o", folder / "out.scad"});
  CHECK_MESSAGE(outcome.says(input), outcome.err);
  CHECK(folder.files() == std::vector<std::string>{"in.off"});
  return outcome;
}

TEST_CASE("parts that lie apart are counted and all kept") {
  const Rebuilt two = rebuilt(cube_mesh(10) + cube_mesh(10, {20, 0, 0}));
  CHECK_MESSAGE(two.outcome.says("2 separate parts"), two.outcome.err);
  CHECK(two.input().at("components") == 2);
  CHECK(two.literals() == 2);
  CHECK(two.iou() > 0.999);
}

TEST_CASE("a shell inside another is a hollow, whichever way it looks") {
  const TextMesh outer = cube_mesh(10);
  const TextMesh inner = cube_mesh(4, {3, 3, 3});
  for (const bool looks_outward : {false, true}) {
    CAPTURE(looks_outward);
    const Rebuilt hollow = rebuilt(outer + (looks_outward ? inner : inner.flipped()));
    CHECK(hollow.outcome.says("taken as a cavity") == looks_outward);
    CHECK(hollow.literals() == 2);
    CHECK(hollow.iou() > 0.999);
  }
}

TEST_CASE("solids that cross each other become their union, with a warning") {
  const Rebuilt crossing = rebuilt(cube_mesh(10) + cube_mesh(10, {5, 5, 5}));
  CHECK_MESSAGE(crossing.outcome.says("cross each other"), crossing.outcome.err);
  CHECK(crossing.input().at("self_intersections") > 0);
  CHECK(crossing.literals() == 2);
  CHECK(crossing.iou() > 0.999);
}

TEST_CASE("solids that touch in an edge, a corner or a side") {
  const Rebuilt edge = rebuilt(cube_mesh(10) + cube_mesh(10, {10, 10, 0}));
  CHECK_MESSAGE(edge.outcome.says("1 edge has more than two triangles"), edge.outcome.err);
  CHECK(edge.input().at("non_manifold_edges") == 1);
  CHECK(edge.literals() == 2);
  CHECK(edge.iou() > 0.999);
  const Rebuilt corner = rebuilt(cube_mesh(10) + cube_mesh(10, {10, 10, 10}));
  CHECK(corner.literals() == 2);
  CHECK(corner.iou() > 0.999);
  // The common side is no boundary of what the two hold together.
  const Rebuilt side = rebuilt(cube_mesh(10) + cube_mesh(10, {10, 0, 0}));
  CHECK_MESSAGE(side.outcome.says("4 duplicate triangles were removed"), side.outcome.err);
  CHECK(side.literals() == 1);
  CHECK(side.iou() > 0.999);
}

TEST_CASE("a solid that is there twice, in either orientation, counts once") {
  for (const TextMesh& copy : {cube_mesh(10), cube_mesh(10).flipped()}) {
    const Rebuilt twice = rebuilt(cube_mesh(10) + copy);
    CHECK_MESSAGE(twice.outcome.says("12 duplicate triangles were removed"), twice.outcome.err);
    CHECK(twice.input().at("is_closed") == true);
    CHECK(twice.literals() == 1);
    CHECK(twice.iou() > 0.999);
  }
}

TEST_CASE("triangles that face the wrong way are turned") {
  TextMesh mixed = cube_mesh(10);
  for (const int t : {0, 3, 6}) std::swap(mixed.triangles[t][1], mixed.triangles[t][2]);
  const Rebuilt some = rebuilt(mixed);
  CHECK_MESSAGE(some.outcome.says("3 triangles were turned"), some.outcome.err);
  CHECK(some.literals() == 1);
  const Rebuilt all = rebuilt(cube_mesh(10).flipped());
  CHECK_MESSAGE(all.outcome.says("inside out"), all.outcome.err);
  CHECK(all.input().at("was_inside_out") == true);
  CHECK(all.iou() > 0.999);
}

TEST_CASE("a fin on a solid is reported as open and does not change the solid") {
  TextMesh finned = cube_mesh(10);
  finned.vertices.push_back({12, 5, 5});
  finned.triangles.push_back({1, 3, 8});
  const Rebuilt found = rebuilt(finned);
  CHECK_MESSAGE(found.outcome.says("2 boundary edges around 1 hole"), found.outcome.err);
  CHECK_MESSAGE(found.outcome.says("more than two triangles"), found.outcome.err);
  CHECK(found.input().at("is_closed") == false);
  CHECK(found.literals() == 1);
  CHECK(found.iou() > 0.95);
}

TEST_CASE("a box without its lid is closed by the majority") {
  TextMesh open = cube_mesh(10);
  open.triangles.resize(10);
  const Rebuilt found = rebuilt(open);
  CHECK_MESSAGE(found.outcome.says("4 boundary edges around 1 hole"), found.outcome.err);
  CHECK(found.input().at("holes") == 1);
  CHECK(found.literals() == 1);
  CHECK(found.iou() > 0.9);
}

TEST_CASE("two triangles with nothing between them give no tree but advice") {
  const TextMesh wedge{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 3}}};
  const Outcome outcome = refused(wedge);
  CHECK(outcome.exit_code == kFailed);
  CHECK_MESSAGE(outcome.says("close the mesh's 1 holes (4 boundary edges)"), outcome.err);
}

TEST_CASE("a one-sided surface is said to have no inside") {
  TextMesh strip;
  constexpr int kSteps = 12;
  for (int i = 0; i < kSteps; ++i) {
    const double turn = 2 * std::numbers::pi * i / kSteps;
    for (const int side : {-1, 1}) {
      const double r = 5 + side * std::cos(turn / 2);
      strip.vertices.push_back({r * std::cos(turn), r * std::sin(turn), side * std::sin(turn / 2)});
    }
  }
  for (int i = 0; i < kSteps; ++i) {
    const int a = 2 * i;
    const bool is_last = i == kSteps - 1;
    const int c = is_last ? 1 : a + 2;  // the ends meet with a half turn
    const int d = is_last ? 0 : a + 3;
    strip.triangles.push_back({a, a + 1, d});
    strip.triangles.push_back({a, d, c});
  }
  const Folder folder;
  const Outcome info = run_hewn({"info", folder.write("strip.off", strip.off())});
  CHECK(info.exit_code == 0);
  CHECK_MESSAGE((info.out + info.err).find("one-sided") != std::string::npos, info.out, info.err);
}

TEST_CASE("triangles without an area are refused with their number") {
  TextMesh point = cube_mesh(0, {1, 1, 1});
  TextMesh row = cube_mesh(10);
  for (auto& v : row.vertices) v = {v[0] + 2 * v[1] + 4 * v[2], 0, 0};
  for (const TextMesh& mesh : {point, row}) {
    const Outcome outcome = refused(mesh);
    CHECK(outcome.exit_code == kBadInput);
    CHECK_MESSAGE(outcome.says("no triangle with an area is left of the 12 read"), outcome.err);
  }
}

TEST_CASE("size and place do not matter") {
  for (const double scale : {1e-30, 1e-3, 1e30}) {
    CAPTURE(scale);
    CHECK(rebuilt(cube_mesh(scale)).literals() == 1);
  }
  // A thousand diagonals away, where single precision would have lost the shape.
  const Rebuilt far = rebuilt(cube_mesh(10, {1e6, -1e6, 1e6}));
  CHECK(far.literals() == 1);
  CHECK(far.iou() > 0.999);
}

}  // namespace
}  // namespace hewn::cli
