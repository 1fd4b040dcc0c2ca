#include "core/io/openscad.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/file.h"
#include "core/base/nearest_rotation.h"
#include "core/csg/protrude.h"
#include "core/csg/turned_faces.h"
#include "core/io/scad_literal.h"
#include "core/io/scad_names.h"
#include "core/io/scad_prism.h"

namespace hewn {
namespace {

constexpr int kIndent = 2;

/// Bounds and largest coordinate of the literals that the solid is made of.
struct Extent {
  double diagonal = 1;
  double reach = 1;
};

/// Tools may be far larger than the solid: the solid's own box sets the scale.
Extent extent_of(const Tree& tree) {
  Box3 box = tree.bounds();
  Extent extent;
  if (!box.is_empty() && std::isfinite(box.diagonal()) && box.diagonal() > 0) {
    extent.diagonal = box.diagonal();
  }
  extent.reach = extent.diagonal;
  for (const Literal& s : tree.literals) {
    const Box3 b = s.bounds();
    if (b.is_empty()) continue;
    const double far = std::max(b.lo.cwiseAbs().maxCoeff(), b.hi.cwiseAbs().maxCoeff());
    if (std::isfinite(far)) extent.reach = std::max(extent.reach, far);
  }
  return extent;
}

/// OpenSCAD 2021 rounds vertices to 2^-20 whatever the model's size: below this diagonal the design
/// is drawn larger and scaled down.
constexpr double kSmallestDiagonal = 1;

int unit_exponent_for(double diagonal) {
  if (diagonal >= kSmallestDiagonal) return 0;
  return std::max(-200, 3 * static_cast<int>(std::floor(std::log10(diagonal) / 3)));
}

ScadStyle style_for(const Tree& tree, const ScadOptions& options) {
  const Extent extent = extent_of(tree);
  const int unit = unit_exponent_for(extent.diagonal);
  ScadStyle style{DecimalGrid(extent.diagonal, extent.reach, unit)};
  style.tolerance_rad = 0.5 * style.grid.step() / extent.reach;
  style.slack = 1e-6 * extent.diagonal;
  style.match_facets = options.match_facets;
  style.unit_exponent = unit;
  style.reach = extent.reach;
  return style;
}

/// The tree with boxes, cylinders, ... whose axes stand exactly at right angles: what is written in
/// a frame must fit it to the digits that are printed.
Tree with_rotations(Tree tree) {
  for (Literal& s : tree.literals) s.rotation = nearest_rotation(s.rotation);
  return tree;
}

class ScadWriter {
 public:
  ScadWriter(const Tree& tree, const ScadStyle& style)
      : tree_(with_rotations(tree)),
        style_(style),
        frames_(find_frames(tree_.literals, style.tolerance_rad)) {}

  /// Modules first, then the design.
  std::string run() {
    std::string body;
    if (tree_.is_empty()) return "// The tree is empty: nothing to draw.\n";
    std::string prefix;
    if (style_.unit_exponent != 0) {
      prefix = "scale(" + decimal_text(1, style_.unit_exponent) + ") ";
    }
    body = block(prefix + turn(0, frames_.root), {tree_.root}, frames_.root, 0);
    return prism_module(modules_ + body) + modules_ + body;
  }

 private:
  static std::string prism_module(std::string_view design) {
    if (design.find("prism(sides = ") == std::string_view::npos) return "";
    return fmt::format("// A regular prism; r is the radius of the inscribed circle.\n{}\n",
                       kPrismModule);
  }

  /// Text of `rotate` from one frame to another.
  std::string turn(int from, int to) const {
    if (from == to) return "";
    const Mat3 relative = frames_.frames[from].transpose() * frames_.frames[to];
    return print_rotation(relative, style_.slack / style_.reach).text();
  }

  static std::string pad(int level) {
    std::string spaces(static_cast<std::size_t>(level) * kIndent, ' ');
    return spaces;
  }

  /// Statements for siblings under one prefix such as "rotate([0, 0, 30]) ".
  std::string block(const std::string& prefix, const std::vector<int>& nodes, int frame,
                    int level) {
    if (nodes.size() == 1) return statement(nodes[0], prefix, frame, level);
    std::string text = pad(level) + prefix + "{\n";
    for (const int n : nodes) text += statement(n, "", frame, level + 1);
    return text + pad(level) + "}\n";
  }

  std::string statement(int index, const std::string& prefix, int frame, int level) {
    const Node& node = tree_.nodes[index];
    const int target = common_frame(index, frame);
    // A whole subtree in one turned frame is combined first and turned as a whole: its coincident
    // faces then stay exactly coincident.
    if (target != frame && node.op != Op::Literal) {
      return statement(index, prefix + turn(frame, target), target, level);
    }
    if (!node.name.empty()) return call(index, prefix, frame, level);
    return content(index, prefix, frame, level);
  }

  std::string call(int index, const std::string& prefix, int frame, int level) {
    const std::string name = names_.unique(tree_.nodes[index].name);
    // Inner modules are appended while the text is made, so they come before their callers.
    const std::string text = content(index, "", frame, 1);
    modules_ += "module " + name + "() {\n" + text + "}\n\n";
    return pad(level) + prefix + name + "();\n";
  }

  std::string content(int index, const std::string& prefix, int frame, int level) {
    const Node& node = tree_.nodes[index];
    if (node.op == Op::Literal) return literal(node.literal, prefix, frame, level);
    static constexpr const char* kNames[] = {"", "union", "intersection", "difference", ""};
    std::string text = pad(level) + prefix + kNames[static_cast<int>(node.op)] + "() {\n";
    std::vector<int> rest = node.children;
    if (node.op == Op::Difference && !rest.empty()) {
      text += statement(rest.front(), "", frame, level + 1);
      rest.erase(rest.begin());
    }
    for (const auto& [target, members] : grouped(rest, frame, node.op)) {
      text += block(turn(frame, target), members, target, level + 1);
    }
    return text + pad(level) + "}\n";
  }

  /// Siblings that share a turned frame, joined when the operation allows it, in order of their
  /// first members.
  std::vector<std::pair<int, std::vector<int>>> grouped(const std::vector<int>& nodes, int frame,
                                                        Op op) const {
    std::vector<std::pair<int, std::vector<int>>> groups;
    for (const int n : nodes) {
      const int target = sibling_frame(n, frame);
      const auto same = std::find_if(groups.begin(), groups.end(), [&](const auto& g) {
        return target != frame && g.first == target;
      });
      if (same == groups.end() || op == Op::Intersection) {
        groups.push_back({target, {n}});
      } else {
        same->second.push_back(n);
      }
    }
    // A lone literal chooses its own way of printing.
    for (auto& [target, members] : groups) {
      if (members.size() == 1) target = frame;
    }
    return groups;
  }

  int sibling_frame(int index, int frame) const {
    const Node& node = tree_.nodes[index];
    if (node.op != Op::Literal) return common_frame(index, frame);
    if (is_aligned(tree_.literals[node.literal], frames_.frames[frame], style_.tolerance_rad)) {
      return frame;
    }
    return frames_.of_literal[node.literal];
  }

  /// The frame that all literals below share when not all fit `frame`; else `frame`.
  int common_frame(int index, int frame) const {
    std::vector<int> literals;
    collect(index, literals);
    int target = frame;
    for (const int i : literals) {
      if (!is_aligned(tree_.literals[i], frames_.frames[frame], style_.tolerance_rad)) {
        target = frames_.of_literal[i];
        break;
      }
    }
    for (const int i : literals) {
      const Mat3& axes = frames_.frames[target];
      if (!is_aligned(tree_.literals[i], axes, style_.tolerance_rad)) return frame;
    }
    return target;
  }

  void collect(int index, std::vector<int>& literals) const {
    const Node& node = tree_.nodes[index];
    if (node.op == Op::Literal) literals.push_back(node.literal);
    for (const int child : node.children) collect(child, literals);
  }

  std::string literal(int index, const std::string& prefix, int frame, int level) const {
    const Literal& s = tree_.literals[index];
    const Mat3& axes = frames_.frames[frame];
    const std::string start = pad(level) + prefix;
    if (is_aligned(s, axes, style_.tolerance_rad)) {
      return start + print_aligned(s, axes, style_, pad(level)) + "\n";
    }
    const int own = frames_.of_literal[index];
    if (s.kind != SolidKind::Box && frames_.members[own] < 2) {
      return start + print_turned(s, axes, style_) + "\n";
    }
    return start + turn(frame, own) + print_aligned(s, frames_.frames[own], style_, pad(level)) +
           "\n";
  }

  const Tree tree_;
  const ScadStyle& style_;
  FrameSet frames_;
  ModuleNames names_;
  std::string modules_;
};

std::string percent(double share) { return fmt::format("{:.6g} %", share * 100); }

std::string plural(int n, const char* noun) {
  return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 32; }, ' ');
  return text;
}

std::string header_text(const Tree& tree, const ScadHeader& header, const ScadStyle& style) {
  std::string text;
  if (!header.part.empty()) text += "// " + one_line(header.part) + "\n";
  const int literals = literal_count(tree);
  const int size = tree_size(tree);
  text += "// " + plural(literals, "literal") + ", " + plural(size - literals, "operation") +
          " (size " + std::to_string(size) + ")";
  if (header.proximity) text += fmt::format(", proximity {:.3g}", *header.proximity);
  text += "\n";
  std::vector<std::string> figures;
  if (header.agreement) figures.push_back("points classified right: " + percent(*header.agreement));
  if (header.iou) figures.push_back(fmt::format("IoU {:.6g}", *header.iou));
  if (header.hausdorff) figures.push_back(fmt::format("Hausdorff {:.3g}", *header.hausdorff));
  if (header.mean_distance) figures.push_back(fmt::format("mean {:.3g}", *header.mean_distance));
  if (!figures.empty()) text += fmt::format("// Against the mesh: {}", fmt::join(figures, ", "));
  if (header.hausdorff || header.mean_distance) text += " of the diagonal";
  if (!figures.empty()) text += "\n";
  for (const std::string& note : header.notes) text += "// " + one_line(note) + "\n";
  if (style.unit_exponent != 0) {
    text += "// Lengths are in units of " + decimal_text(1, style.unit_exponent) +
            " and scaled below, because OpenSCAD rounds coordinates to a millionth.\n";
  }
  return text;
}

}  // namespace

std::string to_openscad(const Tree& tree, const ScadHeader& header, const ScadOptions& options) {
  Tree plain = without_complements(tree);
  if (options.extend_tools) plain = with_turned_faces_apart(with_protruding_tools(plain));
  const ScadStyle style = style_for(plain, options);
  return header_text(plain, header, style) +
         fmt::format("\n$fn = {};\n\n", std::max(3, options.segments)) +
         ScadWriter(plain, style).run();
}

Result<void> write_openscad(const Tree& tree, const std::filesystem::path& path,
                            const ScadHeader& header, const ScadOptions& options) {
  if (options.segments < 3) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("{} segments make no circle; choose at least 3", options.segments),
                 path.string()};
  }
  for (std::size_t i = 0; i < tree.literals.size(); ++i) {
    const Box3 box = tree.literals[i].bounds();
    if (box.lo.allFinite() && box.hi.allFinite()) continue;
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("literal {} ({}) has no finite extent and cannot be drawn", i,
                             name_of(tree.literals[i].kind)),
                 path.string()};
  }
  return write_file(path, to_openscad(tree, header, options));
}

}  // namespace hewn
