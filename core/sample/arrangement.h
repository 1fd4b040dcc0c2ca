#pragma once
/// The cells into which a set of literals divides space: every distinct combination of "inside" and
/// "outside", each with a point that shows it.
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/compute/bits.h"
#include "core/csg/bounds_table.h"
#include "core/sample/key_set.h"

namespace hewn {

/// Points with the same signature cannot be told apart by any tree over the literals (canonical
/// intersection terms, Friedrich et al. 2020, section 3.1.1).
struct Arrangement {
  std::vector<Literal> literals;
  std::vector<LiteralBounds> bounds;  ///< of each literal
  std::vector<double> uncertain;      ///< of each: nearer to its surface rounding may decide
  BoundsTable near;                   ///< which of them are nearer to a point than that
  std::size_t stride = 0;             ///< words per signature
  std::vector<Vec3> points;
  std::vector<Word> signatures;  ///< bit k: the cell's point is inside literal k
  double scale = 1;              ///< the length to which tolerances relate
  /// Cells thinner than this are not told from their neighbours.
  double resolution = 0;

  std::size_t size() const { return points.size(); }
  const Word* signature(std::size_t cell) const { return signatures.data() + cell * stride; }
  bool is_inside(std::size_t cell, int literal) const {
    return test_bit(signature(cell), static_cast<std::size_t>(literal));
  }
};

struct ArrangementOptions {
  // All but the last are upper bounds: a batch that finds nothing new is the last of its kind.
  int volume_lines = 3000;    ///< random lines through the literals' common box
  int lines_per_face = 12;    ///< of each side of a face
  int curves_per_face = 6;    ///< circles on each side of a round face
  int crossing_lines = 3000;  ///< common lines of two planes of neighbours; all when they are fewer
  std::size_t most_cells = 250'000;
  /// Lines along faces are drawn for literals from this index on.
  std::size_t first_literal = 0;
  std::uint64_t stream = 0;  ///< another one finds the cells by other lines
};

/// Finds cells along lines: random ones, and ones that run on both sides of every face and edge of
/// every literal at a distance of `resolution`, where exact crossings tell the cells apart however
/// thin they are; round faces and rims are followed in circles. Grows over several calls.
///
/// Same result for any number of threads.
class ArrangementSampler {
 public:
  /// `scale`: the diagonal of the solid; the resolution is a millionth of it.
  ArrangementSampler(std::vector<Literal> literals, double scale);

  /// Adds the cells that are found. Returns how many are new. Fails with: Cancelled.
  /// Cost: O(literals^2) crossings.
  Result<std::size_t> sample(const ArrangementOptions& options, const RunContext& run);

  /// Adds the cells of the points that are no nearer to any literal's surface than rounding.
  /// Returns how many are new.
  std::size_t add(const std::vector<Vec3>& points, const RunContext& run);
  /// The same for the cells of another arrangement of the same scale: on which sides of the
  /// literals of both its points lie is known.
  std::size_t add(const Arrangement& known, const RunContext& run);

  /// The cells beside all edges are among those added: lines need not run along them.
  void trust_edges() { edges_known_from_ = 0; }

  /// The cell that holds `p`, or the number of cells when it is not known.
  std::size_t cell_of(const Vec3& p) const;

  const Arrangement& arrangement() const { return out_; }

 private:
  std::size_t find(const Word* signature) const;
  template <class Classify>
  std::size_t add_points(const std::vector<Vec3>& points, const RunContext& run,
                         const Classify& classify);
  bool insert(const Vec3& point, const Word* signature);

  Arrangement out_;
  std::vector<std::uint64_t> keys_;   ///< of each literal
  KeySet known_;                      ///< keys of the cells, which lines need not find again
  std::size_t edges_known_from_ = 0;  ///< the edges of literals from this one on have been walked
  std::size_t crossings_known_from_ = 0;  ///< all crossings of later ones have been, too
  std::unordered_multimap<std::uint64_t, std::size_t> by_hash_;  // looked up only, never iterated
};

/// The box around all literals that have bounds.
Box3 common_box(const Arrangement& arrangement);

/// Sets the literal's bit where it holds `p`. False when its surface is within rounding.
inline bool take_side(const Arrangement& arrangement, std::size_t literal, const Vec3& p,
                      Word* signature) {
  const double margin = arrangement.uncertain[literal];
  const double d =
      distance_within(arrangement.literals[literal], arrangement.bounds[literal], p, margin);
  if (d < 0) set_bit(signature, literal);
  return std::abs(d) >= margin;
}

/// Which literals hold `p`, into `signature`. False when one of their surfaces is within rounding.
bool classify(const Arrangement& arrangement, const Vec3& p, Word* signature);

}  // namespace hewn
