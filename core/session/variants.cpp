#include "core/session/variants.h"

#include <utility>

#include "core/base/counted.h"

namespace hewn {

std::vector<Variant> search_variants(const Project& plan) {
  std::vector<Variant> all;
  const auto add = [&all, &plan](std::string name, auto change) {
    Project variant = plan;
    variant.edits.clear();
    change(variant.settings.tree);
    all.push_back({std::move(name), std::move(variant)});
  };
  for (const int starts : {1, 8}) {
    add(counted(starts, "start", "starts"), [starts](auto& tree) { tree.starts = starts; });
  }
  for (const int rounds : {0, 1}) {
    add(counted(rounds, "round", "rounds"), [rounds](auto& tree) {
      tree.rounds = rounds;
      tree.stray_rounds = 0;
    });
  }
  add("beam of 2", [](auto& tree) { tree.beam_width = 2; });
  add("brief search", [](auto& tree) { tree.neighbourhood_steps = 200; });
  return all;
}

}  // namespace hewn
