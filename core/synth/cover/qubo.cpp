// Set cover as a quadratic problem over bits (Lucas 2014, section 5.1).
#include <algorithm>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/synth/cover/set_cover.h"

namespace hewn {
namespace {

/// Collects the coefficients of squares of linear forms.
class QuadraticForm {
 public:
  using Term = std::pair<int, double>;  ///< variable and its factor

  /// Adds `weight` times the square of `constant` plus the terms.
  void add_square(double weight, double constant, const std::vector<Term>& terms) {
    offset_ += weight * constant * constant;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      // Bits: x^2 = x.
      add(terms[i].first, terms[i].first,
          weight * (terms[i].second * terms[i].second + 2 * constant * terms[i].second));
      for (std::size_t k = i + 1; k < terms.size(); ++k) {
        add(terms[i].first, terms[k].first, 2 * weight * terms[i].second * terms[k].second);
      }
    }
  }
  void add(int a, int b, double value) { entries_[{std::min(a, b), std::max(a, b)}] += value; }

  void write(Qubo& out) const {
    out.offset = offset_;
    for (const auto& [at, value] : entries_) {
      if (value != 0) out.entries.push_back({at.first, at.second, value});
    }
  }

 private:
  std::map<std::pair<int, int>, double> entries_;
  double offset_ = 0;
};

}  // namespace

Qubo qubo_of(const SetCoverProblem& problem) {
  Qubo qubo;
  qubo.sets = static_cast<int>(problem.sets.size());
  qubo.variables = qubo.sets;
  qubo.penalty = 1;
  for (const int c : problem.costs) qubo.penalty = std::max(qubo.penalty, c + 1.0);
  QuadraticForm form;
  for (int k = 0; k < qubo.sets; ++k) {
    form.add(k, k, problem.costs[static_cast<std::size_t>(k)]);
  }
  for (std::size_t e = 0; e < problem.elements; ++e) {
    // One of the counters m = 1, 2, ... is set, and says how many chosen sets hold the element.
    std::vector<QuadraticForm::Term> one;
    std::vector<QuadraticForm::Term> equal;
    for (int k = 0; k < qubo.sets; ++k) {
      if (!test_bit(problem.sets[static_cast<std::size_t>(k)].data(), e)) continue;
      equal.emplace_back(k, -1.0);
    }
    const std::size_t holders = equal.size();
    for (std::size_t m = 1; m <= holders; ++m) {
      one.emplace_back(qubo.variables, -1.0);
      equal.emplace_back(qubo.variables, static_cast<double>(m));
      ++qubo.variables;
    }
    form.add_square(qubo.penalty, 1, one);
    form.add_square(qubo.penalty, 0, equal);
  }
  form.write(qubo);
  return qubo;
}

double energy(const Qubo& qubo, const std::vector<char>& bits) {
  double sum = qubo.offset;
  for (const Qubo::Entry& e : qubo.entries) {
    if (bits[static_cast<std::size_t>(e.row)] && bits[static_cast<std::size_t>(e.column)]) {
      sum += e.value;
    }
  }
  return sum;
}

std::string qubo_to_json(const Qubo& qubo) {
  nlohmann::ordered_json entries = nlohmann::ordered_json::array();
  for (const Qubo::Entry& e : qubo.entries) entries.push_back({e.row, e.column, e.value});
  const nlohmann::ordered_json document = {
      {"hewn-qubo", 1},          {"variables", qubo.variables}, {"sets", qubo.sets},
      {"penalty", qubo.penalty}, {"offset", qubo.offset},       {"entries", std::move(entries)}};
  return document.dump() + "\n";
}

}  // namespace hewn
