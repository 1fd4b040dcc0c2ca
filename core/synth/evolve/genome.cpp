#include "core/synth/evolve/genome.h"

#include <algorithm>
#include <utility>

#include "core/compute/kernels/breeding.h"

namespace hewn {
namespace {

using Kind = Formula::Kind;

/// The node without its own negation.
void append_positive(const Formula& f, Genome& out) {
  if (f.kind == Kind::Leaf) {
    out.push_back(static_cast<Token>(f.literal));
    return;
  }
  bool is_first = true;
  for (const bool is_negated : {false, true}) {
    for (const Formula& child : f.children) {
      if (child.is_negated != is_negated) continue;
      append_positive(child, out);
      if (!is_first) {
        out.push_back(is_negated           ? kDifferenceToken
                      : f.kind == Kind::Or ? kUnionToken
                                           : kIntersectionToken);
      }
      is_first = false;
    }
  }
}

}  // namespace

Op op_of(Token operation) {
  switch (operation) {
    case kUnionToken:
      return Op::Union;
    case kIntersectionToken:
      return Op::Intersection;
    case kComplementToken:
      return Op::Complement;
    default:
      return Op::Difference;
  }
}

Token token_of(Op op) {
  switch (op) {
    case Op::Union:
      return kUnionToken;
    case Op::Intersection:
      return kIntersectionToken;
    case Op::Complement:
      return kComplementToken;
    default:
      return kDifferenceToken;
  }
}

Genome random_genome(int literals, int most_nodes, Rng& rng) {
  const int most = std::max(1, most_nodes);
  Genome genome(static_cast<std::size_t>(most));
  std::vector<std::int32_t> pending(static_cast<std::size_t>(most) + 1);
  const int size = write_random_tree(literals, most, rng, genome.data(), pending.data());
  genome.resize(static_cast<std::size_t>(size));
  return genome;
}

Genome genome_of(const Formula& formula) {
  Genome genome;
  append_positive(formula, genome);
  if (formula.is_negated) genome.push_back(kComplementToken);
  return genome;
}

Formula formula_of(const Genome& genome) {
  std::vector<Formula> stack;
  for (const Token t : genome) {
    if (t >= 0) {
      stack.push_back(Formula::leaf(t));
      continue;
    }
    if (t == kComplementToken) {
      stack.back().is_negated = !stack.back().is_negated;
      continue;
    }
    std::vector<Formula> parts;
    parts.push_back(std::move(stack[stack.size() - 2]));
    parts.push_back(std::move(stack.back()));
    stack.resize(stack.size() - 2);
    if (t == kDifferenceToken) parts[1].is_negated = !parts[1].is_negated;
    stack.push_back(Formula::join(t == kUnionToken ? Kind::Or : Kind::And, std::move(parts)));
  }
  return normalised(std::move(stack.back()));
}

}  // namespace hewn
