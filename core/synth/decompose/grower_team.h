#pragma once
/// Many terms from the same open cells at once.
#include <optional>
#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/synth/decompose/grow.h"

namespace hewn {

/// A grower for each thread that may join in.
class GrowerTeam {
 public:
  /// All three must outlive it.
  GrowerTeam(const ColumnTable& columns, const Combinability& combinability, const RunContext& run);

  /// A term per request, as by `TermGrower::grow` after `set_open`: the same for any number of
  /// threads. The result is valid until the next call; once the run is cancelled it lacks terms.
  std::span<std::optional<Term>> grow(std::span<const GrowRequest> requests,
                                      const std::vector<Word>& open,
                                      const std::vector<Word>* required = nullptr);

  long terms_grown() const;

 private:
  const RunContext* run_;
  std::vector<TermGrower> growers_;
  std::vector<std::optional<Term>> terms_;
};

}  // namespace hewn
