#pragma once
/// All kernels. Each has, for a `Grain` of core/compute/host_device.h,
///   items<Grain>()    how many independent items it consists of
///   run<Grain>(item)  does one; items may run in any order and at the same time
#include <variant>

#include "core/compute/kernels/cell_kernel.h"
#include "core/compute/kernels/column_kernel.h"
#include "core/compute/kernels/tree_kernel.h"

namespace hewn {

using Kernel = std::variant<ColumnKernel, TransposeKernel, CellKernel, TreeKernel>;

}  // namespace hewn
