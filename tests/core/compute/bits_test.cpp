#include "core/compute/bits.h"

#include <vector>

#include <doctest/doctest.h>

#include "core/base/rng.h"

namespace hewn {
namespace {

std::vector<Word> random_words(std::size_t n, Rng& rng) {
  std::vector<Word> words(n);
  for (Word& w : words) w = rng.next() & rng.next();
  return words;
}

TEST_CASE("every instruction set counts the same bits") {
  Rng rng(5);
  for (const std::size_t words : {kWordBlock, 3 * kWordBlock, 16 * kWordBlock}) {
    const std::vector<Word> a = random_words(words, rng);
    const std::vector<Word> b = random_words(words, rng);
    const std::vector<Word> c = random_words(words, rng);
    int both = 0;
    int with_a = 0;
    int with_b = 0;
    int differ = 0;
    for (std::size_t i = 0; i < words * 64; ++i) {
      both += test_bit(a.data(), i) && test_bit(b.data(), i) ? 1 : 0;
      differ += test_bit(a.data(), i) != test_bit(b.data(), i) ? 1 : 0;
      with_a += test_bit(a.data(), i) && test_bit(c.data(), i) ? 1 : 0;
      with_b += test_bit(b.data(), i) && test_bit(c.data(), i) ? 1 : 0;
    }
    for (const BitPath path : {BitPath::Portable, BitPath::Avx2, BitPath::Avx512}) {
      const BitKernels* kernels = bit_kernels(path);
      if (kernels == nullptr) continue;
      CHECK(kernels->count_and(a.data(), b.data(), words) == both);
      CHECK(kernels->count_xor(a.data(), b.data(), words) == differ);
      CHECK(kernels->count(a.data(), words) == kernels->count_and(a.data(), a.data(), words));
      // Some kernels take several columns at once, and what is left of them.
      const std::vector<const Word*> columns{c.data(), a.data(), b.data(),
                                             c.data(), c.data(), a.data()};
      std::vector<std::uint32_t> blocks;
      for (std::size_t i = 0; i < words; i += kWordBlock) {
        blocks.push_back(static_cast<std::uint32_t>(i));
      }
      std::vector<CommonCounts> in_blocks(columns.size());
      kernels->count_common_in(a.data(), b.data(), columns, blocks, in_blocks);
      for (const std::size_t k : {0, 3, 4}) {
        CHECK(in_blocks[k].a == with_a);
        CHECK(in_blocks[k].b == with_b);
      }
      CHECK(in_blocks[1].b == both);
      CHECK(in_blocks[2].a == both);
      CHECK(in_blocks[5].b == both);
      blocks.erase(blocks.begin());
      kernels->count_common_in(a.data(), b.data(), columns, blocks, in_blocks);
      CHECK(in_blocks[0].a ==
            with_a - kernels->count_and(a.data(), c.data(), std::min(words, kWordBlock)));
    }
  }
}

TEST_CASE("set bits are visited in ascending order") {
  std::vector<Word> words(kWordBlock, 0);
  const std::vector<std::size_t> wanted{0, 1, 63, 64, 200, 511};
  for (const std::size_t i : wanted) set_bit(words.data(), i);
  std::vector<std::size_t> seen;
  for_each_bit(words, [&](std::size_t i) { seen.push_back(i); });
  CHECK(seen == wanted);
}

}  // namespace
}  // namespace hewn
