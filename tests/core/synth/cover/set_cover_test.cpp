#include "core/synth/cover/set_cover.h"

#include <algorithm>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "core/base/rng.h"

namespace hewn {
namespace {

SetCoverProblem problem_of(std::size_t elements, const std::vector<std::vector<int>>& sets) {
  SetCoverProblem problem;
  problem.elements = elements;
  for (const std::vector<int>& members : sets) {
    Column set(padded_words(elements), 0);
    for (const int e : members) set_bit(set.data(), static_cast<std::size_t>(e));
    problem.sets.push_back(std::move(set));
    problem.costs.push_back(1);
  }
  return problem;
}

SetCoverProblem random_problem(Rng& rng, int elements, int sets) {
  std::vector<std::vector<int>> members(static_cast<std::size_t>(sets));
  for (int e = 0; e < elements; ++e) {
    const std::size_t holders = 1 + rng.below(3);
    for (std::size_t i = 0; i < holders; ++i) {
      const std::size_t set = rng.below(members.size());
      members[set].push_back(e);
    }
  }
  SetCoverProblem problem = problem_of(static_cast<std::size_t>(elements), members);
  for (int& c : problem.costs) c = 1 + static_cast<int>(rng.below(4));
  return problem;
}

int least_cost(const SetCoverProblem& problem) {
  int least = 1 << 20;
  for (int choice = 0; choice < (1 << problem.sets.size()); ++choice) {
    Column held(padded_words(problem.elements), 0);
    int cost = 0;
    for (std::size_t k = 0; k < problem.sets.size(); ++k) {
      if (((choice >> k) & 1) == 0) continue;
      cost += problem.costs[k];
      for (std::size_t w = 0; w < held.size(); ++w) held[w] |= problem.sets[k][w];
    }
    int count = 0;
    for (const Word w : held) count += std::popcount(w);
    if (count == static_cast<int>(problem.elements)) least = std::min(least, cost);
  }
  return least;
}

TEST_CASE("the exact search finds the cheapest cover and proves it") {
  Rng rng(51);
  for (int i = 0; i < 60; ++i) {
    const SetCoverProblem problem = random_problem(rng, 12, 9);
    const SetCover cover = exact_cover(problem, 100'000, {});
    CHECK(cover.is_complete);
    CHECK(cover.is_optimal);
    CHECK(cover.cost == least_cost(problem));
    CHECK(greedy_cover(problem).cost >= cover.cost);
  }
}

TEST_CASE("where greed fails, the search does not") {
  // Greed takes the long row first and then needs both others.
  const SetCoverProblem problem = problem_of(6, {{1, 2, 4, 5}, {0, 1, 2}, {3, 4, 5}});
  CHECK(exact_cover(problem, 1000, {}).chosen == std::vector<int>{1, 2});
}

TEST_CASE("the least energy of the QUBO is the cost of the cheapest cover") {
  Rng rng(52);
  for (int i = 0; i < 8; ++i) {
    const SetCoverProblem problem = random_problem(rng, 4, 4);
    const Qubo qubo = qubo_of(problem);
    if (qubo.variables > 18) continue;
    double least = 1e9;
    for (int x = 0; x < (1 << qubo.variables); ++x) {
      std::vector<char> bits;
      for (int k = 0; k < qubo.variables; ++k) bits.push_back(((x >> k) & 1) ? 1 : 0);
      least = std::min(least, energy(qubo, bits));
    }
    CHECK(least == doctest::Approx(least_cost(problem)));
  }
}

TEST_CASE("annealing covers everything, nearly as cheaply") {
  Rng rng(53);
  int annealed = 0;
  int exact = 0;
  for (int i = 0; i < 20; ++i) {
    const SetCoverProblem problem = random_problem(rng, 14, 10);
    const SetCover cover = anneal_cover(problem, {}, {});
    REQUIRE(cover.is_complete);
    annealed += cover.cost;
    exact += exact_cover(problem, 100'000, {}).cost;
  }
  CHECK(annealed >= exact);
  CHECK(annealed <= 1.1 * exact);
}

TEST_CASE("the matrix is written as JSON") {
  const SetCoverProblem problem = problem_of(2, {{0}, {0, 1}});
  const Qubo qubo = qubo_of(problem);
  const auto document = nlohmann::json::parse(qubo_to_json(qubo));
  CHECK(document.at("variables") == qubo.variables);
  CHECK(document.at("sets") == 2);
  CHECK(document.at("entries").size() == qubo.entries.size());
}

}  // namespace
}  // namespace hewn
