#pragma once
/// The panels of the window, one source file each. They read the session, keep to their state and
/// make commands.
#include "ui/studio_state.h"
#include "ui/view/look.h"

namespace hewn {

/// A rectangle of the window in pixels.
struct PanelArea {
  float x = 0, y = 0, width = 0, height = 0;
};

void draw_menu_bar(Ui& ui);                                 ///< inside a window with a menu bar
void draw_plan_panel(Ui& ui, const PanelArea& area);        ///< left: partitions, cuts, groups
void draw_partitions(Ui& ui);                               ///< in it, the partitions
void draw_result_panel(Ui& ui, const PanelArea& area);      ///< right: numbers, tree, Pareto
void draw_outline(Ui& ui, const Tree& tree);                ///< the result's tree as rows
void draw_graph(Ui& ui, const Tree& tree);                  ///< the same as nodes and lines
void draw_pareto(Ui& ui);                                   ///< the trees found, as a plot
void draw_status_bar(Ui& ui, const PanelArea& area);        ///< bottom: jobs, counts
void draw_toolbar(Ui& ui, const PanelArea& area);           ///< above the part
void draw_selection_card(Ui& ui, const PanelArea& view);    ///< floats over the part
void draw_knife_card(Ui& ui, const PanelArea& view);        ///< in its place while cutting
void draw_section_card(Ui& ui, const PanelArea& view);      ///< upper left, while there is one
void draw_gizmo(Ui& ui, const PanelArea& view);             ///< axes, lower right
void draw_measure_card(Ui& ui, const PanelArea& view);      ///< in its place while measuring
void draw_deviation_legend(Ui& ui, const PanelArea& view);  ///< while deviations are shown
void draw_exact_card(Ui& ui, const PanelArea& view);        ///< how the result is drawn
void draw_notices(Ui& ui, const PanelArea& view);           ///< upper right of the part
void draw_recovery(Ui& ui, const PanelArea& view);          ///< after a crash
void draw_leave_card(Ui& ui, const PanelArea& view);        ///< asks before unsaved work goes
void draw_log(Ui& ui, const PanelArea& view);               ///< what was done and said
void draw_settings(Ui& ui, const PanelArea& view);          ///< every tunable
void draw_hints(Ui& ui, const PanelArea& view);             ///< first steps
void draw_palette(Ui& ui, const PanelArea& window);         ///< find a command
void draw_keys(Ui& ui, const PanelArea& window);            ///< list of keys
void draw_file_panel(Ui& ui, const PanelArea& window);      ///< open, save, export

}  // namespace hewn
