#include "core/io/brep/module.h"

#include <string>

#include "core/base/module.h"

namespace hewn {

Result<const BrepFunctions*> brep_functions() {
  const auto functions = module_functions<BrepFunctions>(kBrepLibrary, kBrepSymbol);
  if (functions) return functions;
  return Error{ErrorCode::Internal,
               "the part of the program that needs OpenCASCADE cannot be loaded (" +
                   functions.error().message + "); keep " + kBrepLibrary +
                   " beside the program, or export OpenSCAD or JSON",
               "boundary representation"};
}

}  // namespace hewn
