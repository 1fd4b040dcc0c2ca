#pragma once
/// Trees as OpenSCAD designs.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/csg/tree.h"

namespace hewn {

/// What the header comment tells beside the tree's own counts; unset figures are left out.
struct ScadHeader {
  std::string part = {};                     ///< the design's name
  std::optional<double> proximity = {};      ///< [0, 1]
  std::optional<double> agreement = {};      ///< share of sample points classified right, [0, 1]
  std::optional<double> iou = {};            ///< [0, 1]
  std::optional<double> hausdorff = {};      ///< share of the bounding-box diagonal
  std::optional<double> mean_distance = {};  ///< share of the bounding-box diagonal
  std::vector<std::string> notes = {};       ///< one comment line each
};

struct ScadOptions {
  int segments = 96;          ///< the file's one `$fn`, at least 3
  bool match_facets = false;  ///< literals with known `Facets` print their own sides and phase
  bool extend_tools = true;   ///< flush ends of subtracted literals stick out (csg/protrude.h)
};

/// The design as text: one `$fn`, named nodes as modules, lengths rounded to a decimal grid of at
/// most 1e-6 of the tree's diagonal (coincident faces print as identical numbers), literals of one
/// frame under one `rotate`. Complements are rewritten first.
std::string to_openscad(const Tree& tree, const ScadHeader& header, const ScadOptions& options);

/// Writes the text. Fails with: InvalidArgument (fewer than 3 segments, coordinates that are not
/// finite), FileWrite.
Result<void> write_openscad(const Tree& tree, const std::filesystem::path& path,
                            const ScadHeader& header, const ScadOptions& options);

}  // namespace hewn
