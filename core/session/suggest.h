#pragma once
/// Partitions to begin with, proposed from a tree that was found without any.
#include "core/base/result.h"
#include "core/csg/tree.h"
#include "core/session/document.h"

namespace hewn {

/// The document's plan with a partition for each outermost term of `tree` but the first, joined as
/// the tree joins them; holes of one radius share a partition. A group belongs to the term with the
/// literal whose surface is nearest to its triangles.
/// Fails with InvalidArgument: not ready, the plan has partitions, the tree is one term or none of
/// the other terms has a group of its own. Cost: O(triangles x literals).
Result<Project> suggest_partitions(const Document& document, const Tree& tree);

}  // namespace hewn
