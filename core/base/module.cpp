#include "core/base/module.h"

#include <filesystem>
#include <system_error>

#include <dlfcn.h>

namespace hewn {
namespace {

void* open_library(const char* file) {
  std::error_code failed;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failed);
  if (!failed) {
    const std::filesystem::path beside = program.parent_path() / file;
    if (void* library = ::dlopen(beside.c_str(), RTLD_NOW | RTLD_LOCAL)) return library;
  }
  return ::dlopen(file, RTLD_NOW | RTLD_LOCAL);
}

}  // namespace

Result<void*> module_symbol(const char* file, const char* symbol) {
  void* const library = open_library(file);
  void* const address = library != nullptr ? ::dlsym(library, symbol) : nullptr;
  if (address != nullptr) return address;
  const char* const reason = ::dlerror();
  return Error{ErrorCode::Internal, reason != nullptr ? reason : "no reason given", file};
}

}  // namespace hewn
