#pragma once
/// From session and state to what is to be seen: the scene and the look of every label.
#include <vector>

#include "ui/studio_state.h"
#include "ui/view/pixels.h"
#include "ui/view/scene.h"

namespace hewn {

/// The group's own colour: unlike those of the groups beside it.
LabelState group_colour(const Ui& ui, int group);

/// The partition's own colour, or one for its place among all.
LabelState partition_colour(const PartitionView& partition, std::size_t place);

/// The looks of the input's groups.
std::vector<LabelState> group_states(const Ui& ui);

/// The looks of the result's literals.
std::vector<LabelState> literal_states(const Ui& ui);

/// What is to be seen now: the input while it is compared, the result while one is looked at.
ShowMode shown_mode(const Ui& ui);

/// Whether the deviations are to be shown and there are some.
bool shows_deviation(const Ui& ui);

Scene build_scene(const Ui& ui, const ViewArea& area);

/// The tolerance and the end of the colours, in model units.
glm::vec2 deviation_scale(const Ui& ui);

}  // namespace hewn
