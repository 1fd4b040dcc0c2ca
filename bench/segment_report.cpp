/// Prints one line for each mesh file: groups, kinds, explained share, deviations, and
/// the time of segmentation and regularisation (wall clock; of segmentation the processor's, too).
#include <array>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "app/heap.h"
#include "core/fit/surface_set.h"
#include "core/mesh/load.h"
#include "core/segment/segment.h"

namespace hewn {
namespace {

bool set_option(SegmentOptions& options, std::string_view name, double value) {
  for (const OptionField<SegmentOptions>& field : option_table<SegmentOptions>()) {
    if (field.name != name) continue;
    std::visit(
        [&](auto member) {
          using Value = std::remove_reference_t<decltype(options.*member)>;
          options.*member = static_cast<Value>(value);
        },
        field.member);
    return true;
  }
  return false;
}

void report(const std::string& path, const SegmentOptions& options, int threads, bool verbose) {
  RunContext run;
  run.threads = threads;
  const auto loaded = load_mesh(path, {}, run);
  if (!loaded) {
    fmt::print("{} {}\n", path, loaded.error().message);
    return;
  }
  const Mesh& mesh = loaded->mesh;
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processor_start = std::clock();
  const auto result = segment(mesh, options, run);
  const double processor_seconds =
      static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC;
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string name = std::filesystem::path(path).stem().string();
  if (!result) {
    fmt::print("{} {}\n", name, result.error().message);
    return;
  }
  const auto middle = std::chrono::steady_clock::now();
  const auto regular = regularise(mesh, *result, {}, run);
  const double seconds2 =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - middle).count();
  const double d = mesh.diagonal();
  std::array<int, 5> kinds{};
  double worst = 0, explained = 0;
  for (const Halfspace& h : regular->halfspaces) ++kinds[static_cast<int>(h.surface.kind)];
  for (std::size_t i = 0; i < result->groups.size(); ++i) {
    const FaceGroup& g = result->groups[i];
    worst = std::max(worst, g.rms_deviation / d);
    const int h = regular->halfspace_of_group[i];
    if (h < 0) continue;
    for (const int t : g.triangles) {
      bool on = true;
      for (const int v : mesh.triangles[t]) {
        on = on &&
             std::abs(regular->halfspaces[h].surface.signed_distance(mesh.vertices[v])) <= 1e-3 * d;
      }
      if (on) explained += mesh.areas[t];
    }
  }
  const int curved = kinds[1] + kinds[2] + kinds[3] + kinds[4];
  fmt::print(
      "{} T {} facets {} groups {} surf {} (curved {}: plane {} sphere {} cyl {} cone {} torus {}) "
      "dirs {} expl {:.4f} "
      "rms {:.1e} noise {:.1e} {:.3f} + {:.3f} s, processor {:.3f} s\n",
      name, mesh.triangles.size(), result->facets.size(), result->groups.size(),
      regular->halfspaces.size(), curved, kinds[0], kinds[1], kinds[2], kinds[3], kinds[4],
      regular->directions.size(), explained / mesh.total_area, worst, result->noise / d, seconds,
      seconds2, processor_seconds);
  if (!verbose) return;
  for (const Halfspace& h : regular->halfspaces) {
    const Surface& s = h.surface;
    fmt::print(
        "  H {:8} area {:.2e} tol {:.1e} off {:.1e} p ({:.9g} {:.9g} {:.9g}) a ({:.9g} "
        "{:.9g} {:.9g}) o {:.9g} r {:.9g} R {:.9g} al {:.9g} sides {} {:.4f} {} {:.4f}\n",
        name_of(s.kind), h.area / mesh.total_area, h.tolerance / d, h.mean_offset / d, s.point.x(),
        s.point.y(), s.point.z(), s.axis.x(), s.axis.y(), s.axis.z(), s.offset, s.radius,
        s.major_radius, s.half_angle_rad * 180 / kPi, h.facets.sides,
        h.facets.phase_rad * 180 / kPi, h.facets.tube_sides, h.facets.tube_phase_rad * 180 / kPi);
  }
  for (const FaceGroup& g : result->groups) {
    const Surface& s = g.surface;
    fmt::print(
        "  {:8} n {:5} area {:.2e} max {:.1e} rms {:.1e} p ({:.5f} {:.5f} {:.5f}) a ({:.5f} "
        "{:.5f} {:.5f}) o {:.5f} r {:.6f} R {:.6f} al {:.4f} {}\n",
        name_of(s.kind), g.triangles.size(), g.area / mesh.total_area, g.max_deviation / d,
        g.rms_deviation / d, s.point.x(), s.point.y(), s.point.z(), s.axis.x(), s.axis.y(),
        s.axis.z(), s.offset, s.radius, s.major_radius, s.half_angle_rad * 180 / kPi,
        g.is_fitted ? "" : "UNFITTED");
  }
}

}  // namespace
}  // namespace hewn

int main(int argc, char** argv) {
  hewn::keep_freed_memory();
  hewn::use_large_pages();
  // segment_report [-v] [--threads N] [--OPTION VALUE]... FILE...
  bool verbose = false;
  int threads = 0;
  hewn::SegmentOptions options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "-v") {
      verbose = true;
    } else if (word == "--threads" && i + 1 < argc) {
      threads = std::atoi(argv[++i]);
    } else if (word.starts_with("--") && i + 1 < argc) {
      if (!hewn::set_option(options, word.substr(2), std::atof(argv[++i]))) {
        fmt::print(stderr, "segment_report: no option {}\n", word);
        return 2;
      }
    } else {
      hewn::report(argv[i], options, threads, verbose);
    }
  }
}
