#pragma once
/// A tree as an exact boundary representation (OpenCASCADE). Private to this layer: only the .cpp
/// files that need OpenCASCADE include it, because its headers are slow to compile.
#include <TopoDS_Shape.hxx>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree.h"

namespace hewn {

/// OpenCASCADE's tolerances are absolute: shapes are built about the origin at this diagonal.
inline constexpr double kBrepDiagonal = 100;

/// Where a shape lies: model point = center + shape point / scale.
struct Brep {
  TopoDS_Shape shape;
  Vec3 center = Vec3::Zero();
  double scale = 1;
};

/// How Booleans are evaluated; the later ones forgive more and cost more.
enum class BooleanStrategy { Together, Pairwise, Fuzzy };

/// Fails with: InvalidArgument (nothing bounded to build), Internal (OpenCASCADE gave up; `where`
/// names the operation), Cancelled (between Booleans).
Result<Brep> build_brep(const Tree& tree, BooleanStrategy strategy, const RunContext& run);

}  // namespace hewn
