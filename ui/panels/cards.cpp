/// What floats over the part: selection, knife, section, legend, notices, hints.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "core/session/describe.h"
#include "ui/panels/widgets.h"
#include "ui/tools/knife.h"
#include "ui/tools/section.h"

namespace hewn {
namespace {

struct Hint {
  const char* text;
  bool (*is_done)(const Ui&);
};

constexpr Hint kHints[] = {
    {"1 of 4: click a face to select its group; Shift adds, S takes all of its kind",
     [](const Ui& ui) { return !ui.state.selected.empty(); }},
    {"2 of 4: press K and drag a line across the part to cut it; Enter confirms, Esc leaves",
     [](const Ui& ui) { return !ui.session.document().project.cuts.empty(); }},
    {"3 of 4: select holes and press Shift+P: they become a partition that is taken away",
     [](const Ui& ui) { return !ui.session.document().project.root.children.empty(); }},
    {"4 of 4: press Ctrl+R for the tree; R shows it, Space compares with the mesh",
     [](const Ui& ui) { return ui.session.shown_result() != nullptr; }}};

/// Blue inside, red outside, as in shaders/mesh.frag.
ImU32 deviation_colour(double d, const glm::vec2& scale) {
  const auto srgb = [](double c) {
    return static_cast<float>(c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
  };
  Vec3 c(0.42, 0.42, 0.42);
  if (std::abs(d) > scale.x) {
    const double t = std::sqrt(std::min((std::abs(d) - scale.x) / (scale.y - scale.x), 1.0));
    const Vec3 end = d > 0 ? Vec3(0.72, 0.06, 0.07) : Vec3(0.05, 0.18, 0.70);
    c = Vec3(0.88, 0.88, 0.88) * (1 - t) + end * t;
  }
  return ImGui::GetColorU32({srgb(c.x()), srgb(c.y()), srgb(c.z()), 1});
}

void draw_histogram(const Ui& ui, const ResultView& view, const glm::vec2& scale, float width) {
  constexpr int kBins = 41;
  int counts[kBins] = {};
  for (const DisplayCorner& corner : view.input.corners) {
    const double share = (corner.value / scale.y + 1) / 2;
    ++counts[std::clamp(static_cast<int>(share * kBins), 0, kBins - 1)];
  }
  const int most = std::max(1, *std::max_element(counts, counts + kBins));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ui.px(36);
  const float step = width / kBins;
  for (int i = 0; i < kBins; ++i) {
    const double d = (2 * (i + 0.5) / kBins - 1) * scale.y;
    // Logarithmic: a part with most vertices exact would show one bar only.
    const double tall = counts[i] == 0 ? 0 : (1 + std::log(counts[i])) / (1 + std::log(most));
    const float x = at.x + step * static_cast<float>(i);
    ImGui::GetWindowDrawList()->AddRectFilled({x, at.y + height * static_cast<float>(1 - tall)},
                                              {x + step - 1, at.y + height},
                                              deviation_colour(d, scale));
  }
  ImGui::Dummy({width, height});
}

}  // namespace

void draw_selection_card(Ui& ui, const PanelArea& view) {
  const Document& document = ui.session.document();
  if (!document.is_ready() || ui.state.selected.empty()) return;
  if (ui.state.tool == Tool::Knife || ui.state.tool == Tool::Measure) return;
  begin_card(ui, "selection", view.x + view.width / 2, view.y + view.height - ui.px(12), {0.5F, 1});
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(describe_selection(*document.prepared, ui.state.selected).c_str());
  ImGui::SameLine(0, ui.px(16));
  if (ui.state.selected.size() > 1) {
    action_button(ui, "Merge groups", "Merge  M");
  } else {
    action_button(ui, "Knife", "Cut  K");
  }
  ImGui::SameLine(0, ui.px(4));
  action_button(ui, "New partition", "Partition  P");
  ImGui::SameLine(0, ui.px(4));
  action_button(ui, "Subtract as partition", "Subtract  Shift+P");
  end_card();
}

void draw_knife_card(Ui& ui, const PanelArea& view) {
  if (ui.state.tool != Tool::Knife || !ui.session.document().is_ready()) return;
  KnifeState& knife = ui.state.knife;
  begin_card(ui, "knife", view.x + view.width / 2, view.y + view.height - ui.px(12), {0.5F, 1});
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(with_icon(ui, icon::kKnife, "").c_str());
  ImGui::SameLine();
  for (int k = 0; k < 3; ++k) {
    const bool is_it = knife.plane && axis_across(knife.plane->normal) == k;
    const char name[] = {"xyz"[k], '\0'};
    if (toggle_button(ui, name, is_it)) {
      const double middle = ui.session.document().prepared->mesh->bounds.center()[k];
      set_knife_plane(ui, {Vec3::Unit(k), middle, fmt::format("{} axis", "xyz"[k])});
    }
    ImGui::SameLine(0, ui.px(4));
  }
  ImGui::SetNextItemWidth(ui.px(96));
  if (ImGui::InputTextWithHint("##offset", "offset", knife.offset_text.data(),
                               knife.offset_text.size(), ImGuiInputTextFlags_CharsDecimal) &&
      knife.plane) {
    char* end = nullptr;
    const double offset = std::strtod(knife.offset_text.data(), &end);
    if (end != knife.offset_text.data()) {
      const auto typed = knife.offset_text;
      set_knife_plane(ui, {knife.plane->normal, offset, ""});
      knife.offset_text = typed;
    }
  }
  ImGui::SameLine();
  if (knife.plane) {
    faint_text(ui, fmt::format("{}{}divides {} group{}", knife.plane->snapped_to,
                               knife.plane->snapped_to.empty() ? "" : ", ", knife.crossed,
                               knife.crossed == 1 ? "" : "s"));
  } else {
    faint_text(ui, "drag a line, or pick an axis and type where");
  }
  ImGui::SameLine();
  action_button(ui, "Confirm the cut", "Cut  Enter");
  end_card();
}

void draw_deviation_legend(Ui& ui, const PanelArea& view) {
  if (!shows_deviation(ui)) return;
  const auto result = ui.session.result_view();
  const glm::vec2 scale = deviation_scale(ui);
  // On narrow windows the card at the bottom's middle reaches as far as here.
  const bool has_card =
      ui.state.tool == Tool::Knife || ui.state.tool == Tool::Measure || !ui.state.selected.empty();
  const float bottom = view.y + view.height - ui.px(has_card ? 60 : 12);
  begin_card(ui, "legend", view.x + ui.px(12), bottom, {0, 1});
  const float width = ui.px(220);
  ImGui::TextUnformatted("Deviation of the mesh, model units");
  draw_histogram(ui, *result, scale, width);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  constexpr int kSteps = 55;
  for (int i = 0; i < kSteps; ++i) {
    const double d = (2 * (i + 0.5) / kSteps - 1) * scale.y;
    const float x = at.x + width * static_cast<float>(i) / kSteps;
    ImGui::GetWindowDrawList()->AddRectFilled({x, at.y}, {x + width / kSteps + 1, at.y + ui.px(8)},
                                              deviation_colour(d, scale));
  }
  ImGui::Dummy({width, ui.px(8)});
  ImGui::PushFont(ui.fonts.small);
  const std::string largest = short_number(scale.y);
  faint_text(ui, "-" + largest);
  ImGui::SameLine(width / 2);
  faint_text(ui, "0");
  ImGui::SameLine(ui.px(8) + width - ImGui::CalcTextSize(("+" + largest).c_str()).x);
  faint_text(ui, "+" + largest);
  ImGui::SetNextItemWidth(width);
  auto exponent = static_cast<float>(std::log10(ui.state.tolerance_share));
  const double diagonal = ui.session.document().prepared->mesh->diagonal();
  if (ImGui::SliderFloat("##tolerance", &exponent, -6, -2, "")) {
    ui.state.tolerance_share = std::pow(10.0, exponent);
  }
  faint_text(ui, "grey: within " + short_number(ui.state.tolerance_share * diagonal));
  ImGui::PopFont();
  end_card();
}

void draw_exact_card(Ui& ui, const PanelArea& view) {
  const ShowMode show = shown_mode(ui);
  const bool shows_result = show == ShowMode::Result || show == ShowMode::Overlay;
  if (!shows_result || !ui.session.result_view()) return;
  const ExactNow& now = ui.state.exact_now;
  begin_card(ui, "exact", view.x + ui.px(12), view.y + view.height - ui.px(12), {0, 1});
  ImGui::PushFont(ui.fonts.small);
  const char* const modes[] = {"auto", "on", "off"};
  ImGui::AlignTextToFramePadding();
  faint_text(ui, exact_text(ui.state.exact, now.is_exact, now.cost, now.problem));
  if (now.problem.empty()) {
    ImGui::SameLine();
    action_button(ui, "Exact result", modes[static_cast<int>(ui.state.exact)]);
  }
  ImGui::PopFont();
  end_card();
}

void draw_notices(Ui& ui, const PanelArea& view) {
  const bool has_hint = ui.state.shows_hints && ui.session.document().is_ready();
  float y = view.y + ui.px(has_hint ? 60 : 12);
  const auto& notices = ui.session.notices();
  constexpr std::size_t kMost = 4;
  const std::size_t first = notices.size() > kMost ? notices.size() - kMost : 0;
  for (std::size_t i = first; i < notices.size(); ++i) {
    const Notice notice = notices[i];
    const std::string name = fmt::format("notice {}", i);
    begin_card(ui, name.c_str(), view.x + view.width - ui.px(12), y, {1, 0});
    const ImVec4 colour = notice.severity == Severity::Error     ? ui.theme.bad
                          : notice.severity == Severity::Warning ? ui.theme.warning
                                                                 : ui.theme.accent;
    const char* sign = notice.severity == Severity::Info ? icon::kInfo : icon::kWarning;
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextUnformatted(ui.fonts.has_icons ? sign : "!");
    ImGui::PopStyleColor();
    ImGui::SameLine();
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + ui.px(300));
    ImGui::TextUnformatted(notice.text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::SameLine();
    const bool is_gone = ImGui::SmallButton(ui.fonts.has_icons ? icon::kClose : "x");
    y += ImGui::GetWindowHeight() + ui.px(8);
    end_card();
    if (is_gone) {
      ui.session.dismiss(i);
      return;
    }
  }
}

void draw_recovery(Ui& ui, const PanelArea& view) {
  if (ui.state.recoverable.empty()) return;
  const std::filesystem::path copy = ui.state.recoverable.front();
  begin_card(ui, "recovery", view.x + view.width / 2, view.y + ui.px(64), {0.5F, 0});
  ImGui::PushFont(ui.fonts.heading);
  ImGui::TextUnformatted("Unsaved work was kept");
  ImGui::PopFont();
  faint_text(ui, "The program ended before this plan was saved. The copy is at most a minute old.");
  if (ImGui::Button("Open the copy")) {
    if (ui.session.recover(copy)) {
      reset_view(ui.state);
      ui.state.recovered = copy;
    }
    // A copy that cannot be opened stays on the disk; the notice says why.
    ui.state.recoverable.erase(ui.state.recoverable.begin());
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", copy.string().c_str());
  ImGui::SameLine(0, ui.px(8));
  if (ImGui::Button("Throw it away")) {
    std::error_code ignored;
    std::filesystem::remove(copy, ignored);
    ui.state.recoverable.erase(ui.state.recoverable.begin());
  }
  ImGui::SameLine(0, ui.px(8));
  if (ImGui::Button("Later")) ui.state.recoverable.clear();
  end_card();
}

void draw_hints(Ui& ui, const PanelArea& view) {
  StudioState& state = ui.state;
  constexpr int kCount = static_cast<int>(std::size(kHints));
  while (state.hint < kCount && kHints[state.hint].is_done(ui)) ++state.hint;
  if (state.hint >= kCount) state.shows_hints = false;
  if (!state.shows_hints || !ui.session.document().is_ready()) return;
  const float top = view.y + ui.px(state.section ? 60 : 12);
  begin_card(ui, "hint", view.x + view.width / 2, top, {0.5F, 0});
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(kHints[state.hint].text);
  ImGui::SameLine();
  if (ImGui::Button(ui.fonts.has_icons ? icon::kClose : "x")) state.shows_hints = false;
  end_card();
}

}  // namespace hewn
