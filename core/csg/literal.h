#pragma once
/// The bounded solids at the leaves of a tree.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/math.h"
#include "core/mesh/mesh.h"

namespace hewn {

class MeshQuery;

enum class SolidKind { Box, Cylinder, Prism, Sphere, Torus, Polyhedron };

/// How the input mesh approximated a curved literal, for export that reproduces its facets.
struct Facets {
  int sides = 0;         ///< around the axis; 0: unknown or irregular
  double phase_rad = 0;  ///< of a vertex, about the local z axis from the local x axis
  int tube_sides = 0;    ///< torus: around the tube; sphere: rings
  double tube_phase_rad = 0;
};

/// A linear map of a solid onto itself stretched or sheared, with what evaluation needs of it.
struct Stretch {
  Mat3 matrix = Mat3::Identity();
  Mat3 inverse = Mat3::Identity();
  double least = 1;  ///< no length shrinks by a smaller factor, > 0

  /// Requires: an invertible matrix.
  static Stretch of(const Mat3& matrix);
};

/// A solid in canonical position, moved by `rotation` and then measured in rotated coordinates:
/// a point x of space has local coordinates `rotation^T x - origin`. Literals with the same
/// rotation therefore share exact coordinates, and coincident faces stay coincident.
/// A literal with a `stretch` is deformed by it first: its local coordinates are
/// `stretch^-1 (rotation^T x - origin)`.
///
/// Canonical positions: Box [0, size]; Cylinder (a frustum when the radii differ) around z from
/// z = 0 to `height`; Prism, a regular one, likewise (see prism.h); Sphere at the origin; Torus
/// around z; Polyhedron as its mesh says.
struct Literal {
  SolidKind kind = SolidKind::Box;
  Mat3 rotation = Mat3::Identity();
  Vec3 origin = Vec3::Zero();
  Vec3 size = Vec3::Zero();  ///< box
  double height = 0;         ///< cylinder, prism
  double radius = 0;         ///< sphere; cylinder: at z = 0; prism: inscribed; torus: of the tube
  double top_radius = 0;     ///< cylinder: at z = height
  double major_radius = 0;   ///< torus
  int sides = 0;             ///< prism, >= 3
  std::shared_ptr<const Mesh> polyhedron;
  /// Answers distances to `polyhedron` in O(log triangles); without it each costs O(triangles).
  std::shared_ptr<const MeshQuery> polyhedron_query;
  Facets facets;
  /// For what no other field can say: ellipsoids, oblique boxes, elliptic cylinders. Never on a
  /// polyhedron (`transformed` moves its vertices).
  std::optional<Stretch> stretch;

  Vec3 to_local(const Vec3& x) const {
    const Vec3 p = rotation.transpose() * x - origin;
    return stretch ? Vec3(stretch->inverse * p) : p;
  }
  /// A direction in local coordinates; not of the same length when stretched.
  Vec3 direction_to_local(const Vec3& d) const {
    const Vec3 p = rotation.transpose() * d;
    return stretch ? Vec3(stretch->inverse * p) : p;
  }
  Vec3 to_world(const Vec3& local) const {
    return rotation * ((stretch ? Vec3(stretch->matrix * local) : local) + origin);
  }
  /// Signed distance, negative inside; exact but for stretched literals and inside a spindle torus
  /// and a polyhedron of several overlapping parts, where it is a bound. Cost: O(1); a polyhedron:
  /// see `polyhedron_query`.
  double signed_distance(const Vec3& x) const;
  /// Whether it is negative, at a lower cost.
  bool contains(const Vec3& x) const;
  /// The tightest axis-aligned box.
  Box3 bounds() const;
};

/// A polyhedron literal at its mesh's place, with its query. Requires: a closed mesh.
Literal polyhedron_literal(std::shared_ptr<const Mesh> mesh);

/// The literal moved by an affine map: by its fields where they can say it (turned, mirrored,
/// scaled along its own axes), else with a `stretch`. Facets of mirrored or stretched literals may
/// lose their phase. Requires: an invertible, finite map.
Literal transformed(const Literal& literal, const Affine3& map);

/// "cube", "cylinder", "prism", "sphere", "torus" or "polyhedron".
const char* name_of(SolidKind kind);

}  // namespace hewn
