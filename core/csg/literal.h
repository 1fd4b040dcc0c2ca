#pragma once
/// The bounded solids at the leaves of a tree.
#include <memory>
#include <string>
#include <vector>

#include "core/base/math.h"
#include "core/mesh/mesh.h"

namespace hewn {

class MeshQuery;

enum class SolidKind { Box, Cylinder, Sphere, Torus, Polyhedron };

/// How the input mesh approximated a curved literal, for export that reproduces its facets.
struct Facets {
  int sides = 0;         ///< around the axis; 0: unknown or irregular
  double phase_rad = 0;  ///< of a vertex, about the local z axis from the local x axis
  int tube_sides = 0;    ///< torus: around the tube; sphere: rings
  double tube_phase_rad = 0;
};

/// A solid in canonical position, moved by `rotation` and then measured in rotated coordinates:
/// a point x of space has local coordinates `rotation^T x - origin`. Literals with the same
/// rotation therefore share exact coordinates, and coincident faces stay coincident.
///
/// Canonical positions: Box [0, size]; Cylinder (a frustum when the radii differ) around z from
/// z = 0 to `height`; Sphere at the origin; Torus around z; Polyhedron as its mesh says.
struct Literal {
  SolidKind kind = SolidKind::Box;
  Mat3 rotation = Mat3::Identity();
  Vec3 origin = Vec3::Zero();
  Vec3 size = Vec3::Zero();  ///< box
  double height = 0;         ///< cylinder
  double radius = 0;         ///< sphere; cylinder: at z = 0; torus: of the tube
  double top_radius = 0;     ///< cylinder: at z = height
  double major_radius = 0;   ///< torus
  std::shared_ptr<const Mesh> polyhedron;
  /// Answers distances to `polyhedron` in O(log triangles); without it each costs O(triangles).
  std::shared_ptr<const MeshQuery> polyhedron_query;
  Facets facets;

  Vec3 to_local(const Vec3& x) const { return rotation.transpose() * x - origin; }
  Vec3 to_world(const Vec3& local) const { return rotation * (local + origin); }
  /// Signed distance, negative inside; exact but inside a spindle torus and a polyhedron of
  /// several overlapping parts, where it is a bound. Cost: O(1); a polyhedron: see
  /// `polyhedron_query`.
  double signed_distance(const Vec3& x) const;
  /// The tightest axis-aligned box.
  Box3 bounds() const;
};

/// A polyhedron literal at its mesh's place, with its query. Requires: a closed mesh.
Literal polyhedron_literal(std::shared_ptr<const Mesh> mesh);

/// "cube", "cylinder", "sphere", "torus" or "polyhedron".
const char* name_of(SolidKind kind);

}  // namespace hewn
