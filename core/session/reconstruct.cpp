#include "core/session/reconstruct.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/compute/compute.h"
#include "core/compute/parallel.h"
#include "core/csg/protrude.h"
#include "core/segment/segment.h"
#include "core/session/draft_board.h"
#include "core/session/found_partitions.h"
#include "core/session/free_form.h"
#include "core/session/join_partitions.h"
#include "core/session/part_report.h"

namespace hewn {
namespace {

/// A tree that shares less with the mesh is of no use; designs come out above 0.97 even where the
/// mesh is as coarse as a dodecagon.
constexpr double kLeastIou = 0.9;

/// Free-form faces from which a tree of all their planes is not even tried.
constexpr int kManyFreeForm = 200;

/// Measures the time since it was made or last asked.
class StopWatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> passed = now - start_;
    start_ = now;
    return passed.count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Joins the progress of partitions that are searched side by side.
class SharedProgress {
 public:
  SharedProgress(const RunContext& run, std::size_t count) : run_(run), shares_(count, 0) {}

  RunContext context_for(std::size_t i, PartReport& part) {
    RunContext own = run_;
    own.on_progress = [this, i, &part](const char* stage, double share) {
      part.running(stage, share);
      update(i, stage, share);
    };
    return own;
  }

 private:
  void update(std::size_t i, const char* stage, double share) {
    double sum = 0;
    {
      const std::lock_guard lock(mutex_);
      shares_[i] = std::max(shares_[i], share);
      for (const double s : shares_) sum += s;
    }
    run_.report(stage, sum / static_cast<double>(shares_.size()));
  }

  const RunContext& run_;
  std::mutex mutex_;
  std::vector<double> shares_;
};

/// The mesh as a literal: what is left when no primitive explains it.
Tree polyhedron_tree(const PreparedMesh& prepared) {
  Literal literal;
  literal.kind = SolidKind::Polyhedron;
  literal.polyhedron = prepared.mesh;
  literal.polyhedron_query = prepared.query;
  Tree tree;
  tree.root = tree.add_literal(std::move(literal));
  return tree;
}

/// Whether all vertices lie in one plane.
bool is_flat(const Mesh& mesh) {
  const auto largest = std::max_element(mesh.areas.begin(), mesh.areas.end());
  if (largest == mesh.areas.end()) return true;
  const auto t = static_cast<int>(largest - mesh.areas.begin());
  const double reach = 1e-7 * mesh.diagonal();
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [&](const Vec3& v) {
    return std::abs(mesh.normals[t].dot(v - mesh.corner(t, 0))) <= reach;
  });
}

}  // namespace

RunContext beside_search(const RunContext& run) {
  RunContext quiet = run;
  quiet.threads = 1;
  quiet.on_progress = {};
  quiet.on_log = {};
  return quiet;
}

namespace {

class Reconstructor {
 public:
  Reconstructor(const Project& project, const RunContext& run) : project_(project), run_(run) {
    run_.seed = project.seed;
    // Warnings go to the report as well as to the caller, in the order in which they came.
    run_.on_log = [this, forward = run.on_log](const LogEntry& entry) {
      // What is said of the machine must not change what is written.
      if (entry.severity != Severity::Info && !entry.is_about_machine) {
        const std::lock_guard lock(mutex_);
        out_.warnings.push_back(entry.message);
      }
      if (forward) forward(entry);
    };
    if (run_.compute) run_.compute->choose(project.settings.device.choice());
    run_.compute = compute_of(run_);
    run_.compute->prepare(run_);
  }

  void tell(const SearchWatch& watch) { watch_ = watch; }

  /// Of stages that ran before this object was made.
  void keep_warnings(const std::vector<std::string>& warnings) { out_.warnings = warnings; }

  Result<SegmentedMesh> prepare() {
    StopWatch watch;
    SegmentedMesh out;
    run_.report("load", 0);
    auto loaded = load_mesh(project_.mesh, project_.settings.load, run_);
    if (!loaded) return loaded.error();
    out.report = std::move(loaded->report);
    for (const std::string& warning : out.report.warnings) run_.warn(warning);
    if (is_flat(loaded->mesh)) {
      return Error{
          ErrorCode::BadMesh,
          fmt::format("the mesh is flat and open ({} triangles in one plane): it bounds no "
                      "solid; export the whole part",
                      loaded->mesh.triangles.size()),
          project_.mesh.string()};
    }
    out.times.push_back({"load", watch.lap()});

    run_.report("segment", 0);
    auto mesh = std::make_shared<const Mesh>(std::move(loaded->mesh));
    auto groups = segment(*mesh, project_.settings.segment, run_);
    if (!groups) return groups.error();
    out.times.push_back({"segment", watch.lap()});

    auto prepared = apply_edits(project_, std::move(mesh), std::move(*groups), run_);
    if (!prepared) return prepared.error();
    out.prepared = std::move(*prepared);
    out.times.push_back({"edit", watch.lap()});
    return out;
  }

  Result<Reconstruction> run() {
    auto segmented = prepare();
    if (!segmented) return segmented.error();
    return run(std::move(*segmented));
  }

  Result<Reconstruction> run(SegmentedMesh segmented) {
    out_.mesh_report = std::move(segmented.report);
    out_.prepared = std::move(segmented.prepared);
    out_.times = std::move(segmented.times);

    StopWatch watch;
    if (auto regular = regularise_groups(); !regular) return regular.error();
    out_.times.push_back({"regularise", watch.lap()});

    auto partitions = resolve_partitions(project_, out_.prepared, run_);
    if (!partitions) return partitions.error();
    auto trees = search(*partitions);
    if (!trees) return trees.error();
    out_.tree = with_protruding_tools(flattened(join_partitions(*partitions, *trees)));
    out_.times.push_back({"search", watch.lap()});

    auto score = score_tree(*out_.prepared.query, out_.tree, project_.settings.verify, run_);
    if (!score) return score.error();
    if (score->iou < kLeastIou && keep_whole_mesh()) {
      score = score_tree(*out_.prepared.query, out_.tree, project_.settings.verify, run_);
      if (!score) return score.error();
    }
    if (auto useful = check_likeness(*score); !useful) return useful.error();
    out_.score = *score;
    out_.times.push_back({"verify", watch.lap()});
    return with_edits(std::move(out_), project_, run_);
  }

 private:
  /// Puts the mesh itself in the place of a tree that is no likeness of it. False when there are
  /// several partitions, whose plan is the user's, or the mesh is open.
  bool keep_whole_mesh() {
    if (out_.partitions.size() != 1 || !out_.mesh_report.is_closed) return false;
    run_.warn("the tree found is not close to the mesh: it is kept as a polyhedron");
    out_.tree = polyhedron_tree(out_.prepared);
    out_.partitions[0].answer.tree = out_.tree;
    out_.partitions[0].is_polyhedron = true;
    return true;
  }

  /// What is left unlike the mesh is said; a tree of nothing is no answer.
  Result<void> check_likeness(const TreeScore& score) {
    if (score.iou >= kLeastIou) return {};
    const MeshReport& mesh = out_.mesh_report;
    const std::string advice = mesh.is_closed
                                   ? "see whether the partitions cover all groups"
                                   : fmt::format("close the mesh's {} holes ({} boundary edges)",
                                                 mesh.holes, mesh.boundary_edges);
    if (out_.tree.is_empty()) {
      return Error{ErrorCode::NotFound,
                   "the tree found is empty: nothing is surely inside; " + advice};
    }
    run_.warn(
        fmt::format("the tree shares only {:.0f} % of its volume with what the mesh encloses; {}",
                    100 * score.iou, advice));
    return {};
  }

  /// A mesh in more pieces than any design has is free-form: it gets no halfspaces, and the search
  /// then keeps it as a polyhedron.
  Result<void> regularise_groups() {
    constexpr std::size_t kMaxGroups = 8000;
    const Segmentation& segmentation = out_.prepared.segmentation;
    if (segmentation.groups.size() > kMaxGroups) {
      out_.surfaces.halfspace_of_group.assign(segmentation.groups.size(), -1);
      out_.surfaces.unexplained_area = 1;
      return {};
    }
    auto surfaces =
        regularise(*out_.prepared.mesh, segmentation, project_.settings.regularise, run_);
    if (!surfaces) return surfaces.error();
    out_.surfaces = std::move(*surfaces);
    return {};
  }

  using Answers = std::vector<std::optional<Result<PartitionResult>>>;

  /// Finds the tree of every partition that has groups, side by side.
  Result<std::vector<std::optional<Tree>>> search(const std::vector<Partition>& partitions) {
    std::vector<std::size_t> work;
    std::vector<bool> searched;
    std::vector<PartReport> reports;
    reports.reserve(partitions.size());
    for (std::size_t p = 0; p < partitions.size(); ++p) {
      searched.push_back(!partitions[p].groups.empty());
      if (!searched.back()) continue;
      work.push_back(p);
      reports.emplace_back(watch_.board, partitions[p].name);
    }
    if (work.empty()) {
      return Error{ErrorCode::InvalidArgument, "no partition has a face group: nothing to do"};
    }
    DraftBoard drafts(searched, [&](const auto& trees) { show_draft(partitions, trees); });
    SharedProgress progress(run_, work.size());
    Answers answers(partitions.size());
    std::atomic<std::size_t> ended{0};
    for_each_index(run_.threads, work.size(), [&](std::size_t i) {
      const std::size_t p = work[i];
      DraftSink on_draft;
      if (watch_.on_draft) on_draft = [&, p](const auto& make) { drafts.update(p, make); };
      reports[i].begin();
      RunContext own = progress.context_for(i, reports[i]);
      if (watch_.board) own.cancel = watch_.board->token_for(partitions[p].name, run_.cancel);
      answers[p] = find_one(partitions[p], on_draft, own);
      reports[i].end(*answers[p]);
      const bool is_last = ++ended == work.size();
      if (on_draft && *answers[p] && !is_last) on_draft([&] { return (*answers[p])->answer.tree; });
    });
    return collect(std::move(answers));
  }

  /// The partitions' trees; the rest of their answers goes to the result.
  Result<std::vector<std::optional<Tree>>> collect(Answers answers) {
    std::vector<std::optional<Tree>> trees(answers.size());
    for (std::size_t p = 0; p < answers.size(); ++p) {
      if (!answers[p]) continue;
      auto& answer = *answers[p];
      if (!answer) return answer.error();
      if (answer->is_polyhedron) {
        run_.warn(
            fmt::format("no primitives explain '{}': it is kept as a polyhedron", answer->name));
      }
      if (answer->free_form_share > 0) {
        run_.warn(fmt::format("{:.2g} % of the surface is free-form: kept as a polyhedron",
                              100 * answer->free_form_share));
      }
      trees[p] = answer->answer.tree;
      out_.partitions.push_back(std::move(*answer));
    }
    return trees;
  }

  void show_draft(const std::vector<Partition>& partitions,
                  const std::vector<std::optional<Tree>>& trees) const {
    Reconstruction draft;
    draft.mesh_report = out_.mesh_report;
    draft.prepared = out_.prepared;
    draft.surfaces = out_.surfaces;
    draft.tree = flattened(join_partitions(partitions, trees));
    const RunContext quiet = beside_search(run_);
    auto score = score_tree(*draft.prepared.query, draft.tree, project_.settings.verify, quiet);
    if (!score) return;
    draft.score = *score;
    watch_.on_draft(std::move(draft));
  }

  /// From the memory, or by a search.
  Result<PartitionResult> find_one(const Partition& partition, const DraftSink& on_draft,
                                   const RunContext& run) const {
    if (!watch_.found) return described(partition, search_one(partition, on_draft, run));
    const std::string key = partition_key(project_, partition);
    if (const auto known = watch_.found->find(key)) return described(partition, *known);
    auto result = search_one(partition, on_draft, run);
    if (result) watch_.found->keep(key, *result);
    return described(partition, std::move(result));
  }

  /// With what is the partition's own, however its tree was found.
  Result<PartitionResult> described(const Partition& partition,
                                    Result<PartitionResult> result) const {
    if (!result) return result;
    result->name = partition.name;
    result->op = name_of(partition.op);
    result->groups = static_cast<int>(partition.groups.size());
    result->area_share = 0;
    for (const int g : partition.groups) {
      result->area_share += out_.prepared.segmentation.groups[g].area;
    }
    result->area_share /= out_.prepared.mesh->total_area;
    return result;
  }

  Result<PartitionResult> search_one(const Partition& partition, const DraftSink& on_draft,
                                     const RunContext& run) const {
    const Segmentation& segmentation = out_.prepared.segmentation;
    PartitionResult result;
    const SurfaceSet surfaces = with_cut_planes(out_.surfaces, project_, partition);
    const bool is_whole = partition.groups.size() == segmentation.groups.size();
    const bool can_keep = is_whole && !partition.is_subtracted && out_.mesh_report.is_closed;
    if (can_keep && keep_free_form(kManyFreeForm, run, result)) return result;
    TreeProblem problem;
    problem.query = out_.prepared.query.get();
    problem.segmentation = &segmentation;
    problem.surfaces = &surfaces;
    if (!is_whole) problem.groups = partition.groups;
    problem.is_subtracted = partition.is_subtracted;
    problem.on_draft = on_draft;
    const Settings& settings = project_.settings;
    const bool evolves = settings.tree.search == static_cast<int>(TreeSearchKind::Evolve);
    auto answer = evolves ? evolve_tree(problem, settings.evolve, run)
                          : find_tree(problem, settings.tree, run);
    if (answer) {
      result.answer = std::move(*answer);
      return result;
    }
    Error error = answer.error();
    if (can_keep && error.code == ErrorCode::NotFound) {
      if (keep_free_form(1, run, result)) return result;
      result.answer.tree = polyhedron_tree(out_.prepared);
      result.answer.agreement = 1;
      result.is_polyhedron = true;
      return result;
    }
    if (error.where.empty()) error.where = "partition " + partition.name;
    return error;
  }

  /// A tree with free-form patches as polyhedra, where they have so many faces; false without.
  bool keep_free_form(int least_faces, const RunContext& run, PartitionResult& result) const {
    const PreparedMesh& prepared = out_.prepared;
    const auto patches = find_free_form_patches(*prepared.mesh, prepared.segmentation);
    int faces = 0;
    for (const FreeFormPatch& patch : patches) faces += patch.unfitted;
    if (faces < least_faces) return false;
    const Settings& settings = project_.settings;
    auto found = find_tree_beside(patches, prepared, settings.regularise, settings.tree, run);
    if (!found) return false;
    result.answer = std::move(found->answer);
    result.free_form_share = found->area_share;
    return true;
  }

  const Project& project_;
  SearchWatch watch_;
  RunContext run_;
  std::mutex mutex_;
  Reconstruction out_;
};

}  // namespace

Result<Reconstruction> with_edits(Reconstruction found, const Project& project,
                                  const RunContext& run) {
  if (project.edits.empty()) return found;
  if (auto done = edit_literals(found.tree, project.edits); !done) return done.error();
  RunContext seeded = run;
  seeded.seed = project.seed;
  StopWatch watch;
  auto score = score_tree(*found.prepared.query, found.tree, project.settings.verify, seeded);
  if (!score) return score.error();
  found.score = *score;
  found.times.push_back({"verify edits", watch.lap()});
  return found;
}

Result<SegmentedMesh> segment_project(const Project& project, const RunContext& run) {
  return Reconstructor(project, run).prepare();
}

Result<Reconstruction> reconstruct(const Project& project, const RunContext& run) {
  return Reconstructor(project, run).run();
}

Result<Reconstruction> reconstruct(const Project& project, SegmentedMesh segmented,
                                   const RunContext& run, const SearchWatch& watch) {
  Reconstructor reconstructor(project, run);
  reconstructor.tell(watch);
  reconstructor.keep_warnings(segmented.report.warnings);
  return reconstructor.run(std::move(segmented));
}

}  // namespace hewn
