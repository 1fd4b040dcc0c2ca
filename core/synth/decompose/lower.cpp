#include "core/synth/decompose/lower.h"

#include <algorithm>
#include <cmath>

#include "core/base/nearest_rotation.h"
#include "core/csg/prism.h"
#include "core/synth/decompose/shorten.h"
#include "core/synth/decompose/term_cost.h"

namespace hewn {
namespace {

constexpr double kParallel = 1e-9;
constexpr double kMarginShare = 0.02;  // of the diagonal: how far tools stick out

/// The largest of 1, 2, 5 x 10^n that is no larger than `x`.
double round_down_nicely(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  const double lead = x / power;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
}

struct Interval {
  double lo = -kInfinity, hi = kInfinity;
};

using Corners = std::vector<Vec3>;

/// What an open end of a primitive has to reach.
struct Room {
  const std::vector<TermLiteral>* work_ends = nullptr;
  std::vector<Corners> within;  ///< of the solids that it is taken out of
};

/// The axis with its largest component positive.
Vec3 upright(const Vec3& axis) {
  int largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0 ? Vec3(-axis) : axis;
}

class Lowering {
 public:
  Lowering(const SurfaceSet& surfaces, const Mesh& mesh, const std::vector<int>& triangles,
           const Frame& frame, const LoweringOptions& options)
      : surfaces_(surfaces),
        combinability_(surfaces),
        mesh_(mesh),
        triangles_(triangles),
        frame_(frame),
        options_(options),
        margin_(round_down_nicely(kMarginShare * mesh.diagonal())) {}

  Tree lower(const DecisionList& list) {
    collect_reach(list);
    if (list.base) tree_.root = add(frame_box());
    for (std::size_t k = list.items.size(); k > 0;) {
      const bool fills = list.items[k - 1]->fills;
      std::vector<int> terms;
      for (; k > 0 && list.items[k - 1]->fills == fills; --k) {
        if (fills || tree_.root >= 0) terms.push_back(term(*list.items[k - 1]));
      }
      if (terms.empty()) continue;  // nothing to subtract from
      sort_by_bulk(terms);
      std::vector<int> children;
      if (tree_.root >= 0) children.push_back(tree_.root);
      children.insert(children.end(), terms.begin(), terms.end());
      tree_.root = children.size() == 1
                       ? children[0]
                       : tree_.add_node(fills ? Op::Union : Op::Difference, std::move(children));
    }
    if (options_.clip && tree_.root >= 0) {
      tree_.root = tree_.add_node(Op::Intersection, {tree_.root, add(frame_box())});
    }
    shorten_tools(tree_, shorter_, options_.threads);
    return flattened(tree_);
  }

 private:
  /// The order of operands of one kind is free: a reader looks for the large ones first.
  void sort_by_bulk(std::vector<int>& nodes) const {
    std::stable_sort(nodes.begin(), nodes.end(),
                     [this](int a, int b) { return bulk(a) > bulk(b); });
  }

  /// The volume of a node's first literal but for constant factors.
  double bulk(int node) const {
    const Node& n = tree_.nodes[node];
    if (n.op != Op::Literal) return bulk(n.children.front());
    return local_bounds(tree_.literals[n.literal]).size().prod();
  }

  int add(Literal literal) { return tree_.add_literal(std::move(literal)); }

  Literal frame_box() const {
    Literal box;
    box.kind = SolidKind::Box;
    box.rotation = frame_.rotation;
    box.origin = frame_.box.lo;
    box.size = frame_.box.size();
    return box;
  }

  int term(const Term& t) {
    std::vector<int> kept;
    std::vector<int> removed;
    const auto plans = plan_primitives(t.literals, combinability_);
    // Unbounded sides: solids end with the geometry, tools reach beyond it, and what is taken out
    // of a term reaches beyond the rest of it.
    const int reach = t.fills && !options_.is_tool ? 0 : 1;
    for (const PrimitivePlan& plan : plans) {
      if (!plan.is_positive()) continue;
      kept.push_back(add(primitive(plan, reach, {})));
      if (!options_.shortens_tools || t.work_ends.empty()) continue;
      const int literal = tree_.nodes[static_cast<std::size_t>(kept.back())].literal;
      shorter_.push_back({literal, primitive(plan, reach, {&t.work_ends, {}})});
    }
    Room room;
    for (const int node : kept) {
      if (!options_.shortens_tools) break;
      room.within.push_back(corners_of(tree_.literals[tree_.nodes[node].literal]));
    }
    for (const PrimitivePlan& plan : plans) {
      if (!plan.is_positive()) removed.push_back(add(primitive(plan, reach + 1, room)));
    }
    int node = kept.size() == 1 ? kept[0] : tree_.add_node(Op::Intersection, kept);
    if (!removed.empty()) {
      removed.insert(removed.begin(), node);
      node = tree_.add_node(Op::Difference, removed);
    }
    return node;
  }

  /// The corners of everything that is united: what tools must be able to reach. A united box at
  /// an angle may stand out of the geometry where a tool takes it away again.
  void collect_reach(const DecisionList& list) {
    reach_ = corners_of(frame_box());
    for (const TermPtr& item : list.items) {
      if (!item->fills) continue;
      for (const PrimitivePlan& plan : plan_primitives(item->literals, combinability_)) {
        if (!plan.is_positive()) continue;
        const Corners corners = corners_of(primitive(plan, 0, {}));
        reach_.insert(reach_.end(), corners.begin(), corners.end());
      }
    }
  }

  static Corners corners_of(const Literal& literal) {
    const Box3 box = local_bounds(literal);
    Corners corners;
    for (int k = 0; k < 8; ++k) {
      const Vec3 pick((k & 1) != 0, (k & 2) != 0, (k & 4) != 0);
      corners.emplace_back(literal.rotation * (box.lo + pick.cwiseProduct(box.size())));
    }
    return corners;
  }

  /// The literal's box in its own rotated coordinates.
  static Box3 local_bounds(const Literal& l) {
    if (l.kind == SolidKind::Box) return {l.origin, l.origin + l.size};
    const bool is_prism = l.kind == SolidKind::Prism;
    const double radius =
        is_prism ? circumradius(l) : std::max(l.radius, l.top_radius) + l.major_radius;
    const bool is_upright = is_prism || l.kind == SolidKind::Cylinder;
    const Vec3 below(radius, radius, is_upright ? 0 : radius);
    const Vec3 above(radius, radius, is_upright ? l.height : radius);
    return {l.origin - below, l.origin + above};
  }

  static Interval extent_of(const Corners& points, const Vec3& direction) {
    Interval e{kInfinity, -kInfinity};
    for (const Vec3& p : points) {
      e.lo = std::min(e.lo, direction.dot(p));
      e.hi = std::max(e.hi, direction.dot(p));
    }
    return e;
  }

  /// The extent of the geometry along a direction.
  Interval extent(const Vec3& direction) const {
    if (triangles_.empty()) return extent_of(mesh_.vertices, direction);
    Interval e{kInfinity, -kInfinity};
    for (const int t : triangles_) {
      for (int k = 0; k < 3; ++k) {
        e.lo = std::min(e.lo, direction.dot(mesh_.corner(t, k)));
        e.hi = std::max(e.hi, direction.dot(mesh_.corner(t, k)));
      }
    }
    return e;
  }

  /// Bounds of the plane sides along `axis`.
  Interval bounds_along(const Vec3& axis, const std::vector<TermLiteral>& planes) const {
    Interval bounds;
    for (const TermLiteral& l : planes) {
      const Surface& s = surfaces_.halfspaces[l.halfspace].surface;
      if (s.axis.cross(axis).norm() > kParallel) continue;
      const bool same_sense = s.axis.dot(axis) > 0;
      const double offset = same_sense ? s.offset : -s.offset;
      if (l.inside == same_sense) {
        bounds.hi = std::min(bounds.hi, offset);
      } else {
        bounds.lo = std::max(bounds.lo, offset);
      }
    }
    return bounds;
  }

  /// How far what is subtracted has to go: `reach` margins beyond all that there is to cut.
  Interval work_along(const Vec3& axis, int reach, const Room& room) const {
    Interval work = extent_of(reach_, axis);
    const auto narrow = [&work](const Interval& to) {
      work.lo = std::max(work.lo, to.lo);
      work.hi = std::min(work.hi, to.hi);
    };
    if (room.work_ends) narrow(bounds_along(axis, *room.work_ends));
    work = {work.lo - reach * margin_, work.hi + reach * margin_};
    for (const Corners& corners : room.within) {
      const Interval rest = extent_of(corners, axis);
      narrow({rest.lo - margin_, rest.hi + margin_});
    }
    return work;
  }

  /// Closes open ends with the geometry's extent, which solids never exceed, and those of tools
  /// behind the end of their work.
  Interval closed(const Vec3& axis, Interval bounds, int reach, const Room& room) const {
    const Interval limit = reach == 0 ? extent(axis) : work_along(axis, reach, room);
    bounds.lo = std::max(bounds.lo, limit.lo);
    bounds.hi = std::min(bounds.hi, limit.hi);
    bounds.hi = std::max(bounds.hi, bounds.lo);
    return bounds;
  }

  Mat3 box_frame(const std::vector<TermLiteral>& planes) const {
    std::vector<Vec3> axes;
    for (const TermLiteral& l : planes) {
      const Vec3 axis = upright(surfaces_.halfspaces[l.halfspace].surface.axis);
      const bool known = std::any_of(axes.begin(), axes.end(), [&](const Vec3& a) {
        return a.cross(axis).norm() < kParallel;
      });
      if (!known) axes.push_back(axis);
    }
    // Missing axes: the frame's own when they fit, so that the box needs no extra rotation.
    for (int c = 0; c < 3 && axes.size() < 3; ++c) {
      const Vec3 candidate = frame_.rotation.col(c);
      const bool fits = std::all_of(axes.begin(), axes.end(), [&](const Vec3& a) {
        return std::abs(a.dot(candidate)) < 1e-6;
      });
      if (fits) axes.push_back(candidate);
    }
    if (axes.size() == 1) axes.emplace_back(frame_about(axes[0]).col(0));
    if (axes.size() == 2) axes.emplace_back(axes[0].cross(axes[1]).normalized());
    return ordered(axes);
  }

  /// A right-handed matrix of the axes; coordinate axes give the identity.
  static Mat3 ordered(const std::vector<Vec3>& axes) {
    Mat3 m;
    // Each axis goes to the free column of its largest component.
    std::vector<char> used(3, 0);
    for (const Vec3& a : axes) {
      int best = -1;
      for (int c = 0; c < 3; ++c) {
        if (!used[c] && (best < 0 || std::abs(a[c]) > std::abs(a[best]))) best = c;
      }
      used[best] = 1;
      m.col(best) = a;
    }
    if (m.determinant() < 0) m.col(2) = -m.col(2);
    return m;
  }

  Literal primitive(const PrimitivePlan& plan, int reach, const Room& room) const {
    if (plan.is_box()) return box(plan, reach, room);
    return plan.prism >= 0 ? prism(plan, reach, room) : curved(plan, reach, room);
  }

  Literal prism(const PrimitivePlan& plan, int reach, const Room& room) const {
    const RegularPrism& ring = combinability_.prisms()[static_cast<std::size_t>(plan.prism)];
    // A corner half a side's angle before the first side's normal, on the local x axis.
    const double half_step = kPi / ring.count();
    const Vec3 corner =
        ring.normal * std::cos(half_step) - ring.axis.cross(ring.normal) * std::sin(half_step);
    Literal out;
    out.kind = SolidKind::Prism;
    out.sides = ring.count();
    out.radius = ring.radius;
    out.rotation << corner, ring.axis.cross(corner), ring.axis;
    out.origin = out.rotation.transpose() * ring.center;
    const Interval side = closed(ring.axis, bounds_along(ring.axis, plan.planes), reach, room);
    out.origin.z() = side.lo;
    out.height = side.hi - side.lo;
    return out;
  }

  Literal box(const PrimitivePlan& plan, int reach, const Room& room) const {
    Literal out;
    out.kind = SolidKind::Box;
    // Its sides may stand at right angles only within a tolerance; a box does exactly.
    const Mat3 axes = box_frame(plan.planes);
    out.rotation = nearest_rotation(axes);
    for (int c = 0; c < 3; ++c) {
      const Vec3 axis = axes.col(c);
      const Interval side = closed(axis, bounds_along(axis, plan.planes), reach, room);
      out.origin[c] = side.lo;
      out.size[c] = side.hi - side.lo;
    }
    return out;
  }

  Literal curved(const PrimitivePlan& plan, int reach, const Room& room) const {
    const Halfspace& h = surfaces_.halfspaces[plan.curved];
    const Surface& s = h.surface;
    Literal out;
    out.facets = h.facets;
    out.radius = s.radius;
    if (s.kind == SurfaceKind::Sphere) {
      out.kind = SolidKind::Sphere;
      out.origin = s.point;
      return out;
    }
    // A cone's axis points from its apex; the others may be turned.
    const Vec3 axis = s.kind == SurfaceKind::Cone ? s.axis : upright(s.axis);
    out.rotation = frame_about(axis);
    out.origin = out.rotation.transpose() * s.point;
    if (s.kind == SurfaceKind::Torus) {
      out.kind = SolidKind::Torus;
      out.major_radius = s.major_radius;
      return out;
    }
    out.kind = SolidKind::Cylinder;
    Interval side = closed(axis, bounds_along(axis, plan.planes), reach, room);
    if (s.kind == SurfaceKind::Cone) {
      const double apex = out.origin.z();
      side.lo = std::max(side.lo, apex);
      side.hi = std::max(side.hi, side.lo);
      out.radius = (side.lo - apex) * std::tan(s.half_angle_rad);
      out.top_radius = (side.hi - apex) * std::tan(s.half_angle_rad);
    } else {
      out.top_radius = out.radius;
    }
    out.origin.z() = side.lo;
    out.height = side.hi - side.lo;
    return out;
  }

  const SurfaceSet& surfaces_;
  Combinability combinability_;
  const Mesh& mesh_;
  const std::vector<int>& triangles_;
  const Frame& frame_;
  const LoweringOptions& options_;
  double margin_;
  Corners reach_;
  std::vector<Shortening> shorter_;
  Tree tree_;
};

}  // namespace

Tree lower_list(const DecisionList& list, const SurfaceSet& surfaces, const Mesh& mesh,
                const std::vector<int>& triangles, const Frame& frame,
                const LoweringOptions& options) {
  return Lowering(surfaces, mesh, triangles, frame, options).lower(list);
}

}  // namespace hewn
