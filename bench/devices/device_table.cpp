/// One table: every kernel's job, copies included, on one core, on all cores and on the GPU.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "core/base/rng.h"
#include "core/compute/cpu_device.h"
#include "core/compute/signatures.h"
#include "core/compute/tree_batch.h"
#include "gpu/cuda_device.h"

namespace hewn {
namespace {

constexpr int kRounds = 5;

/// A job and its size, for rates.
struct Task {
  std::string name;
  double work;  ///< in units of `unit`
  const char* unit;
  std::function<Result<void>(Device&)> job;
};

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

Task columns_task(std::size_t surface_count, std::size_t point_count) {
  Rng rng(1);
  auto surfaces = random_surfaces(surface_count, rng);
  auto points = random_points(point_count, rng);
  auto columns = std::vector<Word>(surface_count * padded_words(point_count));
  return {
      "columns, " + std::to_string(surface_count) + " x " + std::to_string(point_count),
      static_cast<double>(surface_count) * static_cast<double>(point_count), "distances",
      [=](Device& device) mutable { return fill_columns(device, surfaces, points, columns, {}); }};
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
          }};
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
          static_cast<double>(point_count), "rows", [=](Device& device) -> Result<void> {
            const auto numbers = number_distinct_rows(device, rows, stride);
            return numbers ? Result<void>() : Result<void>(numbers.error());
          }};
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
          [=](Device& device) { return table->measure(device, *batch, *measured, {}); }};
}

double now_s(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Seconds of the middle one of several rounds after one to warm up; negative: it failed.
double median_seconds(Device& device, const Task& task, clockid_t clock = CLOCK_MONOTONIC) {
  std::vector<double> seconds;
  for (int round = 0; round <= kRounds; ++round) {
    const double start = now_s(clock);
    const Result<void> done = task.job(device);
    if (!done) {
      std::fprintf(stderr, "%s: %s\n", task.name.c_str(), done.error().message.c_str());
      return -1;
    }
    if (round > 0) seconds.push_back(now_s(clock) - start);
  }
  std::nth_element(seconds.begin(), seconds.begin() + kRounds / 2, seconds.end());
  return seconds[kRounds / 2];
}

void print_row(const Task& task, CpuDevice& one, CpuDevice& all, Device* gpu) {
  // Processor time, which other programs disturb least; with several threads that says nothing.
  const double one_s = median_seconds(one, task, CLOCK_PROCESS_CPUTIME_ID);
  const double all_s = median_seconds(all, task);
  std::printf("%-42s %10.3f %10.3f %6.2f", task.name.c_str(), one_s * 1e3, all_s * 1e3,
              one_s / all_s);
  const double gpu_s = gpu != nullptr ? median_seconds(*gpu, task) : 0;
  if (gpu_s > 0) {
    std::printf(" %10.3f %8.1f", gpu_s * 1e3, all_s / gpu_s);
  } else {
    std::printf(" %10s %8s", "-", "-");
  }
  const double best_s = gpu_s > 0 ? std::min(gpu_s, all_s) : all_s;
  std::printf("  %10.3g %s/s\n", task.work / best_s, task.unit);
}

int run() {
  auto opened = open_cuda_device(0);
  Device* gpu = opened ? opened->get() : nullptr;
  std::printf("GPU: %s\n",
              gpu != nullptr ? gpu->info().name.c_str() : opened.error().message.c_str());
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  std::printf("cores: %u\n\n%-42s %10s %10s %6s %10s %8s  %s\n", cores, "job, copies included",
              "1 core ms", "cores ms", "ratio", "GPU ms", "ratio", "best rate");
  CpuDevice one(1);
  CpuDevice all(0);
  for (const auto& [surfaces, points] :
       {std::pair<std::size_t, std::size_t>{36, 40000}, {1000, 100000}}) {
    print_row(columns_task(surfaces, points), one, all, gpu);
    print_row(signatures_task(surfaces, points), one, all, gpu);
  }
  if (gpu != nullptr) print_row(columns_task(1000, 1000000), one, all, gpu);
  print_row(cells_task(40000, 1), one, all, gpu);
  print_row(cells_task(1000000, 2), one, all, gpu);
  print_row(trees_task(150, 4096), one, all, gpu);
  print_row(trees_task(gpu != nullptr ? 1000000 : 20000, 4096), one, all, gpu);
  print_row(trees_task(gpu != nullptr ? 200000 : 2000, 65536), one, all, gpu);
  return 0;
}

}  // namespace
}  // namespace hewn

int main() {
  // Rows as they are measured, into files too.
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  return hewn::run();
}
