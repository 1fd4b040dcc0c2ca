#include "core/csg/turned_faces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/csg/flat_end.h"
#include "core/csg/prism.h"

namespace hewn {
namespace {

constexpr double kParallel = 1e-9;  ///< of unit vectors: sine of the angle between them
constexpr double kCoplanar = 2e-6;  ///< share of the diagonal
constexpr double kNudge = 1e-5;     ///< share of the diagonal: ten times what is rounded, or more
constexpr int kMostLevels = 4;      ///< faces above each other in one plane
constexpr int kProbes = 9;          ///< per direction of a face, for its overlap with another

/// Whether each axis of one frame is one of the other, up to sign.
bool is_same_frame(const Mat3& a, const Mat3& b) {
  const Mat3 cosines = (a.transpose() * b).cwiseAbs();
  return cosines.colwise().maxCoeff().minCoeff() > 1 - 1e-12;
}

/// Whether all flat ends of the literal are at right angles to an axis of the frame. Round literals
/// have no direction but their axis.
bool is_along(const Literal& literal, const Mat3& frame) {
  if (literal.kind == SolidKind::Box) return is_same_frame(literal.rotation, frame);
  return (frame.transpose() * literal.rotation.col(2)).cwiseAbs().maxCoeff() > 1 - 1e-12;
}

/// The axes of most literals.
Mat3 main_frame(const std::vector<Literal>& literals) {
  Mat3 best = Mat3::Identity();
  std::ptrdiff_t most = 0;
  for (const Literal& candidate : literals) {
    const auto count = std::count_if(literals.begin(), literals.end(), [&](const Literal& l) {
      return is_along(l, candidate.rotation);
    });
    if (count <= most) continue;
    most = count;
    best = candidate.rotation;
  }
  return best;
}

/// A flat end, or a side of a prism, which cannot move without the others.
struct Face {
  int node = 0;  ///< of the literal
  FlatEnd end;
  int side = -1;  ///< from this corner of a prism to the next; -1: the end

  bool is_turned = false;  ///< not along the main axes
  int level = 0;           ///< how often it is moved out

  bool is_side() const { return side >= 0; }
  /// The corners of a prism are rounded wherever it lies.
  bool is_rounded() const { return is_turned || is_side(); }
};

Vec3 side_normal(const Literal& prism, int side) {
  const Vec2 normal = prism_side_normal(prism, side);
  return prism.rotation * Vec3(normal.x(), normal.y(), 0);
}

Vec3 normal_of(const Literal& literal, const Face& face) {
  return face.is_side() ? side_normal(literal, face.side) : outward_normal(literal, face.end);
}

double offset_of(const Literal& literal, const Face& face) {
  if (!face.is_side()) return plane_offset(literal, face.end);
  return normal_of(literal, face).dot(literal.rotation * literal.origin) + literal.radius;
}

/// The point at `s` and `t` of [0, 1] across the smallest rectangle around the face, in space.
Vec3 point_across(const Literal& literal, const Face& face, double s, double t) {
  Vec3 p;
  if (face.is_side()) {
    const Vec2 from = prism_corner(literal, face.side);
    const Vec2 to = prism_corner(literal, face.side + 1);
    p << from + (to - from) * s, literal.height * t;
  } else {
    const LocalBox plane = beyond_end(literal, face.end, 0, 0);
    const int u = (face.end.axis + 1) % 3;
    const int v = (face.end.axis + 2) % 3;
    p = plane.lo;
    p[u] += plane.size()[u] * s;
    p[v] += plane.size()[v] * t;
  }
  return literal.to_world(p);
}

/// Whether a point on the face's plane lies on the face.
bool is_on(const Literal& literal, const Face& face, const Vec3& point) {
  const Vec3 p = literal.to_local(point);
  if (!face.is_side()) return is_over_end(literal, face.end, p, 0);
  const Vec2 from = prism_corner(literal, face.side);
  const Vec2 to = prism_corner(literal, face.side + 1);
  const double along = (p.head<2>() - from).dot(to - from) / (to - from).squaredNorm();
  return along >= 0 && along <= 1 && p.z() >= 0 && p.z() <= literal.height;
}

/// Of two faces in one plane, the one that has to lie further out: beyond the other, or, back to
/// back with it, into the other's literal.
struct Order {
  std::size_t decides = 0;
  std::size_t yields = 0;
  bool is_same_side = true;
};

/// The operation that joins two leaves, and which of them it takes away.
struct Meeting {
  Op op = Op::Union;
  bool takes_first = false;
  bool takes_second = false;
};

class Separation {
 public:
  explicit Separation(const Tree& tree)
      : tree_(tree), diagonal_(tree.bounds().diagonal()), main_(main_frame(tree.literals)) {}

  Tree run() {
    if (!std::isfinite(diagonal_) || !(diagonal_ > 0)) return tree_;
    nudge_ = std::pow(10, std::floor(std::log10(kNudge * diagonal_)));
    parent_.assign(tree_.nodes.size(), -1);
    is_new_.assign(tree_.literals.size(), true);
    collect(tree_.root);
    for (std::size_t a = 0; a < faces_.size(); ++a) {
      for (std::size_t b = a + 1; b < faces_.size(); ++b) {
        if (const auto order = order_of(a, b)) orders_.push_back(*order);
      }
    }
    settle_levels();
    for (const Face& face : faces_) move_out(face);
    return std::move(tree_);
  }

 private:
  Literal& literal_of(const Face& f) { return tree_.literals[tree_.nodes[f.node].literal]; }
  const Literal& literal_of(const Face& f) const {
    return tree_.literals[tree_.nodes[f.node].literal];
  }

  /// The faces below a node, and everyone's parent.
  void collect(int index) {
    const Node& node = tree_.nodes[index];
    if (node.op == Op::Literal && is_new_[node.literal]) {
      is_new_[node.literal] = false;
      const Literal& literal = tree_.literals[node.literal];
      for (const FlatEnd end : flat_ends(literal)) add_face({index, end});
      const bool is_prism = literal.kind == SolidKind::Prism && !literal.stretch;
      for (int k = 0; is_prism && k < literal.sides; ++k) add_face({index, {}, k});
    }
    for (const int child : node.children) {
      parent_[child] = index;
      collect(child);
    }
  }

  void add_face(Face face) {
    const Vec3 normal = normal_of(literal_of(face), face);
    face.is_turned = (main_.transpose() * normal).cwiseAbs().maxCoeff() < 1 - kParallel;
    faces_.push_back(face);
  }

  std::optional<Order> order_of(std::size_t first, std::size_t second) const {
    const Face& a = faces_[first];
    const Face& b = faces_[second];
    if (!a.is_rounded() && !b.is_rounded()) return std::nullopt;
    if (a.node == b.node || (a.is_side() && b.is_side())) return std::nullopt;
    const Literal& l = literal_of(a);
    const Literal& m = literal_of(b);
    const Vec3 normal = normal_of(l, a);
    const Vec3 other = normal_of(m, b);
    if (normal.cross(other).norm() > kParallel) return std::nullopt;
    const bool is_same_side = normal.dot(other) > 0;
    const double gap = offset_of(l, a) - offset_of(m, b) * (is_same_side ? 1 : -1);
    if (std::abs(gap) > kCoplanar * diagonal_) return std::nullopt;
    const Meeting meeting = meeting_of(a.node, b.node);
    // Solid and void on one side of the plane, or equals back to back, leave nothing at the plane.
    if (is_same_side == (meeting.takes_first == meeting.takes_second)) return std::nullopt;
    if (!overlap(l, a, m, b) && !overlap(m, b, l, a)) return std::nullopt;
    // Solids decide in a union, tools in the other operations.
    const bool tools_decide = meeting.op != Op::Union;
    if (meeting.takes_first == tools_decide) return Order{first, second, is_same_side};
    if (meeting.takes_second == tools_decide) return Order{second, first, is_same_side};
    return std::nullopt;
  }

  /// What decides over a face that was moved has to move further.
  void settle_levels() {
    bool is_settled = false;
    for (int pass = 0; pass < kMostLevels && !is_settled; ++pass) {
      is_settled = true;
      for (const Order& order : orders_) is_settled = !raise(order) && is_settled;
    }
  }

  /// A prism's side stays: what yields to it moves in, what meets its back moves out.
  bool raise(const Order& order) {
    Face& decides = faces_[order.decides];
    Face& yields = faces_[order.yields];
    const int least = 1 + (order.is_same_side ? yields.level : -yields.level);
    if (decides.level >= least) return false;
    if (!decides.is_side()) {
      decides.level = least;
    } else {
      yields.level = order.is_same_side ? -1 : 1;
    }
    return true;
  }

  void move_out(const Face& face) {
    if (face.level == 0) return;
    const Literal moved = with_moved_end(literal_of(face), face.end, face.level * nudge_);
    if (is_valid_flat(moved)) literal_of(face) = moved;
  }

  Meeting meeting_of(int a, int b) const {
    std::vector<int> above;
    for (int n = a; n >= 0; n = parent_[n]) above.push_back(n);
    int meet = b;
    while (std::find(above.begin(), above.end(), meet) == above.end()) meet = parent_[meet];
    return {tree_.nodes[meet].op, is_taken(a, meet), is_taken(b, meet)};
  }

  /// Whether `node` counts as void in the result of `ancestor`.
  bool is_taken(int node, int ancestor) const {
    bool is_taken = false;
    for (int n = node; n != ancestor; n = parent_[n]) {
      const Node& above = tree_.nodes[parent_[n]];
      const bool is_tool = above.op == Op::Difference && above.children.front() != n;
      if (is_tool || above.op == Op::Complement) is_taken = !is_taken;
    }
    return is_taken;
  }

  /// Whether some of the first face lies on the second.
  static bool overlap(const Literal& l, const Face& face, const Literal& m, const Face& other) {
    for (int i = 0; i < kProbes * kProbes; ++i) {
      const int row = i / kProbes;
      const Vec3 p = point_across(l, face, (i % kProbes + 0.5) / kProbes, (row + 0.5) / kProbes);
      if (is_on(l, face, p) && is_on(m, other, p)) return true;
    }
    return false;
  }

  Tree tree_;
  double diagonal_;
  Mat3 main_;
  double nudge_ = 0;
  std::vector<int> parent_;
  std::vector<bool> is_new_;  ///< by literal, while faces are collected
  std::vector<Face> faces_;
  std::vector<Order> orders_;
};

}  // namespace

Tree with_turned_faces_apart(const Tree& tree) {
  return tree.is_empty() ? tree : Separation(tree).run();
}

}  // namespace hewn
