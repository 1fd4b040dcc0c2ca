#include "core/io/step.h"

#include "core/io/brep/module.h"

namespace hewn {

Result<void> write_step(const Tree& tree, const std::filesystem::path& path,
                        const RunContext& run) {
  const Result<const BrepFunctions*> functions = brep_functions();
  if (!functions) return functions.error();
  const Tree plain = without_complements(tree);
  return (*functions)->write_step({plain, plain.bounds()}, path, run);
}

}  // namespace hewn
