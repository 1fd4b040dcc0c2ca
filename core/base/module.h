#pragma once
/// Parts of the program in libraries of their own, loaded when they are first needed: binding their
/// symbols takes longer than small commands run.
#include "core/base/result.h"

namespace hewn {

/// The address of `symbol` in the library `file`, which lies beside the program, or wherever the
/// loader looks, and stays loaded. Fails with: Internal, whose message is the loader's reason.
Result<void*> module_symbol(const char* file, const char* symbol);

/// What the library's function `symbol`, a `const Functions* ()`, returns. Fails with: the same.
template <class Functions>
Result<const Functions*> module_functions(const char* file, const char* symbol) {
  const Result<void*> address = module_symbol(file, symbol);
  if (!address) return address.error();
  return reinterpret_cast<const Functions* (*)()>(*address)();
}

}  // namespace hewn
