// Quine (1952) and McCluskey (1956): all prime implicants by merging, then the cheapest cover.
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "core/synth/twolevel/two_level.h"

namespace hewn {
namespace {

/// Every cube as a number in base 3: digit k is 0 (outside), 1 (inside) or 2 (free).
class CubeTable {
 public:
  explicit CubeTable(std::size_t variables) : powers_(1, 1) {
    for (std::size_t k = 0; k < variables; ++k) powers_.push_back(powers_.back() * 3);
    allowed_.assign(powers_.back(), 1);
  }

  std::size_t size() const { return allowed_.size(); }
  bool is_allowed(std::size_t cube) const { return allowed_[cube] != 0; }
  std::size_t digit(std::size_t cube, std::size_t k) const { return cube / powers_[k] % 3; }
  void forbid(std::size_t cube) { allowed_[cube] = 0; }
  std::size_t with_digit(std::size_t cube, std::size_t k, std::size_t d) const {
    return cube + (d - digit(cube, k)) * powers_[k];
  }

  /// A cube with a free variable is allowed when both of its halves are; those have smaller
  /// numbers.
  void merge() {
    const std::size_t variables = powers_.size() - 1;
    for (std::size_t cube = 0; cube < allowed_.size(); ++cube) {
      for (std::size_t k = 0; k < variables; ++k) {
        if (digit(cube, k) != 2) continue;
        const bool both = is_allowed(with_digit(cube, k, 0)) && is_allowed(with_digit(cube, k, 1));
        allowed_[cube] = both ? 1 : 0;
        break;
      }
    }
  }

  bool is_prime(std::size_t cube) const {
    if (!is_allowed(cube)) return false;
    for (std::size_t k = 0; k + 1 < powers_.size(); ++k) {
      if (digit(cube, k) != 2 && is_allowed(with_digit(cube, k, 2))) return false;
    }
    return true;
  }

 private:
  std::vector<std::size_t> powers_;
  std::vector<char> allowed_;
};

}  // namespace

Result<std::vector<Cube>> quine_mccluskey(const TwoLevelProblem& problem,
                                          const TwoLevelOptions& options, const RunContext& run) {
  const std::size_t variables = problem.literals.size();
  if (static_cast<int>(variables) > options.most_variables) {
    return Error{ErrorCode::TooLarge,
                 fmt::format("{} primitives are left, too many for Quine-McCluskey (at most {}); "
                             "use another method",
                             variables, options.most_variables)};
  }
  CubeTable table(variables);
  for_each_bit(problem.off, [&](std::size_t row) {
    std::size_t cube = 0;
    for (std::size_t k = variables; k-- > 0;) {
      cube = cube * 3 + (test_bit(problem.rows.column(static_cast<int>(k)).data(), row) ? 1 : 0);
    }
    table.forbid(cube);
  });
  table.merge();
  std::vector<Cube> primes;
  for (std::size_t t = 0; t < table.size(); ++t) {
    if (t % 4096 == 0 && run.is_cancelled()) return RunContext::cancelled();
    if (!table.is_prime(t)) continue;
    Cube cube;
    for (std::size_t k = 0; k < variables; ++k) {
      constexpr Cube::Side kSides[] = {Cube::Side::Outside, Cube::Side::Inside, Cube::Side::Free};
      cube.sides.push_back(kSides[table.digit(t, k)]);
    }
    if (intersects(rows_of(cube, problem), problem.on)) primes.push_back(std::move(cube));
  }
  const SetCover cover = exact_cover(covering_problem(primes, problem), options.most_branches, run);
  if (run.is_cancelled()) return RunContext::cancelled();
  std::vector<Cube> chosen;
  for (const int k : cover.chosen) chosen.push_back(primes[static_cast<std::size_t>(k)]);
  return chosen;
}

}  // namespace hewn
