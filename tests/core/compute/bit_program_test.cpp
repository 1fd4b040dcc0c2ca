#include "core/compute/bit_program.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <doctest/doctest.h>

#include "core/base/rng.h"

namespace hewn {
namespace {

constexpr BitPath kPaths[] = {BitPath::Portable, BitPath::Avx2, BitPath::Avx512};

/// Signed distances of points from surfaces, and the bits that say which are negative.
struct Samples {
  Samples(std::size_t columns, std::size_t point_count, Rng& rng) : points(point_count) {
    for (std::size_t c = 0; c < columns; ++c) {
      distances.emplace_back(points);
      bits.emplace_back(padded_words(points), 0);
      for (std::size_t i = 0; i < points; ++i) {
        const double distance = rng.uniform(-1, 1) + 1e-9;
        distances[c][i] = static_cast<float>(distance);
        if (distances[c][i] < 0) set_bit(bits[c].data(), i);
      }
    }
    for (const auto& column : bits) pointers.push_back(column.data());
  }

  std::size_t points;
  std::vector<std::vector<float>> distances;
  std::vector<std::vector<Word>> bits;
  std::vector<const Word*> pointers;
};

/// A postfix formula as data; a column where `op` is empty.
struct Token {
  std::optional<BitOp> op;
  int column = 0;
};

void append_random(std::vector<Token>& out, Rng& rng, std::size_t leaves, std::size_t columns) {
  if (leaves == 1) {
    out.push_back({{}, static_cast<int>(rng.below(columns))});
  } else {
    const std::size_t left = 1 + rng.below(leaves - 1);
    append_random(out, rng, left, columns);
    append_random(out, rng, leaves - left, columns);
    out.push_back({static_cast<BitOp>(rng.below(3)), 0});
  }
  if (rng.below(4) == 0) out.push_back({BitOp::Not, 0});
}

BitProgram program_of(const std::vector<Token>& tokens) {
  BitProgram program;
  for (const Token& t : tokens) {
    if (t.op) {
      program.push_op(*t.op);
    } else {
      program.push_column(t.column);
    }
  }
  return program;
}

/// The formula as a signed distance: min, max and negation, one point at a time.
float distance_at(const std::vector<Token>& tokens, const Samples& samples, std::size_t point) {
  std::vector<float> stack;
  for (const Token& t : tokens) {
    if (!t.op) {
      stack.push_back(samples.distances[static_cast<std::size_t>(t.column)][point]);
      continue;
    }
    const float b = stack.back();
    if (*t.op == BitOp::Not) {
      stack.back() = -b;
      continue;
    }
    stack.pop_back();
    float& a = stack.back();
    if (*t.op == BitOp::And) a = std::max(a, b);
    if (*t.op == BitOp::Or) a = std::min(a, b);
    if (*t.op == BitOp::AndNot) a = std::max(a, -b);
  }
  return stack.back();
}

int differing_signs(const std::vector<Token>& tokens, const Samples& samples,
                    const std::vector<float>& wanted) {
  int count = 0;
  for (std::size_t i = 0; i < samples.points; ++i) {
    count += (distance_at(tokens, samples, i) < 0) != (wanted[i] < 0) ? 1 : 0;
  }
  return count;
}

TEST_CASE("a single column differs from itself nowhere and from its complement everywhere") {
  Rng rng(1);
  const Samples samples(1, 700, rng);
  BitProgram same;
  same.push_column(0);
  BitProgram opposite = same;
  opposite.push_op(BitOp::Not);
  for (const BitPath path : kPaths) {
    if (bit_kernels(path) == nullptr) continue;
    CHECK(same.count_differing(samples.pointers, samples.bits[0].data(), 700, path) == 0);
    CHECK(opposite.count_differing(samples.pointers, samples.bits[0].data(), 700, path) == 700);
  }
}

TEST_CASE("the topmost value is the second operand of a difference") {
  std::vector<Word> a(kWordBlock, 0);
  std::vector<Word> b(kWordBlock, 0);
  a[0] = 0b0111;
  b[0] = 0b0110;
  const Word* const columns[] = {a.data(), b.data()};
  std::vector<Word> wanted(kWordBlock, 0);
  wanted[0] = 0b0001;
  BitProgram program;
  program.push_column(0);
  program.push_column(1);
  CHECK_FALSE(program.is_complete());
  program.push_op(BitOp::AndNot);
  CHECK(program.is_complete());
  CHECK(program.columns_needed() == 2);
  CHECK(program.count_differing(columns, wanted.data(), 100) == 0);
  wanted[0] = 0b1000;
  CHECK(program.count_differing(columns, wanted.data(), 100) == 2);
}

TEST_CASE("a chain needs one slot however long it is") {
  BitProgram left;
  left.push_column(0);
  BitProgram right;
  for (int i = 0; i < 50; ++i) right.push_column(i);
  for (int i = 1; i < 50; ++i) {
    left.push_column(i);
    left.push_op(BitOp::Or);
    right.push_op(BitOp::Or);
  }
  CHECK(left.is_complete());
  CHECK(right.is_complete());
  CHECK(left.slots_needed() == 1);
  CHECK(right.slots_needed() == 1);
}

TEST_CASE("random formulas count what the signs of min and max over distances count") {
  Rng rng(2);
  constexpr std::size_t kPoints[] = {1, 64, 511, 512, 513, 4096, 5000};
  for (const std::size_t points : kPoints) {
    const Samples samples(12, points, rng);
    for (int k = 0; k < 20; ++k) {
      const std::size_t leaves = 1 + rng.below(24);
      std::vector<Token> tokens;
      append_random(tokens, rng, leaves, 12);
      const BitProgram program = program_of(tokens);
      const int expected = differing_signs(tokens, samples, samples.distances[0]);
      const Word* wanted = samples.bits[0].data();
      CHECK(program.count_differing(samples.pointers, wanted, points) == expected);
      for (const BitPath path : kPaths) {
        if (bit_kernels(path) == nullptr) continue;
        CHECK(program.count_differing(samples.pointers, wanted, points, path) == expected);
      }
    }
  }
}

TEST_CASE("a formula with more slots than fit on the stack counts the same") {
  Rng rng(3);
  const Samples samples(6, 3000, rng);
  std::vector<Token> tokens;
  // Every pair must wait in a slot of its own until all are read.
  constexpr int kPairs = 40;
  for (int i = 0; i < kPairs; ++i) {
    tokens.push_back({{}, static_cast<int>(rng.below(6))});
    tokens.push_back({{}, static_cast<int>(rng.below(6))});
    tokens.push_back({static_cast<BitOp>(rng.below(3)), 0});
  }
  for (int i = 1; i < kPairs; ++i) tokens.push_back({static_cast<BitOp>(rng.below(3)), 0});
  const BitProgram program = program_of(tokens);
  CHECK(program.slots_needed() == kPairs);
  CHECK(program.count_differing(samples.pointers, samples.bits[1].data(), 3000) ==
        differing_signs(tokens, samples, samples.distances[1]));
}

}  // namespace
}  // namespace hewn
