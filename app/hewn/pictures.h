#pragma once
/// The pictures that the commands write.
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/io/picture.h"
#include "core/session/plan.h"

namespace hewn {

/// The mesh coloured by face group.
Result<Image> draw_groups(const PreparedMesh& prepared, bool is_dark, const RunContext& run);

/// The mesh by face group, and next to it the tree by literal, from the same place.
Result<Image> draw_input_and_result(const PreparedMesh& prepared, const Tree& tree, bool is_dark,
                                    const RunContext& run);

}  // namespace hewn
