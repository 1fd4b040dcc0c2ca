/// One table: every kernel's job, copies included, on one core, on all cores and on the GPU; there
/// also the kernels alone, against what they must do at least.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "bench/devices/ceilings.h"
#include "bench/devices/ring_mesh.h"
#include "bench/devices/timed_device.h"
#include "core/base/rng.h"
#include "core/compute/cpu_device.h"
#include "core/compute/curvature_job.h"
#include "core/compute/fit_batch.h"
#include "core/compute/generations.h"
#include "core/compute/pair_counts.h"
#include "core/compute/signatures.h"
#include "core/compute/surface_scores.h"
#include "core/compute/tree_batch.h"
#include "core/compute/winding.h"
#include "gpu/cuda_device.h"

namespace hewn {
namespace {

constexpr int kRounds = 5;
constexpr double kLong_s = 1;

/// What a job's kernels must do at least (docs/performance.md has the counts).
struct Floor {
  double logic = 0;    ///< 32-bit logic operations
  double doubles = 0;  ///< operations in double precision
  double bytes = 0;    ///< read or written
};

/// A job and its size, for rates.
struct Task {
  std::string name;
  double work;  ///< in units of `unit`
  const char* unit;
  std::function<Result<void>(Device&)> job;
  Floor floor;
};

/// What every job pays for its data, there and back.
Task copies_task(std::size_t bytes) {
  auto data = std::make_shared<std::vector<std::uint64_t>>(bytes / sizeof(std::uint64_t), 1);
  const auto total = static_cast<double>(2 * bytes);
  return {"copies of " + std::to_string(bytes >> 10) + " KiB there and back",
          total,
          "bytes",
          [=](Device& device) {
            DeviceJob job(device);
            const auto there = job.upload(std::span<const std::uint64_t>(*data));
            job.download(there, std::span(*data));
            return job.result();
          },
          {}};
}

std::vector<SurfaceForm> random_surfaces(std::size_t count, Rng& rng) {
  std::vector<SurfaceForm> surfaces(count);
  for (std::size_t k = 0; k < count; ++k) {
    SurfaceForm& s = surfaces[k];
    s.kind = static_cast<SurfaceKind>(k % 5);
    for (double& c : s.point) c = rng.uniform(-1, 1);
    Vec3 axis;
    for (double& c : axis) c = rng.uniform(-1, 1);
    axis.normalize();
    for (int c = 0; c < 3; ++c) s.axis[c] = axis[c];
    s.first = rng.uniform(0.1, 0.8);
    s.second = s.kind == SurfaceKind::Cone ? std::sqrt(1 - s.first * s.first) : 0.9;
  }
  return surfaces;
}

std::vector<Vec3> random_points(std::size_t count, Rng& rng) {
  std::vector<Vec3> points(count);
  for (Vec3& p : points) {
    for (double& c : p) c = rng.uniform(-2, 2);
  }
  return points;
}

Floor column_floor(std::size_t surfaces, std::size_t points) {
  // In the mean of the five kinds; a square root counts once.
  const double pairs = static_cast<double>(surfaces) * static_cast<double>(points);
  return {0, 18 * pairs, pairs / 8 + 24 * static_cast<double>(points)};
}

Task columns_task(std::size_t surface_count, std::size_t point_count) {
  Rng rng(1);
  auto surfaces = random_surfaces(surface_count, rng);
  auto points = random_points(point_count, rng);
  auto columns = std::vector<Word>(surface_count * padded_words(point_count));
  return {
      "columns, " + std::to_string(surface_count) + " x " + std::to_string(point_count),
      static_cast<double>(surface_count) * static_cast<double>(point_count), "distances",
      [=](Device& device) mutable { return fill_columns(device, surfaces, points, columns, {}); },
      column_floor(surface_count, point_count)};
}

Task signatures_task(std::size_t surface_count, std::size_t point_count) {
  Rng rng(2);
  auto surfaces = random_surfaces(surface_count, rng);
  auto points = random_points(point_count, rng);
  const std::size_t stride = (surface_count + 63) / 64;
  auto rows = std::vector<Word>(point_count * stride);
  return {"signatures, " + std::to_string(surface_count) + " x " + std::to_string(point_count),
          static_cast<double>(surface_count) * static_cast<double>(point_count), "distances",
          [=](Device& device) mutable {
            return add_signatures(device, surfaces, points, 0, {rows, stride}, {});
          },
          column_floor(surface_count, point_count)};
}

Task cells_task(std::size_t point_count, std::size_t stride) {
  Rng rng(3);
  std::vector<Word> kinds(1000 * stride);
  for (Word& w : kinds) w = rng.next();
  std::vector<Word> rows;
  for (std::size_t i = 0; i < point_count; ++i) {
    const auto kind = static_cast<std::ptrdiff_t>(rng.below(1000) * stride);
    rows.insert(rows.end(), kinds.begin() + kind,
                kinds.begin() + kind + static_cast<std::ptrdiff_t>(stride));
  }
  return {"cells, " + std::to_string(point_count) + " rows of " + std::to_string(stride),
          static_cast<double>(point_count),
          "rows",
          [=](Device& device) -> Result<void> {
            const auto numbers = number_distinct_rows(device, rows, stride);
            return numbers ? Result<void>() : Result<void>(numbers.error());
          },
          {0, 0, static_cast<double>(point_count) * (16 * static_cast<double>(stride) + 16)}};
}

void append_tree(std::vector<Token>& out, std::size_t leaves, Rng& rng) {
  if (leaves == 1) {
    out.push_back(static_cast<Token>(rng.below(64)));
    return;
  }
  const std::size_t left = 1 + rng.below(leaves - 1);
  append_tree(out, left, rng);
  append_tree(out, leaves - left, rng);
  out.push_back(static_cast<Token>(kUnionToken - static_cast<Token>(rng.below(3))));
}

Floor tree_floor(std::size_t trees, double operations, std::size_t rows) {
  // Each operation, whether its operands overlap, two population counts and the wanted rows.
  const double words = static_cast<double>(trees) * static_cast<double>(rows) / 32;
  return {words * (2 * operations + 3), 0, 0};
}

/// Trees of 31 nodes over 64 columns. The columns stay on the device between rounds.
Task trees_task(std::size_t trees, std::size_t rows) {
  Rng rng(4);
  std::vector<std::vector<Word>> columns(64, std::vector<Word>(padded_words(rows)));
  for (auto& column : columns) {
    for (std::size_t w = 0; w < rows / 64; ++w) column[w] = rng.next();
  }
  auto table = std::make_shared<MeasuredRows>(rows, columns, columns[0]);
  auto batch = std::make_shared<TreeBatch>();
  for (std::size_t t = 0; t < trees; ++t) {
    std::vector<Token> tree;
    append_tree(tree, 16, rng);
    batch->add(tree);
  }
  auto measured = std::make_shared<std::vector<TreeMeasures>>(trees);
  return {std::to_string(trees) + " trees of 31 nodes, " + std::to_string(rows) + " rows",
          static_cast<double>(trees), "trees",
          [=](Device& device) { return table->measure(device, *batch, *measured, {}); },
          tree_floor(trees, 15, rows)};
}

/// What pairs of literals keep of the open cells.
Task pairs_task(std::size_t column_count, std::size_t rows) {
  Rng rng(7);
  const std::size_t words = padded_words(rows);
  auto bits = std::make_shared<std::vector<Word>>((column_count + 2) * words);
  for (Word& w : *bits) w = rng.next();
  std::vector<const Word*> columns;
  for (std::size_t k = 0; k < column_count; ++k) columns.push_back(bits->data() + k * words);
  auto pairs = std::make_shared<PairCounts>(columns, words);
  const auto count = static_cast<double>(column_count) * static_cast<double>(column_count + 1) / 2;
  return {
      "pairs of " + std::to_string(column_count) + " columns, " + std::to_string(rows) + " rows",
      count,
      "pairs",
      [=](Device& device) {
        const std::span<const Word> sets = std::span(*bits).subspan(column_count * words);
        return pairs->count(device, sets.first(words), sets.subspan(words), {});
      },
      // Three operands each for two sets, and what is counted.
      {4 * count * static_cast<double>(rows) / 32, 0, 0}};
}

std::shared_ptr<SurfaceScores> random_scores(std::size_t primitives, std::size_t samples) {
  Rng rng(5);
  auto table = std::make_shared<SurfaceScores>(primitives, samples);
  for (std::size_t k = 0; k < primitives; ++k) {
    for (std::size_t i = 0; i < samples; ++i) {
      table->set(k, i, {static_cast<float>(rng.uniform(-1, 1)), 1000, 10});
    }
  }
  return table;
}

/// Trees of 31 nodes over 64 primitives.
Task scores_task(std::size_t trees, std::size_t samples) {
  Rng rng(6);
  constexpr std::size_t kPrimitives = 64;
  auto table = random_scores(kPrimitives, samples);
  auto batch = std::make_shared<TreeBatch>();
  for (std::size_t t = 0; t < trees; ++t) {
    std::vector<Token> tree;
    append_tree(tree, 16, rng);
    batch->add(tree);
  }
  auto totals = std::make_shared<std::vector<std::uint64_t>>(trees);
  const double pairs = static_cast<double>(trees) * static_cast<double>(samples);
  return {std::to_string(trees) + " surface scores, " + std::to_string(samples) + " samples",
          static_cast<double>(trees),
          "trees",
          [=](Device& device) { return table->measure(device, *batch, *totals, {}); },
          // A comparison and two choices for each operation.
          {3 * 15 * pairs, 0, 0}};
}

/// A genetic search over 64 primitives: what a generation takes, once the trees are on the device.
Task generations_task(std::size_t trees, std::size_t samples) {
  constexpr int kGenerations = 20;
  constexpr std::size_t kPrimitives = 64;
  constexpr int kLeaves = 40;
  auto scores = random_scores(kPrimitives, samples);
  Rng rng(9);
  auto first = std::make_shared<std::vector<std::vector<Token>>>(trees);
  for (auto& tree : *first) append_tree(tree, kLeaves, rng);
  const BreedingRules rules{kPrimitives, 127, 0.3, 0.3, 2};
  const TreeWorth worth{2.0 * SurfaceScoreKernel::kLargestScore * static_cast<double>(samples),
                        1e-5};
  const double bred = kGenerations * static_cast<double>(trees);
  return {std::to_string(kGenerations) + " generations of " + std::to_string(trees) + ", " +
              std::to_string(samples) + " samples",
          bred,
          "trees",
          [=](Device& device) -> Result<void> {
            Generations generations(device, *scores, rules, worth);
            if (auto done = generations.begin(*first, {}); !done) return done;
            for (int i = 0; i < kGenerations; ++i) {
              const std::vector<std::int32_t> elite = {0, 1};
              const auto done = generations.breed(elite, static_cast<std::uint64_t>(i), {});
              if (!done) return done;
            }
            return {};
          },
          // A comparison and two choices for each operation of trees as long as the first.
          {3.0 * (kLeaves - 1) * bred * static_cast<double>(samples), 0, 0}};
}

/// All stages of segmentation by curvature on a torus of 2 n^2 triangles.
Task curvature_task(int n) {
  auto mesh = std::make_shared<RingMesh>(n);
  const auto triangles = static_cast<double>(mesh->triangles.size());
  const CurvatureJobOptions options{0.44, 0.7, 1.05, false, {0.01, 0.3, 0.3, 1.5}};
  return {"curvature of " + std::to_string(mesh->triangles.size()) + " triangles",
          triangles,
          "triangles",
          [=](Device& device) -> Result<void> {
            const RunContext run;
            CurvatureJob job(device, mesh->arrays(), options, run);
            const auto classes = job.classes();
            const auto regions = job.regions();
            return job.result();
          },
          // Each pass reads its triangle and writes its result once.
          {0, 0, 1050 * triangles}};
}

/// Random points around a torus of 2 n^2 triangles.
Task inside_task(int n, std::size_t point_count) {
  const RingMesh mesh(n);
  auto tree = std::make_shared<WindingTree>(mesh.vertices, mesh.triangles, true);
  Rng rng(6);
  auto points = random_points(point_count, rng);
  for (Vec3& p : points) p = 2 * p.cwiseProduct(Vec3(1, 1, 0.3));
  auto inside = std::vector<Inside>(point_count);
  return {"inside of " + std::to_string(mesh.triangles.size()) + " triangles, " +
              std::to_string(point_count) + " points",
          static_cast<double>(point_count),
          "points",
          [=](Device& device) mutable { return tree->find_inside(device, points, inside, {}); },
          // Each point and its answer.
          {0, 0, 25 * static_cast<double>(point_count)}};
}

/// Points of a cylinder's flank about a random axis, and a guess near it.
void add_cylinder_fit(std::size_t point_count, Rng& rng, FitBatch& batch) {
  FitTarget target;
  target.kind = SurfaceKind::Cylinder;
  SurfaceForm guess = random_surfaces(3, rng)[static_cast<std::size_t>(target.kind)];
  for (double& c : guess.point) c *= 0.1;
  const RowFrame frame = row_frame(guess);
  std::vector<PlainVec> points;
  for (std::size_t i = 0; i < point_count; ++i) {
    const double turn = rng.uniform(0, 2);
    const double radius = guess.first + rng.uniform(-1e-3, 1e-3);
    points.push_back(frame.point + frame.axis * rng.uniform(-0.5, 0.5) +
                     frame.tilt.u * (radius * std::cos(turn)) +
                     frame.tilt.w * (radius * std::sin(turn)));
  }
  guess.first *= 1.1;
  guess.point[0] += 0.02;
  batch.add(target, guess, {points});
}

Task fits_task(std::size_t fits, std::size_t points) {
  Rng rng(8);
  auto batch = std::make_shared<FitBatch>();
  for (std::size_t f = 0; f < fits; ++f) add_cylinder_fit(points, rng, *batch);
  // A row, the sums over its pairs, and the costs, in four rounds at least.
  constexpr double kOperations = 4 * (30 + 45 + 6);
  return {std::to_string(fits) + " cylinder fits, " + std::to_string(points) + " points",
          static_cast<double>(fits),
          "fits",
          [=](Device& device) { return batch->solve(device, {}); },
          {0, kOperations * static_cast<double>(fits) * static_cast<double>(points), 0}};
}

double now_s(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Seconds by `now` of the middle one of several rounds after one to warm up, or of a single one
/// that takes long; negative: it failed.
double median_seconds(Device& device, const Task& task, const std::function<double()>& now) {
  std::vector<double> seconds;
  for (int round = 0; round <= kRounds; ++round) {
    const double start = now();
    const Result<void> done = task.job(device);
    if (!done) {
      std::fprintf(stderr, "%s: %s\n", task.name.c_str(), done.error().message.c_str());
      return -1;
    }
    const double taken = now() - start;
    if (round == 0 && taken > kLong_s) return taken;
    if (round > 0) seconds.push_back(taken);
  }
  std::nth_element(seconds.begin(), seconds.begin() + kRounds / 2, seconds.end());
  return seconds[kRounds / 2];
}

double wall_s() { return now_s(CLOCK_MONOTONIC); }
double processor_s() { return now_s(CLOCK_PROCESS_CPUTIME_ID); }

/// Where the rows are measured.
struct Machines {
  std::string filter;  ///< part of the names of the jobs to measure
  CpuDevice one{1};
  CpuDevice all{0};
  Device* gpu = nullptr;                 ///< or none
  std::unique_ptr<TimedDevice> kernels;  ///< the same without copies
  Ceilings ceilings;
};

/// The share of the measured time that the job must take at least, by whichever ceiling binds.
double floor_share(const Floor& floor, const Ceilings& ceilings, double seconds) {
  return std::max({floor.logic / ceilings.logic, floor.doubles / ceilings.doubles,
                   floor.bytes / ceilings.bytes}) /
         seconds;
}

void print_row(Machines& machines, const Task& task) {
  if (task.name.find(machines.filter) == std::string::npos) return;
  // Processor time, which other programs disturb least; with several threads that says nothing.
  const double one_s = median_seconds(machines.one, task, processor_s);
  const double all_s = median_seconds(machines.all, task, wall_s);
  std::printf("%-42s %10.3f %10.3f %6.2f", task.name.c_str(), one_s * 1e3, all_s * 1e3,
              one_s / all_s);
  if (machines.gpu == nullptr) {
    std::printf("  %10.3g %s/s\n", task.work / all_s, task.unit);
    return;
  }
  const double gpu_s = median_seconds(*machines.gpu, task, wall_s);
  const double kernels_s =
      median_seconds(*machines.kernels, task, [&] { return machines.kernels->kernel_seconds(); });
  std::printf(" %10.3f %8.1f", gpu_s * 1e3, all_s / gpu_s);
  if (kernels_s == 0) {
    std::printf(" %10s %7s  %10.3g %s/s\n", "-", "-", task.work / gpu_s, task.unit);
    return;
  }
  std::printf(" %10.3f %5.0f %%  %10.3g %s/s\n", kernels_s * 1e3,
              100 * floor_share(task.floor, machines.ceilings, kernels_s), task.work / kernels_s,
              task.unit);
}

void print_heading(Machines& machines, const std::string& gpu) {
  std::printf("GPU: %s\n", gpu.c_str());
  if (machines.gpu != nullptr) {
    std::printf(
        "its ceilings: %.3g logic operations, %.3g double operations, %.3g bytes a second\n",
        machines.ceilings.logic, machines.ceilings.doubles, machines.ceilings.bytes);
  }
  std::printf("cores: %u\n\n%-42s %10s %10s %6s", std::max(1u, std::thread::hardware_concurrency()),
              "job, copies included", "1 core ms", "cores ms", "ratio");
  if (machines.gpu != nullptr) {
    std::printf(" %10s %8s %10s %7s", "GPU ms", "ratio", "kernels ms", "floor");
  }
  std::printf("  %10s\n", machines.gpu != nullptr ? "kernels' rate" : "rate");
}

int run(const std::string& filter) {
  auto opened = open_cuda_device(0);
  Machines machines;
  machines.filter = filter;
  if (opened) {
    const auto ceilings = measure_ceilings(0);
    if (!ceilings) {
      std::fprintf(stderr, "%s\n", ceilings.error().message.c_str());
      return 1;
    }
    machines.gpu = opened->get();
    machines.kernels = std::make_unique<TimedDevice>(*machines.gpu);
    machines.ceilings = *ceilings;
  }
  print_heading(machines, opened ? machines.gpu->info().name : opened.error().message);
  print_row(machines, copies_task(std::size_t{1} << 16));
  print_row(machines, copies_task(std::size_t{1} << 27));
  for (const auto& [surfaces, points] :
       {std::pair<std::size_t, std::size_t>{36, 40000}, {1000, 100000}}) {
    print_row(machines, columns_task(surfaces, points));
    print_row(machines, signatures_task(surfaces, points));
  }
  const bool has_gpu = machines.gpu != nullptr;
  if (has_gpu) print_row(machines, columns_task(1000, 1000000));
  print_row(machines, cells_task(40000, 1));
  print_row(machines, cells_task(1000000, 2));
  print_row(machines, trees_task(150, 4096));
  print_row(machines, trees_task(has_gpu ? 1000000 : 100000, 4096));
  print_row(machines, trees_task(has_gpu ? 200000 : 10000, 65536));
  print_row(machines, pairs_task(120, 6000));
  print_row(machines, pairs_task(1000, 50000));
  print_row(machines, scores_task(150, 2000));
  print_row(machines, scores_task(has_gpu ? 50000 : 1000, 4096));
  print_row(machines, generations_task(150, 2000));
  print_row(machines, generations_task(has_gpu ? 5000 : 500, 2000));
  print_row(machines, curvature_task(100));
  print_row(machines, curvature_task(708));
  print_row(machines, fits_task(50, 300));
  print_row(machines, fits_task(1000, 1000));
  print_row(machines, inside_task(100, 100000));
  print_row(machines, inside_task(708, 1000000));
  return 0;
}

}  // namespace
}  // namespace hewn

/// Usage: device_table [PART], for the jobs with PART in their names.
int main(int argc, char** argv) {
  // Rows as they are measured, into files too.
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  return hewn::run(argc > 1 ? argv[1] : "");
}
