#pragma once
/// A tree as an exact boundary representation (OpenCASCADE). Only the library that
/// needs OpenCASCADE includes it, because its headers are slow to compile.
#include <TopoDS_Shape.hxx>

#include "core/io/brep/module.h"

namespace hewn {

/// Where a shape lies: model point = center + shape point / scale.
struct Brep {
  TopoDS_Shape shape;
  Vec3 center = Vec3::Zero();
  double scale = 1;
};

/// Fails with: InvalidArgument (nothing bounded to build), Internal (OpenCASCADE gave up; `where`
/// names the operation), Cancelled (between Booleans).
Result<Brep> build_brep(const BrepInput& input, BooleanStrategy strategy, const RunContext& run);

}  // namespace hewn
