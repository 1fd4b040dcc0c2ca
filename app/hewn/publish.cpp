#include "app/hewn/publish.h"

#include <mutex>

namespace hewn {

Result<void> check_outputs(const std::vector<std::string>& paths) {
  if (auto known = check_tree_extension(paths.front()); !known) return known;
  for (const std::string& path : paths) {
    if (path.empty() || path == "-") continue;
    if (auto possible = check_output(path); !possible) return possible;
  }
  return {};
}

Result<void> publish_tree(const Tree& tree, const std::string& path, const TreeFileOptions& options,
                          Environment& environment,
                          const std::function<Result<void>()>& write_others) {
  const auto content = tree_file(tree, path, options, environment.run);
  if (!content) return content.error();
  const std::lock_guard lock(environment.interrupt->publishing());
  if (environment.run.is_cancelled()) return RunContext::cancelled();
  if (auto done = write_tree_file(*content, path); !done) return done;
  return write_others ? write_others() : Result<void>{};
}

}  // namespace hewn
