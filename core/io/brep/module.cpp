#include "core/io/brep/module.h"

#include <string>

#include "core/base/module.h"

namespace hewn {

Result<const BrepFunctions*> brep_functions() {
  using Symbol = const BrepFunctions* (*)();
  const Result<void*> symbol = module_symbol(kBrepLibrary, kBrepSymbol);
  if (symbol) return reinterpret_cast<Symbol>(*symbol)();
  return Error{ErrorCode::Internal,
               "the part of the program that needs OpenCASCADE cannot be loaded (" +
                   symbol.error().message + "); keep " + kBrepLibrary +
                   " beside the program, or export OpenSCAD or JSON",
               "boundary representation"};
}

}  // namespace hewn
