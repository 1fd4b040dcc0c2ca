#pragma once

namespace hewn {

/// One side of a halfspace.
struct HalfspaceSide {
  int halfspace = -1;  ///< index into `SurfaceSet::halfspaces`
  bool inside = true;

  bool operator==(const HalfspaceSide&) const = default;
};

}  // namespace hewn
