#include "core/segment/curvature/curvature_options.h"

#include <set>

#include <doctest/doctest.h>

namespace hewn {
namespace {

TEST_CASE("every curvature option has its own name, a help text and a default in range") {
  const CurvatureOptions defaults;
  std::set<std::string_view> names;
  for (const auto& field : option_table<CurvatureOptions>()) {
    CHECK(names.insert(field.name).second);
    CHECK(field.help.ends_with('.'));
    const auto* real = std::get_if<double CurvatureOptions::*>(&field.member);
    const auto* whole = std::get_if<int CurvatureOptions::*>(&field.member);
    REQUIRE((real || whole));
    const double value = real ? defaults.*(*real) : defaults.*(*whole);
    CHECK(value >= field.min);
    CHECK(value <= field.max);
  }
  CHECK(names.size() == 12);
}

}  // namespace
}  // namespace hewn
