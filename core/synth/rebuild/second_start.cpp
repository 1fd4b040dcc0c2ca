#include "core/synth/rebuild/second_start.h"

#include <algorithm>
#include <utility>

namespace hewn {
namespace {

/// What is found is rewritten afterwards, so that less of a search does than for reconstruction:
/// a few starts, each for a short time. The freedom of a depth is worth more.
constexpr int kStarts = 4;
constexpr int kExactStarts = 3;
constexpr int kBeam = 6;
constexpr int kExactBeam = 4;
constexpr int kFirstShare = 8;
/// Of answers that are refuted; each mends the one before.
constexpr int kMostRounds = 24;

RebuildOptions options_for(double depth) {
  RebuildOptions options;
  options.depth = depth;
  options.list.starts = depth > 0 ? kStarts : kExactStarts;
  options.list.beam_width = depth > 0 ? kBeam : kExactBeam;
  options.list.first_share = kFirstShare;
  return options;
}

/// A quick look, enough to find most of what is wrong. The tree is checked again when it has been
/// rewritten.
ArrangementOptions quick(ArrangementOptions lines) {
  lines.volume_lines /= 6;
  lines.crossing_lines /= 10;
  lines.lines_per_face = 1;
  lines.curves_per_face = 1;
  return lines;
}

/// Those literals of the tree that are among `others`.
Tree shared(const Tree& tree, LiteralSet others) {
  Tree shared;
  const std::size_t count = others.literals().size();
  const std::vector<int> index = others.add(tree);
  for (std::size_t k = 0; k < index.size(); ++k) {
    if (static_cast<std::size_t>(index[k]) < count) shared.literals.push_back(tree.literals[k]);
  }
  return shared;
}

}  // namespace

SecondStart::SecondStart(const Tree& input, std::vector<Vec3> points, double scale, double depth,
                         const RunContext& run)
    : input_(input),
      points_(std::move(points)),
      scale_(scale),
      options_(options_for(depth)),
      run_(run),
      rebuilder_(input_, points_, scale_, options_, run_) {}

Result<std::optional<RebuiltTree>> SecondStart::find(const Arrangement& known,
                                                     const std::vector<Vec3>& further,
                                                     const ArrangementOptions& lines,
                                                     int most_literals) {
  using Take = TreeRebuilder::Take;
  std::vector<LabelledPoint> labelled = rebuilder_.labelled(known.points);
  const std::vector<LabelledPoint> labelled_further = rebuilder_.labelled(further);
  labelled.insert(labelled.end(), labelled_further.begin(), labelled_further.end());
  if (last_) rebuilder_.refute(*last_, labelled, Take::WrongAndNew);
  while (round_ < kMostRounds) {
    ++round_;
    auto tree = rebuilder_.next(most_literals);
    if (!tree) return tree.error();
    if (!*tree || literal_count(**tree) > most_literals) break;
    last_ = std::move(**tree);
    if (rebuilder_.refute(*last_, labelled, Take::Wrong) > 0) continue;
    auto good = judged(*last_, known, further, lines);
    if (!good || *good) return good;
  }
  round_ = kMostRounds;
  return std::optional<RebuiltTree>();
}

/// The tree with the cells between its primitives and the input's, when none refutes it. No line
/// runs along primitives beside which lines have run before.
Result<std::optional<RebuiltTree>> SecondStart::judged(const Tree& tree, const Arrangement& known,
                                                       const std::vector<Vec3>& further,
                                                       const ArrangementOptions& lines) {
  LiteralSet both;
  both.add(input_);
  both.add(shared(tree, looked_along_));
  ArrangementOptions look = quick(lines);
  look.first_literal = both.literals().size();
  std::vector<int> literal_of = both.add(tree);
  ArrangementSampler sampler(both.literals(), scale_);
  sampler.add(known, run_);
  sampler.add(further, run_);
  const std::size_t before = sampler.arrangement().size();
  sampler.add(seen_, run_);
  if (auto more = sampler.sample(look, run_); !more) return more.error();
  sampler.trust_edges();
  looked_along_ = both;
  seen_ = sampler.arrangement();
  const std::vector<Vec3> fresh(seen_.points.begin() + static_cast<std::ptrdiff_t>(before),
                                seen_.points.end());
  const std::size_t wrong =
      rebuilder_.refute(tree, rebuilder_.labelled(fresh), TreeRebuilder::Take::WrongAndNew);
  if (wrong > 0) return std::optional<RebuiltTree>();
  return std::optional<RebuiltTree>(
      RebuiltTree{tree, std::move(both), std::move(literal_of), std::move(sampler)});
}

}  // namespace hewn
