#pragma once
/// Colours, fonts and icons of the window.
#include <string>

#include <glm/glm.hpp>
#include <imgui.h>

#include "core/base/math.h"
#include "core/csg/surface.h"
#include "core/csg/tree.h"
#include "ui/view/scene.h"

namespace hewn {

/// sRGB. Text on panels keeps a contrast of at least 4.5.
struct Theme {
  bool is_light = false;
  ImVec4 background, panel, raised, line, text, faint, accent;
  ImVec4 good, warning, bad;
};

Theme dark_theme();
Theme light_theme();

/// Sets Dear ImGui's style. `scale`: of the monitor, 1 at 96 dpi.
void apply_theme(const Theme& theme, float scale);

struct Fonts {
  ImFont* body = nullptr;     ///< 15 px
  ImFont* small = nullptr;    ///< 13 px, for tables
  ImFont* heading = nullptr;  ///< semi-bold, 15 px
  bool has_icons = false;
};

/// Loads Inter and Font Awesome from the system's fonts, or what comes nearest. Digits get equal
/// widths.
Fonts load_fonts(float scale);

/// The colour of face group or literal number `index`: golden-angle hues of equal lightness.
LabelState golden_state(int index);
/// Of a kind of surface.
LabelState kind_state(SurfaceKind kind, bool is_fitted);
/// Union green, difference red, intersection blue.
ImVec4 op_colour(Op op);
/// "+", "-" or a cross: always shown beside the colour.
const char* op_sign(Op op);

inline ImVec4 to_colour(const LabelState& s) {
  return {static_cast<float>(s.red) / 255, static_cast<float>(s.green) / 255,
          static_cast<float>(s.blue) / 255, 1};
}
glm::vec3 to_linear(const ImVec4& srgb);

namespace icon {
inline constexpr const char* kPointer = "\uf245";
inline constexpr const char* kBox = "\uf125";
inline constexpr const char* kLasso = "\uf040";
inline constexpr const char* kLock = "\uf023";
inline constexpr const char* kMove = "\uf047";
inline constexpr const char* kKnife = "\uf0c4";
inline constexpr const char* kMeasure = "\uf07e";
inline constexpr const char* kEye = "\uf06e";
inline constexpr const char* kEyeOff = "\uf070";
inline constexpr const char* kPlay = "\uf04b";
inline constexpr const char* kStop = "\uf04d";
inline constexpr const char* kTrash = "\uf1f8";
inline constexpr const char* kSearch = "\uf002";
inline constexpr const char* kWarning = "\uf071";
inline constexpr const char* kInfo = "\uf05a";
inline constexpr const char* kClose = "\uf00d";
inline constexpr const char* kFolder = "\uf114";
inline constexpr const char* kFile = "\uf1b2";
inline constexpr const char* kExport = "\uf093";
inline constexpr const char* kBolt = "\uf0e7";
}  // namespace icon

}  // namespace hewn
