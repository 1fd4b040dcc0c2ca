#include "core/synth/inflate.h"

#include <optional>
#include <utility>
#include <vector>

#include "core/base/rng.h"
#include "core/synth/evolve/redundancy_growth.h"

namespace hewn {
namespace {

/// A binary tree by value, so that parts can be copied and replaced.
struct Term {
  Op op = Op::Literal;
  int literal = -1;
  std::vector<Term> children;
};

Term operation(Op op, Term left, Term right) {
  Term t;
  t.op = op;
  t.children.push_back(std::move(left));
  t.children.push_back(std::move(right));
  return t;
}

Term complement(Term child) {
  Term t;
  t.op = Op::Complement;
  t.children.push_back(std::move(child));
  return t;
}

/// N-ary nodes become left folds; an operation without operands is an empty union.
Term term_of(const Tree& tree, int index) {
  const Node& node = tree.nodes[index];
  Term t;
  t.op = node.op;
  t.literal = node.literal;
  if (node.op == Op::Literal || node.children.empty()) return t;
  if (node.op == Op::Complement) return complement(term_of(tree, node.children[0]));
  Term left = term_of(tree, node.children[0]);
  for (std::size_t i = 1; i < node.children.size(); ++i) {
    left = operation(node.op, std::move(left), term_of(tree, node.children[i]));
  }
  return left;
}

/// In postfix order; nothing for operations without operands, which genomes cannot express.
bool append_tokens(const Term& t, Genome& out) {
  if (t.op == Op::Literal) {
    out.push_back(static_cast<Token>(t.literal));
    return true;
  }
  if (t.children.empty()) return false;
  for (const Term& child : t.children) {
    if (!append_tokens(child, out)) return false;
  }
  out.push_back(token_of(t.op));
  return true;
}

Term term_of(const Genome& genome) {
  std::vector<Term> stack;
  for (const Token token : genome) {
    if (token >= 0) {
      Term leaf;
      leaf.literal = token;
      stack.push_back(std::move(leaf));
      continue;
    }
    Term last = std::move(stack.back());
    stack.pop_back();
    if (token == kComplementToken) {
      stack.push_back(complement(std::move(last)));
      continue;
    }
    stack.back() = operation(op_of(token), std::move(stack.back()), std::move(last));
  }
  return std::move(stack.back());
}

int write(const Term& t, const std::vector<Literal>& literals, Tree& out) {
  if (t.op == Op::Literal) return out.add_literal(literals[static_cast<std::size_t>(t.literal)]);
  std::vector<int> children;
  for (const Term& child : t.children) children.push_back(write(child, literals, out));
  return out.add_node(t.op, std::move(children));
}

int size_of(const Term& t) {
  int n = 1;
  for (const Term& child : t.children) n += size_of(child);
  return n;
}

void collect(Term& t, std::vector<Term*>& out) {
  out.push_back(&t);
  for (Term& child : t.children) collect(child, out);
}

class Inflater {
 public:
  Inflater(const Tree& tree, const InflateOptions& options, const RunContext& run)
      : tree_(tree),
        root_(term_of(tree, tree.root)),
        options_(options),
        run_(run),
        rng_(run.seed, 99) {}

  Result<Term> work() {
    for (int i = 0; i < options_.iterations; ++i) {
      if (run_.is_cancelled()) return RunContext::cancelled();
      if (happens(options_.copied_subtree)) copy_subtree();
      if (happens(options_.double_negation)) negate_twice();
      if (happens(options_.distributive)) distribute();
      if (happens(options_.absorption)) absorb();
      if (happens(options_.genetic)) {
        if (auto done = evolve_redundancy(); !done) return done.error();
      }
    }
    return std::move(root_);
  }

 private:
  bool happens(double probability) { return rng_.uniform() < probability; }
  bool has_room(int more) const { return size_of(root_) + more <= options_.most_nodes; }

  Term& random_term() {
    std::vector<Term*> all;
    collect(root_, all);
    return *all[rng_.below(all.size())];
  }

  void copy_subtree() {
    Term& place = random_term();
    if (!has_room(size_of(place) + 1)) return;
    Term copy = place;
    place = operation(rng_.coin() ? Op::Union : Op::Intersection, std::move(copy), Term(place));
  }

  void negate_twice() {
    Term& place = random_term();
    if (!has_room(2)) return;
    Term inner = complement(std::move(place));
    place = complement(std::move(inner));
  }

  /// A op (B dual C), on either side.
  static int side_to_distribute(const Term& t) {
    if (t.op != Op::Union && t.op != Op::Intersection) return -1;
    const Op dual = t.op == Op::Union ? Op::Intersection : Op::Union;
    for (int side = 0; side < 2; ++side) {
      const Term& child = t.children[static_cast<std::size_t>(side)];
      if (child.op == dual && child.children.size() == 2) return side;
    }
    return -1;
  }

  void distribute() {
    std::vector<Term*> all;
    collect(root_, all);
    std::vector<Term*> fitting;
    for (Term* t : all) {
      if (t->children.size() == 2 && side_to_distribute(*t) >= 0) fitting.push_back(t);
    }
    if (fitting.empty()) return;
    Term& place = *fitting[rng_.below(fitting.size())];
    const int side = side_to_distribute(place);
    Term outer = place.children[static_cast<std::size_t>(1 - side)];
    if (!has_room(size_of(outer) + 1)) return;
    Term inner = place.children[static_cast<std::size_t>(side)];
    Term left = operation(place.op, outer, std::move(inner.children[0]));
    Term right = operation(place.op, std::move(outer), std::move(inner.children[1]));
    place = operation(inner.op, std::move(left), std::move(right));
  }

  void absorb() {
    Term other = random_term();
    Term& place = random_term();
    if (!has_room(size_of(place) + size_of(other) + 2)) return;
    const bool is_union = rng_.coin();
    Term copy = place;
    Term absorbed = operation(is_union ? Op::Intersection : Op::Union, copy, std::move(other));
    place =
        operation(is_union ? Op::Union : Op::Intersection, std::move(copy), std::move(absorbed));
  }

  Result<void> evolve_redundancy() {
    Genome genome;
    if (!append_tokens(root_, genome)) return {};
    if (!growth_) {
      auto growth = RedundancyGrowth::of(tree_, run_);
      if (!growth) return growth.error();
      growth_.emplace(std::move(*growth));
    }
    RunContext run = run_;
    run.seed = rng_.next();
    const auto larger = growth_->grow(genome, options_.most_nodes, run);
    if (!larger) return larger.error();
    root_ = term_of(*larger);
    return {};
  }

  const Tree& tree_;
  Term root_;
  const InflateOptions& options_;
  const RunContext& run_;
  Rng rng_;
  std::optional<RedundancyGrowth> growth_;
};

}  // namespace

Result<Tree> inflate(const Tree& tree, const InflateOptions& options, const RunContext& run) {
  for (const double p : {options.copied_subtree, options.double_negation, options.distributive,
                         options.absorption, options.genetic}) {
    if (p >= 0 && p <= 1) continue;
    return Error{ErrorCode::InvalidArgument, "a probability must lie between 0 and 1"};
  }
  if (tree.is_empty()) return tree;
  auto term = Inflater(tree, options, run).work();
  if (!term) return term.error();
  Tree out;
  out.root = write(*term, tree.literals, out);
  return out;
}

}  // namespace hewn
