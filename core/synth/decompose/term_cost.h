#pragma once
/// How many bounded primitives a term takes: planes at right angles share a box, planes across an
/// axis cap the cylinder, cone or prism on it.
#include <vector>

#include "core/fit/regular_prisms.h"
#include "core/fit/surface_set.h"
#include "core/synth/decompose/term.h"

namespace hewn {

/// One bounded primitive of a term.
struct PrimitivePlan {
  int curved = -1;                  ///< halfspace of the curved surface; -1: none
  int prism = -1;                   ///< index into `Combinability::prisms()`; -1: none
  bool inside = true;               ///< the term lies inside the curved surface
  std::vector<TermLiteral> planes;  ///< box sides, or caps

  bool is_box() const { return curved < 0 && prism < 0; }
  /// Boxes, prisms and insides are intersected; the outside of a curved surface is subtracted.
  bool is_positive() const { return curved < 0 || inside; }
};

/// Which halfspaces can share a primitive.
class Combinability {
 public:
  explicit Combinability(const SurfaceSet& surfaces);

  SurfaceKind kind(int halfspace) const { return kinds_[halfspace]; }
  bool is_plane(int halfspace) const { return kinds_[halfspace] == SurfaceKind::Plane; }
  /// Two planes that can be sides of one box.
  bool share_box(int plane_a, int plane_b) const {
    return relation(plane_a, plane_b) != Relation::Oblique;
  }
  /// The plane cuts the cylinder or cone at a right angle.
  bool caps(int plane, int curved) const {
    return (kinds_[curved] == SurfaceKind::Cylinder || kinds_[curved] == SurfaceKind::Cone) &&
           relation(plane, curved) == Relation::Parallel;
  }
  const std::vector<RegularPrism>& prisms() const { return prisms_; }
  /// The plane cuts the prism at a right angle.
  bool caps_prism(int plane, int prism) const { return prism_caps_[prism][plane] != 0; }

 private:
  enum class Relation : char { Oblique, Parallel, Square };
  Relation relation(int a, int b) const {
    const int i = directions_[a];
    const int j = directions_[b];
    return i < 0 || j < 0 ? Relation::Oblique
                          : relations_[static_cast<std::size_t>(i) * direction_count_ +
                                       static_cast<std::size_t>(j)];
  }

  std::vector<SurfaceKind> kinds_;
  std::vector<int> directions_;
  std::size_t direction_count_;
  std::vector<Relation> relations_;
  std::vector<RegularPrism> prisms_;
  std::vector<std::vector<char>> prism_caps_;  // by prism, by halfspace
};

/// Distributes the term's literals over bounded primitives. The result has a positive one.
std::vector<PrimitivePlan> plan_primitives(const std::vector<TermLiteral>& literals,
                                           const Combinability& combinability);

/// `plan_primitives(...).size()`.
int term_cost(const std::vector<TermLiteral>& literals, const Combinability& combinability);

}  // namespace hewn
