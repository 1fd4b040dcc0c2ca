#include "bench/variants/remesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>

#include "core/mesh/closest_on_triangle.h"
#include "core/mesh/query.h"

namespace hewn {
namespace {

struct Traits : public OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
  FaceAttributes(OpenMesh::Attributes::Status);
};
using Surface = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Vertex = OpenMesh::VertexHandle;
using EdgeHandle = OpenMesh::EdgeHandle;
using Halfedge = OpenMesh::HalfedgeHandle;

Vec3 to_eigen(const OpenMesh::Vec3d& p) { return {p[0], p[1], p[2]}; }
OpenMesh::Vec3d to_open(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

Vec3 triangle_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a).normalized();
}

/// The length of equal-sided triangles, `count` of which cover the area.
double length_for(double area, double count) {
  return std::sqrt(area * 4 / std::sqrt(3.0) / count);
}

double wanted_length(const Mesh& mesh, const RemeshOptions& options) {
  const double count = options.min_growth * static_cast<double>(mesh.triangles.size());
  const double growing =
      std::min(options.edge_length * mesh.diagonal(), length_for(mesh.total_area, count));
  return std::max(growing, length_for(mesh.total_area, options.max_triangles));
}

class Remesher {
 public:
  Remesher(const Mesh& mesh, const RemeshOptions& options)
      : options_(options),
        input_(std::make_shared<const Mesh>(mesh)),
        query_(input_),
        length_(wanted_length(mesh, options)),
        max_deviation_(3e-4 * mesh.diagonal()) {}

  Result<Mesh> run(const RunContext& context) {
    if (!build()) {
      return Error{ErrorCode::BadMesh,
                   "the surface branches (it is not manifold) and cannot be remeshed",
                   {}};
    }
    mark_features();
    for (int i = 0; i < options_.iterations; ++i) {
      if (context.is_cancelled()) return RunContext::cancelled();
      split_long();
      collapse_short();
      flip_edges();
      relax();
      context.report("remeshing", (i + 1.0) / options_.iterations);
    }
    return to_mesh();
  }

 private:
  Vec3 at(Vertex v) const { return to_eigen(surface_.point(v)); }
  Vertex from(Halfedge h) const { return surface_.from_vertex_handle(h); }
  Vertex to(Halfedge h) const { return surface_.to_vertex_handle(h); }
  bool is_feature(EdgeHandle e) const { return surface_.status(e).feature(); }
  bool is_corner(Vertex v) const { return surface_.status(v).locked(); }
  bool is_on_feature(Vertex v) const { return surface_.status(v).feature(); }
  double length_of(EdgeHandle e) const { return surface_.calc_edge_length(e); }

  bool build() {
    // The library prints its complaints; the caller gets them as an error instead.
    omerr().disable();
    for (const Vec3& p : input_->vertices) surface_.add_vertex(to_open(p));
    for (const auto& [a, b, c] : input_->triangles) {
      if (!surface_.add_face(Vertex(a), Vertex(b), Vertex(c)).is_valid()) return false;
    }
    return true;
  }

  void mark_features() {
    const double cos_feature = std::cos(options_.feature_angle_deg * kPi / 180);
    std::vector<int> degree(surface_.n_vertices(), 0);
    for (const auto e : surface_.edges()) {
      const auto left = surface_.face_handle(surface_.halfedge_handle(e, 0));
      const auto right = surface_.face_handle(surface_.halfedge_handle(e, 1));
      const bool is_sharp =
          !left.is_valid() || !right.is_valid() ||
          input_->normals[left.idx()].dot(input_->normals[right.idx()]) < cos_feature;
      if (!is_sharp) continue;
      surface_.status(e).set_feature(true);
      for (const Vertex v :
           {from(surface_.halfedge_handle(e, 0)), to(surface_.halfedge_handle(e, 0))}) {
        surface_.status(v).set_feature(true);
        ++degree[v.idx()];
      }
    }
    for (const auto v : surface_.vertices()) {
      if (degree[v.idx()] != 0 && degree[v.idx()] != 2) surface_.status(v).set_locked(true);
    }
  }

  void split_long() {
    // Long strips halve several times before their sides are short enough.
    constexpr int kPasses = 24;
    for (int pass = 0; pass < kPasses; ++pass) {
      std::vector<std::pair<double, int>> longest;
      for (const auto e : surface_.edges()) {
        if (length_of(e) > 4.0 / 3 * length_) longest.emplace_back(-length_of(e), e.idx());
      }
      if (longest.empty()) return;
      std::sort(longest.begin(), longest.end());
      for (const auto& [negative_length, index] : longest) split(EdgeHandle(index));
    }
  }

  void split(EdgeHandle e) {
    const Halfedge h = surface_.halfedge_handle(e, 0);
    const Vertex a = from(h);
    const Vertex b = to(h);
    const bool was_feature = is_feature(e);
    const Vec3 middle = (at(a) + at(b)) / 2;
    // A middle of two vertices on different facets is off the surface, unless the edge is sharp.
    const Vertex m = surface_.add_vertex(to_open(was_feature ? middle : project(middle)));
    surface_.split(e, m);
    surface_.status(m).set_feature(was_feature);
    for (const auto out : surface_.voh_range(m)) {
      const Vertex end = to(out);
      surface_.status(surface_.edge_handle(out)).set_feature(was_feature && (end == a || end == b));
    }
  }

  Vec3 project(const Vec3& p) const { return query_.closest(p).point; }

  void collapse_short() {
    std::vector<std::pair<double, int>> shortest;
    for (const auto e : surface_.edges()) {
      if (length_of(e) < 0.8 * length_) shortest.emplace_back(length_of(e), e.idx());
    }
    std::sort(shortest.begin(), shortest.end());
    for (const auto& [length, index] : shortest) {
      const EdgeHandle e(index);
      if (surface_.status(e).deleted() || length_of(e) >= 0.8 * length_) continue;
      for (int side = 0; side < 2; ++side) {
        const Halfedge h = surface_.halfedge_handle(e, side);
        if (!may_collapse(h)) continue;
        collapse(h);
        break;
      }
    }
    surface_.garbage_collection();
  }

  /// Whether the start of `h` may be pulled onto its end.
  bool may_collapse(Halfedge h) const {
    const Vertex gone = from(h);
    const Vertex kept = to(h);
    if (is_corner(gone)) return false;
    const bool is_along_feature = is_feature(surface_.edge_handle(h));
    if (is_on_feature(gone) && (!is_along_feature || !stays_straight(h))) return false;
    if (would_merge_features(h)) return false;
    for (const auto out : surface_.voh_range(gone)) {
      const Vertex other = to(out);
      if (other != kept && (at(other) - at(kept)).norm() > 4.0 / 3 * length_) return false;
    }
    // OpenMesh counts this check among the non-const ones though it only sets tags.
    return keeps_normals(gone, at(kept), kept) &&
           (is_on_feature(gone) || stays_near(gone, at(kept), kept)) &&
           const_cast<Surface&>(surface_).is_collapse_ok(h);
  }

  /// Whether the sharp line through the start of `h` still passes it closely when it is gone.
  bool stays_straight(Halfedge h) const {
    const Vec3 p = at(from(h));
    const Vec3 end = at(to(h));
    for (const auto out : surface_.voh_range(from(h))) {
      if (to(out) == to(h) || !is_feature(surface_.edge_handle(out))) continue;
      const Vec3 start = at(to(out));
      const Vec3 step = (end - start).normalized();
      return (p - start - step * step.dot(p - start)).norm() < max_deviation_;
    }
    return false;
  }

  /// The two other sides of the triangle left of `side`, which become one edge in a collapse.
  std::pair<EdgeHandle, EdgeHandle> joined_sides(Halfedge side) const {
    return {surface_.edge_handle(surface_.next_halfedge_handle(side)),
            surface_.edge_handle(surface_.prev_halfedge_handle(side))};
  }

  /// Whether the collapse would lay two sharp lines on each other.
  bool would_merge_features(Halfedge h) const {
    for (const Halfedge side : {h, surface_.opposite_halfedge_handle(h)}) {
      if (surface_.is_boundary(side)) continue;
      const auto [next, previous] = joined_sides(side);
      if (is_feature(next) && is_feature(previous)) return true;
    }
    return false;
  }

  /// Collapses and keeps the mark of a sharp side, whichever of the joined two the library deletes.
  void collapse(Halfedge h) {
    const Vertex kept = to(h);
    std::vector<Vertex> sharp_ends;
    for (const Halfedge side : {h, surface_.opposite_halfedge_handle(h)}) {
      if (surface_.is_boundary(side)) continue;
      const auto [next, previous] = joined_sides(side);
      if (is_feature(next) || is_feature(previous)) {
        sharp_ends.push_back(to(surface_.next_halfedge_handle(side)));
      }
    }
    surface_.collapse(h);
    for (const Vertex end : sharp_ends) {
      const Halfedge left = surface_.find_halfedge(kept, end);
      if (left.is_valid()) surface_.status(surface_.edge_handle(left)).set_feature(true);
    }
  }

  /// Whether the triangles around `v` keep facing the same way when it moves to `p`; triangles with
  /// the vertex `except` vanish and do not count.
  bool keeps_normals(Vertex v, const Vec3& p, Vertex except = Vertex()) const {
    for (const auto h : surface_.voh_range(v)) {
      if (surface_.is_boundary(h)) continue;
      const Vertex b = to(h);
      const Vertex c = to(surface_.next_halfedge_handle(h));
      if (b == except || c == except) continue;
      const Vec3 before = triangle_normal(at(v), at(b), at(c));
      const Vec3 after = triangle_normal(p, at(b), at(c));
      // Written so that a triangle without area (NaN) fails as well.
      const bool was_flat = !before.allFinite();
      if (!was_flat && !(before.dot(after) > 0.8)) return false;
    }
    return true;
  }

  /// Whether the surface passes close by the place of `v` once it has moved to `p`.
  bool stays_near(Vertex v, const Vec3& p, Vertex except = Vertex()) const {
    double nearest = kInfinity;
    for (const auto h : surface_.voh_range(v)) {
      if (surface_.is_boundary(h)) continue;
      const Vertex b = to(h);
      const Vertex c = to(surface_.next_halfedge_handle(h));
      if (b == except || c == except) continue;
      nearest = std::min(nearest, (closest_on_triangle(at(v), p, at(b), at(c)) - at(v)).norm());
    }
    return nearest < max_deviation_;
  }

  void flip_edges() {
    for (const auto e : surface_.edges()) {
      if (is_feature(e) || surface_.is_boundary(e) || !surface_.is_flip_ok(e)) continue;
      if (improves_valence(e) && keeps_shape(e)) surface_.flip(e);
    }
  }

  struct Diamond {
    Vertex a, b, left, right;  ///< the edge from a to b and the corners across it
  };
  Diamond diamond(EdgeHandle e) const {
    const Halfedge h = surface_.halfedge_handle(e, 0);
    const Halfedge o = surface_.opposite_halfedge_handle(h);
    return {from(h), to(h), to(surface_.next_halfedge_handle(h)),
            to(surface_.next_halfedge_handle(o))};
  }

  bool improves_valence(EdgeHandle e) const {
    const Diamond d = diamond(e);
    const auto excess = [&](Vertex v, int change) {
      const int wanted = is_on_feature(v) ? 4 : 6;
      // On a sharp edge the two sides have different needs: only the total is known.
      const int off = static_cast<int>(surface_.valence(v)) + change - wanted;
      return is_on_feature(v) ? std::abs(off) / 2 : std::abs(off);
    };
    const int before = excess(d.a, 0) + excess(d.b, 0) + excess(d.left, 0) + excess(d.right, 0);
    const int after = excess(d.a, -1) + excess(d.b, -1) + excess(d.left, 1) + excess(d.right, 1);
    return after < before || (after == before && is_bad_diagonal(d));
  }

  /// Whether the edge is not Delaunay by a good margin.
  bool is_bad_diagonal(const Diamond& d) const {
    const auto angle = [&](Vertex apex) {
      return angle_between((at(d.a) - at(apex)).normalized(), (at(d.b) - at(apex)).normalized());
    };
    return angle(d.left) + angle(d.right) > 1.1 * kPi;
  }

  bool keeps_shape(EdgeHandle e) const {
    const Diamond d = diamond(e);
    const Vec3 old1 = triangle_normal(at(d.a), at(d.b), at(d.left));
    const Vec3 old2 = triangle_normal(at(d.b), at(d.a), at(d.right));
    const Vec3 new1 = triangle_normal(at(d.left), at(d.right), at(d.b));
    const Vec3 new2 = triangle_normal(at(d.right), at(d.left), at(d.a));
    const Vec3 across = (at(d.b) - at(d.a)).cross(at(d.right) - at(d.left));
    if (!(std::abs(across.dot(at(d.left) - at(d.a))) < max_deviation_ * across.norm()))
      return false;
    constexpr double kCosBend = 0.95;
    if (old1.allFinite() && old2.allFinite() && !(old1.dot(old2) > kCosBend)) return false;
    const Vec3& reference = old1.allFinite() ? old1 : old2;
    return new1.dot(reference) > kCosBend && new2.dot(reference) > kCosBend;
  }

  void relax() {
    std::vector<std::pair<Vertex, Vec3>> moves;
    for (const auto v : surface_.vertices()) {
      if (is_on_feature(v) || surface_.is_boundary(v)) continue;
      Vec3 center = Vec3::Zero();
      Vec3 normal = Vec3::Zero();
      double count = 0;
      for (const auto h : surface_.voh_range(v)) {
        center += at(to(h));
        normal += (at(to(h)) - at(v)).cross(at(to(surface_.next_halfedge_handle(h))) - at(v));
        ++count;
      }
      if (!(normal.norm() > 0)) continue;
      normal.normalize();
      const Vec3 step = center / count - at(v);
      moves.emplace_back(v, project(at(v) + step - normal * normal.dot(step)));
    }
    for (const auto& [v, p] : moves) {
      if (keeps_normals(v, p) && stays_near(v, p)) surface_.set_point(v, to_open(p));
    }
  }

  Mesh to_mesh() const {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    for (const auto v : surface_.vertices()) vertices.push_back(at(v));
    for (const auto f : surface_.faces()) {
      Triangle t;
      int k = 0;
      for (const auto v : surface_.fv_range(f)) t[k++] = v.idx();
      triangles.push_back(t);
    }
    return make_mesh(std::move(vertices), std::move(triangles));
  }

  RemeshOptions options_;
  std::shared_ptr<const Mesh> input_;
  MeshQuery query_;
  double length_;
  double max_deviation_;  ///< of a sharp line, or of the surface in one step
  Surface surface_;
};

}  // namespace

Result<Mesh> remesh_isotropic(const Mesh& mesh, const RemeshOptions& options,
                              const RunContext& run) {
  return Remesher(mesh, options).run(run);
}

}  // namespace hewn
