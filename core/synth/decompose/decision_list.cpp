#include "core/synth/decompose/decision_list.h"

#include <algorithm>
#include <utility>

namespace hewn {

void evaluate_list(std::span<const TermPtr> items, bool base, std::vector<Word>& inside) {
  std::fill(inside.begin(), inside.end(), base ? ~Word{0} : Word{0});
  for (std::size_t k = items.size(); k-- > 0;) {
    const Word* cover = items[k]->cover.data();
    if (items[k]->fills) {
      for (std::size_t i = 0; i < inside.size(); ++i) inside[i] |= cover[i];
    } else {
      for (std::size_t i = 0; i < inside.size(); ++i) inside[i] &= ~cover[i];
    }
  }
}

std::vector<Word> wrong_cells(const SearchSpace& space, std::span<const TermPtr> items, bool base) {
  std::vector<Word> wrong(space.words());
  evaluate_list(items, base, wrong);
  const std::vector<Word>& wanted = space.columns->wanted();
  for (std::size_t i = 0; i < wrong.size(); ++i) {
    wrong[i] = (wrong[i] ^ wanted[i]) & space.care[i];
  }
  return wrong;
}

bool is_right(const SearchSpace& space, std::span<const TermPtr> items, bool base) {
  // Block by block: a wrong block ends the check early.
  const std::vector<Word>& wanted = space.columns->wanted();
  for (std::size_t block = 0; block < space.words(); block += kWordBlock) {
    Word inside[kWordBlock];
    std::fill_n(inside, kWordBlock, base ? ~Word{0} : Word{0});
    for (std::size_t k = items.size(); k-- > 0;) {
      const Word* cover = items[k]->cover.data() + block;
      if (items[k]->fills) {
        for (std::size_t i = 0; i < kWordBlock; ++i) inside[i] |= cover[i];
      } else {
        for (std::size_t i = 0; i < kWordBlock; ++i) inside[i] &= ~cover[i];
      }
    }
    Word wrong = 0;
    for (std::size_t i = 0; i < kWordBlock; ++i) {
      wrong |= (inside[i] ^ wanted[block + i]) & space.care[block + i];
    }
    if (wrong != 0) return false;
  }
  return true;
}

void drop_redundant_items(const SearchSpace& space, std::vector<TermPtr>& items, bool base) {
  const std::size_t words = space.words();
  const std::vector<Word>& wanted = space.columns->wanted();
  // By item: the cells that it decides, being the first to cover them.
  std::vector<Word> decided(items.size() * words);
  std::vector<Word> open = space.care;
  for (std::size_t k = 0; k < items.size(); ++k) {
    for (std::size_t i = 0; i < words; ++i) {
      decided[k * words + i] = open[i] & items[k]->cover[i];
      open[i] &= ~items[k]->cover[i];
    }
  }
  // From the back: what remains of the list behind an item is what would decide in its place.
  std::vector<Word> behind(words, base ? ~Word{0} : Word{0});
  for (std::size_t k = items.size(); k-- > 0;) {
    const Word* own = decided.data() + k * words;
    Word wrong = 0;
    for (std::size_t i = 0; i < words; ++i) wrong |= (behind[i] ^ wanted[i]) & own[i];
    if (wrong == 0) {
      items.erase(items.begin() + static_cast<long>(k));
      continue;
    }
    const Word fill = items[k]->fills ? ~Word{0} : Word{0};
    for (std::size_t i = 0; i < words; ++i) {
      const Word cover = items[k]->cover[i];
      behind[i] = (behind[i] & ~cover) | (fill & cover);
    }
  }
}

bool replace_item(const SearchSpace& space, DecisionList& list, TermPtr& item, Term term) {
  term.cost = term_cost(term.literals, *space.combinability);
  if (term.cost > item->cost) return false;
  const TermPtr old = std::exchange(item, with_cover(*space.columns, term));
  if (is_right(space, list.items, list.base)) return true;
  item = old;
  return false;
}

TermPtr finished_term(const SearchSpace& space, Term term) {
  term.cost = term_cost(term.literals, *space.combinability);
  return with_cover(*space.columns, term);
}

TermPtr with_cover(const ColumnTable& columns, const Term& term) {
  auto fresh = std::make_shared<Term>(term);
  fresh->cover = columns.all();
  for (const TermLiteral& l : fresh->literals) {
    const Word* column = columns.column(static_cast<std::size_t>(l.halfspace), l.inside);
    for (std::size_t i = 0; i < fresh->cover.size(); ++i) fresh->cover[i] &= column[i];
  }
  return fresh;
}

}  // namespace hewn
