#include "core/csg/turned_faces.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/csg/flat_end.h"

namespace hewn {
namespace {

constexpr double kParallel = 1e-9;  ///< of unit vectors: sine of the angle between them
constexpr double kCoplanar = 2e-6;  ///< share of the diagonal
constexpr double kNudge = 1e-5;     ///< share of the diagonal: ten times what is rounded, or more
constexpr int kProbes = 9;          ///< per direction of a face, for its overlap with another

/// Whether each axis of one frame is one of the other, up to sign.
bool is_same_frame(const Mat3& a, const Mat3& b) {
  const Mat3 cosines = (a.transpose() * b).cwiseAbs();
  return cosines.colwise().maxCoeff().minCoeff() > 1 - 1e-12;
}

/// The axes of most literals.
Mat3 main_frame(const std::vector<Literal>& literals) {
  Mat3 best = Mat3::Identity();
  std::ptrdiff_t most = 0;
  for (const Literal& candidate : literals) {
    const auto count = std::count_if(literals.begin(), literals.end(), [&](const Literal& l) {
      return is_same_frame(l.rotation, candidate.rotation);
    });
    if (count <= most) continue;
    most = count;
    best = candidate.rotation;
  }
  return best;
}

struct Face {
  int node = 0;  ///< of the literal
  FlatEnd end;
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
    collect(tree_.root);
    for (std::size_t a = 0; a < faces_.size(); ++a) {
      for (std::size_t b = a + 1; b < faces_.size(); ++b) separate(faces_[a], faces_[b]);
    }
    return std::move(tree_);
  }

 private:
  Literal& literal_of(const Face& f) { return tree_.literals[tree_.nodes[f.node].literal]; }

  /// The turned faces below a node, and everyone's parent.
  void collect(int index) {
    const Node& node = tree_.nodes[index];
    if (node.op == Op::Literal) {
      const Literal& literal = tree_.literals[node.literal];
      for (const FlatEnd end : flat_ends(literal)) {
        if (is_turned(outward_normal(literal, end))) faces_.push_back({index, end});
      }
    }
    for (const int child : node.children) {
      parent_[child] = index;
      collect(child);
    }
  }

  bool is_turned(const Vec3& normal) const {
    return (main_.transpose() * normal).cwiseAbs().maxCoeff() < 1 - kParallel;
  }

  void separate(const Face& a, const Face& b) {
    const Literal& l = literal_of(a);
    const Literal& m = literal_of(b);
    const Vec3 normal = outward_normal(l, a.end);
    const Vec3 other = outward_normal(m, b.end);
    if (a.node == b.node || normal.cross(other).norm() > kParallel) return;
    const bool is_same_side = normal.dot(other) > 0;
    const double gap = plane_offset(l, a.end) - plane_offset(m, b.end) * (is_same_side ? 1 : -1);
    if (std::abs(gap) > kCoplanar * diagonal_) return;
    const Meeting meeting = meeting_of(a.node, b.node);
    // Solid and void on one side of the plane, or equals back to back, leave nothing at the plane.
    if (is_same_side == (meeting.takes_first == meeting.takes_second)) return;
    if (!overlap(l, a.end, m, b.end) && !overlap(m, b.end, l, a.end)) return;
    // Solids decide in a union, tools in the other operations.
    const bool tools_decide = meeting.op != Op::Union;
    for (const auto& [face, is_tool] :
         {std::pair{a, meeting.takes_first}, {b, meeting.takes_second}}) {
      if (is_tool != tools_decide) continue;
      literal_of(face) = with_moved_end(literal_of(face), face.end, nudge_);
      return;
    }
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

  /// Whether some of the first end lies on the second.
  static bool overlap(const Literal& l, FlatEnd end, const Literal& m, FlatEnd other) {
    const LocalBox plane = beyond_end(l, end, 0, 0);
    const int u = (end.axis + 1) % 3;
    const int v = (end.axis + 2) % 3;
    for (int i = 0; i < kProbes * kProbes; ++i) {
      const int row = i / kProbes;
      Vec3 p = plane.lo;
      p[u] += plane.size()[u] * (i % kProbes + 0.5) / kProbes;
      p[v] += plane.size()[v] * (row + 0.5) / kProbes;
      if (is_over_end(l, end, p, 0) && is_over_end(m, other, m.to_local(l.to_world(p)), 0)) {
        return true;
      }
    }
    return false;
  }

  Tree tree_;
  double diagonal_;
  Mat3 main_;
  double nudge_ = 0;
  std::vector<int> parent_;
  std::vector<Face> faces_;
};

}  // namespace

Tree with_turned_faces_apart(const Tree& tree) {
  return tree.is_empty() ? tree : Separation(tree).run();
}

}  // namespace hewn
