#include "core/session/option_io.h"

#include <array>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace hewn {
namespace {

struct Sample {
  double share = 0.5;
  int count = 3;
  bool is_on = true;
  int method = 0;
};

}  // namespace

template <>
std::span<const OptionField<Sample>> option_table<Sample>() {
  static constexpr std::array<OptionField<Sample>, 4> kTable{{
      {"share", &Sample::share, 0, 1, "a share"},
      {"count", &Sample::count, 1, 10, "a count"},
      {"switch", &Sample::is_on, 0, 1, "a switch"},
      {"method", &Sample::method, 0, 1, "a choice", "fast,exact"},
  }};
  return kTable;
}

namespace {

TEST_CASE("an option takes what its table allows") {
  Sample values;
  const auto options = bind_options(values);
  REQUIRE(options.size() == 4);
  CHECK(set_option(options[0], "0.25"));
  CHECK(set_option(options[1], "10"));
  CHECK(set_option(options[2], "off"));
  CHECK(set_option(options[3], "exact"));
  CHECK(values.share == 0.25);
  CHECK(values.count == 10);
  CHECK(values.is_on == false);
  CHECK(values.method == 1);
}

TEST_CASE("a bad value is refused, names what is allowed and changes nothing") {
  Sample values;
  const auto options = bind_options(values);
  for (const char* text : {"", "abc", "1.5", "-1", "nan", "0.5x"}) {
    const auto set = set_option(options[0], text);
    REQUIRE(!set);
    CHECK(set.error().code == ErrorCode::InvalidArgument);
    CHECK(set.error().message.find("number from 0 to 1") != std::string::npos);
  }
  CHECK(!set_option(options[1], "2.5"));
  CHECK(!set_option(options[1], "11"));
  CHECK(!set_option(options[2], "maybe"));
  const auto choice = set_option(options[3], "slow");
  REQUIRE(!choice);
  CHECK(choice.error().message.find("fast, exact") != std::string::npos);
  CHECK(values.share == 0.5);
  CHECK(values.count == 3);
  CHECK(values.method == 0);
}

TEST_CASE("options survive the way through JSON") {
  Sample values{0.125, 7, false, 1};
  const auto json = options_to_json({"sample", "", bind_options(values)});
  CHECK(json.at("method") == "exact");
  Sample back;
  REQUIRE(options_from_json({"sample", "", bind_options(back)}, json));
  CHECK(back.share == 0.125);
  CHECK(back.count == 7);
  CHECK(back.is_on == false);
  CHECK(back.method == 1);
}

TEST_CASE("an unknown option in a file is an error that names it") {
  Sample values;
  const auto set =
      options_from_json({"sample", "", bind_options(values)}, nlohmann::json{{"shore", 1}});
  REQUIRE(!set);
  CHECK(set.error().message.find("'shore'") != std::string::npos);
}

}  // namespace
}  // namespace hewn
