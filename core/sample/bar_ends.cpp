#include "core/sample/bar_ends.h"

#include <algorithm>
#include <utility>

#include "core/fit/round_values.h"
#include "core/sample/bars.h"
#include "core/sample/separating_plane.h"

namespace hewn {
namespace {

constexpr std::size_t kMostEnds = 24;
constexpr double kNearEnd = 0.01;  // of the thickness: a plane so near to the end is at it
constexpr int kSteps = 8;          // per thickness, on the way beyond what can be seen
constexpr int kMostSteps = 400;    // to the end of the part

/// Whether a plane of the part across the bar lies at `end` or beyond it, in the sense of `sign`.
bool has_end(const Bar& bar, double end, double sign, const SurfaceSet& surfaces) {
  return std::any_of(surfaces.halfspaces.begin(), surfaces.halfspaces.end(),
                     [&](const Halfspace& h) {
                       if (h.surface.kind != SurfaceKind::Plane) return false;
                       if (h.surface.axis.cross(bar.along).norm() > kSameBarDirection) return false;
                       const double place = bar.along.dot(h.surface.axis) * h.surface.offset;
                       const double beyond = sign * (place - end);
                       return beyond > -kNearEnd * bar.thickness;
                     });
}

/// How far the bar goes on unseen beyond `end`, in the sense of `sign`; 0 when that is to the end
/// of the part, where it needs no end of its own.
double room_beyond(const Bar& bar, double end, double sign, const SampleSpace& space) {
  const double step = bar.thickness / kSteps;
  const std::vector<Vec3>& rim = sign < 0 ? bar.low_rim : bar.high_rim;
  for (int k = 0; k < kMostSteps; ++k) {
    bool is_in_part = false;
    for (const Vec3& p : rim) {
      const Vec3 q = p + (end + sign * (k + 0.5) * step - bar.along.dot(p)) * bar.along;
      if ((*space.label)(q) != bar.label) return k * step;
      is_in_part = is_in_part || space.mesh().bounds.contains(q);
    }
    if (!is_in_part) return 0;
  }
  return 0;
}

int direction_index(const Vec3& along, std::vector<Vec3>& directions) {
  for (std::size_t i = 0; i < directions.size(); ++i) {
    if (directions[i].cross(along).norm() < kSameBarDirection) return static_cast<int>(i);
  }
  directions.push_back(along);
  return static_cast<int>(directions.size()) - 1;
}

/// Appends the bar's hidden ends to `ends`, and their direction to `directions` if it is new.
void add_ends(const Bar& bar, const SampleSpace& space, const SurfaceSet& surfaces,
              std::vector<Vec3>& directions, std::vector<Halfspace>& ends) {
  for (const auto& [end, sign] : {std::pair{bar.lo, -1.0}, std::pair{bar.hi, 1.0}}) {
    if (has_end(bar, end, sign, surfaces)) continue;
    const double room = std::min(bar.thickness, room_beyond(bar, end, sign, space));
    if (room <= 0) continue;  // what is beyond ends the bar
    const double place = roundest_value(end + sign * room / 2, room / 4);
    const int direction = direction_index(bar.along, directions);
    const Halfspace h = separating_plane(directions, direction, bar.along, place, space.diagonal);
    const bool is_new = std::none_of(ends.begin(), ends.end(), [&](const Halfspace& other) {
      return other.direction == h.direction &&
             std::abs(other.surface.offset - h.surface.offset) < bar.thickness / 2;
    });
    if (is_new) ends.push_back(h);
  }
}

}  // namespace

std::vector<Halfspace> bar_ends(const SampleSpace& space, SurfaceSet& surfaces) {
  std::vector<Vec3> directions = surfaces.directions;
  std::vector<Halfspace> ends;
  for (const Bar& bar : find_bars(space, surfaces)) {
    add_ends(bar, space, surfaces, directions, ends);
  }
  if (ends.size() > kMostEnds) return {};
  surfaces.directions = std::move(directions);
  return ends;
}

}  // namespace hewn
