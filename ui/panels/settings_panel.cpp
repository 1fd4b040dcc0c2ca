/// Every tunable, from the tables that give the command its flags.
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/session/option_io.h"
#include "core/session/settings.h"
#include "ui/panels/widgets.h"

namespace hewn {
namespace {

/// Draws the control over the option's value in memory; true when it was changed.
bool draw_control(const OptionRef& option) {
  if (auto* const* flag = std::get_if<bool*>(&option.value)) {
    return ImGui::Checkbox("##value", *flag);
  }
  constexpr ImGuiInputTextFlags kFlags = ImGuiInputTextFlags_EnterReturnsTrue;
  if (auto* const* number = std::get_if<double*>(&option.value)) {
    return ImGui::InputDouble("##value", *number, 0, 0, "%.6g", kFlags);
  }
  int* const whole = std::get<int*>(option.value);
  if (!option.is_choice()) return ImGui::InputInt("##value", whole, 0, 0, kFlags);
  std::string names(option.choices);  // Dear ImGui wants an empty name at the end
  std::replace(names.begin(), names.end(), ',', '\0');
  names += '\0';
  return ImGui::Combo("##value", whole, names.c_str());
}

void set(Ui& ui, const OptionSection& section, const OptionRef& option) {
  static_cast<void>(ui.session.execute(
      SetOption{std::string(section.name), std::string(option.name), option_text(option)}));
}

/// `standard`: the same option with its default.
void draw_option(Ui& ui, const OptionSection& section, const OptionRef& option,
                 const OptionRef& standard) {
  ImGui::PushID(option.name.data());
  const bool is_standard = option_text(option) == option_text(standard);
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, is_standard ? ui.theme.faint : ui.theme.text);
  ImGui::TextUnformatted(std::string(option.name).c_str());
  ImGui::PopStyleColor();
  const auto tip = [&] {
    if (!ImGui::IsItemHovered()) return;
    ImGui::SetTooltip(
        "%s", fmt::format("{}\n{}; default {}\n--{}-{}", option.help, allowed_values(option),
                          option_text(standard), section.name, option.name)
                  .c_str());
  };
  tip();
  ImGui::SameLine(ui.px(200));
  ImGui::SetNextItemWidth(ui.px(112));
  const bool is_changed = draw_control(option);
  tip();
  if (is_changed) set(ui, section, option);
  if (!is_standard) {
    ImGui::SameLine(0, ui.px(4));
    if (ImGui::Button("reset")) set(ui, section, standard);
    if (ImGui::IsItemHovered()) {
      ImGui::SetTooltip("Back to %s.", option_text(standard).c_str());
    }
  }
  ImGui::PopID();
}

bool matches(const OptionSection& section, const OptionRef& option, const std::string& filter) {
  return filter.empty() ||
         fmt::format("--{}-{}", section.name, option.name).find(filter) != std::string::npos ||
         option.help.find(filter) != std::string_view::npos;
}

/// "Finding the tree of one partition": without what only the command line wants to know.
std::string short_title(std::string_view title) {
  const std::size_t end = std::min(title.find(" ("), title.find('.'));
  return std::string(title.substr(0, end));
}

void draw_section(Ui& ui, const OptionSection& section, const OptionSection& standard) {
  const std::string& filter = ui.state.settings_filter;
  const auto is_sought = [&](const OptionRef& o) { return matches(section, o, filter); };
  if (std::none_of(section.options.begin(), section.options.end(), is_sought)) return;
  if (!filter.empty()) ImGui::SetNextItemOpen(true);
  if (!ImGui::CollapsingHeader(short_title(section.title).c_str())) return;
  ImGui::PushID(section.name.data());
  for (std::size_t i = 0; i < section.options.size(); ++i) {
    if (!is_sought(section.options[i])) continue;
    draw_option(ui, section, section.options[i], standard.options[i]);
  }
  ImGui::PopID();
}

void draw_seed(Ui& ui) {
  ImGui::AlignTextToFramePadding();
  faint_text(ui, "seed");
  ImGui::SameLine(ui.px(200));
  ImGui::SetNextItemWidth(ui.px(112));
  std::uint64_t seed = ui.session.document().project.seed;
  if (ImGui::InputScalar("##seed", ImGuiDataType_U64, &seed, nullptr, nullptr, "%llu",
                         ImGuiInputTextFlags_EnterReturnsTrue)) {
    static_cast<void>(ui.session.execute(SetSeed{seed}));
  }
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("Of all random numbers: another seed may find another tree.\n--seed");
  }
}

}  // namespace

void draw_settings(Ui& ui, const PanelArea& view) {
  if (!ui.state.shows_settings) return;
  const float width = ui.px(392);
  begin_card(ui, "settings", view.x + view.width - ui.px(12), view.y + ui.px(12), {1, 0});
  heading(ui, "Settings");
  ImGui::SameLine(width - ui.px(48));
  if (ImGui::Button("Close", {ui.px(56), 0})) ui.state.shows_settings = false;
  ImGui::SetNextItemWidth(width);
  if (ImGui::IsWindowAppearing()) {
    ImGui::SetWindowFocus();
    ImGui::SetKeyboardFocusHere();
  }
  ImGui::InputTextWithHint("##filter", "find an option", &ui.state.settings_filter);
  ImGui::PushFont(ui.fonts.small);
  if (ImGui::BeginChild("options", {width, std::max(ui.px(120), view.height - ui.px(116))})) {
    Settings settings = ui.session.document().project.settings;
    Settings defaults;
    const auto sections = bind_settings(settings);
    const auto standard = bind_settings(defaults);
    draw_seed(ui);
    ImGui::PushStyleColor(ImGuiCol_Header, ui.theme.panel);
    for (std::size_t i = 0; i < sections.size(); ++i) draw_section(ui, sections[i], standard[i]);
    ImGui::PopStyleColor();
  }
  ImGui::EndChild();
  ImGui::PopFont();
  end_card();
}

}  // namespace hewn
