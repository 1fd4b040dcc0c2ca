#include <doctest/doctest.h>

#include "core/base/file.h"
#include "core/session/project.h"
#include "core/session/reconstruct.h"
#include "core/session/tree_file.h"

namespace hewn {
namespace {

TEST_CASE("docs/project-file.md shows its example and the design that comes of it") {
  const std::string example = HEWN_DOCS "/examples/elbow.json";
  const auto page = read_file(HEWN_DOCS "/project-file.md");
  const auto text = read_file(example);
  REQUIRE(page);
  REQUIRE(text);
  CHECK(page->find(*text) != std::string::npos);
  const auto project = load_project(example);
  REQUIRE(project);
  const auto found = reconstruct(*project, {});
  REQUIRE(found);
  CHECK(found->warnings.empty());
  CHECK(found->score.iou > 0.98);
  const auto design = tree_file(found->tree, "elbow.scad", {}, {});
  REQUIRE(design);
  const std::size_t first = design->find("module body()");
  REQUIRE(first != std::string::npos);
  CHECK(page->find(design->substr(first)) != std::string::npos);
}

}  // namespace
}  // namespace hewn
