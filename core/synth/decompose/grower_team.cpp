#include "core/synth/decompose/grower_team.h"

#include <utility>

#include "core/compute/idle_threads.h"

namespace hewn {

GrowerTeam::GrowerTeam(const ColumnTable& columns, const Combinability& combinability,
                       const RunContext& run, double least_seconds)
    : columns_(&columns),
      run_(&run),
      least_seconds_(least_seconds),
      compute_(compute_of(run)),
      growers_(idle_workers(run.threads), TermGrower(columns, combinability)) {
  std::vector<const Word*> insides;
  for (std::size_t k = 0; k < columns.halfspaces(); ++k) {
    insides.push_back(columns.column(k, true));
  }
  for (std::size_t kind = 0; kind < kGrowKinds; ++kind) {
    pairs_.emplace_back(insides, columns.words());
  }
}

std::span<std::optional<Term>> GrowerTeam::grow(std::span<const GrowRequest> requests,
                                                const std::vector<Word>& open,
                                                const std::vector<Word>* required) {
  terms_.resize(requests.size());
  const PairsByKind pairs = count_pairs(requests, open, required);
  for (TermGrower& g : growers_) g.set_open(open, required, pairs);
  for_each_with_idle(
      run_->threads, growers_.size(), requests.size(), [&](std::size_t worker, std::size_t i) {
        terms_[i] = run_->is_cancelled() ? std::nullopt : growers_[worker].grow(requests[i]);
      });
  return terms_;
}

PairsByKind GrowerTeam::count_pairs(std::span<const GrowRequest> requests,
                                    const std::vector<Word>& open,
                                    const std::vector<Word>* required) {
  PairsByKind counted = {};
  if (pairs_[0].seconds() < least_seconds_) return counted;
  std::array<bool, kGrowKinds> is_met = {};
  for (const GrowRequest& request : requests) {
    const std::size_t kind = kind_of(request);
    if (std::exchange(is_met[kind], true)) continue;
    PairCounts& pairs = pairs_[kind];
    bool is_counted = false;
    const auto job = [&](Device& device) -> Result<void> {
      // The processor counts only what is asked for, when it is.
      if (!device.info().is_accelerator) return {};
      cells_.reset(*columns_, open, request.gains_required ? required : nullptr, request.fills);
      Result<void> done = pairs.count(device, cells_.others(), cells_.same(), *run_);
      is_counted = done.has_value();
      return done;
    };
    // Without the counts, terms grow as well.
    static_cast<void>(compute_->run(pairs.seconds(), *run_, job));
    if (is_counted) counted[kind] = &pairs;
  }
  return counted;
}

long GrowerTeam::terms_grown() const {
  long total = 0;
  for (const TermGrower& g : growers_) total += g.terms_grown();
  return total;
}

}  // namespace hewn
