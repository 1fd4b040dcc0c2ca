#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "core/session/command.h"
#include "core/session/settings.h"

namespace hewn {
namespace {

Error refused(std::string message) { return {ErrorCode::InvalidArgument, std::move(message)}; }

/// Which groups each partition owns, parents first.
using Members = std::vector<std::vector<int>>;

void visit_plans(PartitionPlan& plan, const std::function<void(PartitionPlan&)>& visit) {
  visit(plan);
  for (PartitionPlan& child : plan.children) visit_plans(child, visit);
}

/// Takes out partitions that have nothing left; the root stays.
void prune(PartitionPlan& plan) {
  for (PartitionPlan& child : plan.children) prune(child);
  std::erase_if(plan.children, [](const PartitionPlan& p) {
    return p.groups.empty() && !p.takes_rest && p.children.empty();
  });
}

bool has_rest(const PartitionPlan& plan) {
  return plan.takes_rest || std::any_of(plan.children.begin(), plan.children.end(), has_rest);
}

/// Prunes, and sees that groups nobody owns have a place.
void tidy(PartitionPlan& root) {
  prune(root);
  if (!has_rest(root) && root.groups.empty()) root.takes_rest = true;
}

std::string fresh_name(PartitionPlan& root) {
  std::vector<std::string> taken;
  visit_plans(root, [&taken](PartitionPlan& plan) { taken.push_back(plan.name); });
  for (int i = 1;; ++i) {
    std::string name = fmt::format("part {}", i);
    if (std::find(taken.begin(), taken.end(), name) == taken.end()) return name;
  }
}

class Editor {
  // Ahead of its use: clang 14 takes it for undefined otherwise.
  template <class NotAnEdit>
  Result<void> edit(const NotAnEdit&) {
    return refused("this command does not edit the plan");
  }

 public:
  Editor(const Document& before, const RunContext& run)
      : before_(before), next_(before), run_(run) {}

  Result<Document> carry_out(const SessionCommand& command) {
    const bool keeps_edits = std::holds_alternative<EditLiteral>(command) ||
                             std::holds_alternative<SetPlan>(command) ||
                             std::holds_alternative<RenamePartition>(command) ||
                             std::holds_alternative<ColourPartition>(command);
    if (!keeps_edits) next_.project.edits.clear();
    const Result<void> done =
        std::visit([this](const auto& c) -> Result<void> { return edit(c); }, command);
    if (!done) return done.error();
    if (plan_text(next_.project) == plan_text(before_.project)) {
      return refused("nothing would change");
    }
    return std::move(next_);
  }

 private:
  // Cuts and merges -----------------------------------------------------------------------------

  Result<void> edit(const AddCut& command) {
    auto groups = groups_of(command.cut.groups);
    if (!groups) return groups.error();
    if (!(std::abs(command.cut.normal.norm() - 1) < 1e-9)) return refused("the normal is not unit");
    CutStep cut = command.cut;
    if (before_.project.merges.empty()) {
      cut.groups = refer_to(*before_.prepared, *groups);
      next_.project.cuts.push_back(cut);
    } else if (auto done = cut_merged(std::move(cut), *groups); !done) {
      return done;
    }
    if (auto done = derive_groups(); !done) return done;
    if (next_.prepared->segmentation.groups.size() ==
        before_.prepared->segmentation.groups.size()) {
      return refused("the plane passes through none of the groups");
    }
    return {};
  }

  Result<void> edit(const MoveCut& command) {
    if (!has_cut(command.cut)) return no_cut(command.cut);
    if (!(std::abs(command.normal.norm() - 1) < 1e-9)) return refused("the normal is not unit");
    next_.project.cuts[command.cut].normal = command.normal;
    next_.project.cuts[command.cut].offset = command.offset;
    return derive_groups();
  }

  Result<void> edit(const DeleteCut& command) {
    if (!has_cut(command.cut)) return no_cut(command.cut);
    next_.project.cuts.erase(next_.project.cuts.begin() + command.cut);
    return derive_groups();
  }

  Result<void> edit(const MergeGroups& command) {
    auto groups = groups_of(command.groups);
    if (!groups) return groups.error();
    if (groups->size() < 2) return refused("select at least two groups to merge");
    next_.project.merges.push_back(refer_to(*before_.prepared, *groups));
    return derive_groups();
  }

  Result<void> edit(const DeleteMerge& command) {
    const auto count = next_.project.merges.size();
    if (command.merge < 0 || static_cast<std::size_t>(command.merge) >= count) {
      return refused(fmt::format("there is no merge {}", command.merge));
    }
    next_.project.merges.erase(next_.project.merges.begin() + command.merge);
    return derive_groups();
  }

  // Partitions ----------------------------------------------------------------------------------

  Result<void> edit(const AddPartition& command) {
    constexpr std::size_t kDeepest = 60;  // project files end at 64
    if (command.parent.size() >= kDeepest) return refused("partitions nest too deep");
    auto groups = groups_of(command.groups);
    if (!groups) return groups.error();
    if (groups->empty()) return refused("select the groups of the new partition first");
    if (!find_partition(next_.project.root, command.parent)) return no_partition();
    if (auto done = release(*groups); !done) return done;
    PartitionPlan plan;
    plan.name = command.name.empty() ? fresh_name(next_.project.root) : command.name;
    plan.op = command.op;
    plan.groups = refer_to(*before_.prepared, *groups);
    find_partition(next_.project.root, command.parent)->children.push_back(std::move(plan));
    tidy(next_.project.root);
    return {};
  }

  Result<void> edit(const AssignGroups& command) {
    auto groups = groups_of(command.groups);
    if (!groups) return groups.error();
    if (!find_partition(next_.project.root, command.partition)) return no_partition();
    if (auto done = release(*groups); !done) return done;
    PartitionPlan& plan = *find_partition(next_.project.root, command.partition);
    if (!plan.takes_rest) {
      const auto refs = refer_to(*before_.prepared, *groups);
      plan.groups.insert(plan.groups.end(), refs.begin(), refs.end());
    }
    tidy(next_.project.root);
    return {};
  }

  Result<void> edit(const RemovePartition& command) {
    if (command.partition.empty()) return refused("the outermost partition stays");
    PartitionPath parent(command.partition.begin(), command.partition.end() - 1);
    if (!find_partition(next_.project.root, command.partition)) return no_partition();
    auto& children = find_partition(next_.project.root, parent)->children;
    children.erase(children.begin() + command.partition.back());
    if (!has_rest(next_.project.root)) next_.project.root.takes_rest = true;
    tidy(next_.project.root);
    return {};
  }

  Result<void> edit(const RenamePartition& command) {
    PartitionPlan* plan = find_partition(next_.project.root, command.partition);
    if (!plan) return no_partition();
    if (command.name.empty()) return refused("a partition needs a name");
    plan->name = command.name;
    return {};
  }

  Result<void> edit(const ColourPartition& command) {
    PartitionPlan* plan = find_partition(next_.project.root, command.partition);
    if (!plan) return no_partition();
    plan->colour = command.colour;
    return {};
  }

  Result<void> edit(const SetPartitionOp& command) {
    if (command.partition.empty()) return refused("the outermost partition has no operation");
    PartitionPlan* plan = find_partition(next_.project.root, command.partition);
    if (!plan) return no_partition();
    plan->op = command.op;
    return {};
  }

  Result<void> edit(const MovePartition& command) {
    const PartitionPath& from = command.partition;
    PartitionPath to = command.parent;
    if (from.empty()) return refused("the outermost partition stays outermost");
    const bool is_inside =
        to.size() >= from.size() && std::equal(from.begin(), from.end(), to.begin());
    if (is_inside) return refused("a partition cannot hang below itself");
    if (!find_partition(next_.project.root, from) || !find_partition(next_.project.root, to)) {
      return no_partition();
    }
    const PartitionPath parent(from.begin(), from.end() - 1);
    auto& siblings = find_partition(next_.project.root, parent)->children;
    PartitionPlan moved = std::move(siblings[from.back()]);
    siblings.erase(siblings.begin() + from.back());
    // The place of the new parent shifts when it stood behind the moved one among its siblings.
    const bool shifts = to.size() >= from.size() &&
                        std::equal(parent.begin(), parent.end(), to.begin()) &&
                        to[from.size() - 1] > from.back();
    if (shifts) --to[from.size() - 1];
    auto& target = find_partition(next_.project.root, to)->children;
    const int last = static_cast<int>(target.size());
    target.insert(target.begin() + std::clamp(command.position, 0, last), std::move(moved));
    tidy(next_.project.root);
    return {};
  }

  // Settings ------------------------------------------------------------------------------------

  Result<void> edit(const SetOption& command) {
    for (const OptionSection& section : bind_settings(next_.project.settings)) {
      if (section.name != command.section) continue;
      for (const OptionRef& option : section.options) {
        if (option.name != command.option) continue;
        if (auto done = set_option(option, command.text); !done) return done;
        return follow_source();
      }
    }
    return refused(fmt::format("there is no option {}-{}", command.section, command.option));
  }

  Result<void> edit(const SetSeed& command) {
    next_.project.seed = command.seed;
    return follow_source();
  }

  Result<void> edit(const EditLiteral& command) {
    if (command.edit.literal < 0 || command.edit.field.empty() ||
        !std::isfinite(command.edit.value)) {
      return refused("an edit needs a literal, a field and a number");
    }
    std::erase_if(next_.project.edits, [&command](const LiteralEdit& e) {
      return e.literal == command.edit.literal && e.field == command.edit.field;
    });
    next_.project.edits.push_back(command.edit);
    return {};
  }

  Result<void> edit(const SetPlan& command) {
    auto project = parse_project(command.plan, "/");
    if (!project) return project.error();
    const bool is_same_mesh = plan_text_mesh(*project) == plan_text_mesh(before_.project);
    if (!is_same_mesh) return refused("the plan is for another mesh");
    project->mesh = before_.project.mesh;
    next_.project = std::move(*project);
    if (auto done = follow_source(); !done || !next_.source) return done;
    return next_.project.cuts.size() + next_.project.merges.size() + before_.project.cuts.size() +
                       before_.project.merges.size() ==
                   0
               ? Result<void>{}
               : derive_prepared();
  }

  // Helpers -------------------------------------------------------------------------------------

  static std::filesystem::path plan_text_mesh(const Project& project) {
    std::error_code ignored;
    return std::filesystem::absolute(project.mesh, ignored).lexically_normal();
  }

  bool has_cut(int cut) const {
    return cut >= 0 && static_cast<std::size_t>(cut) < next_.project.cuts.size();
  }
  static Error no_cut(int cut) { return refused(fmt::format("there is no cut {}", cut)); }
  static Error no_partition() { return refused("there is no such partition"); }

  Result<std::vector<int>> groups_of(const std::vector<GroupRef>& refs) const {
    if (!before_.is_ready()) {
      return refused("the mesh is still being divided into groups; wait until it is done");
    }
    return find_groups(*before_.prepared, refs, "selection");
  }

  /// Takes groups away from the partitions that own them.
  Result<void> release(const std::vector<int>& groups) {
    Result<void> outcome;
    visit_plans(next_.project.root, [&](PartitionPlan& plan) {
      std::erase_if(plan.groups, [&](const GroupRef& ref) {
        const auto found = find_groups(*before_.prepared, {ref}, "partition " + plan.name);
        if (!found) {
          outcome = found.error();
          return false;
        }
        return std::binary_search(groups.begin(), groups.end(), found->front());
      });
    });
    return outcome;
  }

  /// Drops the mesh when the options that shape its groups have changed; a job reads it anew.
  Result<void> follow_source() {
    if (source_key(next_.project) == source_key(before_.project)) return {};
    next_.source = nullptr;
    next_.prepared = nullptr;
    next_.display = nullptr;
    return {};
  }

  Result<void> derive_prepared() {
    if (!next_.source) return refused("the mesh is still being divided into groups");
    auto next = with_source(next_, next_.source, run_);
    if (!next) return next.error();
    next_ = std::move(*next);
    return {};
  }

  /// Carries out changed cuts and merges, and gives the new pieces to the partitions that own what
  /// they are made from.
  Result<void> derive_groups() {
    if (!before_.is_ready()) return refused("the mesh is still being divided into groups");
    const auto members = resolve_partitions(before_.project, *before_.prepared, RunContext{});
    if (!members) return members.error();
    if (only_appends()) {
      if (auto done = append_last(); !done) return done;
    } else if (auto done = derive_prepared(); !done) {
      return done;
    }
    std::size_t at = 0;
    visit_plans(next_.project.root, [&](PartitionPlan& plan) {
      const Partition& old = (*members)[at++];
      if (plan.takes_rest || plan.groups.empty()) return;
      plan.groups = refer_to(*next_.prepared, made_from(old.groups));
    });
    tidy(next_.project.root);
    return {};
  }

  /// Cuts come before merges in a plan: a cut through a merged group must divide all that it is
  /// made of, and each side is merged again by itself.
  Result<void> cut_merged(CutStep cut, const std::vector<int>& groups) {
    if (!before_.source) return refused("the mesh is still being divided into groups");
    const PreparedMesh& plain = before_.source->prepared;
    Project unmerged = before_.project;
    unmerged.merges.clear();
    auto base = apply_edits(unmerged, plain.mesh, plain.segmentation, run_);
    if (!base) return base.error();
    // Merging leaves the triangles as they are.
    std::vector<int> merged_of;
    for (const FaceGroup& group : base->segmentation.groups) {
      merged_of.push_back(
          before_.prepared->segmentation.group_of_triangle[group.triangles.front()]);
    }
    const auto is_cut = [&groups](int merged) {
      return groups.empty() || std::binary_search(groups.begin(), groups.end(), merged);
    };
    std::vector<int> divided;
    for (std::size_t g = 0; g < merged_of.size(); ++g) {
      if (!groups.empty() && is_cut(merged_of[g])) divided.push_back(static_cast<int>(g));
    }
    cut.groups = refer_to(*base, divided);
    next_.project.cuts.push_back(cut);
    Project last;
    last.cuts = {cut};
    auto pieces = apply_edits(last, base->mesh, base->segmentation, run_);
    if (!pieces) return pieces.error();
    // By merged group and side.
    std::map<std::pair<int, bool>, std::vector<int>> sets;
    for (std::size_t g = 0; g < pieces->segmentation.groups.size(); ++g) {
      const Vec3 at = *refer_to(*pieces, {static_cast<int>(g)}).front().at;
      const ClosestPoint from = base->query->closest(at);
      if (from.triangle < 0) continue;
      const int merged = merged_of[base->segmentation.group_of_triangle[from.triangle]];
      const bool is_above = is_cut(merged) && cut.normal.dot(at) > cut.offset;
      sets[{merged, is_above}].push_back(static_cast<int>(g));
    }
    next_.project.merges.clear();
    for (const auto& [place, set] : sets) {
      if (set.size() > 1) next_.project.merges.push_back(refer_to(*pieces, set));
    }
    return {};
  }

  /// Whether the new plan is the old one with a cut or merge behind all others.
  bool only_appends() const {
    const Project& a = before_.project;
    const Project& b = next_.project;
    const bool cut = b.cuts.size() == a.cuts.size() + 1 && b.merges.empty();
    const bool merge = b.merges.size() == a.merges.size() + 1 && b.cuts.size() == a.cuts.size();
    return cut || merge;
  }

  Result<void> append_last() {
    Project last = next_.project;
    const bool is_merge = last.merges.size() > before_.project.merges.size();
    last.cuts.erase(last.cuts.begin(), is_merge ? last.cuts.end() : last.cuts.end() - 1);
    if (is_merge) last.merges.erase(last.merges.begin(), last.merges.end() - 1);
    auto prepared = apply_edits(last, before_.prepared->mesh, before_.prepared->segmentation, run_);
    if (!prepared) return prepared.error();
    next_.prepared = std::make_shared<const PreparedMesh>(std::move(*prepared));
    next_.display = nullptr;
    return {};
  }

  /// The new groups that lie on any of the old ones.
  std::vector<int> made_from(const std::vector<int>& old_groups) {
    if (origin_.empty()) {
      const auto& groups = next_.prepared->segmentation.groups;
      for (std::size_t g = 0; g < groups.size(); ++g) {
        const GroupRef ref = refer_to(*next_.prepared, {static_cast<int>(g)}).front();
        const ClosestPoint at = before_.prepared->query->closest(*ref.at);
        origin_.push_back(
            at.triangle < 0 ? -1 : before_.prepared->segmentation.group_of_triangle[at.triangle]);
      }
    }
    std::vector<int> out;
    for (std::size_t g = 0; g < origin_.size(); ++g) {
      if (std::binary_search(old_groups.begin(), old_groups.end(), origin_[g])) {
        out.push_back(static_cast<int>(g));
      }
    }
    return out;
  }

  const Document& before_;
  Document next_;
  const RunContext& run_;
  std::vector<int> origin_;  ///< for each new group, the old one it lies on
};

}  // namespace

Result<Document> edited(const Document& document, const SessionCommand& command,
                        const RunContext& run) {
  return Editor(document, run).carry_out(command);
}

}  // namespace hewn
