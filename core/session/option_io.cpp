#include "core/session/option_io.h"

#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hewn {
namespace {

std::vector<std::string_view> split_choices(std::string_view choices) {
  std::vector<std::string_view> names;
  while (!choices.empty()) {
    const std::size_t comma = choices.find(',');
    names.push_back(choices.substr(0, comma));
    if (comma == std::string_view::npos) break;
    choices.remove_prefix(comma + 1);
  }
  return names;
}

Error bad_value(const OptionRef& option, std::string_view text) {
  return {ErrorCode::InvalidArgument, fmt::format("'{}' is not a value of {}; allowed: {}", text,
                                                  option.name, allowed_values(option))};
}

std::optional<double> parse_number(std::string_view text) {
  double value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

std::optional<bool> parse_switch(std::string_view text) {
  if (text == "on" || text == "true" || text == "yes" || text == "1") return true;
  if (text == "off" || text == "false" || text == "no" || text == "0") return false;
  return {};
}

bool is_in_range(const OptionRef& option, double value) {
  return value >= option.min && value <= option.max;  // false for NaN
}

}  // namespace

std::string allowed_values(const OptionRef& option) {
  if (option.is_choice()) {
    return fmt::format("{}", fmt::join(split_choices(option.choices), ", "));
  }
  if (std::holds_alternative<bool*>(option.value)) return "on or off";
  const char* kind = std::holds_alternative<int*>(option.value) ? "whole number" : "number";
  return fmt::format("{} from {} to {}", kind, option.min, option.max);
}

Result<void> set_option(const OptionRef& option, std::string_view text) {
  if (bool* const* on = std::get_if<bool*>(&option.value)) {
    const auto value = parse_switch(text);
    if (!value) return bad_value(option, text);
    **on = *value;
    return {};
  }
  if (option.is_choice()) {
    const auto names = split_choices(option.choices);
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] != text) continue;
      *std::get<int*>(option.value) = static_cast<int>(i);
      return {};
    }
    return bad_value(option, text);
  }
  const auto value = parse_number(text);
  if (!value || !is_in_range(option, *value)) return bad_value(option, text);
  if (int* const* whole = std::get_if<int*>(&option.value)) {
    if (std::floor(*value) != *value) return bad_value(option, text);
    **whole = static_cast<int>(*value);
  } else {
    *std::get<double*>(option.value) = *value;
  }
  return {};
}

std::string option_text(const OptionRef& option) {
  if (const auto on = std::get_if<bool*>(&option.value)) return **on ? "on" : "off";
  if (const auto real = std::get_if<double*>(&option.value)) return fmt::format("{}", **real);
  const int value = *std::get<int*>(option.value);
  if (!option.is_choice()) return fmt::format("{}", value);
  return std::string(split_choices(option.choices).at(static_cast<std::size_t>(value)));
}

nlohmann::json options_to_json(const OptionSection& section) {
  nlohmann::json object = nlohmann::json::object();
  for (const OptionRef& option : section.options) {
    nlohmann::json& value = object[std::string(option.name)];
    if (option.is_choice()) {
      value = option_text(option);
    } else {
      std::visit([&](const auto* number) { value = *number; }, option.value);
    }
  }
  return object;
}

Result<void> options_from_json(const OptionSection& section, const nlohmann::json& object) {
  if (!object.is_object()) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("'{}' must be an object of options", section.name)};
  }
  for (const auto& [name, value] : object.items()) {
    const OptionRef* found = nullptr;
    for (const OptionRef& option : section.options) {
      if (option.name == name) found = &option;
    }
    if (found == nullptr) {
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("there is no option '{}' in '{}'; `hewn options` lists them", name,
                               section.name)};
    }
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    if (Result<void> set = set_option(*found, text); !set) return set.error();
  }
  return {};
}

std::string options_to_markdown(const OptionSection& section) {
  std::string out = fmt::format("## {}\n\n{}\n\n", section.name, section.title);
  out += "| flag | default | allowed | meaning |\n|---|---|---|---|\n";
  for (const OptionRef& option : section.options) {
    out += fmt::format("| `--{}-{}` | {} | {} | {} |\n", section.name, option.name,
                       option_text(option), allowed_values(option), option.help);
  }
  return out;
}

}  // namespace hewn
