#pragma once
/// Many terms from the same open cells at once.
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/compute/compute.h"
#include "core/synth/decompose/grow.h"

namespace hewn {

/// A grower for each thread that may join in.
class GrowerTeam {
 public:
  /// All pairs of literals are counted before, on an accelerator, where that would keep one core
  /// busy for longer: the growers on all cores count only what they need, and there is a launch for
  /// each call.
  static constexpr double kLeastSeconds = 5e-3;

  /// All three must outlive it.
  GrowerTeam(const ColumnTable& columns, const Combinability& combinability, const RunContext& run,
             double least_seconds = kLeastSeconds);

  /// A term per request, as by `TermGrower::grow` after `set_open`: the same for any number of
  /// threads. The result is valid until the next call; once the run is cancelled it lacks terms.
  std::span<std::optional<Term>> grow(std::span<const GrowRequest> requests,
                                      const std::vector<Word>& open,
                                      const std::vector<Word>* required = nullptr);

  long terms_grown() const;

 private:
  PairsByKind count_pairs(std::span<const GrowRequest> requests, const std::vector<Word>& open,
                          const std::vector<Word>* required);

  const ColumnTable* columns_;
  const RunContext* run_;
  double least_seconds_;
  std::shared_ptr<Compute> compute_;
  std::vector<PairCounts> pairs_;  ///< by kind of term
  OpenCells cells_;
  std::vector<TermGrower> growers_;
  std::vector<std::optional<Term>> terms_;
};

}  // namespace hewn
