#include "core/io/brep/faces.h"
#include "core/io/brep/step_file.h"

/// What `brep_functions` looks up.
extern "C" __attribute__((visibility("default"))) const hewn::BrepFunctions* hewn_brep_functions() {
  static constexpr hewn::BrepFunctions kFunctions{hewn::triangulate_brep, hewn::write_step_brep};
  return &kFunctions;
}
