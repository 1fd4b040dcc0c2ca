#include "ui/theme.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <initializer_list>

#include <imgui_freetype.h>

#include "core/io/picture.h"

namespace hewn {
namespace {

ImVec4 hex(unsigned rgb) {
  return {static_cast<float>((rgb >> 16) & 255) / 255, static_cast<float>((rgb >> 8) & 255) / 255,
          static_cast<float>(rgb & 255) / 255, 1};
}

ImVec4 with_alpha(ImVec4 colour, float alpha) {
  colour.w = alpha;
  return colour;
}

std::string first_file(std::initializer_list<const char*> paths) {
  for (const char* path : paths) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) return path;
  }
  return {};
}

/// Equal widths for digits, so that columns of numbers stand still: the font's own tabular digits
/// are an OpenType feature that the atlas cannot ask for.
void make_digits_tabular(ImFont* font) {
  float widest = 0;
  for (ImWchar c = '0'; c <= '9'; ++c) {
    if (const ImFontGlyph* g = font->FindGlyphNoFallback(c)) widest = std::max(widest, g->AdvanceX);
  }
  for (ImWchar c = '0'; c <= '9'; ++c) {
    auto* g = const_cast<ImFontGlyph*>(font->FindGlyphNoFallback(c));  // NOLINT: adjusts its width
    if (g == nullptr) continue;
    const float shift = std::round((widest - g->AdvanceX) / 2);
    g->X0 += shift;
    g->X1 += shift;
    g->AdvanceX = widest;
    font->IndexAdvanceX[c] = widest;
  }
}

ImFont* add_font(const std::string& text, const std::string& icons, float size) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  static constexpr ImWchar kText[] = {0x20,   0x24F,  0x2010, 0x2027, 0x2190,
                                      0x2193, 0x2200, 0x22FF, 0};
  static constexpr ImWchar kIcons[] = {0xf000, 0xf2e0, 0};
  ImFont* font = nullptr;
  if (text.empty()) {
    font = atlas.AddFontDefault();
  } else {
    font = atlas.AddFontFromFileTTF(text.c_str(), size, nullptr, kText);
  }
  if (!icons.empty()) {
    ImFontConfig config;
    config.MergeMode = true;
    config.GlyphMinAdvanceX = std::round(1.2F * size);
    atlas.AddFontFromFileTTF(icons.c_str(), size * 0.95F, &config, kIcons);
  }
  return font;
}

void set_shape(ImGuiStyle& style) {
  style.WindowPadding = {8, 8};
  style.FramePadding = {8, 4};
  style.ItemSpacing = {8, 4};
  style.ItemInnerSpacing = {4, 4};
  style.CellPadding = {4, 2};
  style.IndentSpacing = 16;
  style.ScrollbarSize = 10;
  style.GrabMinSize = 8;
  style.WindowBorderSize = 0;
  style.ChildBorderSize = 0;
  style.PopupBorderSize = 1;
  style.FrameBorderSize = 0;
  style.WindowRounding = 0;
  style.ChildRounding = 4;
  style.FrameRounding = 4;
  style.PopupRounding = 4;
  style.GrabRounding = 4;
  style.ScrollbarRounding = 4;
  style.TabRounding = 4;
  style.WindowMenuButtonPosition = ImGuiDir_None;
  style.ButtonTextAlign = {0.5F, 0.5F};
}

}  // namespace

Theme dark_theme() {
  return {false,         hex(0x15181c), hex(0x1d2126), hex(0x262b31), hex(0x343a42), hex(0xd7dde4),
          hex(0x8a94a0), hex(0x4da3ff), hex(0x6cc08b), hex(0xe0a458), hex(0xe67c85)};
}

Theme light_theme() {
  return {true,          hex(0xf4f6f8), hex(0xffffff), hex(0xeef1f4), hex(0xd5dbe1), hex(0x1c2127),
          hex(0x5c6773), hex(0x1668c7), hex(0x1f7a45), hex(0x8a5a00), hex(0xb3261e)};
}

void apply_theme(const Theme& theme, float scale) {
  ImGuiStyle style;
  set_shape(style);
  const auto set = [&style](int index, const ImVec4& colour) { style.Colors[index] = colour; };
  const ImVec4 none(0, 0, 0, 0);
  for (ImVec4& colour : style.Colors) colour = theme.raised;
  set(ImGuiCol_Text, theme.text);
  set(ImGuiCol_TextDisabled, theme.faint);
  set(ImGuiCol_WindowBg, theme.panel);
  set(ImGuiCol_ChildBg, none);
  set(ImGuiCol_PopupBg, theme.raised);
  set(ImGuiCol_Border, theme.line);
  set(ImGuiCol_BorderShadow, none);
  set(ImGuiCol_FrameBg, theme.raised);
  set(ImGuiCol_FrameBgHovered, theme.line);
  set(ImGuiCol_FrameBgActive, theme.line);
  set(ImGuiCol_MenuBarBg, theme.panel);
  set(ImGuiCol_ScrollbarBg, none);
  set(ImGuiCol_ScrollbarGrab, theme.line);
  set(ImGuiCol_ScrollbarGrabHovered, theme.faint);
  set(ImGuiCol_ScrollbarGrabActive, theme.faint);
  set(ImGuiCol_CheckMark, theme.accent);
  set(ImGuiCol_SliderGrab, theme.accent);
  set(ImGuiCol_SliderGrabActive, theme.accent);
  set(ImGuiCol_Button, theme.raised);
  set(ImGuiCol_ButtonHovered, theme.line);
  set(ImGuiCol_ButtonActive, with_alpha(theme.accent, 0.45F));
  set(ImGuiCol_Header, with_alpha(theme.accent, 0.22F));
  set(ImGuiCol_HeaderHovered, with_alpha(theme.accent, 0.14F));
  set(ImGuiCol_HeaderActive, with_alpha(theme.accent, 0.30F));
  set(ImGuiCol_Separator, theme.line);
  set(ImGuiCol_SeparatorHovered, theme.accent);
  set(ImGuiCol_SeparatorActive, theme.accent);
  set(ImGuiCol_ResizeGrip, none);
  set(ImGuiCol_Tab, theme.panel);
  set(ImGuiCol_TabHovered, theme.line);
  set(ImGuiCol_TabActive, theme.raised);
  set(ImGuiCol_PlotHistogram, theme.accent);
  set(ImGuiCol_TableHeaderBg, theme.panel);
  set(ImGuiCol_TableBorderLight, theme.line);
  set(ImGuiCol_TableRowBg, none);
  set(ImGuiCol_TableRowBgAlt, none);
  set(ImGuiCol_TextSelectedBg, with_alpha(theme.accent, 0.35F));
  set(ImGuiCol_DragDropTarget, theme.accent);
  set(ImGuiCol_NavHighlight, none);
  set(ImGuiCol_ModalWindowDimBg, with_alpha(theme.background, 0.5F));
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

Fonts load_fonts(float scale) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
  const std::string text = first_file({"/usr/share/fonts/opentype/inter/Inter-Regular.otf",
                                       "/usr/share/fonts/truetype/inter/Inter-Regular.ttf",
                                       "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                       "/usr/share/fonts/truetype/liberation/LiberationSans-"
                                       "Regular.ttf"});
  std::string bold = first_file({"/usr/share/fonts/opentype/inter/Inter-SemiBold.otf",
                                 "/usr/share/fonts/truetype/inter/Inter-SemiBold.ttf",
                                 "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"});
  if (bold.empty()) bold = text;
  const std::string icons =
      first_file({"/usr/share/fonts/opentype/font-awesome/FontAwesome.otf",
                  "/usr/share/fonts/truetype/font-awesome/fontawesome-webfont.ttf"});
  Fonts fonts;
  fonts.body = add_font(text, icons, std::round(15 * scale));
  fonts.small = add_font(text, icons, std::round(13 * scale));
  fonts.heading = add_font(bold, icons, std::round(15 * scale));
  fonts.has_icons = !icons.empty();
  atlas.Build();
  // Headings are no tables.
  for (ImFont* font : {fonts.body, fonts.small}) make_digits_tabular(font);
  return fonts;
}

LabelState golden_state(int index) {
  const Vec3 linear = golden_colour(index);
  std::array<std::uint8_t, 3> rgb{};
  for (int k = 0; k < 3; ++k) {
    const double x = linear[k];
    const double srgb = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    rgb[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::lround(255 * srgb));
  }
  return {rgb[0], rgb[1], rgb[2], 0};
}

LabelState kind_state(SurfaceKind kind, bool is_fitted) {
  if (!is_fitted) return {0x9a, 0xa0, 0xa6, 0};
  switch (kind) {
    case SurfaceKind::Plane:
      return {0x8a, 0xa4, 0xc8, 0};
    case SurfaceKind::Cylinder:
      return {0xe0, 0xa4, 0x58, 0};
    case SurfaceKind::Cone:
      return {0x5f, 0xb3, 0xa5, 0};
    case SurfaceKind::Sphere:
      return {0xd7, 0x7a, 0x8b, 0};
    case SurfaceKind::Torus:
      break;
  }
  return {0xa4, 0x8a, 0xd4, 0};
}

ImVec4 op_colour(Op op) {
  if (op == Op::Difference) return hex(0xe06c75);
  return op == Op::Intersection ? hex(0x61a0ff) : hex(0x6cc08b);
}

const char* op_sign(Op op) {
  if (op == Op::Difference) return "\u2212";
  return op == Op::Intersection ? "\u00d7" : "+";
}

glm::vec3 to_linear(const ImVec4& srgb) {
  const auto one = [](float c) {
    return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
  };
  return {one(srgb.x), one(srgb.y), one(srgb.z)};
}

}  // namespace hewn
