#pragma once
/// What a decision list decides, and whether that is right.
#include <cstddef>
#include <span>
#include <vector>

#include "core/sample/cells.h"
#include "core/synth/decompose/term.h"
#include "core/synth/decompose/term_cost.h"

namespace hewn {

/// The search problem over cells. The pointees must outlive it.
struct SearchSpace {
  const ColumnTable* columns = nullptr;
  const Combinability* combinability = nullptr;
  std::vector<Word> care;  ///< cells that must come out right; all others are don't-cares

  std::size_t words() const { return columns->words(); }
};

/// The cells that the items (and `base` where none covers) put inside the solid.
void evaluate_list(std::span<const TermPtr> items, bool base, std::vector<Word>& inside);

/// Whether every cell that matters comes out as wanted. Cost: O(items x words).
bool is_right(const SearchSpace& space, std::span<const TermPtr> items, bool base);

/// Cells that matter and come out wrong.
std::vector<Word> wrong_cells(const SearchSpace& space, std::span<const TermPtr> items, bool base);

/// Drops items, the last first, as long as the list stays right.
void drop_redundant_items(const SearchSpace& space, std::vector<TermPtr>& items, bool base);

/// Puts `term`, its cost and cover computed anew, in the place of an item, if it is no dearer and
/// the list stays right. `item` is one of the list's.
bool replace_item(const SearchSpace& space, DecisionList& list, TermPtr& item, Term term);

/// A term with its cost and cover, by its literals.
TermPtr finished_term(const SearchSpace& space, Term term);

/// Recomputes a term's cover for other columns.
TermPtr with_cover(const ColumnTable& columns, const Term& term);

}  // namespace hewn
