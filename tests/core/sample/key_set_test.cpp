#include "core/sample/key_set.h"

#include <doctest/doctest.h>

#include "core/base/rng.h"

namespace hewn {
namespace {

TEST_CASE("a key set holds what was put in, and nothing else") {
  KeySet keys;
  CHECK_FALSE(keys.contains(0));
  Rng rng(3);
  std::vector<std::uint64_t> in = {0, 1, ~std::uint64_t{0}};
  // Neighbours want the same places.
  for (int i = 0; i < 2000; ++i) in.push_back(i % 2 == 0 ? rng.next() : in.back() + 64);
  for (const std::uint64_t key : in) CHECK(keys.insert(key));
  for (const std::uint64_t key : in) {
    CHECK(keys.contains(key));
    CHECK_FALSE(keys.insert(key));
  }
  CHECK(keys.size() == in.size());
  for (int i = 0; i < 2000; ++i) CHECK_FALSE(keys.contains(rng.next()));
}

}  // namespace
}  // namespace hewn
