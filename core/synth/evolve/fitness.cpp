#include "core/synth/evolve/fitness.h"

#include <algorithm>

namespace hewn {
namespace {

/// The rows of `care`, in order, out of every column.
MeasuredRows packed_rows(const CellColumns& cells, const Column& wanted, const Column& care) {
  std::vector<std::size_t> rows;
  for_each_bit(care, [&](std::size_t c) { rows.push_back(c); });
  const auto packed = [&](const Column& from) {
    Column out(padded_words(rows.size()), 0);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (test_bit(from.data(), rows[r])) set_bit(out.data(), r);
    }
    return out;
  };
  std::vector<Column> columns;
  columns.reserve(static_cast<std::size_t>(cells.literals()));
  for (int k = 0; k < cells.literals(); ++k) columns.push_back(packed(cells.column(k)));
  return {rows.size(), columns, packed(wanted)};
}

}  // namespace

FitnessTable::FitnessTable(const CellColumns& cells, const Column& wanted, const Column& care,
                           const RunContext& run)
    : compute_(compute_of(run)), rows_(packed_rows(cells, wanted, care)) {
  const std::size_t words = std::min(wanted.size(), care.size());
  inside_ = bit_kernels().count_and(wanted.data(), care.data(), words);
  outside_ = static_cast<int>(rows_.rows()) - inside_;
}

Result<std::vector<Measures>> FitnessTable::measure(std::span<const Genome* const> genomes,
                                                    const RunContext& run) {
  batch_.clear();
  for (const Genome* genome : genomes) batch_.add(*genome);
  measured_.resize(genomes.size());
  const auto job = [&](Device& device) { return rows_.measure(device, batch_, measured_, run); };
  const Result<void> done = compute_->run(rows_.seconds_for(batch_), run, job);
  if (!done) return done.error();
  std::vector<Measures> measures(genomes.size());
  for (std::size_t i = 0; i < genomes.size(); ++i) {
    const TreeMeasures& from = measured_[i];
    Measures& to = measures[i];
    to.inside_right = from.held_wanted;
    to.outside_right = outside_ - (from.held - from.held_wanted);
    to.size = static_cast<int>(genomes[i]->size());
    // Leaves and complements count one each, other operations when their operands overlap.
    const auto counts = [](Token t) { return t >= 0 || t == kComplementToken; };
    to.proximity = from.overlaps +
                   static_cast<int>(std::count_if(genomes[i]->begin(), genomes[i]->end(), counts));
  }
  return measures;
}

}  // namespace hewn
