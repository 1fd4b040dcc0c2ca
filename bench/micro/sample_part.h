#pragma once
/// A shipped sample part, ready for each stage's benchmark.
#include <string>

#include "core/mesh/load.h"
#include "tests/support/part_problem.h"

namespace hewn::bench {

/// One thread, so that numbers of different machines compare.
inline RunContext single_thread() {
  RunContext run;
  run.threads = 1;
  return run;
}

/// `file` is a name in assets/.
inline Result<LoadedMesh> load_sample(const std::string& file) {
  return load_mesh(std::string(HEWN_ASSETS) + "/" + file, {}, single_thread());
}

/// The first table of a reconstruction has this many uniform points (`TreeSearchOptions`).
inline constexpr int kVolumePoints = 20000;

}  // namespace hewn::bench
