#include "core/io/scad_names.h"

#include <doctest/doctest.h>

namespace hewn {
namespace {

TEST_CASE("a valid name stays as it is and is given once") {
  ModuleNames names;
  CHECK(names.unique("mounting_plate") == "mounting_plate");
  CHECK(names.unique("mounting_plate") == "mounting_plate_2");
  CHECK(names.unique("mounting plate") == "mounting_plate_3");
}

TEST_CASE("foreign characters, keywords and digits are made valid") {
  ModuleNames names;
  CHECK(names.unique("") == "part");
  CHECK(names.unique("+++") == "part_2");
  CHECK(names.unique("union") == "part_union");
  CHECK(names.unique("3rd hole") == "part_3rd_hole");
  CHECK(names.unique("H\xC3\xBClse") == "H_lse");
  CHECK(names.unique("a(); cube(1); //") == "a_cube_1");
}

}  // namespace
}  // namespace hewn
