#include "core/csg/branching_program.h"

namespace hewn {
namespace {

/// Lays the steps out from the last to the first, so that where to go is known when a step is made.
/// Steps are numbered by their distance from the end, and turned round when all are there.
class Compiler {
 public:
  explicit Compiler(const Tree& tree) : tree_(tree) {}

  BranchingProgram run() {
    BranchingProgram out;
    if (tree_.is_empty()) return out;
    out.start = below(tree_.root, BranchingProgram::kSolid, BranchingProgram::kEmpty);
    const auto last = static_cast<std::uint32_t>(steps_.size()) - 1;
    const auto turned = [last](std::uint32_t at) {
      return at == BranchingProgram::kSolid || at == BranchingProgram::kEmpty ? at : last - at;
    };
    out.start = turned(out.start);
    for (std::size_t k = steps_.size(); k-- > 0;) {
      const auto& step = steps_[k];
      out.steps.push_back({step.literal, turned(step.inside), turned(step.outside), 0});
    }
    return out;
  }

 private:
  /// The first step of a node that goes on to `yes` where a point is inside, else to `no`.
  std::uint32_t below(int index, std::uint32_t yes, std::uint32_t no) {
    const Node& node = tree_.nodes[index];
    const auto& children = node.children;
    if (node.op == Op::Literal) {
      steps_.push_back({static_cast<std::uint32_t>(node.literal), yes, no, 0});
      return static_cast<std::uint32_t>(steps_.size()) - 1;
    }
    if (node.op == Op::Complement) return children.empty() ? yes : below(children[0], no, yes);
    if (children.empty()) return no;
    std::uint32_t next = node.op == Op::Union ? no : yes;
    for (std::size_t i = children.size(); i-- > 0;) {
      if (node.op == Op::Union) {
        next = below(children[i], yes, next);
      } else if (node.op == Op::Intersection || i == 0) {
        next = below(children[i], next, no);
      } else {
        next = below(children[i], no, next);
      }
    }
    return next;
  }

  const Tree& tree_;
  std::vector<BranchStep> steps_;
};

}  // namespace

BranchingProgram branching_program(const Tree& tree) { return Compiler(tree).run(); }

}  // namespace hewn
