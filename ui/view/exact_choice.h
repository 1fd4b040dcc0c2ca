#pragma once
/// Whether a result is drawn exactly, ray by ray, or as triangles.
#include <string>

namespace hewn {

/// What the user asks for.
enum class ExactMode { Auto, On, Off };

/// Pictures slower than this are drawn as triangles while the view moves or a job runs ...
inline constexpr double kMovingExact_ms = 40;
/// ... and at rest.
inline constexpr double kRestingExact_ms = 250;

/// What exact pictures of the present tree have cost; below 0: not known yet.
struct ExactCost {
  double rough_ms = -1;  ///< with one sample a pixel
  double full_ms = -1;   ///< with all of them
};

struct ExactSituation {
  bool is_possible = false;  ///< there is a tree that the shaders can draw
  bool is_hurried = false;   ///< the view moves, or a job needs the processor
  bool is_rough = false;     ///< the picture gets one sample a pixel
};

/// Whether a small picture is to be tried first, to learn what a whole one costs: automatically, at
/// rest, while nothing is known.
bool needs_trial(ExactMode mode, const ExactSituation& situation, const ExactCost& cost);

/// The choice. Automatic: the time that pictures have taken decides; unknown is too long.
bool draws_exactly(ExactMode mode, const ExactSituation& situation, const ExactCost& cost);

/// For a caption: "exact, 38 ms", "triangles: exact pictures take 900 ms". `problem`: why the tree
/// cannot be drawn exactly; empty: it can.
std::string exact_text(ExactMode mode, bool is_exact, const ExactCost& cost,
                       const std::string& problem);

}  // namespace hewn
