#include "core/session/document.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/session/display_mesh.h"
#include "core/session/report.h"
#include "core/session/settings.h"

namespace hewn {
namespace {

void collect_paths(const PartitionPlan& plan, PartitionPath& path,
                   std::vector<PartitionView>& out) {
  PartitionView view;
  view.path = path;
  view.takes_rest = plan.takes_rest;
  view.colour = plan.colour;
  out.push_back(std::move(view));
  for (std::size_t i = 0; i < plan.children.size(); ++i) {
    path.push_back(static_cast<int>(i));
    collect_paths(plan.children[i], path, out);
    path.pop_back();
  }
}

void drop_colours(PartitionPlan& plan) {
  plan.colour.reset();
  for (PartitionPlan& child : plan.children) drop_colours(child);
}

const char* sign_of(Op op) {
  if (op == Op::Difference) return " - ";
  return op == Op::Intersection ? " * " : " + ";
}

std::string expression_below(const PartitionPlan& plan) {
  std::string text = plan.groups.empty() && !plan.takes_rest ? "" : plan.name;
  for (const PartitionPlan& child : plan.children) {
    const std::string inner = expression_below(child);
    text += text.empty() ? "" : sign_of(child.op);
    text += child.children.empty() ? inner : "(" + inner + ")";
  }
  return text;
}

}  // namespace

std::string plan_text(const Project& project) {
  Project absolute = project;
  std::error_code ignored;
  absolute.mesh = std::filesystem::absolute(project.mesh, ignored);
  return project_text(absolute, "/");
}

std::string search_key(const Project& project) {
  Project plain = project;
  drop_colours(plain.root);
  return plan_text(plain);
}

std::string source_key(const Project& project) {
  const nlohmann::json all = settings_to_json(project.settings);
  nlohmann::json key = {{"mesh", std::filesystem::path(project.mesh).string()},
                        {"seed", project.seed}};
  for (const char* section : {"load", "segment", "curvature"}) key[section] = all.at(section);
  return key.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Result<Document> with_source(Document document, std::shared_ptr<const SegmentedMesh> source,
                             const RunContext& run) {
  const PreparedMesh& plain = source->prepared;
  document.display = nullptr;
  if (document.project.cuts.empty() && document.project.merges.empty()) {
    document.prepared = std::make_shared<const PreparedMesh>(plain);
  } else {
    auto edited = apply_edits(document.project, plain.mesh, plain.segmentation, run);
    if (!edited) return edited.error();
    document.prepared = std::make_shared<const PreparedMesh>(std::move(*edited));
  }
  document.source = std::move(source);
  return document;
}

Result<Document> read_source(const Document& document, const RunContext& run) {
  Project plain = document.project;
  plain.cuts.clear();
  plain.merges.clear();
  RunContext own = run;
  own.seed = plain.seed;
  auto read = segment_project(plain, own);
  if (!read) return read.error();
  return with_source(document, std::make_shared<const SegmentedMesh>(std::move(*read)), own);
}

void add_display(Document& document) {
  if (!document.prepared || document.display) return;
  document.display = std::make_shared<const DisplayMesh>(build_display_mesh(*document.prepared));
}

std::vector<GroupRef> refer_to(const PreparedMesh& prepared, const std::vector<int>& groups) {
  std::vector<GroupRef> refs;
  refs.reserve(groups.size());
  for (const int g : groups) {
    refs.push_back({point_on_group(*prepared.mesh, prepared.segmentation.groups[g]), -1});
  }
  return refs;
}

std::vector<PartitionView> partition_views(const Document& document) {
  std::vector<PartitionView> views;
  if (!document.is_ready()) return views;
  auto partitions = resolve_partitions(document.project, *document.prepared, RunContext{});
  if (!partitions) return views;
  PartitionPath path;
  collect_paths(document.project.root, path, views);
  for (std::size_t i = 0; i < views.size(); ++i) {
    views[i].partition = std::move((*partitions)[i]);
  }
  return views;
}

const PartitionPlan* find_partition(const PartitionPlan& root, const PartitionPath& path) {
  const PartitionPlan* plan = &root;
  for (const int child : path) {
    if (child < 0 || static_cast<std::size_t>(child) >= plan->children.size()) return nullptr;
    plan = &plan->children[child];
  }
  return plan;
}

PartitionPlan* find_partition(PartitionPlan& root, const PartitionPath& path) {
  return const_cast<PartitionPlan*>(find_partition(std::as_const(root), path));  // NOLINT: same
}

std::string expression_text(const PartitionPlan& root) { return expression_below(root); }

}  // namespace hewn
