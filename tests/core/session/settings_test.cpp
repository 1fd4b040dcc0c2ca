#include "core/session/settings.h"

#include <set>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "core/base/file.h"

namespace hewn {
namespace {

TEST_CASE("docs/options.md is what the tables say") {
  const auto page = read_file(HEWN_DOCS "/options.md");
  REQUIRE(page);
  CHECK_MESSAGE(*page == settings_to_markdown(),
                "run: build/bin/hewn options --markdown > docs/options.md");
}

TEST_CASE("no two options share a flag, and every default lies in its range") {
  Settings settings;
  std::set<std::string> flags;
  for (const OptionSection& section : bind_settings(settings)) {
    for (const OptionRef& option : section.options) {
      const std::string flag = std::string(section.name) + "-" + std::string(option.name);
      CHECK_MESSAGE(flags.insert(flag).second, flag);
      CHECK_MESSAGE(set_option(option, option_text(option)), flag);
      CHECK_MESSAGE(!option.help.empty(), flag);
    }
  }
  CHECK(flags.size() > 10);
}

TEST_CASE("settings survive the way through JSON") {
  Settings settings;
  settings.tree.starts = 3;
  settings.load.weld_tolerance = 2e-6;
  Settings back;
  REQUIRE(settings_from_json(back, settings_to_json(settings)));
  CHECK(settings_to_json(back) == settings_to_json(settings));
  CHECK(back.tree.starts == 3);
}

TEST_CASE("an unknown section is refused by name") {
  Settings settings;
  const auto set = settings_from_json(settings, nlohmann::json{{"trees", {{"starts", 2}}}});
  REQUIRE(!set);
  CHECK(set.error().message.find("'trees'") != std::string::npos);
}

}  // namespace
}  // namespace hewn
