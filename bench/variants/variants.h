#pragma once
/// What people do to a mesh without meaning to change the part.
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/mesh/mesh.h"

namespace hewn {

struct Variant {
  std::string name;       ///< "rotated", "scaled-up", "scaled-down", "moved", "binary", "jittered",
                          ///< "remeshed"
  std::string extension;  ///< ".off", or ".stl" for the one whose point is the format
  Mesh mesh;
};

/// All seven variants. `run.seed` chooses the rotation, the direction of the move and the jitter.
/// Fails with: BadMesh (cannot be remeshed), Cancelled.
Result<std::vector<Variant>> make_variants(const Mesh& mesh, const RunContext& run);

/// Writes every variant to `folder` as STEM-NAME.EXT and returns the paths.
/// Fails with: FileWrite and what `make_variants` fails with.
Result<std::vector<std::filesystem::path>> write_variants(const Mesh& mesh,
                                                          const std::filesystem::path& folder,
                                                          const std::string& stem,
                                                          const RunContext& run);

}  // namespace hewn
