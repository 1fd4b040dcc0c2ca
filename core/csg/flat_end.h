#pragma once
/// The flat ends of boxes and cylinders, and what moving them means.
#include <vector>

#include "core/csg/literal.h"

namespace hewn {

/// An end at right angles to a local axis of a literal: a side of a box, the bottom or top of a
/// cylinder.
struct FlatEnd {
  int axis = 2;
  bool is_upper = false;
};

/// A box in a literal's local coordinates.
struct LocalBox {
  Vec3 lo = Vec3::Zero(), hi = Vec3::Zero();
  Vec3 center() const { return (lo + hi) / 2; }
  Vec3 size() const { return hi - lo; }
};

/// Six for a box, two for a cylinder, none for other kinds.
std::vector<FlatEnd> flat_ends(const Literal& literal);

/// The end's unit normal in space, away from the literal.
Vec3 outward_normal(const Literal& literal, FlatEnd end);

/// Of the end's plane along `outward_normal`.
double plane_offset(const Literal& literal, FlatEnd end);

/// The literal with the end moved out by `amount` (in, when negative); a cone keeps its slope.
/// Neither the length nor a radius may come out negative: see `is_valid_flat`.
Literal with_moved_end(Literal literal, FlatEnd end, double amount);

/// Whether the lengths of a box or cylinder are positive and its radii not negative.
bool is_valid_flat(const Literal& literal);

/// The local box around what lies between `from` and `to` beyond the end (negative: within).
LocalBox beyond_end(const Literal& literal, FlatEnd end, double from, double to);

/// Whether a local point lies within `margin` of the end's cross-section, prolonged at its slope.
bool is_over_end(const Literal& literal, FlatEnd end, const Vec3& local, double margin);

}  // namespace hewn
