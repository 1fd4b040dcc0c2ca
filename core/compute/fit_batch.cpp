#include "core/compute/fit_batch.h"

#include <algorithm>

#include "core/base/assert.h"
#include "core/compute/kernels/kernels.h"
#include "core/compute/vector_paths.h"

namespace hewn {
namespace {

std::int32_t number(std::size_t value) { return static_cast<std::int32_t>(value); }

/// Appends the parts of a fit: those of its points on the surface, then those of its normals.
/// `from` tells where both begin.
void append_parts(std::size_t points, std::size_t normals, const FitPart& from,
                  std::vector<FitPart>& parts) {
  constexpr std::size_t kLongest = FitPart::kLongest;
  const std::size_t on_surface = points - normals;
  for (std::size_t i = 0; i < on_surface; i += kLongest) {
    const std::size_t count = std::min(kLongest, on_surface - i);
    parts.push_back({from.fit, from.first + number(i), number(count), -1});
  }
  for (std::size_t i = 0; i < normals; i += kLongest) {
    const std::size_t count = std::min(kLongest, normals - i);
    parts.push_back({from.fit, from.first + number(on_surface + i), number(count),
                     from.first_normal + number(i)});
  }
}

/// A fit from its guess to its end, with any instruction set.
template <SurfaceKind K>
struct WholeFit {
  const FitTarget& target;
  const FitRows& rows;
  std::span<const FitPart> parts;
  FitState& state;

  HEWN_HD void operator()() const {
    while (!state.is_done) {
      FitEquations total;
      for (const FitPart& part : parts) {
        total.add<kParameters<K>>(equations_of<K, kFitLanes>(
            target, state, part, 0, rows.points.data(), rows.normals.data()));
      }
      advance<K>(target, total, state);
    }
  }
};

template <SurfaceKind K>
SurfaceForm solve_alone(const FitTarget& target, const SurfaceForm& guess, const FitRows& rows) {
  std::vector<FitPart> parts;
  append_parts(rows.points.size(), rows.normals.size(), {0, 0, 0, 0}, parts);
  FitState state = state_at(guess);
  call_on_path(bit_kernels().path, WholeFit<K>{target, rows, parts, state});
  return state.best;
}

}  // namespace

SurfaceForm fit_alone(const FitTarget& target, const SurfaceForm& guess, const FitRows& rows) {
  switch (target.kind) {
    case SurfaceKind::Plane:
      return solve_alone<SurfaceKind::Plane>(target, guess, rows);
    case SurfaceKind::Sphere:
      return solve_alone<SurfaceKind::Sphere>(target, guess, rows);
    case SurfaceKind::Cylinder:
      return solve_alone<SurfaceKind::Cylinder>(target, guess, rows);
    case SurfaceKind::Cone:
      return solve_alone<SurfaceKind::Cone>(target, guess, rows);
    case SurfaceKind::Torus:
      return solve_alone<SurfaceKind::Torus>(target, guess, rows);
  }
  return guess;
}

void FitBatch::add(const FitTarget& target, const SurfaceForm& guess, const FitRows& rows) {
  HEWN_ASSERT(rows.on_surface() > 0, "a fit has points on the surface");
  fits_.push_back({points_.size(), rows.points.size(), normals_.size(), rows.normals.size()});
  targets_.push_back(target);
  starts_.push_back(state_at(guess));
  points_.insert(points_.end(), rows.points.begin(), rows.points.end());
  normals_.insert(normals_.end(), rows.normals.begin(), rows.normals.end());
  HEWN_ASSERT(points_.size() < std::size_t{1} << 30, "too many points for 32-bit numbers");
}

Result<void> FitBatch::solve(Device& device, const RunContext& run) {
  constexpr std::size_t kBytesOfPart = sizeof(FitPart) + kFitLanes * sizeof(FitEquations);
  constexpr std::size_t kBytesOfFit = sizeof(FitTarget) + sizeof(FitState) + sizeof(FitParts);
  const auto bytes_of = [&](const Fit& fit) {
    const std::size_t most_parts = fit.points / FitPart::kLongest + 2;
    return (fit.points + fit.normals) * sizeof(PlainVec) + most_parts * kBytesOfPart + kBytesOfFit;
  };
  solved_.resize(size());
  for (std::size_t begin = 0; begin < size();) {
    std::size_t end = begin;
    std::size_t bytes = 0;
    do {
      bytes += bytes_of(fits_[end++]);
    } while (end < size() && bytes + bytes_of(fits_[end]) <= device.info().memory_budget);
    Result<void> done = solve_some(device, begin, end, run);
    if (!done) return done;
    begin = end;
  }
  return {};
}

Result<void> FitBatch::solve_some(Device& device, std::size_t begin, std::size_t end,
                                  const RunContext& run) {
  const std::size_t first_point = fits_[begin].first_point;
  const std::size_t first_normal = fits_[begin].first_normal;
  std::vector<FitPart> parts;
  std::vector<FitParts> parts_of;
  for (std::size_t f = begin; f < end; ++f) {
    const std::size_t before = parts.size();
    const FitPart from{number(f - begin), number(fits_[f].first_point - first_point), 0,
                       number(fits_[f].first_normal - first_normal)};
    append_parts(fits_[f].points, fits_[f].normals, from, parts);
    parts_of.push_back({number(before), number(parts.size() - before)});
  }
  const auto some = [](auto& all, std::size_t from, std::size_t to) {
    return std::span(all).subspan(from, to - from);
  };
  DeviceJob job(device);
  const auto points = job.upload<PlainVec>(some(points_, first_point, fits_[end - 1].end_point()));
  const auto normals =
      job.upload<PlainVec>(some(normals_, first_normal, fits_[end - 1].end_normal()));
  const auto targets = job.upload<FitTarget>(some(targets_, begin, end));
  const auto states = job.upload<FitState>(some(starts_, begin, end));
  const auto device_parts = job.upload<FitPart>(parts);
  const auto device_parts_of = job.upload<FitParts>(parts_of);
  const auto sums = job.allocate<FitEquations>(parts.size() * kFitLanes);
  const FitTable table{targets.data(), states.data(), device_parts.data(), sums.data()};
  for (int unfinished = 1; unfinished > 0 && !job.has_failed();) {
    if (run.is_cancelled()) return RunContext::cancelled();
    const auto counter = job.allocate_filled<int>(1, 0);
    job.launch(FitSumKernel{table, static_cast<std::int64_t>(parts.size()), points.data(),
                            normals.data()});
    job.launch(FitStepKernel{table, device_parts_of.data(), static_cast<std::int64_t>(end - begin),
                             counter.data()});
    job.download(counter, std::span<int>(&unfinished, 1));
  }
  job.download(states, some(solved_, begin, end));
  return job.result();
}

}  // namespace hewn
