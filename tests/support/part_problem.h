#pragma once
/// A mesh carried through segmentation and regularisation, ready for sampling and search.
#include <memory>
#include <utility>

#include "core/fit/surface_set.h"
#include "core/mesh/query.h"
#include "core/sample/cells.h"
#include "core/sample/sample_table.h"
#include "core/segment/segment.h"

namespace hewn::solids {

/// Owns everything that a `TreeProblem` or a `SampleSpace` points to. Not movable.
struct PartProblem {
  explicit PartProblem(Mesh solid, RunContext context = {})
      : run(std::move(context)),
        mesh(std::make_shared<const Mesh>(std::move(solid))),
        query(mesh),
        segmentation(*segment(*mesh, {}, run)),
        surfaces(*regularise(*mesh, segmentation, {}, run)),
        label(query, segmentation, {}, false) {
    space.label = &label;
    space.segmentation = &segmentation;
    space.halfspaces = &surfaces.halfspaces;
    space.frame = find_frame(*mesh, {}, surfaces);
    space.diagonal = mesh->diagonal();
  }
  PartProblem(const PartProblem&) = delete;
  PartProblem& operator=(const PartProblem&) = delete;

  RunContext run;
  std::shared_ptr<const Mesh> mesh;
  MeshQuery query;
  Segmentation segmentation;
  SurfaceSet surfaces;
  Labeller label;
  SampleSpace space;
};

}  // namespace hewn::solids
