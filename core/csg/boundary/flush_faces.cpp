#include "core/csg/boundary/flush_faces.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/csg/boundary/same_surface.h"

namespace hewn {
namespace {

/// Which flat patches make one face, and as part of which literal it is shown.
class FlushFaces {
 public:
  FlushFaces(const BoundaryModel& model, const std::vector<PatchPart>& parts)
      : model_(model), leader_(parts.size()), label_(parts.size()) {
    std::iota(leader_.begin(), leader_.end(), 0);
    for (std::size_t p = 0; p < parts.size(); ++p) join(static_cast<int>(p), parts[p].flush);
    choose_labels(parts);
  }

  const std::vector<int>& labels() const { return label_; }

 private:
  const BoundaryPatch& patch(int p) const { return model_.patches[static_cast<std::size_t>(p)]; }

  int leader(int p) const {
    while (leader_[static_cast<std::size_t>(p)] != p) p = leader_[static_cast<std::size_t>(p)];
    return p;
  }

  void join(int p, const std::vector<int>& literals) {
    if (literals.empty()) return;
    for (int q = 0; q < static_cast<int>(leader_.size()); ++q) {
      const auto found = std::find(literals.begin(), literals.end(), patch(q).literal);
      if (found == literals.end() || !on_same_surface(model_, patch(p), patch(q))) continue;
      const int a = leader(p);
      const int b = leader(q);
      leader_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  }

  void choose_labels(const std::vector<PatchPart>& parts) {
    std::vector<std::vector<std::pair<int, double>>> areas(parts.size());  // by leader
    for (int p = 0; p < static_cast<int>(parts.size()); ++p) {
      auto& of_face = areas[static_cast<std::size_t>(leader(p))];
      const double area = parts[static_cast<std::size_t>(p)].area;
      if (of_face.empty() || of_face.back().first != patch(p).literal) {
        of_face.emplace_back(patch(p).literal, 0.0);
      }
      of_face.back().second += area;
    }
    for (int p = 0; p < static_cast<int>(parts.size()); ++p) {
      const auto& of_face = areas[static_cast<std::size_t>(leader(p))];
      label_[static_cast<std::size_t>(p)] =
          std::max_element(of_face.begin(), of_face.end(), [](const auto& a, const auto& b) {
            return a.second < b.second;
          })->first;
    }
  }

  const BoundaryModel& model_;
  std::vector<int> leader_;
  std::vector<int> label_;
};

}  // namespace

std::vector<int> shown_literals(const BoundaryModel& model, const std::vector<PatchPart>& parts) {
  return FlushFaces(model, parts).labels();
}

}  // namespace hewn
