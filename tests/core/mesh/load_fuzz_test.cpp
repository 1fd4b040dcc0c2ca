#include <fstream>
#include <iterator>

#include <doctest/doctest.h>

#include "core/base/rng.h"
#include "core/mesh/load.h"
#include "tests/core/mesh/scratch_file.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

std::string bytes_of(const Mesh& mesh, const char* extension) {
  const ScratchFile file(extension);
  REQUIRE(save_mesh(mesh, file.path()));
  std::ifstream in(file.path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void mutate(std::string& bytes, Rng& rng) {
  static constexpr std::string_view kTokens[] = {"nan", "-1", "1e309", "99999999999", "\0", "\n"};
  const std::size_t changes = 1 + rng.below(6);
  for (std::size_t i = 0; i < changes && !bytes.empty(); ++i) {
    const std::size_t at = rng.below(bytes.size());
    const std::size_t kind = rng.below(5);
    if (kind == 0) bytes.resize(at);
    if (kind == 1) bytes[at] = static_cast<char>(rng.below(256));
    if (kind == 2) bytes.erase(at, 1 + rng.below(8));
    if (kind == 3) bytes.insert(at, kTokens[rng.below(std::size(kTokens))]);
    if (kind == 4) bytes[at] = static_cast<char>(bytes[at] ^ (1 << rng.below(8)));
  }
}

/// What a loaded mesh promises, whatever the file held.
void check_sound(const LoadedMesh& loaded) {
  const Mesh& mesh = loaded.mesh;
  REQUIRE(!mesh.triangles.empty());
  CHECK(mesh.normals.size() == mesh.triangles.size());
  const int count = static_cast<int>(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    for (const int i : t) REQUIRE((i >= 0 && i < count));
    REQUIRE((t[0] != t[1] && t[1] != t[2] && t[2] != t[0]));
  }
  for (const Vec3& v : mesh.vertices) REQUIRE(v.allFinite());
  if (loaded.report.is_closed) CHECK(loaded.report.boundary_edges == 0);
}

TEST_CASE("a damaged file is either a sound mesh or an error that says what and where") {
  const Mesh part = solids::block_with_fillet({3, 2, 1}, 0.4, 4);
  Rng rng(2026);
  int refused = 0;
  int loaded_count = 0;
  for (const char* extension : {".off", ".stl", ".obj", ".ply"}) {
    const std::string original = bytes_of(part, extension);
    for (int i = 0; i < 400; ++i) {
      std::string bytes = original;
      mutate(bytes, rng);
      const ScratchFile file(bytes, extension);
      const auto loaded = load_mesh(file.path(), {}, {});
      if (loaded) {
        ++loaded_count;
        check_sound(*loaded);
        continue;
      }
      ++refused;
      CHECK(loaded.error().code != ErrorCode::Internal);
      CHECK(loaded.error().message.size() > 10);
      CHECK(loaded.error().where.find(file.path().string()) == 0);
    }
  }
  CHECK(refused > 100);
  CHECK(loaded_count > 50);
}

}  // namespace
}  // namespace hewn
