#include "core/synth/decompose/grower_team.h"

#include "core/compute/idle_threads.h"

namespace hewn {

GrowerTeam::GrowerTeam(const ColumnTable& columns, const Combinability& combinability,
                       const RunContext& run)
    : run_(&run), growers_(idle_workers(run.threads), TermGrower(columns, combinability)) {}

std::span<std::optional<Term>> GrowerTeam::grow(std::span<const GrowRequest> requests,
                                                const std::vector<Word>& open,
                                                const std::vector<Word>* required) {
  terms_.resize(requests.size());
  for (TermGrower& g : growers_) g.set_open(open, required);
  for_each_with_idle(
      run_->threads, growers_.size(), requests.size(), [&](std::size_t worker, std::size_t i) {
        terms_[i] = run_->is_cancelled() ? std::nullopt : growers_[worker].grow(requests[i]);
      });
  return terms_;
}

long GrowerTeam::terms_grown() const {
  long total = 0;
  for (const TermGrower& g : growers_) total += g.terms_grown();
  return total;
}

}  // namespace hewn
