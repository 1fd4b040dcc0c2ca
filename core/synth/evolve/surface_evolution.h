#pragma once
/// The genetic search of Fayolle and Pasko 2016 for a tree that fits a surface.
#include "core/synth/evolve/evolve_tree.h"
#include "core/synth/evolve/surface_fitness.h"

namespace hewn {

struct Evolved {
  Genome best;  ///< tokens are indices of primitives
  long evaluations = 0;
};

/// Evolves trees over the primitives of `fitness`, on the device that suits; one or two primitives
/// are combined in every way instead. Fails with: Cancelled. Deterministic for `run.seed`, for any
/// number of threads and on every device.
Result<Evolved> evolve_on_surface(SurfaceFitness& fitness, const EvolveOptions& options,
                                  const RunContext& run);

}  // namespace hewn
