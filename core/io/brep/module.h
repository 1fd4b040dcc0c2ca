#pragma once
/// OpenCASCADE behind a library that is loaded when it is first needed: binding its symbols takes
/// longer than most commands run. Private to core/io.
///
/// The library shares nothing with the program but header-only types, so that no layer is linked
/// into it.
#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree.h"

namespace hewn {

/// How Booleans are evaluated; the later ones forgive more and cost more.
enum class BooleanStrategy { Together, Pairwise, Fuzzy };

/// OpenCASCADE's tolerances are absolute: shapes are built about the origin at this diagonal.
inline constexpr double kBrepDiagonal = 100;

/// A tree without complements, and its bounds.
struct BrepInput {
  const Tree& tree;
  Box3 bounds;
};

struct TriangleSoup {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

struct BrepFunctions {
  /// Triangles of the solid's faces, not yet joined; `deflection` as a share of the diagonal.
  /// Fails with: InvalidArgument (nothing bounded to build), Internal, Cancelled.
  Result<TriangleSoup> (*triangulate)(const BrepInput& input, BooleanStrategy strategy,
                                      double angle_deg, double deflection, const RunContext& run);
  /// Fails with: InvalidArgument (nothing bounded to build), Internal, FileWrite, Cancelled.
  Result<void> (*write_step)(const BrepInput& input, const std::filesystem::path& path,
                             const RunContext& run);
};

/// The library's file; it lies beside the program.
inline constexpr const char* kBrepLibrary = "libhewn-brep.so";
/// Its one symbol: a `const BrepFunctions* ()`.
inline constexpr const char* kBrepSymbol = "hewn_brep_functions";

/// Loads the library, which stays loaded. Fails with: Internal (not found, or not loadable).
Result<const BrepFunctions*> brep_functions();

}  // namespace hewn
