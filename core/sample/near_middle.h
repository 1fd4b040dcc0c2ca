#pragma once
/// A place in a stretch of a line. Internal to core/sample and its users.

namespace hewn {

/// Close to the middle of a stretch, but not on it: there often lies a plane of something else, on
/// which a point tells nothing.
inline double near_middle(double from, double to) { return from + 0.4871 * (to - from); }

}  // namespace hewn
