#include <doctest/doctest.h>

#include "core/mesh/load.h"
#include "tests/core/mesh/scratch_file.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

TEST_CASE("an OFF file holds every bit of the coordinates") {
  const Mesh sphere = solids::transformed(solids::sphere(1, 8, 4), solids::oblique_transform());
  const ScratchFile file(".off");
  REQUIRE(save_mesh(sphere, file.path()));
  const auto loaded = load_mesh(file.path(), {}, {});
  REQUIRE(loaded);
  CHECK(loaded->mesh.vertices == sphere.vertices);
}

TEST_CASE("an unknown extension and a missing folder are refused") {
  const Mesh box = solids::box({0, 0, 0}, {1, 1, 1});
  const auto unknown = save_mesh(box, "part.xyz");
  REQUIRE(!unknown);
  CHECK(unknown.error().code == ErrorCode::InvalidArgument);
  CHECK(unknown.error().message.find("'.xyz'") != std::string::npos);
  const auto nowhere = save_mesh(box, "/no/such/folder/part.stl");
  REQUIRE(!nowhere);
  CHECK(nowhere.error().code == ErrorCode::FileWrite);
}

}  // namespace
}  // namespace hewn
