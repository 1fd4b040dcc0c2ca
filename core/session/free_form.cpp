#include "core/session/free_form.h"

#include <algorithm>
#include <utility>

#include "core/sample/frame.h"
#include "core/segment/triangle_topology.h"

namespace hewn {
namespace {

/// Groups with less of the mesh's area may belong to a patch.
constexpr double kSmallArea = 2e-3;
/// Those with up to so much may when they are loose fits.
constexpr double kLooseArea = 3e-2;
/// Of the diagonal: vertices of a designed surface are on it but for noise.
constexpr double kExact = 5e-5;
/// Fewer faces without a surface are planes like any others.
constexpr int kFewestFaces = 40;
/// Of the diagonal: how far a patch's box reaches beyond it.
constexpr double kMargin = 5e-3;
/// Of the diagonal: how far the mesh's piece reaches beyond the box, so that no faces coincide.
constexpr double kOverlap = 1e-3;
/// Boxes that fill more of the part leave nothing worth a tree.
constexpr double kMostVolume = 0.6;

Error no_tree(const char* why) { return {ErrorCode::NotFound, why}; }

/// The groups with the patches' own marked as unexplained and all others as explained.
Segmentation with_patches_unfitted(Segmentation segmentation,
                                   const std::vector<FreeFormPatch>& patches) {
  for (FaceGroup& group : segmentation.groups) group.is_fitted = true;
  for (const FreeFormPatch& patch : patches) {
    for (const int g : patch.groups) segmentation.groups[g].is_fitted = false;
  }
  return segmentation;
}

Box3 bounds_in(const Frame& frame, const Mesh& mesh, const Segmentation& segmentation,
               const FreeFormPatch& patch) {
  Box3 box;
  for (const int g : patch.groups) {
    for (const int t : segmentation.groups[g].triangles) {
      for (int k = 0; k < 3; ++k) box.extend(frame.to_local(mesh.corner(t, k)));
    }
  }
  return box;
}

Box3 grown(Box3 box, double margin) {
  box.lo.array() -= margin;
  box.hi.array() += margin;
  return box;
}

bool overlap(const Box3& a, const Box3& b) {
  return (a.lo.array() < b.hi.array()).all() && (b.lo.array() < a.hi.array()).all();
}

/// Boxes that overlap become one, until none do.
std::vector<Box3> joined(std::vector<Box3> boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t k = i + 1; k < boxes.size(); ++k) {
      if (!overlap(boxes[i], boxes[k])) continue;
      boxes[i].extend(boxes[k].lo);
      boxes[i].extend(boxes[k].hi);
      boxes.erase(boxes.begin() + static_cast<long>(k));
      return joined(std::move(boxes));
    }
  }
  return boxes;
}

Literal literal_of(const Box3& box, const Frame& frame) {
  Literal s;
  s.kind = SolidKind::Box;
  s.rotation = frame.rotation;
  s.origin = box.lo;
  s.size = box.size();
  return s;
}

int add_boxes(Tree& tree, const std::vector<Box3>& boxes, const Frame& frame) {
  std::vector<int> nodes;
  nodes.reserve(boxes.size());
  for (const Box3& box : boxes) nodes.push_back(tree.add_literal(literal_of(box, frame)));
  return nodes.size() == 1 ? nodes[0] : tree.add_node(Op::Union, std::move(nodes));
}

/// The tree outside the boxes, the mesh inside.
Tree with_mesh_in(const std::vector<Box3>& boxes, Tree tree, const PreparedMesh& prepared,
                  const Frame& frame, double overlap) {
  const int rest = tree.add_node(Op::Difference, {tree.root, add_boxes(tree, boxes, frame)});
  std::vector<Box3> wider;
  wider.reserve(boxes.size());
  for (const Box3& box : boxes) wider.push_back(grown(box, overlap));
  Literal mesh;
  mesh.kind = SolidKind::Polyhedron;
  mesh.polyhedron = prepared.mesh;
  mesh.polyhedron_query = prepared.query;
  const int whole = tree.add_literal(std::move(mesh));
  const int piece = tree.add_node(Op::Intersection, {whole, add_boxes(tree, wider, frame)});
  tree.root = tree.add_node(Op::Union, {rest, piece});
  return tree;
}

/// Whether a group may belong to a patch that it touches: small ones, and larger ones of curved
/// surfaces that their vertices are not really on (a wave's back may by chance look like a torus).
bool may_be_free_form(const Mesh& mesh, const Segmentation& segmentation, const FaceGroup& group) {
  if (group.area < kSmallArea * mesh.total_area) return true;
  const double exact = std::max(kExact * mesh.diagonal(), 10 * segmentation.noise);
  const bool is_curved = group.surface.kind != SurfaceKind::Plane;
  return is_curved && group.max_deviation > exact && group.area < kLooseArea * mesh.total_area;
}

}  // namespace

std::vector<FreeFormPatch> find_free_form_patches(const Mesh& mesh,
                                                  const Segmentation& segmentation) {
  const auto& groups = segmentation.groups;
  std::vector<char> is_open(groups.size());  // in no patch yet
  for (std::size_t g = 0; g < groups.size(); ++g) {
    is_open[g] = may_be_free_form(mesh, segmentation, groups[g]) ? 1 : 0;
  }
  const TriangleTopology topology = build_topology(mesh);
  std::vector<FreeFormPatch> patches;
  for (std::size_t start = 0; start < groups.size(); ++start) {
    if (!is_open[start] || groups[start].is_fitted) continue;
    FreeFormPatch patch;
    patch.groups = {static_cast<int>(start)};
    is_open[start] = 0;
    for (std::size_t i = 0; i < patch.groups.size(); ++i) {
      const FaceGroup& group = groups[patch.groups[i]];
      patch.unfitted += group.is_fitted ? 0 : 1;
      for (const int t : group.triangles) {
        for (const int n : topology.neighbors[t]) {
          const int other = n < 0 ? -1 : segmentation.group_of_triangle[n];
          if (other < 0 || !is_open[other]) continue;
          is_open[other] = 0;
          patch.groups.push_back(other);
        }
      }
    }
    if (patch.unfitted < kFewestFaces) continue;
    std::sort(patch.groups.begin(), patch.groups.end());
    patches.push_back(std::move(patch));
  }
  return patches;
}

Result<FreeFormAnswer> find_tree_beside(const std::vector<FreeFormPatch>& patches,
                                        const PreparedMesh& prepared,
                                        const RegulariseOptions& regularise_options,
                                        const TreeSearchOptions& tree_options,
                                        const RunContext& run) {
  if (patches.empty()) return no_tree("the part has no free-form patch");
  const Mesh& mesh = *prepared.mesh;
  const Segmentation segmentation = with_patches_unfitted(prepared.segmentation, patches);
  RegulariseOptions without_patches = regularise_options;
  without_patches.keep_free_form = false;
  const auto surfaces = regularise(mesh, segmentation, without_patches, run);
  if (!surfaces) return surfaces.error();

  const Frame frame = find_frame(mesh, {}, *surfaces);
  std::vector<Box3> boxes;
  boxes.reserve(patches.size());
  for (const FreeFormPatch& patch : patches) {
    boxes.push_back(grown(bounds_in(frame, mesh, segmentation, patch), kMargin * mesh.diagonal()));
  }
  boxes = joined(std::move(boxes));
  double volume = 0;
  for (const Box3& box : boxes) volume += box.size().prod();
  if (volume > kMostVolume * frame.box.size().prod()) {
    return no_tree("free-form patches reach over most of the part");
  }

  TreeProblem problem;
  problem.query = prepared.query.get();
  problem.segmentation = &segmentation;
  problem.surfaces = &*surfaces;
  for (const Box3& box : boxes) problem.ignored.push_back(literal_of(box, frame));
  auto found = find_tree(problem, tree_options, run);
  if (!found) return found.error();
  FreeFormAnswer out;
  out.answer = std::move(*found);
  out.answer.tree =
      with_mesh_in(boxes, std::move(out.answer.tree), prepared, frame, kOverlap * mesh.diagonal());
  for (const FreeFormPatch& patch : patches) {
    for (const int g : patch.groups) out.area_share += segmentation.groups[g].area;
  }
  out.area_share /= mesh.total_area;
  return out;
}

}  // namespace hewn
