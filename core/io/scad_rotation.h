#pragma once
/// Rotations as OpenSCAD's `rotate([a, b, c])`, and the frames that a tree's literals share.
#include <array>
#include <string>
#include <vector>

#include "core/csg/literal.h"

namespace hewn {

/// A rotation in print: `rotate([x, y, z])` turns about x first and z last.
struct PrintedRotation {
  std::array<std::string, 3> angles = {"0", "0", "0"};  ///< degrees
  bool is_identity() const { return angles == std::array<std::string, 3>{"0", "0", "0"}; }
  /// "rotate([0, 0, 30]) " or nothing.
  std::string text() const;
  /// Lower is easier to read: fewer axes, then fewer digits, then smaller and positive angles.
  std::array<double, 4> cost() const;
};

/// The angles, each with an error of at most `tolerance_rad / 3`.
PrintedRotation print_rotation(const Mat3& rotation, double tolerance_rad);

/// A rotation that takes z to `axis` or, when `may_flip`, to its opposite.
struct AxisRotation {
  PrintedRotation printed;
  bool is_flipped = false;
  Mat3 matrix = Mat3::Identity();
};
AxisRotation print_axis_rotation(const Vec3& axis, bool may_flip, double tolerance_rad);

/// The frame among the 24 that differ by quarter turns whose angles print best.
Mat3 readable_frame(const Mat3& frame, double tolerance_rad);

/// Rounds to the signed permutation matrix that equals `m` within the tolerance; false if none.
bool as_signed_permutation(const Mat3& m, double tolerance, Mat3& permutation);

/// The column of `frame` that `axis` lies along, and its sign; index -1 when there is none.
struct AlongColumn {
  int index = -1;
  int sign = 1;
};
AlongColumn along_column(const Mat3& frame, const Vec3& axis, double tolerance);

/// Whether the literal can be written in the frame with quarter turns only.
bool is_aligned(const Literal& literal, const Mat3& frame, double tolerance);

/// Spheres, polyhedra and stretched literals have no direction that a frame could share.
bool is_oriented(const Literal& literal);

/// The frames that literals share. Frame 0 is the identity.
struct FrameSet {
  std::vector<Mat3> frames;
  std::vector<int> of_literal;
  std::vector<int> members;  ///< aligned literals of each frame
  int root = 0;              ///< the one to write the whole design in
};
FrameSet find_frames(const std::vector<Literal>& literals, double tolerance_rad);

}  // namespace hewn
