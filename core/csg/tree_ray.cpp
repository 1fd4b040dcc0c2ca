#include "core/csg/tree_ray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/csg/prism.h"

namespace hewn {
namespace {

using Intervals = std::vector<TreeInterval>;

constexpr TreeInterval kWholeLine{{-kInfinity, -1, 0}, {kInfinity, -1, 0}};

/// A stretch along a line with the faces at its ends, narrowed by one constraint after the other.
struct Span {
  double enter = -kInfinity, leave = kInfinity;
  int enter_face = 0, leave_face = 0;

  void clip(double from, int from_face, double to, int to_face) {
    if (from > enter) {
      enter = from;
      enter_face = from_face;
    }
    if (to < leave) {
      leave = to;
      leave_face = to_face;
    }
  }
  bool is_empty() const { return !(enter < leave); }
  void clear() { leave = -kInfinity; }
};

/// What lies between two parallel faces.
struct Slab {
  double lo, hi;
  int lo_face, hi_face;
};

/// Narrows to lo <= o + t d <= hi along one coordinate.
void clip_slab(Span& span, double o, double d, const Slab& slab) {
  if (d == 0) {
    if (o < slab.lo || o > slab.hi) span.clear();
    return;
  }
  const double t_lo = (slab.lo - o) / d;
  const double t_hi = (slab.hi - o) / d;
  if (d > 0) {
    span.clip(t_lo, slab.lo_face, t_hi, slab.hi_face);
  } else {
    span.clip(t_hi, slab.hi_face, t_lo, slab.lo_face);
  }
}

void add(Intervals& out, const Span& span, int literal) {
  if (span.is_empty() || span.leave <= 0) return;
  out.push_back({{span.enter, literal, span.enter_face}, {span.leave, literal, span.leave_face}});
}

/// Real roots of a t^2 + 2 b t + c in ascending order; false without two of them.
bool roots(double a, double b, double c, double& lo, double& hi) {
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0) || a == 0) return false;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  lo = q / a;
  hi = q == 0 ? 0 : c / q;
  if (lo > hi) std::swap(lo, hi);
  return true;
}

/// The part of the z slab where x^2 + y^2 <= (r + slope z)^2: convex, hence one span.
void clip_flank(Span& span, const Vec3& o, const Vec3& d, double radius, double slope) {
  const double r = radius + slope * o.z();
  const double dr = slope * d.z();
  const double a = d.x() * d.x() + d.y() * d.y() - dr * dr;
  const double b = o.x() * d.x() + o.y() * d.y() - r * dr;
  const double c = o.x() * o.x() + o.y() * o.y() - r * r;
  double lo = 0;
  double hi = 0;
  if (!roots(a, b, c, lo, hi)) {
    // No crossing: the line is inside for good or outside for good. With a == 0 it runs along a
    // flank line and crosses once.
    if (a == 0 && b != 0) {
      const double t = -c / (2 * b);
      b > 0 ? span.clip(-kInfinity, 0, t, 0) : span.clip(t, 0, kInfinity, 0);
    } else if (c > 0) {
      span.clear();
    }
  } else if (a > 0) {
    span.clip(lo, 0, hi, 0);
  } else {
    // Steeper than the flank: inside the double cone before `lo` and after `hi`; the slab holds
    // only the nappe where the radius is positive.
    dr > 0 ? span.clip(hi, 0, kInfinity, 0) : span.clip(-kInfinity, 0, lo, 0);
  }
}

/// Walks through the torus by its exact distance: every root lies at least |distance| away.
void cast_torus(const Literal& shape, const Vec3& o, const Vec3& d, int index, Intervals& out) {
  const double reach = shape.major_radius + shape.radius;
  const double length = d.norm();
  double t = 0;
  double end = 0;
  if (!roots(d.squaredNorm(), o.dot(d), o.squaredNorm() - reach * reach, t, end)) return;
  const auto distance = [&](double at) {
    const Vec3 p = o + at * d;
    return std::hypot(std::hypot(p.x(), p.y()) - shape.major_radius, p.z()) - shape.radius;
  };
  const double smallest = 1e-7 * reach;
  bool inside = false;
  double enter = 0;
  while (t < end) {
    const double value = distance(t);
    if (value < 0 && !inside) enter = t;
    if (value >= 0 && inside && t > 0) out.push_back({{enter, index, 0}, {t, index, 0}});
    inside = value < 0;
    t += std::max(std::abs(value), smallest) / length;
  }
  if (inside && end > 0) out.push_back({{enter, index, 0}, {end, index, 0}});
}

/// Crossings of a closed mesh, paired up in order.
void cast_mesh(const MeshQuery& query, const Vec3& o, const Vec3& d, int index, Intervals& out) {
  const double step = 1e-6 * query.mesh().diagonal() / d.norm();
  bool inside = query.contains(o);
  double t = 0;
  double enter = 0;
  for (int crossings = 0; crossings < 1000; ++crossings) {
    const RayHit hit = query.cast(o + t * d, d);
    if (hit.triangle < 0) break;
    t += hit.t;
    if (inside) {
      out.push_back({{enter, index, 0}, {t, index, 0}});
    } else {
      enter = t;
    }
    inside = !inside;
    t += step;
  }
}

/// a or b, both ascending and disjoint.
void unite(const Intervals& a, const Intervals& b, Intervals& out) {
  out.clear();
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() || j < b.size()) {
    const bool from_a = j == b.size() || (i < a.size() && a[i].enter.t <= b[j].enter.t);
    const TreeInterval& next = from_a ? a[i++] : b[j++];
    if (!out.empty() && next.enter.t <= out.back().leave.t) {
      if (next.leave.t > out.back().leave.t) out.back().leave = next.leave;
    } else {
      out.push_back(next);
    }
  }
}

void intersect(const Intervals& a, const Intervals& b, Intervals& out) {
  out.clear();
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const TreeCrossing& enter = a[i].enter.t >= b[j].enter.t ? a[i].enter : b[j].enter;
    const TreeCrossing& leave = a[i].leave.t <= b[j].leave.t ? a[i].leave : b[j].leave;
    if (enter.t < leave.t) out.push_back({enter, leave});
    a[i].leave.t <= b[j].leave.t ? ++i : ++j;
  }
}

/// The line without `a`.
void complement(const Intervals& a, Intervals& out) {
  out.clear();
  TreeCrossing from = kWholeLine.enter;
  for (const TreeInterval& stretch : a) {
    if (from.t < stretch.enter.t) out.push_back({from, stretch.enter});
    from = stretch.leave;
  }
  if (from.t < kInfinity) out.push_back({from, kWholeLine.leave});
}

/// Whether a further operand changes nothing.
bool is_neutral(Op op, Nearby operand) {
  return operand == (op == Op::Intersection ? Nearby::All : Nearby::Nothing);
}

}  // namespace

struct TreeRays::Ray {
  Vec3 origin, direction;
  bool is_nearby = false;  ///< only as far as the scratch memory's ball
  Vec3 inverse;            ///< of the direction; where that is 0 it is not used

  Ray(Vec3 from, Vec3 along, bool stays_nearby = false)
      : origin(std::move(from)),
        direction(std::move(along)),
        is_nearby(stays_nearby),
        inverse(direction.cwiseInverse()) {}

  /// Whether it certainly passes the box by. Generous: bounds are computed apart from the surfaces
  /// that they enclose.
  bool misses(const Box3& box) const {
    double enter = -kInfinity;
    double leave = kInfinity;
    for (int k = 0; k < 3; ++k) {
      if (direction[k] == 0) {
        if (origin[k] < box.lo[k] || origin[k] > box.hi[k]) return true;
        continue;
      }
      const double a = (box.lo[k] - origin[k]) * inverse[k];
      const double b = (box.hi[k] - origin[k]) * inverse[k];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    const double slack = 1e-9 * (1 + std::abs(enter));
    return enter > leave + slack || leave < -slack;
  }
};

TreeRays::TreeRays(const Tree& tree) : tree_(&tree) {
  for (const Literal& literal : tree.literals) {
    bounds_.emplace_back(literal);
    std::shared_ptr<const MeshQuery> query;
    if (literal.kind == SolidKind::Polyhedron && literal.polyhedron) {
      query = literal.polyhedron_query ? literal.polyhedron_query
                                       : std::make_shared<const MeshQuery>(literal.polyhedron);
    }
    meshes_.push_back(std::move(query));
  }
  table_ = BoundsTable(bounds_, std::vector<double>(bounds_.size(), 0));
}

void TreeRays::append_literal(int literal, const Ray& ray, Intervals& out) const {
  if (!ray.misses(bounds_[literal].box)) append_met(literal, ray, out);
}

/// Of a literal whose bounds the ray meets, as far as is known.
void TreeRays::append_met(int literal, const Ray& ray, Intervals& out) const {
  const Literal& shape = tree_->literals[literal];
  const Vec3 o = shape.to_local(ray.origin);
  const Vec3 d = shape.direction_to_local(ray.direction);
  Span span;
  switch (shape.kind) {
    case SolidKind::Box:
      for (int k = 0; k < 3; ++k) {
        clip_slab(span, o[k], d[k], {0, shape.size[k], 2 * k, 2 * k + 1});
      }
      add(out, span, literal);
      break;
    case SolidKind::Cylinder:
      clip_slab(span, o.z(), d.z(), {0, shape.height, 1, 2});
      clip_flank(span, o, d, shape.radius, (shape.top_radius - shape.radius) / shape.height);
      add(out, span, literal);
      break;
    case SolidKind::Prism:
      clip_slab(span, o.z(), d.z(), {0, shape.height, shape.sides, shape.sides + 1});
      for (int k = 0; k < shape.sides; ++k) {
        const Vec2 n = prism_side_normal(shape, k);
        clip_slab(span, n.dot(o.head<2>()), n.dot(d.head<2>()), {-kInfinity, shape.radius, k, k});
      }
      add(out, span, literal);
      break;
    case SolidKind::Sphere:
      if (!roots(d.squaredNorm(), o.dot(d), o.squaredNorm() - shape.radius * shape.radius,
                 span.enter, span.leave)) {
        span.clear();
      }
      add(out, span, literal);
      break;
    case SolidKind::Torus:
      cast_torus(shape, o, d, literal, out);
      break;
    case SolidKind::Polyhedron:
      if (meshes_[literal]) cast_mesh(*meshes_[literal], o, d, literal, out);
      break;
  }
}

void TreeRays::cast_node(int node, const Ray& ray, std::size_t depth,
                         TreeRayScratch& scratch) const {
  // Four lists a level: the result so far, the child's, its complement and the combination.
  const std::size_t base = 3 * depth;
  if (scratch.lists.size() < base + 4) scratch.lists.resize(base + 4);
  if (ray.is_nearby && scratch.nearby[node] != Nearby::Surface) {
    const bool is_all = scratch.nearby[node] == Nearby::All;
    scratch.lists[base].assign(is_all ? 1 : 0, kWholeLine);
    return;
  }
  const Node& here = tree_->nodes[node];
  if (here.op == Op::Literal) {
    scratch.lists[base].clear();
    append_literal(here.literal, ray, scratch.lists[base]);
    return;
  }
  scratch.lists[base].clear();
  bool is_first = true;
  for (const int child : here.children) {
    // Nothing can come back once an intersection or difference is empty.
    if (!is_first && here.op != Op::Union && scratch.lists[base].empty()) return;
    if (!is_first && ray.is_nearby && is_neutral(here.op, scratch.nearby[child])) continue;
    cast_node(child, ray, depth + 1, scratch);
    if (scratch.lists.size() < base + 4) scratch.lists.resize(base + 4);
    Intervals& result = scratch.lists[base];
    Intervals& other = scratch.lists[base + 3];
    Intervals& merged = scratch.lists[base + 1];
    if (here.op == Op::Complement) {
      complement(other, result);
    } else if (is_first) {
      std::swap(result, other);
    } else if (other.empty() && is_neutral(here.op, Nearby::Nothing)) {
      continue;
    } else if (here.op == Op::Union) {
      unite(result, other, merged);
      std::swap(result, merged);
    } else if (here.op == Op::Intersection) {
      intersect(result, other, merged);
      std::swap(result, merged);
    } else {
      complement(other, scratch.lists[base + 2]);
      intersect(result, scratch.lists[base + 2], merged);
      std::swap(result, merged);
    }
    is_first = false;
  }
}

void TreeRays::cast_literal(int literal, const Vec3& origin, const Vec3& direction,
                            Intervals& out) const {
  out.clear();
  append_literal(literal, {origin, direction}, out);
}

void TreeRays::cast_literals(const Vec3& origin, const Vec3& direction, Intervals& out) const {
  out.clear();
  const Ray ray(origin, direction);
  table_.visit_met(origin, direction,
                   [&](std::size_t k) { append_met(static_cast<int>(k), ray, out); });
}

const Intervals& TreeRays::cast(const Vec3& origin, const Vec3& direction,
                                TreeRayScratch& scratch) const {
  return cast(Ray(origin, direction), scratch);
}

const Intervals& TreeRays::cast_nearby(const Vec3& origin, const Vec3& direction,
                                       TreeRayScratch& scratch) const {
  return cast(Ray(origin, direction, true), scratch);
}

const Intervals& TreeRays::cast(const Ray& ray, TreeRayScratch& scratch) const {
  if (scratch.lists.empty()) scratch.lists.resize(4);
  scratch.lists[0].clear();
  if (!tree_->is_empty()) cast_node(tree_->root, ray, 0, scratch);
  std::erase_if(scratch.lists[0], [](const TreeInterval& s) { return s.leave.t <= 0; });
  return scratch.lists[0];
}

Nearby TreeRays::look_around(const Vec3& center, double reach, TreeRayScratch& scratch) const {
  scratch.nearby.resize(tree_->nodes.size());
  return tree_->is_empty() ? Nearby::Nothing
                           : look_around(tree_->root, center, reach, scratch.nearby);
}

/// Stops at the first operand that decides.
Nearby TreeRays::look_around(int node, const Vec3& center, double reach,
                             std::vector<Nearby>& nearby) const {
  const Node& here = tree_->nodes[node];
  if (here.op == Op::Literal) {
    const double distance =
        distance_within(tree_->literals[here.literal], bounds_[here.literal], center, reach);
    const bool is_far = std::abs(distance) > reach;
    return nearby[node] = !is_far ? Nearby::Surface : distance < 0 ? Nearby::All : Nearby::Nothing;
  }
  const auto opposite = [](Nearby n) {
    return n == Nearby::Surface ? n : n == Nearby::All ? Nearby::Nothing : Nearby::All;
  };
  if (here.children.empty()) return nearby[node] = Nearby::Nothing;
  const Nearby decides = here.op == Op::Union ? Nearby::All : Nearby::Nothing;
  Nearby all = opposite(decides);
  bool is_taken_away = here.op == Op::Complement;  // of a difference all but the first are
  for (const int child : here.children) {
    const Nearby below = look_around(child, center, reach, nearby);
    const Nearby counts = is_taken_away ? opposite(below) : below;
    if (counts == decides) return nearby[node] = decides;
    if (counts == Nearby::Surface) all = Nearby::Surface;
    is_taken_away = here.op == Op::Difference;
  }
  return nearby[node] = all;
}

Vec3 TreeRays::normal(const TreeCrossing& crossing, const Vec3& position,
                      const Vec3& direction) const {
  if (crossing.literal < 0) return -direction.normalized();
  const Literal& shape = tree_->literals[crossing.literal];
  const Vec3 x = shape.to_local(position);
  Vec3 local = Vec3::UnitZ();
  switch (shape.kind) {
    case SolidKind::Box:
      local = Vec3::Unit(crossing.face / 2);
      break;
    case SolidKind::Cylinder:
      if (crossing.face == 0) {
        const double slope = (shape.top_radius - shape.radius) / shape.height;
        local = Vec3(x.x(), x.y(), -slope * std::hypot(x.x(), x.y())).normalized();
      }
      break;
    case SolidKind::Prism:
      if (crossing.face < shape.sides) {
        local << prism_side_normal(shape, crossing.face), 0;
      }
      break;
    case SolidKind::Sphere:
      local = x.normalized();
      break;
    case SolidKind::Torus: {
      const Vec3 ring = Vec3(x.x(), x.y(), 0).normalized() * shape.major_radius;
      local = (x - ring).normalized();
      break;
    }
    case SolidKind::Polyhedron:
      local =
          meshes_[crossing.literal]->mesh().normals[meshes_[crossing.literal]->closest(x).triangle];
      break;
  }
  if (shape.stretch) local = (shape.stretch->inverse.transpose() * local).normalized();
  const Vec3 n = shape.rotation * local;
  return n.dot(direction) > 0 ? Vec3(-n) : n;
}

}  // namespace hewn
