#include "core/csg/tree.h"

#include <algorithm>
#include <utility>

namespace hewn {
namespace {

double node_distance(const Tree& tree, int index, const Vec3& x) {
  const Node& node = tree.nodes[index];
  if (node.op == Op::Literal) return tree.literals[node.literal].signed_distance(x);
  if (node.children.empty()) return node.op == Op::Complement ? -kInfinity : kInfinity;
  double d = node_distance(tree, node.children[0], x);
  if (node.op == Op::Complement) return -d;
  for (std::size_t i = 1; i < node.children.size(); ++i) {
    const double other = node_distance(tree, node.children[i], x);
    if (node.op == Op::Union) d = std::min(d, other);
    if (node.op == Op::Intersection) d = std::max(d, other);
    if (node.op == Op::Difference) d = std::max(d, -other);
  }
  return d;
}

Box3 node_bounds(const Tree& tree, int index) {
  const Node& node = tree.nodes[index];
  if (node.op == Op::Literal) return tree.literals[node.literal].bounds();
  if (node.op == Op::Complement) {
    return {Vec3::Constant(-kInfinity), Vec3::Constant(kInfinity)};
  }
  Box3 box;
  for (std::size_t i = 0; i < node.children.size(); ++i) {
    if (node.op == Op::Difference && i > 0) break;
    const Box3 child = node_bounds(tree, node.children[i]);
    if (i == 0) {
      box = child;
    } else if (node.op == Op::Union) {
      box.lo = box.lo.cwiseMin(child.lo);
      box.hi = box.hi.cwiseMax(child.hi);
    } else {
      box.lo = box.lo.cwiseMax(child.lo);
      box.hi = box.hi.cwiseMin(child.hi);
    }
    // An inverted box must not grow or shrink others by its stray corners.
    if (box.is_empty()) box = {};
  }
  return box;
}

}  // namespace

int Tree::add_literal(Literal literal) {
  literals.push_back(std::move(literal));
  Node leaf;
  leaf.literal = static_cast<int>(literals.size()) - 1;
  nodes.push_back(std::move(leaf));
  return static_cast<int>(nodes.size()) - 1;
}

int Tree::add_node(Op op, std::vector<int> children, std::string name) {
  nodes.push_back({op, -1, std::move(children), std::move(name)});
  return static_cast<int>(nodes.size()) - 1;
}

int Tree::graft(const Tree& other) {
  const int literal_base = static_cast<int>(literals.size());
  const int node_base = static_cast<int>(nodes.size());
  // Sizes are taken first, so that a tree may be grafted onto itself.
  const std::size_t literals_added = other.literals.size();
  const std::size_t nodes_added = other.nodes.size();
  const int other_root = other.root;
  for (std::size_t i = 0; i < literals_added; ++i) {
    Literal copy = other.literals[i];
    literals.push_back(std::move(copy));
  }
  for (std::size_t i = 0; i < nodes_added; ++i) {
    Node copy = other.nodes[i];
    if (copy.literal >= 0) copy.literal += literal_base;
    for (int& child : copy.children) child += node_base;
    nodes.push_back(std::move(copy));
  }
  return other_root < 0 ? -1 : other_root + node_base;
}

double Tree::signed_distance(const Vec3& x) const {
  return is_empty() ? kInfinity : node_distance(*this, root, x);
}

Box3 Tree::bounds() const { return is_empty() ? Box3{} : node_bounds(*this, root); }

}  // namespace hewn
