#pragma once
/// The option tables seen as text and JSON: what flags, project files, reports and the generated
/// page of documentation are made from.
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/base/option_table.h"
#include "core/base/result.h"

namespace hewn {

/// One field of one options struct in memory. Valid as long as the struct.
struct OptionRef {
  std::string_view name;  ///< kebab-case, unique within its section
  std::variant<double*, int*, bool*> value;
  double min = 0, max = 0;
  std::string_view help;
  std::string_view choices;

  bool is_choice() const { return !choices.empty(); }
};

/// The fields of one options struct under the name that flags and files know it by.
struct OptionSection {
  std::string_view name;   ///< "segment": flags are `--segment-...`
  std::string_view title;  ///< one line for the documentation
  std::vector<OptionRef> options;
};

/// The fields of `values` in the order of their table.
template <class S>
std::vector<OptionRef> bind_options(S& values) {
  std::vector<OptionRef> refs;
  for (const OptionField<S>& field : option_table<S>()) {
    OptionRef ref{field.name,   static_cast<double*>(nullptr), field.min, field.max, field.help,
                  field.choices};
    std::visit([&](auto member) { ref.value = &(values.*member); }, field.member);
    refs.push_back(ref);
  }
  return refs;
}

/// Sets the option from a flag's text: a number, on/off/true/false, or the name of a choice.
/// Fails with InvalidArgument (says what is allowed); the option then keeps its value.
Result<void> set_option(const OptionRef& option, std::string_view text);

/// The value as `set_option` reads it.
std::string option_text(const OptionRef& option);

/// "number from 0 to 1", "on or off", "facets, curvature": what `set_option` accepts.
std::string allowed_values(const OptionRef& option);

/// {"name": value, ...} of one section.
nlohmann::json options_to_json(const OptionSection& section);

/// Sets the options that `object` names. Fails with InvalidArgument: unknown name, wrong type, out
/// of range.
Result<void> options_from_json(const OptionSection& section, const nlohmann::json& object);

/// A table of the section's flags with their defaults, as Markdown. The values shown are those
/// in memory: pass default-constructed structs.
std::string options_to_markdown(const OptionSection& section);

}  // namespace hewn
