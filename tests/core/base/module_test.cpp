#include "core/base/module.h"

#include <string>
#include <utility>

#include <doctest/doctest.h>

namespace hewn {
namespace {

TEST_CASE("a symbol of a library that the loader finds can be called") {
  const auto symbol = module_symbol("libm.so.6", "floor");
  REQUIRE(symbol);
  CHECK(reinterpret_cast<double (*)(double)>(*symbol)(3.5) == 3);
}

TEST_CASE("a missing library, and a missing symbol, are named") {
  for (const auto& [file, symbol] :
       {std::pair("libno-such-library.so", "cbrt"), std::pair("libm.so.6", "no_such_symbol")}) {
    CAPTURE(file);
    const auto found = module_symbol(file, symbol);
    REQUIRE_FALSE(found);
    CHECK(found.error().code == ErrorCode::Internal);
    CHECK(found.error().where == file);
    CHECK(found.error().message.find(file == std::string("libm.so.6") ? symbol : file) !=
          std::string::npos);
  }
}

}  // namespace
}  // namespace hewn
