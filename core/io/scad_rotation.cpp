#include "core/io/scad_rotation.h"

#include <algorithm>
#include <cstdlib>

#include "core/io/decimal.h"

namespace hewn {
namespace {

constexpr double kDegrees = 180 / kPi;

Mat3 rotation_about(int axis, double angle_rad) {
  return Eigen::AngleAxisd(angle_rad, Vec3::Unit(axis)).toRotationMatrix();
}

std::string angle_text(double angle_rad, double tolerance_rad) {
  const std::string text = shortest_decimal(angle_rad * kDegrees, tolerance_rad * kDegrees);
  return text == "-180" ? "180" : text;
}

PrintedRotation printed(const Vec3& angles_rad, double tolerance_rad) {
  PrintedRotation r;
  for (int k = 0; k < 3; ++k) r.angles[k] = angle_text(angles_rad[k], tolerance_rad / 3);
  return r;
}

/// Of the two solutions the one with the middle angle in [-90, 90] degrees.
Vec3 euler_angles(const Mat3& m) {
  const double cosine = std::hypot(m(0, 0), m(1, 0));
  const double b = std::atan2(-m(2, 0), cosine);
  // In gimbal lock the turn about x can be left to z.
  if (cosine < 1e-9) return {0, b, std::atan2(-m(0, 1), m(1, 1))};
  return {std::atan2(m(2, 1), m(2, 2)), b, std::atan2(m(1, 0), m(0, 0))};
}

double wrapped(double angle_rad) { return std::remainder(angle_rad, 2 * kPi); }

bool is_cheaper(const PrintedRotation& a, const PrintedRotation& b) {
  return std::make_pair(a.cost(), a.angles) < std::make_pair(b.cost(), b.angles);
}

std::vector<Mat3> quarter_turns() {
  std::vector<Mat3> turns;
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 3; ++y) {
      for (int signs = 0; signs < 4 && y != x; ++signs) {
        const Vec3 u = Vec3::Unit(x) * ((signs & 1) ? -1 : 1);
        const Vec3 v = Vec3::Unit(y) * ((signs & 2) ? -1 : 1);
        Mat3 m;
        m << u, v, u.cross(v);
        turns.push_back(m);
      }
    }
  }
  return turns;
}

bool has_axis(const Literal& s) {
  const bool has_axis =
      s.kind == SolidKind::Cylinder || s.kind == SolidKind::Prism || s.kind == SolidKind::Torus;
  return has_axis && !s.stretch;
}

/// Stretched literals are printed by their matrix, in any frame.
bool is_plain_box(const Literal& s) { return !s.stretch && s.kind == SolidKind::Box; }

/// Builds the frame set in three passes: boxes, pairs of axes, single axes.
class FrameFinder {
 public:
  FrameFinder(const std::vector<Literal>& literals, double tolerance)
      : literals_(literals), tolerance_(tolerance) {
    set_.frames.emplace_back(Mat3::Identity());
  }

  FrameSet run() {
    for (const Literal& s : literals_) {
      if (is_plain_box(s)) add_unless_aligned(s, s.rotation);
    }
    add_axis_pairs();
    for (const Literal& s : literals_) {
      if (!has_axis(s)) continue;
      add_unless_aligned(s, print_axis_rotation(s.rotation.col(2), true, tolerance_).matrix);
    }
    count_members();
    choose_root();
    return std::move(set_);
  }

 private:
  void add_unless_aligned(const Literal& s, const Mat3& frame) {
    for (const Mat3& known : set_.frames) {
      if (is_aligned(s, known, tolerance_)) return;
    }
    set_.frames.push_back(readable_frame(frame, tolerance_));
  }

  /// Two orthogonal axes make a frame for a turned part that has no box.
  void add_axis_pairs() {
    constexpr std::size_t kMostAxes = 24;
    std::vector<const Literal*> lone;
    for (const Literal& s : literals_) {
      if (!has_axis(s) || lone.size() >= kMostAxes) continue;
      const bool is_known = std::any_of(set_.frames.begin(), set_.frames.end(), [&](const Mat3& f) {
        return is_aligned(s, f, tolerance_);
      });
      if (!is_known) lone.push_back(&s);
    }
    for (const Literal* a : lone) {
      for (const Literal* b : lone) {
        const Vec3 u = a->rotation.col(2);
        const Vec3 v = b->rotation.col(2);
        if (std::abs(u.dot(v)) > tolerance_) continue;
        Mat3 frame;
        frame << u, u.cross(v).cross(u).normalized(), u.cross(v).normalized();
        add_unless_aligned(*a, frame);
      }
    }
  }

  void count_members() {
    set_.members.assign(set_.frames.size(), 0);
    for (std::size_t f = 0; f < set_.frames.size(); ++f) {
      for (const Literal& s : literals_) {
        if (is_oriented(s) && is_aligned(s, set_.frames[f], tolerance_)) ++set_.members[f];
      }
    }
    for (const Literal& s : literals_) {
      int best = 0;
      for (std::size_t f = 1; f < set_.frames.size() && !is_aligned(s, set_.frames[0], tolerance_);
           ++f) {
        if (!is_aligned(s, set_.frames[f], tolerance_)) continue;
        if (best == 0 || set_.members[f] > set_.members[best]) best = static_cast<int>(f);
      }
      set_.of_literal.push_back(best);
    }
  }

  /// A design is written upright unless hardly anything in it is; boxes decide where there are any.
  /// Those of a turned frame must be half of all: spokes around a hub leave it upright.
  void choose_root() {
    const bool has_box = std::any_of(literals_.begin(), literals_.end(),
                                     [](const Literal& s) { return s.kind == SolidKind::Box; });
    std::vector<const Literal*> voters;
    for (const Literal& s : literals_) {
      if (has_box ? s.kind == SolidKind::Box : has_axis(s)) voters.push_back(&s);
    }
    constexpr int kUprightBonus = 3;
    int best_votes = 0;
    for (std::size_t f = 0; f < set_.frames.size(); ++f) {
      auto votes =
          static_cast<int>(std::count_if(voters.begin(), voters.end(), [&](const Literal* s) {
            return is_aligned(*s, set_.frames[f], tolerance_);
          }));
      if (f > 0 && 2 * votes < static_cast<int>(voters.size())) continue;
      if (f == 0) votes *= kUprightBonus;
      if (votes > best_votes) {
        best_votes = votes;
        set_.root = static_cast<int>(f);
      }
    }
  }

  const std::vector<Literal>& literals_;
  double tolerance_;
  FrameSet set_;
};

}  // namespace

std::string PrintedRotation::text() const {
  if (is_identity()) return "";
  return "rotate([" + angles[0] + ", " + angles[1] + ", " + angles[2] + "]) ";
}

std::array<double, 4> PrintedRotation::cost() const {
  std::array<double, 4> cost = {0, 0, 0, 0};
  for (const std::string& a : angles) {
    cost[0] += a == "0" ? 0 : 1;
    cost[1] += static_cast<double>(std::count_if(a.begin(), a.end(), ::isdigit));
    cost[2] += std::abs(std::strtod(a.c_str(), nullptr));
    cost[3] += a.front() == '-' ? 1 : 0;
  }
  return cost;
}

PrintedRotation print_rotation(const Mat3& rotation, double tolerance_rad) {
  const Vec3 angles = euler_angles(rotation);
  const Vec3 other(wrapped(angles[0] + kPi), wrapped(kPi - angles[1]), wrapped(angles[2] + kPi));
  const PrintedRotation a = printed(angles, tolerance_rad);
  const PrintedRotation b = printed(other, tolerance_rad);
  return is_cheaper(b, a) ? b : a;
}

AxisRotation print_axis_rotation(const Vec3& axis, bool may_flip, double tolerance_rad) {
  AxisRotation best;
  bool has_best = false;
  const auto offer = [&](const Vec3& angles, bool is_flipped) {
    const PrintedRotation candidate = printed(angles, tolerance_rad);
    if (has_best && !is_cheaper(candidate, best.printed)) return;
    has_best = true;
    best.printed = candidate;
    best.is_flipped = is_flipped;
    best.matrix =
        rotation_about(2, angles[2]) * rotation_about(1, angles[1]) * rotation_about(0, angles[0]);
  };
  for (const bool is_flipped : {false, true}) {
    if (is_flipped && !may_flip) break;
    const Vec3 a = is_flipped ? Vec3(-axis) : axis;
    const double polar = std::atan2(std::hypot(a.x(), a.y()), a.z());
    const double azimuth = polar > 0 ? std::atan2(a.y(), a.x()) : 0;
    offer({0, polar, azimuth}, is_flipped);
    offer({0, -polar, wrapped(azimuth + kPi)}, is_flipped);
    if (std::abs(a.x()) <= tolerance_rad / 3) offer({std::atan2(-a.y(), a.z()), 0, 0}, is_flipped);
  }
  return best;
}

Mat3 readable_frame(const Mat3& frame, double tolerance_rad) {
  // A mirrored frame holds the same axes.
  Mat3 proper = frame;
  if (proper.determinant() < 0) proper.col(0) = -proper.col(0);
  Mat3 best = proper;
  PrintedRotation best_print = print_rotation(proper, tolerance_rad);
  for (const Mat3& turn : quarter_turns()) {
    const Mat3 candidate = proper * turn;
    const PrintedRotation print = print_rotation(candidate, tolerance_rad);
    if (!is_cheaper(print, best_print)) continue;
    best = candidate;
    best_print = print;
  }
  return best;
}

bool as_signed_permutation(const Mat3& m, double tolerance, Mat3& permutation) {
  permutation.setZero();
  for (int column = 0; column < 3; ++column) {
    int row = 0;
    m.col(column).cwiseAbs().maxCoeff(&row);
    permutation(row, column) = m(row, column) < 0 ? -1 : 1;
  }
  return (m - permutation).cwiseAbs().maxCoeff() <= tolerance;
}

AlongColumn along_column(const Mat3& frame, const Vec3& axis, double tolerance) {
  const Vec3 local = frame.transpose() * axis;
  AlongColumn found;
  int k = 0;
  local.cwiseAbs().maxCoeff(&k);
  found.sign = local[k] < 0 ? -1 : 1;
  if ((local - Vec3::Unit(k) * found.sign).cwiseAbs().maxCoeff() <= tolerance) found.index = k;
  return found;
}

bool is_aligned(const Literal& literal, const Mat3& frame, double tolerance) {
  if (has_axis(literal)) {
    return along_column(frame, literal.rotation.col(2), tolerance).index >= 0;
  }
  if (!is_plain_box(literal)) return true;
  Mat3 ignored;
  return as_signed_permutation(frame.transpose() * literal.rotation, tolerance, ignored);
}

bool is_oriented(const Literal& literal) { return is_plain_box(literal) || has_axis(literal); }

FrameSet find_frames(const std::vector<Literal>& literals, double tolerance_rad) {
  return FrameFinder(literals, tolerance_rad).run();
}

}  // namespace hewn
