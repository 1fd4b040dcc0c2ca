#include "core/compute/signatures.h"

#include <algorithm>
#include <bit>

#include "core/compute/kernels/kernels.h"

namespace hewn {
namespace {

/// Distances between two looks at the cancel token: some 10 ms of one core, or of a GPU.
constexpr std::size_t kPairsPerPart = std::size_t{1} << 22;
constexpr std::size_t kPairsPerAcceleratedPart = std::size_t{1} << 30;

/// The points' coordinates in three arrays, padded to whole words of `kWordBlock`.
struct PointArrays {
  PointArrays(DeviceJob& job, std::span<const Vec3> points)
      : count(static_cast<std::int64_t>(points.size())),
        words(static_cast<std::int64_t>(padded_words(points.size()))) {
    std::vector<double> values(static_cast<std::size_t>(words) * 64, 0);
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < points.size(); ++i) values[i] = points[i][static_cast<long>(c)];
      coordinates[c] = job.upload(std::span<const double>(values));
    }
  }

  ColumnKernel kernel(const DeviceBuffer<SurfaceForm>& surfaces, Word* columns) const {
    return {surfaces.data(),
            static_cast<std::int64_t>(surfaces.size()),
            coordinates[0].data(),
            coordinates[1].data(),
            coordinates[2].data(),
            count,
            words,
            columns};
  }

  std::int64_t count, words;
  DeviceBuffer<double> coordinates[3];
};

/// A number of points, a multiple of 512, so that a part is short and fits into the device.
std::size_t points_per_part(const Device& device, std::size_t surfaces, std::size_t bits_a_pair) {
  constexpr std::size_t kStep = 64 * kWordBlock;
  const std::size_t point_bytes = 3 * sizeof(double) + (surfaces + 64) * bits_a_pair / 8;
  const std::size_t reserve = surfaces * sizeof(SurfaceForm);
  const std::size_t budget = device.info().memory_budget;
  const std::size_t fit = budget > reserve ? (budget - reserve) / point_bytes : 0;
  const std::size_t quick =
      (device.info().is_accelerator ? kPairsPerAcceleratedPart : kPairsPerPart) / surfaces;
  return std::max(std::min(fit, quick) / kStep * kStep, kStep);
}

}  // namespace

Result<void> fill_columns(Device& device, std::span<const SurfaceForm> surfaces,
                          std::span<const Vec3> points, std::span<Word> columns,
                          const RunContext& run) {
  if (points.empty() || surfaces.empty()) return {};
  const std::size_t words = padded_words(points.size());
  const std::size_t step = points_per_part(device, surfaces.size(), 1);
  DeviceJob job(device);
  const auto forms = job.upload(surfaces);
  std::vector<Word> part_columns;
  for (std::size_t begin = 0; begin < points.size(); begin += step) {
    if (run.is_cancelled()) return RunContext::cancelled();
    const PointArrays part(job, points.subspan(begin, std::min(step, points.size() - begin)));
    const auto part_words = static_cast<std::size_t>(part.words);
    const auto out = job.allocate<Word>(surfaces.size() * part_words);
    job.launch(part.kernel(forms, out.data()));
    if (part_words == words) {
      job.download(out, columns);
      break;
    }
    part_columns.resize(surfaces.size() * part_words);
    job.download(out, std::span<Word>(part_columns));
    if (job.has_failed()) return job.result();
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
      std::copy_n(part_columns.begin() + static_cast<std::ptrdiff_t>(k * part_words), part_words,
                  columns.begin() + static_cast<std::ptrdiff_t>(k * words + begin / 64));
    }
  }
  return job.result();
}

Result<void> add_signatures(Device& device, std::span<const SurfaceForm> surfaces,
                            std::span<const Vec3> points, std::size_t first_bit,
                            const SignatureRows& rows, const RunContext& run) {
  if (points.empty() || surfaces.empty()) return {};
  const std::size_t step = points_per_part(device, surfaces.size(), 2);
  const std::size_t stride = (surfaces.size() + 63) / 64;
  const std::size_t shift = first_bit % 64;
  DeviceJob job(device);
  const auto forms = job.upload(surfaces);
  std::vector<Word> signatures;
  for (std::size_t begin = 0; begin < points.size(); begin += step) {
    if (run.is_cancelled()) return RunContext::cancelled();
    const PointArrays part(job, points.subspan(begin, std::min(step, points.size() - begin)));
    const auto count = static_cast<std::size_t>(part.count);
    const auto columns = job.allocate<Word>(surfaces.size() * static_cast<std::size_t>(part.words));
    const auto out = job.allocate<Word>(count * stride);
    job.launch(part.kernel(forms, columns.data()));
    job.launch(TransposeKernel{columns.data(), static_cast<std::int64_t>(surfaces.size()),
                               part.words, part.count, static_cast<std::int64_t>(stride),
                               out.data()});
    signatures.resize(count * stride);
    job.download(out, std::span<Word>(signatures));
    if (job.has_failed()) return job.result();
    for (std::size_t i = 0; i < count; ++i) {
      Word* to = rows.words.data() + (begin + i) * rows.stride + first_bit / 64;
      for (std::size_t w = 0; w < stride; ++w) {
        const Word bits = signatures[i * stride + w];
        to[w] |= bits << shift;
        // What does not fit into this word; nothing is left of the last one's clear end.
        if (const Word rest = shift == 0 ? 0 : bits >> (64 - shift)) to[w + 1] |= rest;
      }
    }
  }
  return job.result();
}

Result<std::vector<int>> number_distinct_rows(Device& device, std::span<const Word> words,
                                              std::size_t stride) {
  const std::size_t rows = stride == 0 ? 0 : words.size() / stride;
  if (rows >= std::size_t{1} << 30) {
    return Error{ErrorCode::TooLarge, "more than 2^30 sample points; use fewer"};
  }
  std::vector<int> place_of_row(rows);
  const std::size_t places = std::bit_ceil(2 * rows + 1);
  DeviceJob job(device);
  const auto signatures = job.upload(words);
  const auto table = job.allocate_filled<int>(places, 0xFF);
  const auto out = job.allocate<int>(rows);
  job.launch(CellKernel{signatures.data(), static_cast<std::int64_t>(stride),
                        static_cast<std::int64_t>(rows), table.data(),
                        static_cast<std::int64_t>(places), out.data()});
  job.download(out, std::span<int>(place_of_row));
  if (job.has_failed()) return job.result().error();
  // Places depend on who came first; numbers must not.
  std::vector<int> number_of_place(places, -1);
  int next = 0;
  for (int& row : place_of_row) {
    int& number = number_of_place[static_cast<std::size_t>(row)];
    if (number < 0) number = next++;
    row = number;
  }
  return place_of_row;
}

}  // namespace hewn
