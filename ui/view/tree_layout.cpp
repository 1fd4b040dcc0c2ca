#include "ui/view/tree_layout.h"

#include <algorithm>
#include <cmath>

namespace hewn {
namespace {

/// The first and last y of a subtree in each column, from its root's first on.
struct Outline {
  std::vector<float> top, bottom;
};

class Layouter {
 public:
  Layouter(const Tree& tree, std::span<const float> widths, const GraphSpacing& spacing)
      : tree_(tree), widths_(widths), spacing_(spacing) {}

  GraphLayout run() {
    if (tree_.is_empty()) return std::move(out_);
    place(tree_.root, -1, 0, 0);
    float least = 0;
    for (const GraphNode& node : out_.nodes) least = std::min(least, node.y);
    for (GraphNode& node : out_.nodes) {
      node.x = spacing_.pitch * static_cast<float>(node.column);
      node.y -= least;
      out_.width = std::max(out_.width, node.x + node.width);
      out_.height = std::max(out_.height, node.y + spacing_.height);
    }
    return std::move(out_);
  }

 private:
  /// Lays the subtree out with its first leaf at about 0, and tells its outline.
  Outline place(int index, int parent, int place_there, int column) {
    const Node& node = tree_.nodes[index];
    const std::size_t self = out_.nodes.size();
    out_.nodes.push_back({index, parent, place_there, column, 0, 0, widths_[index]});
    const auto columns = static_cast<int>(
        std::ceil((widths_[index] + spacing_.gap_x) / std::max(spacing_.pitch, 1.0F)));
    Outline all;
    std::vector<std::size_t> heads;
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      const std::size_t head = out_.nodes.size();
      Outline one =
          place(node.children[i], static_cast<int>(self), static_cast<int>(i), column + columns);
      const float down = distance(all, one);
      for (std::size_t k = head; k < out_.nodes.size(); ++k) out_.nodes[k].y += down;
      join(all, one, down);
      heads.push_back(head);
    }
    float y = 0;
    if (!heads.empty()) y = (out_.nodes[heads.front()].y + out_.nodes[heads.back()].y) / 2;
    out_.nodes[self].y = y;
    all.top.insert(all.top.begin(), columns, y);
    all.bottom.insert(all.bottom.begin(), columns, y + spacing_.height);
    return all;
  }

  /// How far `next` must go down to stand clear of what is above it.
  float distance(const Outline& above, const Outline& next) const {
    const std::size_t shared = std::min(above.bottom.size(), next.top.size());
    float down = 0;
    for (std::size_t k = 0; k < shared; ++k) {
      const float needed = above.bottom[k] + spacing_.gap_y - next.top[k];
      down = k == 0 ? needed : std::max(down, needed);
    }
    return down;
  }

  static void join(Outline& above, const Outline& next, float down) {
    for (std::size_t k = 0; k < next.top.size(); ++k) {
      if (k == above.top.size()) {
        above.top.push_back(next.top[k] + down);
        above.bottom.push_back(next.bottom[k] + down);
      } else {
        above.bottom[k] = next.bottom[k] + down;
      }
    }
  }

  const Tree& tree_;
  std::span<const float> widths_;
  GraphSpacing spacing_;
  GraphLayout out_;
};

}  // namespace

GraphLayout layout_tree(const Tree& tree, std::span<const float> widths,
                        const GraphSpacing& spacing) {
  return Layouter(tree, widths, spacing).run();
}

}  // namespace hewn
