#include "core/mesh/load.h"

#include <cstring>

#include <doctest/doctest.h>

#include "tests/core/mesh/scratch_file.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

const std::string kTetra =
    "4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

Result<LoadedMesh> load(std::string_view content, std::string_view extension,
                        const MeshLoadOptions& options = {}) {
  const ScratchFile file(content, extension);
  return load_mesh(file.path(), options, {});
}

bool has_text(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

/// Loads content that must be refused, and checks code, message and place.
void check_refused(std::string_view content, std::string_view extension, ErrorCode code,
                   std::string_view message, std::string_view where) {
  CAPTURE(content.substr(0, 60));
  const auto loaded = load(content, extension);
  REQUIRE(!loaded);
  CHECK(loaded.error().code == code);
  INFO(loaded.error().message);
  CHECK(has_text(loaded.error().message, message));
  INFO(loaded.error().where);
  CHECK(has_text(loaded.error().where, where));
}

bool warns(const LoadedMesh& loaded, std::string_view part) {
  for (const std::string& w : loaded.report.warnings) {
    if (has_text(w, part)) return true;
  }
  return false;
}

TEST_CASE("every format written is read back as the same solid") {
  const Mesh box =
      solids::transformed(solids::box({0, 0, 0}, {1, 2, 3}), solids::oblique_transform());
  for (const char* extension : {".off", ".stl", ".obj", ".ply"}) {
    CAPTURE(extension);
    const ScratchFile file(extension);
    REQUIRE(save_mesh(box, file.path()));
    const auto loaded = load_mesh(file.path(), {}, {});
    REQUIRE(loaded);
    CHECK(loaded->report.is_closed);
    CHECK(loaded->mesh.vertices.size() == 8);
    CHECK(loaded->mesh.triangles.size() == 12);
    CHECK(loaded->mesh.volume == doctest::Approx(6).epsilon(1e-5));
  }
}

TEST_CASE("text keeps all digits of a coordinate") {
  const auto loaded = load("OFF\n3 1 0\n0.12345678901234567 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ".off");
  REQUIRE(loaded);
  CHECK(loaded->mesh.vertices[0].x() == 0.12345678901234567);
}

TEST_CASE("OFF variants, comments and glued counts are read") {
  CHECK(load("OFF\n" + kTetra, ".off"));
  CHECK(load("# by hand\nOFF # again\n\n" + kTetra, ".off"));
  CHECK(load("OFF" + kTetra, ".off"));
  CHECK(load("OFF\r\n3 1 0\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n", ".off"));
  CHECK(load("COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 1 1 1 1\n0 1 0 9 9 9 9\n3 0 1 2 0.5 0.5 0.5\n",
             ".off"));
}

TEST_CASE("a face with many corners becomes triangles, a concave one too") {
  // An L: a fan from corner 0 would cover the notch.
  const auto loaded =
      load("OFF\n6 1 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n0 0 0\n6 0 1 2 3 4 5\n", ".off");
  REQUIRE(loaded);
  CHECK(loaded->mesh.triangles.size() == 4);
  CHECK(loaded->mesh.total_area == doctest::Approx(3));
}

TEST_CASE("an OBJ counts from one, backwards, and with slashes") {
  const auto loaded =
      load("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2/1/1 3\nf -3 -1 -2\n", ".obj");
  REQUIRE(loaded);  // the same triangle twice, back to back
  CHECK(loaded->report.duplicates_removed == 1);
  CHECK(loaded->mesh.triangles.size() == 1);
  CHECK(load("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2/1/1 3\n", ".obj"));
}

TEST_CASE("a binary PLY of either byte order is read, with foreign properties") {
  const auto make = [](bool big) {
    std::string text = std::string("ply\nformat ") +
                       (big ? "binary_big_endian" : "binary_little_endian") +
                       " 1.0\ncomment made by a test\nelement vertex 3\nproperty uchar red\n"
                       "property float x\nproperty double y\nproperty float z\nelement face 1\n"
                       "property list uchar float weights\nproperty list uchar short "
                       "vertex_index\nend_header\n";
    const auto put = [&](auto value) {
      char bytes[sizeof value];
      std::memcpy(bytes, &value, sizeof value);
      if (big) std::reverse(bytes, bytes + sizeof value);
      text.append(bytes, sizeof value);
    };
    for (int i = 0; i < 3; ++i) {
      put(static_cast<unsigned char>(9));
      put(static_cast<float>(i == 1));
      put(static_cast<double>(i == 2) * 0.1);
      put(0.5f);
    }
    put(static_cast<unsigned char>(1));
    put(2.5f);
    put(static_cast<unsigned char>(3));
    for (short i = 0; i < 3; ++i) put(i);
    return text;
  };
  for (const bool big : {false, true}) {
    const auto loaded = load(make(big), ".ply");
    REQUIRE(loaded);
    CHECK(loaded->report.format == "PLY");
    CHECK(loaded->mesh.bounds.hi == Vec3(1, 0.1, 0.5));
    const std::string cut = make(big).substr(0, make(big).size() - 3);
    check_refused(cut, ".ply", ErrorCode::Format, "truncated", "byte");
  }
}

TEST_CASE("a name that does not fit the content is read with a warning") {
  const auto loaded = load("OFF\n" + kTetra, ".stl");
  REQUIRE(loaded);
  CHECK(loaded->report.format == "OFF");
  CHECK(warns(*loaded, "The name ends in '.stl', but the file holds OFF"));
  CHECK(load("OFF\n" + kTetra, ".off")->report.warnings.empty());
}

TEST_CASE("a binary STL that starts with 'solid' is read as binary") {
  const ScratchFile file(".stl");
  REQUIRE(save_mesh(solids::box({0, 0, 0}, {1, 1, 1}), file.path()));
  std::ifstream in(file.path(), std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  bytes.replace(0, 10, "solid part");
  const auto loaded = load(bytes, ".stl");
  REQUIRE(loaded);
  CHECK(loaded->report.format == "STL (binary)");
  check_refused(bytes.substr(0, 300), ".stl", ErrorCode::Format, "promises 12 triangles",
                "byte 80");
}

TEST_CASE("an ASCII STL is read in any case and refused when cut") {
  const std::string facet =
      "solid x\n FACET normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n"
      "   vertex 0 1e0 +0\n  endloop\n endfacet\n";
  const auto loaded = load(facet + "endsolid x\n", ".stl");
  REQUIRE(loaded);
  CHECK(loaded->report.format == "STL (ASCII)");
  CHECK(loaded->report.triangles_read == 1);
  check_refused(facet, ".stl", ErrorCode::Format, "endsolid", ":8");
  check_refused(facet + "rubbish\n", ".stl", ErrorCode::Format, "'rubbish'", ":9");
  check_refused("solid x\nfacet\nouter loop\nvertex 0 zero 0\n", ".stl", ErrorCode::Format,
                "'zero'", ":4");
}

TEST_CASE("a missing file and a folder are told apart") {
  const auto missing = load_mesh("/no/such/part.off", {}, {});
  REQUIRE(!missing);
  CHECK(missing.error().code == ErrorCode::FileNotFound);
  CHECK(missing.error().where == "/no/such/part.off");
  const auto folder = load_mesh(std::filesystem::temp_directory_path(), {}, {});
  REQUIRE(!folder);
  CHECK(has_text(folder.error().message, "folder"));
}

TEST_CASE("files that hold no mesh are refused with place and advice") {
  check_refused("", ".off", ErrorCode::Format, "empty", ".off");
  check_refused("\n\n", ".stl", ErrorCode::Format, "2 bytes", "byte 2");
  check_refused("hello world\n", ".off", ErrorCode::Format, "starts with 'OFF'", ":1");
  check_refused(std::string("PK\x03\x04rest", 8), ".obj", ErrorCode::Format, "ZIP", ":1");
  check_refused("ISO-10303-21;\n", ".ply", ErrorCode::Format, "STEP", ":1");
  check_refused("OFF BINARY\n", ".off", ErrorCode::Format, "save it as text", ":1");
  check_refused("4OFF\n1 1 1\n", ".off", ErrorCode::Format, "4-dimensional", ":1");
}

TEST_CASE("truncated and damaged OFF files name the line") {
  check_refused("OFF\n", ".off", ErrorCode::Format, "counts", ":1");
  check_refused("OFF\nx y\n", ".off", ErrorCode::Format, "'x' 'y'", ":2");
  check_refused("OFF\n3 1 0\n0 0 0\n1 0\n", ".off", ErrorCode::Format,
                "vertex 1 needs 3 numbers, found the end of the line", ":4");
  check_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n", ".off", ErrorCode::Format,
                "ends after 2 of 3 vertices", ":4");
  check_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n", ".off", ErrorCode::Format,
                "ends after 0 of 1 faces", ":5");
  check_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n", ".off", ErrorCode::Format,
                "names vertex 9, but the vertices are 0 to 2", ":6");
  check_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", ".off", ErrorCode::Format,
                "names vertex -1", ":6");
  check_refused("OFF\n2000000000 1 0\n0 0 0\n", ".off", ErrorCode::Format, "promises 2000000000",
                ":2");
}

TEST_CASE("NaN, infinite and overflowing coordinates are bad meshes at a line") {
  for (const char* bad : {"nan", "inf", "-INF", "1e999"}) {
    CAPTURE(bad);
    check_refused(std::string("OFF\n3 1 0\n0 0 0\n1 0 ") + bad + "\n0 1 0\n3 0 1 2\n", ".off",
                  ErrorCode::BadMesh, "not a number", ":4");
  }
  check_refused("v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n", ".obj", ErrorCode::BadMesh,
                "not a number", ":3");
  check_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1e70 0\n3 0 1 2\n", ".off", ErrorCode::BadMesh, "1e60",
                "vertex 2");
}

TEST_CASE("damaged OBJ and PLY files name the line") {
  check_refused("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", ".obj", ErrorCode::Format,
                "names vertex 4, but only 3", ":4");
  check_refused("v 0 0 0\nf 1 1\n", ".obj", ErrorCode::Format, "needs at least 3", ":2");
  check_refused("v 0 0 0\n", ".obj", ErrorCode::Format, "no face", ":1");
  check_refused("ply\nformat ascii 1.0\n", ".ply", ErrorCode::Format, "end_header", ":");
  check_refused("ply\nformat weird 1.0\nend_header\n", ".ply", ErrorCode::Format, "'weird'", ":2");
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  CHECK(load(head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ".ply"));
  check_refused(head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", ".ply", ErrorCode::Format,
                "names vertex 7", ":13");
  check_refused(head + "0 0 0\n1 0 0\n0 x 0\n3 0 1 2\n", ".ply", ErrorCode::Format, "entry 2",
                ":12");
  check_refused("ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n", ".ply",
                ErrorCode::Format, "x, y and z", "");
}

TEST_CASE("a mesh above the limit is too large") {
  MeshLoadOptions options;
  options.max_triangles = 3;
  const auto loaded = load("OFF\n" + kTetra, ".off", options);
  REQUIRE(!loaded);
  CHECK(loaded.error().code == ErrorCode::TooLarge);
  CHECK(has_text(loaded.error().message, "limit is 3"));
}

TEST_CASE("a cancelled load stops") {
  RunContext run;
  run.cancel->cancel();
  const ScratchFile file("OFF\n" + kTetra, ".off");
  const auto loaded = load_mesh(file.path(), {}, run);
  REQUIRE(!loaded);
  CHECK(loaded.error().code == ErrorCode::Cancelled);
}

TEST_CASE("one triangle is loaded and reported as open") {
  const auto loaded = load("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ".off");
  REQUIRE(loaded);
  CHECK(loaded->report.holes == 1);
  CHECK(loaded->report.boundary_edges == 3);
  CHECK(!loaded->report.is_closed);
  CHECK(warns(*loaded, "open"));
}

}  // namespace
}  // namespace hewn
