#include "core/session/join_partitions.h"

#include <cstddef>

namespace hewn {
namespace {

class Joiner {
 public:
  Joiner(const std::vector<Partition>& partitions, const std::vector<std::optional<Tree>>& trees)
      : partitions_(partitions), trees_(trees) {}

  Tree join() {
    tree_.root = join_below(0);
    return std::move(tree_);
  }

 private:
  int join_below(std::size_t here) {
    int node = trees_[here] ? tree_.graft(*trees_[here]) : -1;
    if (node >= 0 && partitions_.size() > 1) node = named(node, partitions_[here].name);
    for (std::size_t p = 0; p < partitions_.size(); ++p) {
      if (partitions_[p].parent != static_cast<int>(here)) continue;
      const int child = join_below(p);
      if (child < 0) {
        if (partitions_[p].op == Op::Intersection) node = -1;
        continue;
      }
      if (node < 0) {
        node = partitions_[p].op == Op::Union ? child : -1;
      } else {
        node = tree_.add_node(partitions_[p].op, {node, child});
      }
    }
    return node;
  }

  /// Gives the node a name; one that already has a name is wrapped.
  int named(int node, const std::string& name) {
    if (!tree_.nodes[node].name.empty()) return tree_.add_node(Op::Union, {node}, name);
    tree_.nodes[node].name = name;
    return node;
  }

  const std::vector<Partition>& partitions_;
  const std::vector<std::optional<Tree>>& trees_;
  Tree tree_;
};

}  // namespace

Tree join_partitions(const std::vector<Partition>& partitions,
                     const std::vector<std::optional<Tree>>& trees) {
  return Joiner(partitions, trees).join();
}

}  // namespace hewn
