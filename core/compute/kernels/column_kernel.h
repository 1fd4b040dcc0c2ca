#pragma once
/// Bit columns: on which side of every surface does every point lie?
#include "core/compute/kernels/surface_form.h"

namespace hewn {

/// Bit `row` of column k tells that point `row` is inside surface k. One item is one surface on
/// `kRows` points. Cost: points x surfaces distances.
struct ColumnKernel {
  const SurfaceForm* surfaces = nullptr;
  std::int64_t surface_count = 0;
  /// The points' coordinates, one array each, `words` * 64 of them: the last points of the last
  /// words may be any finite ones.
  const double* x = nullptr;
  const double* y = nullptr;
  const double* z = nullptr;
  std::int64_t points = 0;
  std::int64_t words = 0;   ///< per column, multiples of `kWordBlock`
  Word* columns = nullptr;  ///< out: zero beyond the last point

  template <class Grain>
  HEWN_HD std::int64_t items() const {
    return surface_count * (words * 64 / Grain::kRows);
  }

  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    const std::int64_t rows = words * 64;
    const std::int64_t groups = rows / Grain::kRows;
    const std::int64_t surface = quotient(item, groups);
    const SurfaceForm& s = surfaces[surface];
    const std::int64_t row = (item - surface * groups) * Grain::kRows;
    Word* column = columns + surface * words;
    switch (s.kind) {
      case SurfaceKind::Plane:
        return store_rows<Grain::kRows>(column, row, sides<Grain, SurfaceKind::Plane>(s, row));
      case SurfaceKind::Sphere:
        return store_rows<Grain::kRows>(column, row, sides<Grain, SurfaceKind::Sphere>(s, row));
      case SurfaceKind::Cylinder:
        return store_rows<Grain::kRows>(column, row, sides<Grain, SurfaceKind::Cylinder>(s, row));
      case SurfaceKind::Cone:
        return store_rows<Grain::kRows>(column, row, sides<Grain, SurfaceKind::Cone>(s, row));
      case SurfaceKind::Torus:
        return store_rows<Grain::kRows>(column, row, sides<Grain, SurfaceKind::Torus>(s, row));
    }
  }

 private:
  template <class Grain, SurfaceKind kKind>
  HEWN_HD Word sides(const SurfaceForm& s, std::int64_t row) const {
    // In two loops: vector units take the first one, which is where the time goes.
    bool is_inside[Grain::kRows];
    for (int r = 0; r < Grain::kRows; ++r) {
      is_inside[r] = signed_distance<kKind>(s, x[row + r], y[row + r], z[row + r]) < 0;
    }
    Word bits = 0;
    for (int r = 0; r < Grain::kRows; ++r) {
      bits |= static_cast<Word>(is_inside[r] && row + r < points) << r;
    }
    return bits;
  }
};

/// Turns columns over points into one signature a point: bit k of it is bit `point` of column k.
/// One item is a block of 64 points and 64 columns.
struct TransposeKernel {
  const Word* columns = nullptr;
  std::int64_t column_count = 0;
  std::int64_t column_words = 0;  ///< per column
  std::int64_t points = 0;
  std::int64_t stride = 0;     ///< words a signature, at least 1 per 64 columns
  Word* signatures = nullptr;  ///< out: `points` * `stride` words

  template <class Grain>
  HEWN_HD std::int64_t items() const {
    return (points + 63) / 64 * stride;
  }

  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    const std::int64_t point_word = quotient(item, stride);
    const std::int64_t column_word = item - point_word * stride;
    const std::int64_t first_column = column_word * 64;
    Word block[64];
    for (int k = 0; k < 64; ++k) {
      const std::int64_t column = first_column + k;
      block[k] = column < column_count ? columns[column * column_words + point_word] : 0;
    }
    transpose(block);
    for (int r = 0; r < 64 && point_word * 64 + r < points; ++r) {
      signatures[(point_word * 64 + r) * stride + column_word] = block[r];
    }
  }

 private:
  /// Bit c of row r changes places with bit r of row c (Warren, Hacker's Delight, section 7-3).
  static HEWN_HD void transpose(Word* block) {
    Word mask = 0x00000000FFFFFFFFull;
    for (int width = 32; width > 0; width /= 2, mask ^= mask << width) {
      for (int r = 0; r < 64; r = (r + width + 1) & ~width) {
        const Word swap = ((block[r] >> width) ^ block[r + width]) & mask;
        block[r] ^= swap << width;
        block[r + width] ^= swap;
      }
    }
  }
};

}  // namespace hewn
