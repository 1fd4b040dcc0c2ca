#include <algorithm>
#include <chrono>
#include <thread>

#include <doctest/doctest.h>

#include "core/base/file.h"
#include "core/session/recovery.h"
#include "core/session/replay.h"
#include "core/session/session.h"
#include "tests/core/session/session_fixture.h"
#include "tests/support/full_disk.h"

namespace hewn {
namespace {

using testing::hole;
using testing::one_thread;
using testing::OpenSession;
using testing::SessionFolder;

TEST_CASE("a hole as a subtracted partition becomes a plate minus a cylinder") {
  OpenSession open;
  Session& session = open.session;
  CHECK(session.document().prepared->segmentation.groups.size() == 7);
  REQUIRE(session.execute(AddPartition{{}, "holes", Op::Difference, hole()}));
  CHECK(expression_text(session.document().project.root) == "body - holes");
  REQUIRE(session.execute(Reconstruct{}));
  session.wait();
  const auto result = session.current_result();
  REQUIRE(result);
  CHECK(literal_count(result->found.tree) == 2);
  CHECK(result->found.score.iou > 0.99);
}

TEST_CASE("undo brings back the result of the earlier plan without a new search") {
  OpenSession open;
  Session& session = open.session;
  REQUIRE(session.execute(Reconstruct{}));
  session.wait();
  const auto first = session.current_result();
  REQUIRE(first);
  REQUIRE(session.execute(AddPartition{{}, "holes", Op::Difference, hole()}));
  CHECK_FALSE(session.current_result());
  CHECK(session.shown_result() == first);  // until the new plan has one
  REQUIRE(session.execute(Undo{}));
  CHECK(session.current_result() == first);
  CHECK(session.jobs().empty());
}

TEST_CASE("a cut through a partition gives both halves to it") {
  OpenSession open;
  Session& session = open.session;
  REQUIRE(session.execute(AddPartition{{}, "holes", Op::Difference, hole()}));
  REQUIRE(session.execute(AddCut{{Vec3::UnitZ(), 1.0, hole()}}));
  CHECK(session.document().prepared->segmentation.groups.size() == 8);
  const auto views = partition_views(session.document());
  REQUIRE(views.size() == 2);
  CHECK(views[1].partition.groups.size() == 2);
  REQUIRE(session.execute(DeleteCut{0}));
  CHECK(partition_views(session.document())[1].partition.groups.size() == 1);
}

TEST_CASE("merging the halves of a cut gives one group again") {
  OpenSession open;
  Session& session = open.session;
  REQUIRE(session.execute(AddCut{{Vec3::UnitZ(), 1.0, hole()}}));
  REQUIRE(session.execute(MergeGroups{{{Vec3(3, 0, 3), -1}, {Vec3(3, 0, -3), -1}}}));
  CHECK(session.document().prepared->segmentation.groups.size() == 7);
  REQUIRE(session.execute(DeleteMerge{0}));
  CHECK(session.document().prepared->segmentation.groups.size() == 8);
}

TEST_CASE("a cut through a merged group divides all that it is made of, side by side") {
  OpenSession open;
  Session& session = open.session;
  const GroupRef right{Vec3(20, 0, 0), -1};
  const GroupRef front{Vec3(0, -10, 0), -1};
  REQUIRE(session.execute(MergeGroups{{right, front}}));
  REQUIRE(session.document().prepared->segmentation.groups.size() == 6);
  REQUIRE(session.execute(AddCut{{Vec3::UnitZ(), 1.0, {right}}}));
  const PreparedMesh& prepared = *session.document().prepared;
  CHECK(prepared.segmentation.groups.size() == 7);
  const auto group_at = [&prepared](const Vec3& p) {
    return find_groups(prepared, {{p, -1}}, "")->front();
  };
  CHECK(group_at(Vec3(20, 0, 3)) == group_at(Vec3(0, -10, 3)));
  CHECK(group_at(Vec3(20, 0, -3)) == group_at(Vec3(0, -10, -3)));
  CHECK(group_at(Vec3(20, 0, 3)) != group_at(Vec3(20, 0, -3)));
  CHECK(group_at(Vec3(-20, 0, 3)) == group_at(Vec3(-20, 0, -3)));  // it was not selected
  REQUIRE(session.execute(Undo{}));
  CHECK(session.document().prepared->segmentation.groups.size() == 6);
}

TEST_CASE("a cut through everything leaves merged groups whole on each side") {
  OpenSession open;
  Session& session = open.session;
  REQUIRE(session.execute(MergeGroups{{{Vec3(20, 0, 0), -1}, {Vec3(0, -10, 0), -1}}}));
  REQUIRE(session.execute(AddCut{{Vec3::UnitZ(), 1.0, {}}}));
  // Top, bottom; the merged pair, two more sides and the hole, twice.
  CHECK(session.document().prepared->segmentation.groups.size() == 2 + 2 * 4);
}

TEST_CASE("edits in the background end as those at once do, in the order they were asked for") {
  OpenSession at_once;
  OpenSession later;
  later.session.set_background_edits(true);
  for (Session* session : {&at_once.session, &later.session}) {
    REQUIRE(session->execute(AddCut{{Vec3::UnitZ(), 1.0, hole()}}));
    REQUIRE(session->execute(AddPartition{{}, "top", Op::Difference, {{Vec3(3, 0, 3), -1}}}));
    REQUIRE(session->execute(MoveCut{0, Vec3::UnitZ(), 2.0}));
  }
  CHECK(later.session.is_editing());
  later.session.wait();
  CHECK_FALSE(later.session.is_editing());
  CHECK(later.session.log().substr(later.session.log().find("cut")) ==
        at_once.session.log().substr(at_once.session.log().find("cut")));
  CHECK(later.session.document().project.cuts[0].offset == 2);
  CHECK(later.session.document().prepared->segmentation.groups.size() == 8);
  CHECK(later.session.history().depth() == 3);
}

TEST_CASE("what fails in the background is said, and what waited for it goes on") {
  OpenSession open;
  Session& session = open.session;
  session.set_background_edits(true);
  REQUIRE(session.execute(AddCut{{Vec3::UnitZ(), 100.0, {}}}));
  REQUIRE(session.execute(AddPartition{{}, "holes", Op::Difference, hole()}));
  session.wait();
  REQUIRE(session.notices().size() == 1);
  CHECK(session.notices()[0].text.find("none of the groups") != std::string::npos);
  CHECK(session.document().project.root.children.size() == 1);
  CHECK(session.history().depth() == 1);
}

TEST_CASE("another mesh takes the place of one that is being cut") {
  OpenSession open;
  Session& session = open.session;
  session.set_background_edits(true);
  REQUIRE(session.execute(AddCut{{Vec3::UnitZ(), 1.0, {}}}));
  REQUIRE(session.execute(OpenFile{open.folder / "plate.off"}));
  session.wait();
  CHECK(session.document().project.cuts.empty());
  CHECK(session.document().prepared->segmentation.groups.size() == 7);
  CHECK_FALSE(session.history().can_undo());
}

TEST_CASE("the rough version of a fine mesh has few triangles and the same labels") {
  Mesh plate = solids::plate_with_hole(Vec3(40, 20, 8), 3, 40000);
  std::vector<int> labels(plate.triangles.size());
  for (std::size_t t = 0; t < labels.size(); ++t) {
    labels[t] = std::abs(plate.normals[t].z()) > 0.5 ? 0 : 1;
  }
  const DisplayMesh display = build_display_mesh(plate, labels);
  REQUIRE(display.indices.size() > 3 * kManyTriangles);
  CHECK(display.is_closed);
  CHECK(display.coarse.size() <= 3 * kManyTriangles / 2);
  CHECK(display.coarse.size() > 3 * 100);
  for (std::size_t i = 0; i < display.coarse.size(); i += 3) {
    const auto label = [&](std::size_t k) { return display.corners[display.coarse[i + k]].label; };
    CHECK((label(0) == label(1) && label(1) == label(2)));
  }
}

TEST_CASE("moving a partition below another keeps its groups") {
  OpenSession open;
  Session& session = open.session;
  REQUIRE(session.execute(AddPartition{{}, "a", Op::Union, {{Vec3(20, 0, 0), -1}}}));
  REQUIRE(session.execute(AddPartition{{}, "b", Op::Difference, hole()}));
  REQUIRE(session.execute(MovePartition{{0}, {1}, 0}));
  CHECK(expression_text(session.document().project.root) == "body - (b + a)");
  CHECK_FALSE(session.execute(MovePartition{{0}, {0, 0}, 0}));  // below itself
  REQUIRE(session.execute(Undo{}));
  CHECK(expression_text(session.document().project.root) == "body + a - b");
}

TEST_CASE("what cannot be done changes nothing, is not recorded and is said") {
  OpenSession open;
  Session& session = open.session;
  const std::string plan = plan_text(session.document().project);
  const std::string log = session.log();
  CHECK_FALSE(session.execute(AddCut{{Vec3::UnitZ(), 100.0, {}}}));
  CHECK_FALSE(session.execute(DeleteCut{0}));
  CHECK_FALSE(session.execute(SetOption{"tree", "starts", "-1"}));
  CHECK_FALSE(session.execute(OpenFile{"/no/such/mesh.stl"}));
  CHECK(plan_text(session.document().project) == plan);
  CHECK(session.log() == log);
  CHECK(session.notices().size() == 4);
  CHECK_FALSE(session.history().can_undo());
}

TEST_CASE("an option of the segmentation has the mesh divided anew; undo needs no job") {
  OpenSession open;
  Session& session = open.session;
  REQUIRE(session.execute(SetOption{"segment", "method", "curvature"}));
  CHECK_FALSE(session.document().is_ready());
  session.wait();
  CHECK(session.document().is_ready());
  REQUIRE(session.execute(Undo{}));
  CHECK(session.document().is_ready());
  CHECK(session.document().prepared->segmentation.groups.size() == 7);
}

TEST_CASE("a mesh that is deleted while open: the plan goes on; reading it again names the file") {
  OpenSession open;
  Session& session = open.session;
  std::filesystem::remove(open.folder / "plate.off");
  REQUIRE(session.execute(AddPartition{{}, "holes", Op::Difference, hole()}));
  REQUIRE(session.execute(Reconstruct{}));
  session.wait();
  REQUIRE(session.current_result());
  REQUIRE(session.execute(SaveProject{open.folder / "plate.json"}));
  REQUIRE(session.execute(ExportTree{open.folder / "plate.scad"}));
  session.wait();
  CHECK(std::filesystem::exists(open.folder / "plate.scad"));
  REQUIRE(session.execute(SetOption{"segment", "method", "curvature"}));
  session.wait();
  const auto& notices = session.notices();
  CHECK(std::any_of(notices.begin(), notices.end(), [](const Notice& n) {
    return n.severity == Severity::Error && n.text.find("plate.off") != std::string::npos;
  }));
  REQUIRE(session.execute(Undo{}));
  CHECK(session.document().is_ready());
  CHECK(session.current_result());
}

TEST_CASE("the newest plan wins over a search that is still running") {
  OpenSession open;
  Session& session = open.session;
  session.set_live(true);
  REQUIRE(session.execute(AddPartition{{}, "holes", Op::Difference, hole()}));
  session.wait();
  REQUIRE(session.current_result());
  CHECK(session.current_result()->found.partitions.size() == 2);
}

TEST_CASE("a picked result puts its plan in place, and undo takes it back") {
  OpenSession open;
  Session& session = open.session;
  REQUIRE(session.execute(Reconstruct{}));
  session.wait();
  session.search_variants();
  session.wait();
  REQUIRE(session.results().size() == 7);
  const auto variant = session.results().back();
  REQUIRE(session.execute(SetPlan{plan_text(variant->project)}));
  CHECK(session.current_result() == variant);
  CHECK(session.document().is_ready());
  REQUIRE(session.execute(Undo{}));
  CHECK(session.current_result() == session.results().front());
}

/// A plate with its hole as a subtracted partition, searched.
std::shared_ptr<const FoundResult> search_with_hole(Session& session) {
  REQUIRE(session.execute(AddPartition{{}, "holes", Op::Difference, hole()}));
  REQUIRE(session.execute(Reconstruct{}));
  session.wait();
  auto found = session.current_result();
  REQUIRE(found);
  return found;
}

TEST_CASE("a partition's colour is part of the plan, but no tree depends on it") {
  OpenSession open;
  Session& session = open.session;
  const auto found = search_with_hole(session);
  session.set_live(true);
  REQUIRE(session.execute(ColourPartition{{0}, 0xff8000}));
  CHECK_FALSE(session.is_busy());
  CHECK(session.current_result() == found);
  CHECK(session.partitions()[1].colour == 0xff8000U);
  const auto saved = parse_project(plan_text(session.document().project), "/");
  REQUIRE(saved);
  CHECK(saved->root.children[0].colour == 0xff8000U);
  CHECK_FALSE(session.execute(ColourPartition{{0}, 0xff8000}));  // nothing would change
  REQUIRE(session.execute(Undo{}));
  CHECK_FALSE(session.partitions()[1].colour);
}

TEST_CASE("an edited radius is measured anew, undone, saved and replayed") {
  OpenSession open;
  Session& session = open.session;
  const auto found = search_with_hole(session);
  int cylinder = -1;
  const auto& literals = found->found.tree.literals;
  for (std::size_t l = 0; l < literals.size(); ++l) {
    if (literals[l].kind == SolidKind::Cylinder) cylinder = static_cast<int>(l);
  }
  REQUIRE(cylinder >= 0);
  CHECK_FALSE(session.execute(EditLiteral{{cylinder, "size-x", 4}}));  // cylinders have none
  CHECK_FALSE(session.execute(EditLiteral{{cylinder, "radius", -4}}));
  CHECK_FALSE(session.execute(EditLiteral{{99, "radius", 4}}));
  REQUIRE(session.execute(EditLiteral{{cylinder, "radius", 4}}));
  session.wait();
  const auto edited = session.current_result();
  REQUIRE(edited);
  CHECK(edited->found.tree.literals[cylinder].radius == 4);
  CHECK(edited->found.tree.literals[cylinder].top_radius == 4);
  CHECK(edited->found.score.iou < found->found.score.iou);
  CHECK(edited->found.score.hausdorff > 0.9 / found->found.prepared.mesh->diagonal());

  REQUIRE(session.execute(ExportTree{open.folder / "edited.scad"}));
  session.wait();
  const auto recorded = read_file(open.folder / "edited.scad");
  REQUIRE(recorded);
  REQUIRE(replay_log(session.log(), "log", one_thread()));
  CHECK(*read_file(open.folder / "edited.scad") == *recorded);

  const auto whole = parse_project(plan_text(session.document().project), "/");
  REQUIRE(whole);
  const auto again = reconstruct(*whole, one_thread());  // as the command line does it
  REQUIRE(again);
  CHECK(again->tree.literals[cylinder].radius == 4);
  CHECK(again->score.iou == edited->found.score.iou);

  REQUIRE(session.execute(Undo{}));
  CHECK(session.current_result() == found);
  REQUIRE(session.execute(Redo{}));
  REQUIRE(session.execute(SetPartitionOp{{0}, Op::Union}));
  CHECK(session.document().project.edits.empty());  // another tree
}

TEST_CASE("a replayed log writes the same files and ends at the same plan") {
  OpenSession open;
  Session& session = open.session;
  REQUIRE(session.execute(AddCut{{Vec3::UnitX(), 7.0, {}}}));
  REQUIRE(session.execute(Undo{}));
  REQUIRE(session.execute(AddPartition{{}, "holes", Op::Difference, hole()}));
  REQUIRE(session.execute(ExportTree{open.folder / "out.scad"}));
  session.wait();
  const auto recorded = read_file(open.folder / "out.scad");
  REQUIRE(recorded);
  std::filesystem::remove(open.folder / "out.scad");
  const auto replayed = replay_log(session.log(), "log", one_thread());
  REQUIRE(replayed);
  CHECK(replayed->commands == 5);
  CHECK(replayed->plan == plan_text(session.document().project));
  CHECK(*read_file(open.folder / "out.scad") == *recorded);
}

TEST_CASE("a bad line of a log is named by its number") {
  const auto unknown = replay_log(
      "\n"
      R"({"command": "fly"})"
      "\n",
      "log", one_thread());
  REQUIRE_FALSE(unknown);
  CHECK(unknown.error().where == "log:2");
  CHECK(unknown.error().message.find("fly") != std::string::npos);
  const auto missing = replay_log(R"({"command": "delete-cut"})", "log", one_thread());
  REQUIRE_FALSE(missing);
  CHECK(missing.error().code == ErrorCode::Format);
}

TEST_CASE("the colours' mesh has the groups' labels and lines between them only") {
  OpenSession open;
  const auto display = open.session.display();
  REQUIRE(display);
  CHECK(display->labels == 7);
  CHECK(display->indices.size() == 3 * open.session.document().prepared->mesh->triangles.size());
  CHECK(display->lines.size() % 2 == 0);
  // 12 edges of the plate, of which rims of the hole have 32 lines each.
  CHECK(display->lines.size() / 2 >= 12 + 64);
  for (const DisplayLineEnd& end : display->lines) CHECK(end.labels[0] != end.labels[1]);
}

TEST_CASE("the groups that a plane would divide are counted") {
  OpenSession open;
  const PreparedMesh& prepared = *open.session.document().prepared;
  const std::vector<int> all = {0, 1, 2, 3, 4, 5, 6};
  CHECK(groups_crossed(prepared, all, Vec3::UnitZ(), 0) == 5);  // four sides and the hole
  CHECK(groups_crossed(prepared, all, Vec3::UnitZ(), 4) == 0);  // the top itself
}

TEST_CASE("what is drawn of a result measures the input against it") {
  OpenSession open;
  Session& session = open.session;
  REQUIRE(session.execute(Reconstruct{}));
  session.set_views(true);
  session.wait();
  session.poll();
  session.wait();
  const auto view = session.result_view();
  REQUIRE(view);
  CHECK_FALSE(view->surface.corners.empty());
  CHECK(view->surface.labels == 2);
  CHECK(view->max_deviation < 1e-3);  // all vertices lie on the true surfaces
}

TEST_CASE("another result is looked at for a while, and its view is kept") {
  OpenSession open;
  Session& session = open.session;
  session.set_views(true);
  const auto settle = [&session] {
    for (int i = 0; i < 3; ++i) {
      session.wait();
      session.poll();
    }
  };
  REQUIRE(session.execute(Reconstruct{}));
  settle();
  const auto first = session.current_result();
  REQUIRE(session.execute(AddPartition{{}, "holes", Op::Difference, hole()}));
  REQUIRE(session.execute(Reconstruct{}));
  settle();
  const auto second = session.current_result();
  REQUIRE(second);
  REQUIRE(second != first);
  const auto own_view = session.result_view();
  REQUIRE(own_view);

  session.preview(first);
  settle();
  CHECK(session.viewed_result() == first);
  CHECK(session.result_view() != own_view);
  CHECK(session.result_view());
  CHECK(session.shown_result() == second);  // the panels keep theirs
  session.preview(nullptr);
  CHECK(session.viewed_result() == second);
  CHECK(session.result_view() == own_view);  // nothing is made anew
  CHECK_FALSE(session.is_busy());
}

TEST_CASE("a view that was stopped is made when it is wanted again") {
  OpenSession open;
  Session& session = open.session;
  REQUIRE(session.execute(Reconstruct{}));
  session.wait();
  session.set_views(true);
  session.poll();
  session.cancel_jobs();
  for (int i = 0; i < 3; ++i) {
    session.wait();
    session.poll();
  }
  CHECK(session.result_view());
}

TEST_CASE("the journal keeps what was done, and what was said and dismissed") {
  OpenSession open;
  Session& session = open.session;
  session.notify(Severity::Warning, "something is odd");
  session.dismiss(0);
  REQUIRE(session.execute(AddCut{{Vec3::UnitX(), 5, {}}}));
  const auto& notes = session.journal();
  REQUIRE(notes.size() >= 3);
  CHECK(notes.front().text.find("open") != std::string::npos);
  CHECK(notes[notes.size() - 2].text == "something is odd");
  CHECK(notes[notes.size() - 2].severity == Severity::Warning);
  CHECK(notes.back().text.find(R"("command":"cut")") != std::string::npos);
  CHECK(session.notices().empty());
}

TEST_CASE("a first answer is shown while the search goes on, and never kept") {
  const SessionFolder folder("draft");
  // The worker pauses whenever it has news, so that each is seen.
  Session session(one_thread(), [] { std::this_thread::sleep_for(std::chrono::milliseconds(2)); });
  REQUIRE(session.execute(OpenFile{folder.plate()}));
  session.wait();
  REQUIRE(session.execute(Reconstruct{}));
  bool has_seen_draft = false;
  while (session.is_busy()) {
    session.poll();
    if (!session.shows_draft()) continue;
    has_seen_draft = true;
    CHECK(session.shown_result());
    CHECK(session.result_view());
    CHECK_FALSE(session.current_result());
    CHECK(session.results().empty());
  }
  CHECK(has_seen_draft);
  CHECK_FALSE(session.shows_draft());
  CHECK(session.results().size() == 1);
  CHECK(session.shown_result() == session.current_result());
  CHECK(session.result_view());
}

TEST_CASE("an unsaved plan is copied once a minute and the copy goes with the session") {
  OpenSession open;
  Session& session = open.session;
  REQUIRE(session.execute(AddPartition{{}, "holes", Op::Difference, hole()}));
  CHECK(session.is_modified());
  const auto folder = open.folder / "state";
  std::filesystem::path copy;
  {
    Autosave autosave(folder);
    const auto start = Autosave::Clock::now();
    REQUIRE(autosave.update(session.document().project, session.is_modified(), start));
    copy = autosave.file();
    const std::string first = *read_file(copy);
    REQUIRE(session.execute(RenamePartition{{0}, "bore"}));
    REQUIRE(autosave.update(session.document().project, true, start + std::chrono::seconds(59)));
    CHECK(*read_file(copy) == first);
    REQUIRE(autosave.update(session.document().project, true, start + std::chrono::seconds(60)));
    CHECK(*read_file(copy) != first);
    CHECK(find_recoverable(folder).empty());  // its owner lives
    std::filesystem::copy_file(copy, folder / "unsaved-999999999.json");
  }
  CHECK_FALSE(std::filesystem::exists(copy));
  const auto left = find_recoverable(folder);
  REQUIRE(left.size() == 1);
  Session next(one_thread());
  next.set_views(false);
  REQUIRE(next.recover(left[0]));
  next.wait();
  CHECK(next.is_modified());
  CHECK(expression_text(next.document().project.root) == "body - bore");
  CHECK(next.document().is_ready());
}

TEST_CASE(
    "on a full disk the last copy of an unsaved plan stays, and the next minute tries again") {
  OpenSession open;
  Session& session = open.session;
  REQUIRE(session.execute(AddPartition{{}, "holes", Op::Difference, hole()}));
  Autosave autosave(open.folder / "state");
  const auto start = Autosave::Clock::now();
  const auto project = [&session]() -> const Project& { return session.document().project; };
  REQUIRE(autosave.update(project(), true, start));
  const std::string first = *read_file(autosave.file());
  REQUIRE(session.execute(RenamePartition{{0}, "bore"}));
  {
    const FullDisk disk;
    const auto done = autosave.update(project(), true, start + std::chrono::seconds(60));
    REQUIRE_FALSE(done);
    CHECK(done.error().code == ErrorCode::FileWrite);
    // Told once: no try at every change.
    CHECK(autosave.update(project(), true, start + std::chrono::seconds(61)));
  }
  CHECK(*read_file(autosave.file()) == first);
  REQUIRE(autosave.update(project(), true, start + std::chrono::seconds(120)));
  CHECK(*read_file(autosave.file()) != first);
}

TEST_CASE("saving and opening a project keeps the plan; a full disk keeps the old file") {
  OpenSession open;
  Session& session = open.session;
  REQUIRE(session.execute(AddPartition{{}, "holes", Op::Difference, hole()}));
  REQUIRE(session.execute(SaveProject{open.folder / "plate.json"}));
  CHECK_FALSE(session.is_modified());
  const std::string saved = *read_file(open.folder / "plate.json");
  REQUIRE(session.execute(RenamePartition{{0}, "bore"}));
  {
    const FullDisk disk;
    const auto done = session.execute(SaveProject{open.folder / "plate.json"});
    REQUIRE_FALSE(done);
    CHECK(done.error().code == ErrorCode::FileWrite);
  }
  CHECK(*read_file(open.folder / "plate.json") == saved);
  CHECK(session.is_modified());
  CHECK_FALSE(session.execute(SaveProject{open.folder / "no" / "folder.json"}));
  CHECK(session.project_path() == open.folder / "plate.json");
  REQUIRE(session.execute(SaveProject{open.folder / "plate.json"}));
  Session second(one_thread());
  second.set_views(false);
  REQUIRE(second.execute(OpenFile{open.folder / "plate.json"}));
  second.wait();
  CHECK(plan_text(second.document().project) == plan_text(session.document().project));
}

}  // namespace
}  // namespace hewn
