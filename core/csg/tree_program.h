#pragma once
/// A tree as flat numbers, for drawing it ray by ray without its nodes: literals as canonical
/// solids with the map into their coordinates, and the Boolean tree as a branching program.
#include <array>
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/csg/branching_program.h"
#include "core/csg/tree.h"

namespace hewn {

/// Single precision; the same 16 numbers as shaders/tree_solids.glsl reads.
struct ProgramLiteral {
  /// Rows of the map from coordinates less `TreeProgram::origin` to the literal's own.
  std::array<float, 12> to_local{};
  /// `SolidKind` as a number, then: box size x, y, z; cylinder radius, top radius, height; prism
  /// inscribed radius, height, sides; sphere radius; torus ring radius, tube radius.
  std::array<float, 4> shape{};
};

struct TreeProgram : BranchingProgram {
  Vec3 origin = Vec3::Zero();
  Box3 bounds;                           ///< of the solid, model coordinates
  std::vector<ProgramLiteral> literals;  ///< in the tree's order
  int stretches = 0;  ///< at most so many intervals lie on a ray, over all literals
  /// As which literal each flat end is shown, six a literal: by axis, the lower end first.
  std::vector<std::int32_t> shown;
};

/// A ray may cross at most so many intervals; a torus counts twice.
inline constexpr int kMostStretches = 128;
/// Prisms of more sides are drawn as triangles.
inline constexpr int kMostProgramSides = 64;

/// The program of a tree. Cost: O(nodes).
/// Fails with InvalidArgument, and the reason as its message: an empty or unbounded tree, a
/// polyhedron, too many literals or sides.
Result<TreeProgram> encode_tree(const Tree& tree);

}  // namespace hewn
