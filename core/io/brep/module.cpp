#include "core/io/brep/module.h"

#include <string>
#include <system_error>

#include <dlfcn.h>

namespace hewn {
namespace {

/// Beside the program, else wherever the loader looks.
void* open_library() {
  std::error_code failed;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failed);
  if (!failed) {
    const std::filesystem::path beside = program.parent_path() / kBrepLibrary;
    if (void* library = ::dlopen(beside.c_str(), RTLD_NOW | RTLD_LOCAL)) return library;
  }
  return ::dlopen(kBrepLibrary, RTLD_NOW | RTLD_LOCAL);
}

}  // namespace

Result<const BrepFunctions*> brep_functions() {
  using Symbol = const BrepFunctions* (*)();
  void* library = open_library();
  void* symbol = library ? ::dlsym(library, kBrepSymbol) : nullptr;
  if (symbol) return reinterpret_cast<Symbol>(symbol)();
  const char* reason = ::dlerror();
  return Error{ErrorCode::Internal,
               std::string("the part of the program that needs OpenCASCADE cannot be loaded (") +
                   (reason ? reason : "no reason given") + "); keep " + kBrepLibrary +
                   " beside the program, or export OpenSCAD or JSON",
               "boundary representation"};
}

}  // namespace hewn
