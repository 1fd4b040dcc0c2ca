#pragma once
/// One declaration per tunable: name, member, range, default and help. The same table gives the
/// command-line flag, the project-file field and the documentation.
#include <span>
#include <string_view>
#include <variant>

namespace hewn {

/// One field of the options struct `S`. The default is the value in a default-constructed `S`.
/// A choice is an `int` member with `choices`, a comma-separated list of names for 0, 1, 2, ...
template <class S>
struct OptionField {
  std::string_view name;  ///< kebab-case, unique within the table
  std::variant<double S::*, int S::*, bool S::*> member;
  double min = 0, max = 0;  ///< inclusive range for numbers
  std::string_view help;    ///< one sentence with the unit
  std::string_view choices = {};
};

/// Each options struct specialises this as a static table.
template <class S>
std::span<const OptionField<S>> option_table();

}  // namespace hewn
