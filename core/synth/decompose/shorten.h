#pragma once
/// Cutting tools that end where there is nothing left to cut.
#include <vector>

#include "core/csg/tree.h"

namespace hewn {

/// A literal of a tree, and the same one with some flat ends further in.
struct Shortening {
  int literal = 0;
  Literal shorter;
};

/// Moves ends in, one by one, wherever the tree's solid stays: on random points of all that is
/// united in what the literal gives up, and in the end on lines through the tree. Same result on
/// every run, with any number of threads.
/// Cost: O(ends x literals) values of the tree at some dozens of points and on some thousands of
/// lines.
void shorten_tools(Tree& tree, const std::vector<Shortening>& wanted, int threads = 1);

}  // namespace hewn
