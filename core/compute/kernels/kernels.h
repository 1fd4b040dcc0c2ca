#pragma once
/// All kernels. Each has, for a `Grain` of core/compute/host_device.h,
///   items<Grain>()    how many independent items it consists of
///   run<Grain>(item)  does one; items may run in any order and at the same time
#include <variant>

#include "core/compute/kernels/boundary_kernel.h"
#include "core/compute/kernels/cell_kernel.h"
#include "core/compute/kernels/column_kernel.h"
#include "core/compute/kernels/fit_kernels.h"
#include "core/compute/kernels/flood_kernel.h"
#include "core/compute/kernels/generation_kernels.h"
#include "core/compute/kernels/group_normal_kernel.h"
#include "core/compute/kernels/pair_count_kernel.h"
#include "core/compute/kernels/surface_score_kernel.h"
#include "core/compute/kernels/tree_kernel.h"
#include "core/compute/kernels/winding_kernel.h"

namespace hewn {

using AnyKernel =
    std::variant<ColumnKernel, TransposeKernel, CellKernel, TreeKernel, VertexClassKernel,
                 BoundaryKernel, GroupNormalKernel, TriangleTensorKernel, SectorTensorKernel,
                 PrincipalKernel, FloodKernel, SurfaceScoreKernel, WindingKernel, PairCountKernel,
                 FitSumKernel, FitStepKernel, BreedKernel, TranslateKernel>;

/// One of them. A type of its own, so that only those who launch kernels need read them all.
struct Kernel : AnyKernel {
  using AnyKernel::AnyKernel;
  const AnyKernel& any() const { return *this; }
};

}  // namespace hewn
