#pragma once
/// The partitions' trees under the user's expression.
#include <optional>
#include <vector>

#include "core/csg/tree.h"
#include "core/session/plan.h"

namespace hewn {

/// `trees`: one for each partition that has groups of its own; nullopt for the others. Each
/// partition's node bears its name, unless it is the only one.
Tree join_partitions(const std::vector<Partition>& partitions,
                     const std::vector<std::optional<Tree>>& trees);

}  // namespace hewn
