/// Every kernel against a straightforward evaluation and, bit by bit, against the plainest device.
#include <map>

#include <doctest/doctest.h>

#include "core/compute/pair_counts.h"
#include "core/compute/signatures.h"
#include "core/compute/tree_batch.h"
#include "tests/gpu/random_tree.h"
#include "tests/gpu/test_device.h"

namespace hewn {
namespace {

using testing::append_random_tree;
using testing::device_under_test;
using testing::plain_device;

std::vector<Word> columns_on(Device& device, std::span<const SurfaceForm> surfaces,
                             std::span<const Vec3> points) {
  std::vector<Word> columns(surfaces.size() * padded_words(points.size()), ~Word{0});
  REQUIRE(fill_columns(device, surfaces, points, columns, {}).has_value());
  return columns;
}

/// The definition, in Eigen's vectors and with a margin for rounding.
double distance_from(const SurfaceForm& s, const Vec3& p) {
  const Vec3 axis(s.axis[0], s.axis[1], s.axis[2]);
  const Vec3 d = p - Vec3(s.point[0], s.point[1], s.point[2]);
  const double height = axis.dot(d);
  const double radial = (d - height * axis).norm();
  switch (s.kind) {
    case SurfaceKind::Plane:
      return axis.dot(p) - s.first;
    case SurfaceKind::Sphere:
      return d.norm() - s.first;
    case SurfaceKind::Cylinder:
      return radial - s.first;
    case SurfaceKind::Cone:
      return radial * s.first - height * s.second;
    case SurfaceKind::Torus:
      return std::hypot(radial - s.second, height) - s.first;
  }
  return 0;
}

TEST_CASE("columns tell on which side of every surface every point lies") {
  const auto device = device_under_test();
  if (!device) return;
  Rng rng(11);
  for (const std::size_t count : {1, 63, 64, 65, 511, 513, 3000}) {
    const auto surfaces = testing::random_surfaces(1 + rng.below(70), rng);
    const auto points = testing::random_points(count, rng);
    const std::vector<Word> columns = columns_on(*device, surfaces, points);
    auto plain = plain_device();
    CHECK(columns == columns_on(plain, surfaces, points));
    const std::size_t words = padded_words(count);
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
      for (std::size_t i = 0; i < words * 64; ++i) {
        const bool bit = test_bit(columns.data() + k * words, i);
        const double distance = i < count ? distance_from(surfaces[k], points[i]) : 1;
        if (std::abs(distance) > 1e-12) REQUIRE(bit == (distance < 0));
      }
    }
  }
}

TEST_CASE("a part's own vertices and planes have the same columns on every device") {
  const auto device = device_under_test();
  if (!device) return;
  // Vertices on planes: the sign is rounding alone.
  const testing::SamplePart part = testing::read_sample_part();
  auto plain = plain_device();
  CHECK(columns_on(*device, part.planes, part.vertices) ==
        columns_on(plain, part.planes, part.vertices));
}

TEST_CASE("signatures are the columns turned about, at any bit") {
  const auto device = device_under_test();
  if (!device) return;
  Rng rng(12);
  for (const std::size_t first_bit : {0, 1, 63, 64, 100}) {
    const auto surfaces = testing::random_surfaces(1 + rng.below(200), rng);
    const auto points = testing::random_points(1 + rng.below(700), rng);
    const std::size_t stride = (first_bit + surfaces.size() + 63) / 64;
    std::vector<Word> words(points.size() * stride, 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t b = 0; b < first_bit; ++b) set_bit(words.data() + i * stride, b);
    }
    REQUIRE(add_signatures(*device, surfaces, points, first_bit, {words, stride}, {}).has_value());
    const std::vector<Word> columns = columns_on(*device, surfaces, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Word* row = words.data() + i * stride;
      for (std::size_t b = 0; b < stride * 64; ++b) {
        const std::size_t k = b - first_bit;
        const bool wanted =
            b < first_bit ||
            (k < surfaces.size() && test_bit(columns.data() + k * padded_words(points.size()), i));
        REQUIRE(test_bit(row, b) == wanted);
      }
    }
  }
}

TEST_CASE("rows are numbered by their first appearance") {
  const auto device = device_under_test();
  if (!device) return;
  Rng rng(13);
  for (const std::size_t stride : {1, 2, 5}) {
    for (const std::size_t kinds : {1, 3, 1000}) {
      std::vector<Word> words;
      std::map<std::vector<Word>, int> known;
      std::vector<int> wanted;
      for (std::size_t i = 0; i < 5000; ++i) {
        // Rows of one kind differ from others in a single bit.
        const std::size_t kind = rng.below(kinds);
        std::vector<Word> row(stride, 0);
        row[kind % stride] = Word{1} << (kind / stride % 64);
        row[0] ^= kind << 40;
        words.insert(words.end(), row.begin(), row.end());
        wanted.push_back(known.emplace(row, static_cast<int>(known.size())).first->second);
      }
      const auto numbers = number_distinct_rows(*device, words, stride);
      REQUIRE(numbers.has_value());
      CHECK(*numbers == wanted);
    }
  }
}

std::vector<Word> random_column(std::size_t rows, Rng& rng) {
  std::vector<Word> column(padded_words(rows), 0);
  for (std::size_t i = 0; i < rows; ++i) {
    if (rng.coin()) set_bit(column.data(), i);
  }
  return column;
}

/// Row by row, with a stack of truth values.
TreeMeasures measured_plainly(const std::vector<Token>& tree,
                              const std::vector<std::vector<Word>>& columns,
                              const std::vector<Word>& wanted, std::size_t rows) {
  TreeMeasures m;
  std::vector<bool> overlaps(tree.size(), false);
  for (std::size_t i = 0; i < rows; ++i) {
    std::vector<bool> stack;
    for (std::size_t t = 0; t < tree.size(); ++t) {
      if (tree[t] >= 0) {
        stack.push_back(test_bit(columns[static_cast<std::size_t>(tree[t])].data(), i));
        continue;
      }
      const bool b = stack.back();
      stack.pop_back();
      if (tree[t] == kComplementToken) {
        stack.push_back(!b);
        continue;
      }
      const bool a = stack.back();
      stack.back() = tree[t] == kUnionToken          ? a || b
                     : tree[t] == kIntersectionToken ? a && b
                                                     : a && !b;
      if (a && b) overlaps[t] = true;
    }
    m.held += stack.back() ? 1 : 0;
    m.held_wanted += stack.back() && test_bit(wanted.data(), i) ? 1 : 0;
  }
  for (const bool o : overlaps) m.overlaps += o ? 1 : 0;
  return m;
}

bool same(const TreeMeasures& a, const TreeMeasures& b) {
  return a.held == b.held && a.held_wanted == b.held_wanted && a.overlaps == b.overlaps;
}

TEST_CASE("trees hold the rows that a row-by-row evaluation finds") {
  const auto device = device_under_test();
  if (!device) return;
  Rng rng(14);
  for (const std::size_t rows : {1, 64, 129, 1000, 8192, 9000}) {
    std::vector<std::vector<Word>> columns;
    for (int k = 0; k < 12; ++k) columns.push_back(random_column(rows, rng));
    const std::vector<Word> wanted = random_column(rows, rng);
    MeasuredRows table(rows, columns, wanted);
    TreeBatch batch;
    std::vector<std::vector<Token>> trees(40);
    for (std::size_t t = 0; t < trees.size(); ++t) {
      append_random_tree(trees[t], 1 + rng.below(t < 30 ? 20 : 150), columns.size(), rng);
      batch.add(trees[t]);
    }
    std::vector<TreeMeasures> measured(batch.size());
    // Twice: the second time the columns are on the device already.
    for (int round = 0; round < 2; ++round) {
      REQUIRE(table.measure(*device, batch, measured, {}).has_value());
      for (std::size_t t = 0; t < trees.size(); ++t) {
        REQUIRE(same(measured[t], measured_plainly(trees[t], columns, wanted, rows)));
      }
    }
  }
}

TEST_CASE("every instruction set measures the same") {
  Rng rng(15);
  constexpr std::size_t kRows = 20000;
  std::vector<std::vector<Word>> columns;
  for (int k = 0; k < 20; ++k) columns.push_back(random_column(kRows, rng));
  // Devices outlive what lies on them.
  auto plain = plain_device();
  CpuDevice avx2(2, CpuDevice::kMemoryBudget, BitPath::Avx2);
  CpuDevice avx512(2, CpuDevice::kMemoryBudget, BitPath::Avx512);
  MeasuredRows table(kRows, columns, columns[0]);
  TreeBatch batch;
  for (int t = 0; t < 50; ++t) {
    std::vector<Token> tree;
    append_random_tree(tree, 16, columns.size(), rng);
    batch.add(tree);
  }
  std::vector<TreeMeasures> expected(batch.size());
  REQUIRE(table.measure(plain, batch, expected, {}).has_value());
  for (const BitPath path : {BitPath::Avx2, BitPath::Avx512}) {
    if (bit_kernels(path) == nullptr) continue;
    CpuDevice& device = path == BitPath::Avx2 ? avx2 : avx512;
    std::vector<TreeMeasures> measured(batch.size());
    REQUIRE(table.measure(device, batch, measured, {}).has_value());
    for (std::size_t t = 0; t < measured.size(); ++t) CHECK(same(measured[t], expected[t]));
  }
}

/// What the kernel says of all trees when it runs as on a device of that grain.
template <class Grain>
std::vector<Word> measured_by_items(TreeKernel kernel, const TreeBatch& batch) {
  std::vector<TreeCounts> counts(batch.size());
  std::vector<OverlapWord> overlaps(batch.overlap_words(), 0);
  kernel.counts = counts.data();
  kernel.overlaps = overlaps.data();
  const std::int64_t items = kernel.template items<Grain>();
  for (std::int64_t i = 0; i < items; ++i) kernel.template run<Grain>(i);
  std::vector<Word> found(overlaps.begin(), overlaps.end());
  for (const TreeCounts& c : counts) {
    found.push_back(static_cast<Word>(c.held));
    found.push_back(static_cast<Word>(c.held_wanted));
  }
  return found;
}

TEST_CASE("trees are measured alike in registers and in arrays") {
  Rng rng(19);
  constexpr std::size_t kColumns = 10;
  for (const std::size_t rows : {500, 4096, 9000, 16384}) {
    const std::size_t words = padded_words(rows);
    std::vector<Word> columns;
    for (std::size_t k = 0; k < kColumns + 1; ++k) {
      const std::vector<Word> column = random_column(rows, rng);
      columns.insert(columns.end(), column.begin(), column.end());
    }
    std::vector<Word> all(words, 0);
    for (std::size_t i = 0; i < rows; ++i) set_bit(all.data(), i);
    TreeBatch batch;
    for (int t = 0; t < 50; ++t) {
      std::vector<Token> tree;
      append_random_tree(tree, 1 + rng.below(150), kColumns, rng);
      batch.add(tree);
    }
    TreeKernel kernel;
    kernel.trees = batch.trees().data();
    kernel.tree_count = static_cast<std::int64_t>(batch.size());
    kernel.steps = batch.steps().data();
    kernel.columns = columns.data();
    kernel.words = static_cast<std::int64_t>(words);
    kernel.wanted = columns.data() + kColumns * words;
    kernel.all = all.data();
    const std::vector<Word> expected = measured_by_items<HostGrain>(kernel, batch);
    CHECK(measured_by_items<DeviceGrain>(kernel, batch) == expected);
    if (kernel.words % TreeKernel::kGroupWords<PairedDeviceGrain> != 0) continue;
    CHECK(measured_by_items<PairedDeviceGrain>(kernel, batch) == expected);
    if (kernel.words % TreeKernel::kGroupWords<WideDeviceGrain> != 0) continue;
    CHECK(measured_by_items<WideDeviceGrain>(kernel, batch) == expected);
  }
}

TEST_CASE("a tree of any depth fits into the work arrays") {
  const auto device = device_under_test();
  if (!device) return;
  Rng rng(16);
  constexpr std::size_t kRows = 300;
  std::vector<std::vector<Word>> columns;
  for (int k = 0; k < 6; ++k) columns.push_back(random_column(kRows, rng));
  // (0 u 1) - ((2 u 3) - ((4 u 5) - ...)): left to right, every level would hold an array.
  std::vector<Token> tree;
  constexpr int kLevels = 500;
  for (int level = 0; level < kLevels; ++level) {
    const auto k = static_cast<Token>(2 * level % 6);
    tree.insert(tree.end(), {k, static_cast<Token>(k + 1), kUnionToken});
  }
  tree.insert(tree.end(), kLevels - 1, kDifferenceToken);
  TreeBatch batch;
  batch.add(tree);
  MeasuredRows table(kRows, columns, columns[0]);
  std::vector<TreeMeasures> measured(1);
  REQUIRE(table.measure(*device, batch, measured, {}).has_value());
  CHECK(same(measured[0], measured_plainly(tree, columns, columns[0], kRows)));
  // Balanced: the most arrays for its size.
  std::vector<Token> balanced;
  const auto build = [&](const auto& self, int depth) -> void {
    if (depth == 0) return balanced.push_back(static_cast<Token>(rng.below(6)));
    self(self, depth - 1);
    self(self, depth - 1);
    balanced.push_back(kDifferenceToken);
  };
  build(build, 12);
  batch.clear();
  batch.add(balanced);
  REQUIRE(table.measure(*device, batch, measured, {}).has_value());
  CHECK(same(measured[0], measured_plainly(balanced, columns, columns[0], kRows)));
}

TEST_CASE("2^31 pairs of trees and rows are counted without overflow") {
  const auto device = device_under_test();
  if (!device) return;
  constexpr std::size_t kRows = 65536;
  constexpr std::size_t kTrees = 32769;
  const std::vector<Word> full(padded_words(kRows), ~Word{0});
  MeasuredRows table(kRows, {full}, full);
  TreeBatch batch;
  const std::vector<Token> tree{0};
  for (std::size_t t = 0; t < kTrees; ++t) batch.add(tree);
  std::vector<TreeMeasures> measured(kTrees);
  REQUIRE(table.measure(*device, batch, measured, {}).has_value());
  std::size_t held = 0;
  for (const TreeMeasures& m : measured) held += static_cast<std::size_t>(m.held);
  CHECK(held == kRows * kTrees);
  CHECK(held > std::size_t{1} << 31);
}

TEST_CASE("pairs of columns keep of two sets what a count of each pair finds") {
  const auto device = device_under_test();
  if (!device) return;
  Rng rng(20);
  for (const std::size_t rows : {1, 500, 6000}) {
    std::vector<std::vector<Word>> columns;
    std::vector<const Word*> first_words;
    for (int k = 0; k < 37; ++k) columns.push_back(random_column(rows, rng));
    for (const auto& column : columns) first_words.push_back(column.data());
    PairCounts pairs(first_words, padded_words(rows));
    // Twice: the second time the columns are on the device already.
    for (int round = 0; round < 2; ++round) {
      const std::vector<Word> a = random_column(rows, rng);
      const std::vector<Word> b = random_column(rows, rng);
      REQUIRE(pairs.count(*device, a, b, {}).has_value());
      for (std::size_t i = 0; i < columns.size(); ++i) {
        for (std::size_t k = 0; k < columns.size(); ++k) {
          CommonCounts expected;
          for (std::size_t row = 0; row < rows; ++row) {
            if (!test_bit(columns[i].data(), row) || !test_bit(columns[k].data(), row)) continue;
            expected.a += test_bit(a.data(), row) ? 1 : 0;
            expected.b += test_bit(b.data(), row) ? 1 : 0;
          }
          REQUIRE(pairs.of(i, k).a == expected.a);
          REQUIRE(pairs.of(i, k).b == expected.b);
        }
      }
    }
  }
  RunContext cancelled;
  cancelled.cancel->cancel();
  CHECK_FALSE(PairCounts({}, 8).count(*device, {}, {}, cancelled).has_value());
  CHECK(PairCounts({}, 8).count(*device, std::vector<Word>(8), std::vector<Word>(8), {}));
}

TEST_CASE("what goes to a device comes back the same, whatever its size") {
  const auto device = device_under_test();
  if (!device) return;
  Rng rng(20);
  for (const std::size_t words : {std::size_t{1}, std::size_t{524'287}, std::size_t{524'288},
                                  std::size_t{2'097'152}, std::size_t{7'000'001}}) {
    std::vector<Word> sent(words);
    for (Word& w : sent) w = rng.next();
    const std::vector<Word> original = sent;
    DeviceJob job(*device);
    const auto first = job.upload(std::span<const Word>(sent));
    std::fill(sent.begin(), sent.end(), 0);
    const auto second = job.upload(std::span<const Word>(sent));
    std::vector<Word> back(words, 1);
    job.download(second, std::span<Word>(back));
    CHECK(back == sent);
    job.download(first, std::span<Word>(back));
    REQUIRE(job.result().has_value());
    CHECK(back == original);
  }
}

TEST_CASE("nothing in, nothing out") {
  const auto device = device_under_test();
  if (!device) return;
  Rng rng(17);
  const auto surfaces = testing::random_surfaces(3, rng);
  const auto points = testing::random_points(3, rng);
  std::vector<Word> columns;
  CHECK(fill_columns(*device, surfaces, {}, columns, {}).has_value());
  CHECK(fill_columns(*device, {}, points, columns, {}).has_value());
  std::vector<Word> rows(3, 0);
  CHECK(add_signatures(*device, {}, points, 0, {rows, 1}, {}).has_value());
  CHECK(rows == std::vector<Word>(3, 0));
  const auto numbers = number_distinct_rows(*device, {}, 1);
  REQUIRE(numbers.has_value());
  CHECK(numbers->empty());
  MeasuredRows none(0, {{}}, {});
  TreeBatch batch;
  std::vector<TreeMeasures> measured;
  CHECK(none.measure(*device, batch, measured, {}).has_value());
  const std::vector<Token> tree{0};
  batch.add(tree);
  measured.resize(1);
  measured[0].held = 7;
  REQUIRE(none.measure(*device, batch, measured, {}).has_value());
  CHECK(measured[0].held == 0);
}

TEST_CASE("a small memory makes more parts, not other results") {
  Rng rng(18);
  const auto surfaces = testing::random_surfaces(100, rng);
  const auto points = testing::random_points(5000, rng);
  CpuDevice large(2);
  CpuDevice small(2, 100'000);
  CHECK(columns_on(large, surfaces, points) == columns_on(small, surfaces, points));
  std::vector<Word> one(points.size() * 2, 0);
  std::vector<Word> other = one;
  REQUIRE(add_signatures(large, surfaces, points, 5, {one, 2}, {}).has_value());
  REQUIRE(add_signatures(small, surfaces, points, 5, {other, 2}, {}).has_value());
  CHECK(one == other);
  std::vector<std::vector<Word>> columns;
  for (int k = 0; k < 30; ++k) columns.push_back(random_column(20000, rng));
  MeasuredRows table(20000, columns, columns[0]);
  TreeBatch batch;
  for (int t = 0; t < 20; ++t) {
    std::vector<Token> tree;
    append_random_tree(tree, 100, columns.size(), rng);
    batch.add(tree);
  }
  std::vector<TreeMeasures> expected(batch.size());
  std::vector<TreeMeasures> measured(batch.size());
  REQUIRE(table.measure(large, batch, expected, {}).has_value());
  REQUIRE(table.measure(small, batch, measured, {}).has_value());
  for (std::size_t t = 0; t < measured.size(); ++t) CHECK(same(measured[t], expected[t]));
}

}  // namespace
}  // namespace hewn
