#include "core/session/suggest.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/csg/tree_nodes.h"
#include "core/session/describe.h"

namespace hewn {
namespace {

/// Triangles of a group that are looked at; they lie on one surface.
constexpr std::size_t kMostTriangles = 48;

struct Term {
  Op op = Op::Union;
  std::vector<int> literals;
};

/// The operands of the outermost operation, the first included. A union below a difference on its
/// left, as in (a + b) - c, is not opened: its parts are the body that the rest is taken from.
std::vector<Term> outermost_terms(const Tree& tree) {
  std::vector<Term> terms;
  const Node& root = tree.nodes[tree.root];
  if (root.op == Op::Literal) return terms;
  for (const int child : root.children) {
    Term term;
    term.op = terms.empty() ? Op::Union : root.op;
    term.literals = literals_below(tree, child);
    terms.push_back(std::move(term));
  }
  return terms;
}

/// Of the middles of triangles: corners lie on the rims, where several literals meet.
double mean_distance(const Literal& literal, const Mesh& mesh, const FaceGroup& group) {
  const std::size_t step = std::max<std::size_t>(1, group.triangles.size() / kMostTriangles);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < group.triangles.size(); i += step) {
    sum += std::abs(literal.signed_distance(mesh.centroid(group.triangles[i])));
    ++count;
  }
  return count == 0 ? kInfinity : sum / count;
}

int nearest_literal(const Tree& tree, const Mesh& mesh, const FaceGroup& group) {
  int nearest = -1;
  double best = kInfinity;
  for (std::size_t l = 0; l < tree.literals.size(); ++l) {
    const double distance = mean_distance(tree.literals[l], mesh, group);
    if (distance >= best) continue;
    best = distance;
    nearest = static_cast<int>(l);
  }
  return nearest;
}

/// "hole r 3" for a subtracted cylinder; else what it is and a number.
std::string name_for(const Tree& tree, const Term& term, std::size_t number) {
  const bool is_single = term.literals.size() == 1;
  if (is_single && tree.literals[term.literals[0]].kind == SolidKind::Cylinder) {
    const double radius = tree.literals[term.literals[0]].radius;
    const char* what = term.op == Op::Difference ? "holes" : "bosses";
    if (term.op != Op::Intersection) return fmt::format("{} r {}", what, short_number(radius));
  }
  if (term.op == Op::Difference) return fmt::format("pocket {}", number);
  return fmt::format("{} {}", term.op == Op::Union ? "part" : "limit", number);
}

}  // namespace

Result<Project> suggest_partitions(const Document& document, const Tree& tree) {
  const auto refused = [](const char* why) { return Error{ErrorCode::InvalidArgument, why}; };
  if (!document.is_ready() || tree.is_empty()) return refused("there is no tree yet");
  if (!document.project.root.children.empty()) {
    return refused("there are partitions already; remove them to have others suggested");
  }
  const std::vector<Term> terms = outermost_terms(tree);
  std::vector<int> term_of(tree.literals.size(), 0);
  for (std::size_t t = 0; t < terms.size(); ++t) {
    for (const int l : terms[t].literals) term_of[l] = static_cast<int>(t);
  }
  const PreparedMesh& prepared = *document.prepared;
  std::vector<std::vector<int>> groups(terms.size());
  for (std::size_t g = 0; !terms.empty() && g < prepared.segmentation.groups.size(); ++g) {
    const int l = nearest_literal(tree, *prepared.mesh, prepared.segmentation.groups[g]);
    if (l >= 0) groups[term_of[l]].push_back(static_cast<int>(g));
  }
  Project project = document.project;
  project.edits.clear();
  for (std::size_t t = 1; t < terms.size(); ++t) {
    if (groups[t].empty()) continue;
    const std::string name = name_for(tree, terms[t], t);
    const auto refs = refer_to(prepared, groups[t]);
    auto& children = project.root.children;
    const auto same = std::find_if(children.begin(), children.end(),
                                   [&name](const PartitionPlan& p) { return p.name == name; });
    if (same != children.end()) {
      same->groups.insert(same->groups.end(), refs.begin(), refs.end());
    } else {
      children.push_back({name, terms[t].op, refs, false, {}});
    }
  }
  if (project.root.children.empty()) {
    return refused("the tree has one outermost term only: there is nothing to divide");
  }
  return project;
}

}  // namespace hewn
