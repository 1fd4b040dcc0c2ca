#include "core/synth/simplify/sibling_care.h"

namespace hewn {

using Kind = Formula::Kind;

Column care_of_child(const Formula& parent, std::size_t child, const Column& care) {
  Column reach = care;
  for (std::size_t k = 0; k < parent.children.size(); ++k) {
    if (k == child) continue;
    const Column& v = parent.children[k].value;
    for (std::size_t i = 0; i < reach.size(); ++i) {
      reach[i] &= parent.kind == Kind::And ? v[i] : ~v[i];
    }
  }
  return reach;
}

/// An intersection is decided where an operand is empty, a union where one is full.
Word SiblingCare::decided(std::size_t child, std::size_t word) const {
  const Word v = parent_.children[child].value[word];
  return parent_.kind == Kind::And ? ~v : v;
}

void SiblingCare::renew() {
  once_.assign(parent_.children.empty() ? 0 : parent_.children[0].value.size(), 0);
  twice_ = once_;
  for (std::size_t k = 0; k < parent_.children.size(); ++k) {
    for (std::size_t i = 0; i < once_.size(); ++i) {
      const Word d = decided(k, i);
      twice_[i] |= once_[i] & d;
      once_[i] |= d;
    }
  }
}

Column SiblingCare::of(std::size_t child, const Column& care) const {
  Column reach = care;
  for (std::size_t i = 0; i < reach.size(); ++i) {
    reach[i] &= ~(twice_[i] | (once_[i] & ~decided(child, i)));
  }
  return reach;
}

}  // namespace hewn
