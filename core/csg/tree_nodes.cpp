#include "core/csg/tree_nodes.h"

namespace hewn {

std::vector<int> literals_below(const Tree& tree, int node) {
  std::vector<int> out;
  std::vector<int> open = {node};
  while (!open.empty()) {
    const Node& here = tree.nodes[open.back()];
    open.pop_back();
    if (here.op == Op::Literal) out.push_back(here.literal);
    open.insert(open.end(), here.children.rbegin(), here.children.rend());
  }
  return out;
}

}  // namespace hewn
