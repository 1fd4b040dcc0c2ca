#pragma once
/// Numbers in messages.
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace hewn {

/// "1 hole", "4 holes": the number before the word that agrees with it.
template <class Integer>
std::string counted(Integer n, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

}  // namespace hewn
