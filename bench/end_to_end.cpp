/// The end-to-end table: every part through segmentation, fitting and search, with times per stage.
///
///   end_to_end [OPTION]... MESH...
///
///   --threads N, --device NAME, --seed N, --out DIR, --evolve, --set NAME=NUMBER
///
/// `--evolve` takes the published genetic search. `--set` takes the options of either
/// search, for measuring what each is worth. A GPU stays open from one part to the next: a part
/// named twice tells what opening it costs. The last line has the sums and the peak memory.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>

#include "app/heap.h"
#include "core/compute/compute.h"
#include "core/fit/surface_set.h"
#include "core/io/openscad.h"
#include "core/mesh/load.h"
#include "core/segment/segment.h"
#include "core/synth/evolve/evolve_tree.h"
#include "core/synth/find_tree.h"
#include "gpu/cuda_device.h"

namespace hewn {
namespace {

class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

struct Totals {
  int parts = 0;
  int literals = 0;
  double seconds = 0;
};

/// Applies "name=number"; false when there is no such option.
template <class Options>
bool set_option(Options& options, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) return false;
  for (const auto& field : option_table<Options>()) {
    if (field.name != assignment.substr(0, equals)) continue;
    const auto* member = std::get_if<int Options::*>(&field.member);
    if (member == nullptr) return false;
    options.*(*member) = std::atoi(assignment.c_str() + equals + 1);
    return true;
  }
  return false;
}

/// The most memory that was resident at once, in MB.
double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts in KB
}

struct Setup {
  RunContext run;
  TreeSearchOptions search;
  EvolveOptions evolution;
  bool evolves = false;
  std::string out;
};

Result<TreeAnswer> search(const TreeProblem& problem, const Setup& setup) {
  return setup.evolves ? evolve_tree(problem, setup.evolution, setup.run)
                       : find_tree(problem, setup.search, setup.run);
}

Result<void> run_part(const std::filesystem::path& path, const Setup& setup, Totals& totals) {
  const RunContext& run = setup.run;
  const std::string& out = setup.out;
  Stopwatch watch;
  const auto loaded = load_mesh(path, {}, run);
  if (!loaded) return loaded.error();
  const auto mesh = std::make_shared<const Mesh>(loaded->mesh);
  const double load = watch.lap();
  const auto segmentation = segment(*mesh, {}, run);
  if (!segmentation) return segmentation.error();
  const double segmented = watch.lap();
  const auto surfaces = regularise(*mesh, *segmentation, {}, run);
  if (!surfaces) return surfaces.error();
  const MeshQuery query(mesh);
  const double regularised = watch.lap();
  TreeProblem problem;
  problem.query = &query;
  problem.segmentation = &*segmentation;
  problem.surfaces = &*surfaces;
  const auto answer = search(problem, setup);
  if (!answer) return answer.error();
  const double searched = watch.lap();
  const int literals = literal_count(answer->tree);
  const double total = load + segmented + regularised + searched;
  fmt::print(
      "{:8s} {:7d} {:5d} {:5d} {:4d} {:6d} {:5d} {:4d} {:8.5f} {:3d} {:8d} {:6.2f} {:6.2f} "
      "{:6.2f} {:6.2f} {:7.2f}\n",
      path.stem().string(), mesh->triangles.size(), segmentation->groups.size(), answer->halfspaces,
      answer->separating, answer->cells, tree_size(answer->tree), literals, answer->agreement,
      answer->rounds, answer->terms_grown, load, segmented, regularised, searched, total);
  std::fflush(stdout);
  ++totals.parts;
  totals.literals += literals;
  totals.seconds += total;
  if (!out.empty()) {
    return write_openscad(answer->tree, out + "/" + path.stem().string() + ".scad", {}, {});
  }
  return {};
}

}  // namespace
}  // namespace hewn

int main(int argc, char** argv) {
  hewn::keep_freed_memory();
  hewn::use_large_pages();
  hewn::Setup setup;
  setup.run.threads = 1;
  hewn::DeviceChoice device;
  std::vector<std::string> meshes;
  for (int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    if (arg == "--threads" && i + 1 < argc) {
      setup.run.threads = std::atoi(argv[++i]);
    } else if (arg == "--device" && i + 1 < argc) {
      const auto parsed = hewn::DeviceChoice::parse(argv[++i]);
      if (!parsed) {
        fmt::print(stderr, "{}\n", parsed.error().message);
        return 2;
      }
      device = *parsed;
    } else if (arg == "--evolve") {
      setup.evolves = true;
    } else if (arg == "--seed" && i + 1 < argc) {
      setup.run.seed = static_cast<std::uint64_t>(std::atoll(argv[++i]));
    } else if (arg == "--out" && i + 1 < argc) {
      setup.out = argv[++i];
    } else if (arg == "--set" && i + 1 < argc) {
      const char* assignment = argv[++i];
      const bool is_of_list = hewn::set_option(setup.search, assignment);
      const bool is_of_evolution = hewn::set_option(setup.evolution, assignment);
      if (!is_of_list && !is_of_evolution) {
        fmt::print(stderr, "no such option: {}\n", assignment);
        return 2;
      }
    } else {
      meshes.push_back(arg);
    }
  }
  setup.run.compute =
      std::make_shared<hewn::Compute>(setup.run.threads, device, hewn::open_cuda_device);
  fmt::print(
      "part     triangl group halfs  sep  cells  size  lit  agreemt rnd    terms   load "
      "segmnt regular search   total\n");
  hewn::Totals totals;
  int failed = 0;
  for (const std::string& mesh : meshes) {
    const auto done = hewn::run_part(mesh, setup, totals);
    if (!done) {
      fmt::print("{}: {}\n", mesh, done.error().message);
      ++failed;
    }
  }
  fmt::print("{} parts, {} literals, {:.2f} s, {:.0f} MB\n", totals.parts, totals.literals,
             totals.seconds, hewn::peak_memory_mb());
  return failed == 0 ? 0 : 1;
}
