// Meshes beside each other: each with runs and histories of its own, in one session.

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/engine/engine.h"
#include "core/session/state_file.h"
#include "core/view/frame_builder.h"
#include "tests/session/spoken_session.h"
#include "tests/support/temporary_folder.h"

namespace dmoscope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class SeveralMeshes : public testing::SpokenSession {
 protected:
  SeveralMeshes() {
    make("generate random 200 3", first_);
    make("generate random 90 5", second_);
    make("generate tetrahedra 60", volume_);
    say("open " + first_.string());
  }
  static void make(const std::string& line, const std::filesystem::path& file) {
    Session session(1);
    Progress progress;
    CommandContext context{session, progress, [](const Message&) {}};
    CommandTable commands;
    add_session_commands(commands, context);
    commands.execute(line);
    commands.execute("export " + file.string());
  }
  /// The positions of a run in a session of its own.
  static std::vector<Vec3> alone(const std::filesystem::path& file, const std::vector<std::string>& lines) {
    Session session(1);
    Progress progress;
    CommandContext context{session, progress, [](const Message&) {}};
    CommandTable commands;
    add_session_commands(commands, context);
    commands.execute("open " + file.string());
    for (const std::string& line : lines) commands.execute(line);
    const auto positions = session.active().positions();
    return {positions.begin(), positions.end()};
  }
  void expect_at(std::size_t run, const std::vector<Vec3>& wanted) {
    const auto positions = session_.run(run).positions();
    ASSERT_EQ(positions.size(), wanted.size());
    EXPECT_EQ(std::memcmp(positions.data(), wanted.data(), wanted.size() * sizeof(Vec3)), 0) << "run " << run;
  }

  const test::TemporaryFolder folder_;
  const std::filesystem::path first_ = folder_ / "first.off", second_ = folder_ / "second.off", volume_ = folder_ / "volume.vtk";
};

TEST_F(SeveralMeshes, EachIsSmoothedAsIfItWereAlone) {
  say("run 2");
  say("open-beside " + second_.string());
  ASSERT_EQ(session_.run_count(), 2U);
  EXPECT_EQ(session_.active_index(), 1U);
  EXPECT_EQ(session_.input()->mesh.name, "second.off");
  EXPECT_EQ(session_.inputs().size(), 2U);
  say("run 3");
  say("metric min-angle");  // a separate run on the same mesh
  say("run 1");
  EXPECT_EQ(session_.inputs().size(), 2U);
  say("select-run 1");
  EXPECT_EQ(session_.input()->mesh.name, "first.off");
  say("run 1");
  expect_at(0, alone(first_, {"run 3"}));
  expect_at(1, alone(second_, {"run 3"}));
  expect_at(2, alone(second_, {"metric min-angle", "run 1"}));
}

TEST_F(SeveralMeshes, UndoTakesTheSecondAwayAndRedoBringsItBack) {
  say("run 1");
  say("open-beside " + second_.string());
  say("run 2");
  say("select-run 1");
  EXPECT_EQ(session_.undo_stack().to_undo()->label, "run 2") << "to look at another mesh is no change";
  say("undo");
  say("undo");
  EXPECT_EQ(session_.run_count(), 1U);
  EXPECT_EQ(session_.input()->mesh.name, "first.off");
  expect_at(0, alone(first_, {"run 1"}));
  say("redo");
  say("redo");
  ASSERT_EQ(session_.run_count(), 2U);
  expect_at(1, alone(second_, {"run 2"}));
}

TEST_F(SeveralMeshes, AnotherOpenReplacesAll) {
  say("open-beside " + second_.string());
  say("open " + second_.string());
  EXPECT_EQ(session_.run_count(), 1U);
  EXPECT_EQ(session_.inputs().size(), 1U);
}

TEST_F(SeveralMeshes, TheLastRunOfAMeshTakesTheMeshWithIt) {
  say("open-beside " + second_.string());
  say("remove-run 1");
  EXPECT_EQ(session_.run_count(), 1U);
  EXPECT_EQ(session_.input()->mesh.name, "second.off");
}

TEST_F(SeveralMeshes, AFailureLeavesTheSessionAsItWas) {
  say("run 1");
  EXPECT_TRUE(fails("open-beside " + (folder_ / "nothing.off").string()));
  EXPECT_TRUE(fails("open-beside " + volume_.string())) << "planar and volume meshes are drawn in other ways";
  EXPECT_EQ(session_.run_count(), 1U);
  expect_at(0, alone(first_, {"run 1"}));
}

TEST_F(SeveralMeshes, WithoutAMeshItIsOpenedAlone) {
  Session session(1);
  session.open_beside(second_, progress_);
  EXPECT_EQ(session.run_count(), 1U);
  EXPECT_EQ(session.input()->mesh.name, "second.off");
}

TEST_F(SeveralMeshes, OnlyTheActiveMeshIsReadAgain) {
  say("run 1");
  say("open-beside " + second_.string());
  say("run 2");
  make("generate random 95 8", second_);
  say("reload");
  expect_at(0, alone(first_, {"run 1"}));
  EXPECT_EQ(session_.active_index(), 1U);
  EXPECT_EQ(session_.run(1).moment(), Moment{});
  expect_at(1, alone(second_, {}));
}

TEST_F(SeveralMeshes, NothingWritesOverEither) {
  say("open-beside " + second_.string());
  say("select-run 1");
  EXPECT_TRUE(fails("export " + second_.string()));
  EXPECT_TRUE(fails("stats " + first_.string()));
}

TEST_F(SeveralMeshes, AreSavedAndOpenedBitForBit) {
  say("run 2");
  const std::filesystem::path state = folder_ / "session.dmoscope";
  const auto saved = [&] {
    std::ifstream stream(state);
    return nlohmann::ordered_json::parse(stream);
  };
  say("save-state " + state.string());
  EXPECT_EQ(saved().at("version"), 2) << "of one mesh: as programs of before read it";
  say("open-beside " + second_.string());
  say("run 3");
  say("select-run 1");
  say("save-state " + state.string());
  Session other(1);
  open_state(state, other, progress_);
  ASSERT_EQ(other.run_count(), 2U);
  EXPECT_EQ(other.active_index(), 0U);
  for (std::size_t run : {0U, 1U}) {
    const auto is = other.run(run).positions(), was = session_.run(run).positions();
    ASSERT_EQ(is.size(), was.size());
    EXPECT_EQ(std::memcmp(is.data(), was.data(), was.size() * sizeof(Vec3)), 0) << "run " << run;
  }

  auto damaged = saved();
  damaged["runs"][1]["mesh"] = 0;
  std::ofstream(state) << damaged;
  EXPECT_THROW(open_state(state, other, progress_), InputError) << "a run on another mesh than its own";
  damaged["runs"][1]["mesh"] = 7;
  damaged["runs"][1].erase("checksums");
  std::ofstream(state) << damaged;
  EXPECT_THROW(open_state(state, other, progress_), InputError);
}

TEST_F(SeveralMeshes, StatisticsSayWhichMeshTheyAreOf) {
  say("run 1");
  say("open-beside " + second_.string());
  say("run 1");
  const std::filesystem::path file = folder_ / "stats.csv";
  say("stats " + file.string());
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_THAT(text, HasSubstr("first.off:dmo:mean-ratio,1,"));
  EXPECT_THAT(text, HasSubstr("second.off:dmo:mean-ratio,1,"));
}

TEST_F(SeveralMeshes, AViewHasTheFramesOfBoth) {
  say("open-beside " + second_.string());
  FrameBuilder frames;
  const std::vector<Watch> watched{{session_.run(0).id(), {}}, {}};
  auto view = frames.build(session_, FrameDetail::Whole, watched);
  ASSERT_EQ(view->meshes.size(), 2U);
  EXPECT_NE(view->meshes[0].serial, view->meshes[1].serial);
  EXPECT_EQ(view->frame->input->mesh.name, "second.off");
  EXPECT_EQ(view->frame->input_serial, view->meshes[1].serial);
  const Frame& other = *view->watched[0].frame;
  EXPECT_EQ(other.input->mesh.name, "first.off");
  EXPECT_EQ(other.input_serial, view->meshes[0].serial);
  EXPECT_EQ(other.quality.size(), other.input->mesh.elements.size());
  EXPECT_EQ(view->watched[1].frame->input->mesh.name, "second.off") << "the input is that of the active run";
  while (frames.work_at_rest(session_, watched, [] { return true; })) view = frames.build(session_, FrameDetail::Whole, watched);
  ASSERT_TRUE(view->meshes[0].summary && view->meshes[1].summary);
  EXPECT_EQ(view->meshes[0].summary->statistics.minimum, session_.run(0).history().records()[0].statistics.minimum);
  EXPECT_EQ(view->meshes[1].summary->statistics.minimum, session_.run(1).history().records()[0].statistics.minimum);
  const std::uint64_t serial = view->meshes[0].serial;
  say("select-run 1");
  view = frames.build(session_, FrameDetail::Whole, watched);
  EXPECT_EQ(view->frame->input_serial, serial) << "to look at another mesh uploads nothing anew";
}

}  // namespace
}  // namespace dmoscope
