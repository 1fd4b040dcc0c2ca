#pragma once
/// Walks through an arrangement: the cells along lines and circles. Internal to core/sample.
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/bucket_sort.h"
#include "core/csg/tree_ray.h"
#include "core/sample/arrangement.h"
#include "core/sample/arrangement_lines.h"
#include "core/sample/key_set.h"

namespace hewn {

/// Cells found by one chunk of work, each once. A cell is known by its key, the exclusive or of the
/// keys of the literals that hold it: one crossing changes it at once. That two cells have the same
/// key is less likely than a cell no line meets.
struct Finds {
  std::vector<Vec3> points;
  std::vector<std::uint64_t> keys;
  KeySet known;

  void add(const Vec3& p, std::uint64_t key) {
    if (!known.insert(key)) return;
    points.push_back(p);
    keys.push_back(key);
  }
};

/// What is walked through.
struct Walkable {
  const Arrangement& arrangement;
  const TreeRays& rays;                    ///< of its literals
  const std::vector<std::uint64_t>& keys;  ///< of each literal
  const KeySet& known;                     ///< cells that need not be found
  Box3 box;                                ///< of all literals
};

/// Nearer to a surface than this share of the scale, rounding may decide the side.
inline constexpr double kUncertain = 1e-9;

/// Walks lines and circles. Holds scratch memory: one per thread.
class Walker {
 public:
  /// Both must outlive it.
  Walker(const Walkable& place, Finds& finds) : place_(place), finds_(finds) {}

  /// Every cell along the line that is longer than rounding on it.
  void line(const ProbeLine& probe);

  /// Samples around the circle, and between samples that more than one surface separates.
  void circle(const ProbeCircle& probe);

 private:
  static constexpr int kSamples = 48;  ///< around a circle
  static constexpr int kDeepest = 9;   ///< halvings of the arc between two

  /// A point on the circle by the literals near it that hold it.
  struct Sample {
    bool is_certain = false;
    std::vector<Word> holds;  ///< a bit for each of `near_`
  };
  /// A literal that the circle may meet, with its distance somewhere on the circle: further along
  /// by less than that, its side is the same.
  struct Near {
    std::size_t literal = 0;
    double distance = 0;
    double at = 0;  ///< along the circle
  };
  void find_near(const ProbeCircle& probe);
  double distance_of(Near& near, const Vec3& p, double at) const;
  void take(const Vec3& p, double at, Sample& out);
  void refine(const ProbeCircle& probe, double from, double to, const Sample& a, const Sample& b,
              int depth);

  const Walkable& place_;
  Finds& finds_;
  using Event = std::pair<double, int>;  ///< a crossing's place, and the literal
  std::vector<Event> events_;
  BucketSorter<Event> sort_;
  std::vector<TreeInterval> stretches_;
  std::vector<Near> near_;
  double radius_ = 0;  ///< of the circle
  Sample last_, here_;
  Sample middle_[kDeepest];     ///< by depth
  std::uint64_t last_key_ = 0;  ///< of the last sample
};

}  // namespace hewn
