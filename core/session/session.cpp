#include "core/session/session.h"

#include <utility>

#include <fmt/format.h>

#include "core/base/file.h"
#include "core/compute/compute.h"
#include "core/session/tree_file.h"
#include "core/session/variants.h"

namespace hewn {
namespace {

/// Edits that make a new mesh or new groups.
bool shapes_groups(const SessionCommand& command) {
  return std::holds_alternative<AddCut>(command) || std::holds_alternative<MoveCut>(command) ||
         std::holds_alternative<DeleteCut>(command) ||
         std::holds_alternative<MergeGroups>(command) ||
         std::holds_alternative<DeleteMerge>(command) || std::holds_alternative<SetPlan>(command);
}

Result<void> write_result(const FoundResult& result, const ExportTree& command,
                          const RunContext& run) {
  TreeFileOptions options;
  options.part = result.project.mesh.stem().string();
  options.match_facets = command.match_facets;
  options.score = result.found.score;
  options.warnings = result.found.warnings;
  auto content = tree_file(result.found.tree, command.path, options, run);
  if (!content) return content.error();
  return write_tree_file(*content, command.path);
}

std::vector<PartProgress> progress_of(const Reconstruction& found) {
  std::vector<PartProgress> parts;
  for (const PartitionResult& p : found.partitions) {
    parts.push_back({.name = p.name,
                     .state = PartProgress::State::Done,
                     .size = tree_size(p.answer.tree),
                     .literals = literal_count(p.answer.tree),
                     .error = 1 - p.answer.agreement});
  }
  return parts;
}

}  // namespace

Session::Session(const RunContext& base, std::function<void()> wake)
    : compute_(compute_of(base)), edits_(base, wake), jobs_(base, std::move(wake)) {
  const auto tell = [this](const std::string& job, const std::string& reason) {
    report({ErrorCode::Internal,
            fmt::format("something inside broke: {}; the document is unharmed", reason), job});
  };
  jobs_.on_failure(tell);
  const auto about_machine = [this](const LogEntry& entry) {
    if (entry.severity != Severity::Info) notify(entry.severity, entry.message);
  };
  jobs_.on_machine_notice(about_machine);
  edits_.on_machine_notice(about_machine);
  edits_.on_failure([this, tell](const std::string& job, const std::string& reason) {
    tell(job, reason);
    drop_edit();
  });
}

Result<void> Session::execute(const SessionCommand& command) {
  ++revision_;
  const bool is_opening = std::holds_alternative<OpenFile>(command);
  if (is_editing_ && !is_opening) {
    waiting_.push_back(command);
    return {};
  }
  if (has_background_edits_ && document().is_ready() && shapes_groups(command)) {
    start_edit(command);
    return {};
  }
  Result<void> done = carry_out(command);
  if (done) {
    journal_.record(command);
  } else {
    report(done.error());
  }
  return done;
}

Result<void> Session::carry_out(const SessionCommand& command) {
  if (const auto* file = std::get_if<OpenFile>(&command)) return open(file->path);
  if (history_.current().project.mesh.empty()) {
    return Error{ErrorCode::InvalidArgument, "open a mesh first"};
  }
  if (const auto* file = std::get_if<SaveProject>(&command)) return save(file->path);
  if (const auto* file = std::get_if<ExportTree>(&command)) return export_tree(*file);
  if (std::holds_alternative<Reconstruct>(command)) return start_search();
  if (std::holds_alternative<Undo>(command) || std::holds_alternative<Redo>(command)) {
    const bool is_undo = std::holds_alternative<Undo>(command);
    if (!(is_undo ? history_.undo() : history_.redo())) {
      return Error{ErrorCode::InvalidArgument, is_undo ? "nothing to undo" : "nothing to do again"};
    }
  } else if (auto done = edit(command); !done) {
    return done;
  }
  plan_changed();
  return {};
}

Result<void> Session::edit(const SessionCommand& command) {
  if (const auto* change = std::get_if<EditLiteral>(&command)) {
    if (auto possible = check_edit(*change); !possible) return possible;
  }
  auto next = edited(history_.current(), command, RunContext{});
  if (!next) return next.error();
  history_.push(title_of(command), std::move(*next));
  return {};
}

void Session::start_edit(const SessionCommand& command) {
  is_editing_ = true;
  edits_.add(title_of(command),
             [this, command, number = ++edit_, document = document(), edition = history_.edition(),
              wants_display = wants_views_](const RunContext& run) -> JobCompletion {
               auto next = edited(document, command, run);
               if (next && wants_display) add_display(*next);
               return [this, command, number, edition, outcome = std::move(next)]() mutable {
                 if (number == edit_) finish_edit(command, edition, std::move(outcome));
               };
             });
}

void Session::finish_edit(const SessionCommand& command, std::uint64_t edition,
                          Result<Document> next) {
  ++revision_;
  is_editing_ = false;
  if (edition != history_.edition()) {  // the mesh came in anew: once more
    waiting_.push_front(command);
  } else if (next) {
    history_.push(title_of(command), std::move(*next));
    journal_.record(command);
    plan_changed();
  } else {
    report(next.error());
  }
  while (!is_editing_ && !waiting_.empty()) {
    const SessionCommand following = waiting_.front();
    waiting_.pop_front();
    static_cast<void>(execute(following));
  }
}

/// Whatever becomes of the edit that runs, it comes too late.
void Session::drop_edit() {
  ++edit_;
  is_editing_ = false;
  waiting_.clear();
}

void Session::cancel_jobs() {
  if (board_) board_->stop();
  jobs_.cancel_all();
  edits_.cancel_all();
  views_.drop_unmade();
  drop_edit();
}

void Session::stop_partition(const std::string& name) {
  ++revision_;
  if (board_) board_->stop(name);
}

std::vector<JobStatus> Session::jobs() const {
  auto all = edits_.status();
  const auto others = jobs_.status();
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

/// Refuses what the tree at hand does not have; without one the search finds out.
Result<void> Session::check_edit(const EditLiteral& command) const {
  const auto result = current_result();
  if (!result) return {};
  Tree tree = result->found.tree;
  return edit_literals(tree, {command.edit});
}

Result<void> Session::open(const std::filesystem::path& path) {
  Document document;
  project_path_.clear();
  if (lower_extension(path) == ".json") {
    auto project = load_project(path);
    if (!project) return project.error();
    document.project = std::move(*project);
    project_path_ = path;
  } else {
    document.project.mesh = path;
    document.project.root.name = "body";
  }
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(document.project.mesh, ignored)) {
    return Error{ErrorCode::FileNotFound, "there is no such file, or it cannot be read",
                 document.project.mesh.string()};
  }
  cancel_jobs();
  results_.clear();
  draft_ = {};
  last_result_ = preview_ = nullptr;
  views_.clear();
  display_of_ = nullptr;
  display_ = nullptr;
  saved_plan_ = plan_text(document.project);
  history_.reset(std::move(document));
  plan_changed();
  return {};
}

Result<void> Session::recover(const std::filesystem::path& copy) {
  if (auto done = execute(OpenFile{copy}); !done) return done;
  project_path_.clear();
  saved_plan_.clear();
  return {};
}

Result<void> Session::save(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto folder = std::filesystem::absolute(path, ignored).parent_path();
  const std::string text = project_text(document().project, folder);
  if (auto done = write_file(path, text); !done) return done;
  project_path_ = path;
  saved_plan_ = plan();
  return {};
}

bool Session::is_modified() const {
  return !document().project.mesh.empty() && plan() != saved_plan_;
}

void Session::plan_changed() {
  failure_.clear();
  if (!document().source) {
    start_reading();
    return;
  }
  // An edited tree is only measured again: no reason to wait for a key.
  if ((is_live_ || unedited_result()) && !current_result()) static_cast<void>(start_search());
}

void Session::start_reading() {
  jobs_.cancel(search_job_);
  jobs_.add("reading the mesh",
            [this, document = document(),
             wants_display = wants_views_](const RunContext& run) -> JobCompletion {
              auto next = read_source(document, run);
              if (next && wants_display) add_display(*next);
              return [this, project = document.project, outcome = std::move(next)]() mutable {
                adopt_source(project, std::move(outcome));
              };
            });
}

void Session::adopt_source(const Project& project, Result<Document> read) {
  ++revision_;
  if (source_key(project) != source_key(document().project)) return;  // the plan has moved on
  if (!read) {
    if (read.error().code != ErrorCode::Cancelled) report(read.error());
    return;
  }
  for (const std::string& warning : read->source->report.warnings) {
    notify(Severity::Info, warning);
  }
  found_ = std::make_shared<FoundPartitions>();
  if (plan_text(project) != plan()) {  // other cuts or partitions than when the reading began
    read = with_source(document(), read->source, RunContext{});
    if (!read) {
      report(read.error());
      return;
    }
  }
  history_.amend(std::move(*read));
  if (is_live_ && !current_result()) static_cast<void>(start_search());
}

int Session::add_search(const Project& project, const std::string& source) {
  Document document = history_.current();
  document.project = project;
  std::string name = source == "plan" ? "searching" : "searching (" + source + ")";
  const auto base = project.edits.empty() ? nullptr : unedited_result();
  const auto board = std::make_shared<PartBoard>();
  if (source == "plan") {
    board_ = board;
    board_key_ = key();
    for (const PartitionView& view : partitions()) {
      if (!view.partition.groups.empty()) board->update({.name = view.partition.name});
    }
  }
  PlanSearch search{document,    base,   source, wants_views_ && source == "plan",
                    board.get(), found_, {}};
  if (search.draws) {
    search.on_draft = [this](const DrawnResult& draft) {
      jobs_.post([this, draft] { adopt_draft(draft); });
    };
  }
  return jobs_.add(std::move(name), [this, search, board](const RunContext& run) -> JobCompletion {
    auto outcome = search_plan(search, run);
    if (!outcome) board->stop();
    return [this, outcome, searched = search_key(search.document.project)] {
      ++revision_;
      if (outcome) {
        adopt_result(*outcome);
      } else if (outcome.error().code != ErrorCode::Cancelled) {
        draft_ = {};
        if (searched == key()) failure_ = text_of(outcome.error());
        report(outcome.error());
      }
    };
  });
}

Result<void> Session::start_search() {
  if (!document().is_ready()) {
    return Error{ErrorCode::InvalidArgument,
                 "the mesh is still being divided into groups; wait until it is done"};
  }
  if (current_result()) return {};
  if (key() == searched_key_ && is_busy()) return {};
  jobs_.cancel(search_job_);
  for (const int job : std::exchange(variant_jobs_, {})) jobs_.cancel(job);
  failure_.clear();
  searched_key_ = key();
  search_job_ = add_search(document().project, "plan");
  return {};
}

void Session::search_variants() {
  if (!document().is_ready()) return;
  for (const int job : std::exchange(variant_jobs_, {})) jobs_.cancel(job);
  for (const Variant& v : hewn::search_variants(document().project)) {
    if (!results_.find(search_key(v.project))) {
      variant_jobs_.push_back(add_search(v.project, v.name));
    }
  }
}

void Session::adopt_draft(const DrawnResult& draft) {
  ++revision_;
  if (draft.result->key == key() && !current_result()) draft_ = draft;
}

void Session::adopt_result(const DrawnResult& drawn) {
  const SharedResult& result = drawn.result;
  results_.keep(result);
  if (result->key == key() || !last_result_) last_result_ = result;
  journal_.note(
      Severity::Info,
      fmt::format("Found ({})  {} literals, size {}, proximity {:.3f}, {:.2f} s", result->source,
                  literal_count(result->found.tree), tree_size(result->found.tree),
                  result->found.score.proximity, result->seconds));
  if (draft_.result && draft_.result->key == result->key) draft_ = {};
  if (!wants_views_) return;
  if (drawn.view) views_.put(result, drawn.view);
  views_.want(shown_result(), jobs_);
}

Result<void> Session::export_tree(const ExportTree& command) {
  if (auto known = check_tree_extension(command.path); !known) return known.error();
  if (!document().is_ready()) {
    return Error{ErrorCode::InvalidArgument, "the mesh is not read yet; wait until it is done"};
  }
  const auto ready = current_result();
  jobs_.add("exporting",
            [this, command, ready, base = unedited_result(),
             document = document()](const RunContext& run) -> JobCompletion {
              Result<DrawnResult> result = DrawnResult{ready, nullptr};
              if (!ready) {
                result = search_plan(
                    {.document = document, .base = base, .source = "plan", .found = found_}, run);
              }
              const Result<void> done =
                  result ? write_result(*result->result, command, run) : result.error();
              return [this, result, done, path = command.path] {
                ++revision_;
                if (result && result->result != current_result()) adopt_result(*result);
                if (done) {
                  notify(Severity::Info, fmt::format("wrote {}", path.string()));
                } else {
                  report(done.error());
                }
              };
            });
  return {};
}

const Session::Derived& Session::derived() const {
  if (derived_.edition != history_.edition()) {
    const Project& project = document().project;
    derived_ = {history_.edition(), plan_text(project), search_key(project),
                partition_views(document())};
  }
  return derived_;
}

std::vector<PartProgress> Session::partition_progress() const {
  if (const auto result = current_result()) return progress_of(result->found);
  return board_ && board_key_ == key() ? board_->parts() : std::vector<PartProgress>{};
}

const std::vector<PartitionView>& Session::partitions() const { return derived().partitions; }

SharedResult Session::current_result() const { return results_.find(key()); }

/// The result that the plan's edits of literals start from; null without edits.
SharedResult Session::unedited_result() const {
  Project project = document().project;
  if (project.edits.empty()) return nullptr;
  project.edits.clear();
  return results_.find(search_key(project));
}

SharedResult Session::shown_result() const {
  if (auto current = current_result()) return current;
  return shows_draft() ? draft_.result : last_result_;
}

bool Session::shows_draft() const {
  return draft_.result && draft_.result->key == key() && !current_result();
}

void Session::preview(const SharedResult& result) {
  if (result == preview_ || !wants_views_) return;
  ++revision_;
  if (preview_job_ > 0) {
    edits_.cancel(preview_job_);
    views_.drop_unmade(preview_);
  }
  preview_ = result;
  preview_job_ = views_.want(result, edits_);
}

SharedResult Session::viewed_result() const {
  return preview_ && views_.find(preview_) ? preview_ : shown_result();
}

std::shared_ptr<const ResultView> Session::result_view() const {
  const auto viewed = viewed_result();
  return viewed && viewed == draft_.result ? draft_.view : views_.find(viewed);
}

void Session::set_live(bool is_live) {
  is_live_ = is_live;
  if (is_live && document().is_ready() && !current_result()) static_cast<void>(start_search());
}

std::string Session::device() const {
  const long jobs = compute_->accelerated_jobs();
  const std::string name = compute_->device_name();
  return jobs > 0 ? fmt::format("{} ({} jobs)", name, jobs) : name;
}

bool Session::poll() {
  bool changed = edits_.poll();
  changed |= jobs_.poll();
  // Undo and redo may bring back another result than the one that is drawn.
  if (wants_views_ && !shows_draft()) views_.want(shown_result(), jobs_);
  if (changed) ++revision_;
  return changed;
}

void Session::wait() {
  while (is_busy()) {
    edits_.wait();
    jobs_.wait();
  }
}

std::shared_ptr<const DisplayMesh> Session::display() {
  if (document().display) return document().display;
  const auto& prepared = document().prepared;
  if (prepared && prepared != display_of_) {
    display_ = std::make_shared<const DisplayMesh>(build_display_mesh(*prepared));
    display_of_ = prepared;
  }
  return prepared ? display_ : nullptr;
}

void Session::notify(Severity severity, std::string text) {
  ++revision_;
  journal_.notify(severity, std::move(text));
}

void Session::dismiss(std::size_t notice) {
  ++revision_;
  journal_.dismiss(notice);
}

void Session::report(const Error& error) {
  ++revision_;
  journal_.fail(error);
}

}  // namespace hewn
