// Corners and feature edges that the user sets, as commands, in saved sessions, and back.

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/io/mesh_io.h"
#include "core/reference/domain.h"
#include "core/session/state_file.h"
#include "tests/session/spoken_session.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class KindsInASession : public testing::SpokenSession {
 protected:
  [[nodiscard]] const Kinds& kinds() { return session_.active().parameters().kinds; }
  [[nodiscard]] const Domain& domain() { return *session_.active().domain(); }
  [[nodiscard]] std::vector<Vec3> positions() { return {session_.active().positions().begin(), session_.active().positions().end()}; }
  /// A block of 4 x 4 x 4 cells, whose boundary slides; the number of a vertex counts x first.
  void open_block() {
    const Mesh mesh = test::volume_grid(4, test::Fill::Hexahedra, 0.2, 3);
    Progress progress;
    write_mesh(folder_.path() / "block.vtk", mesh, mesh.positions, progress);
    say("open \"" + (folder_.path() / "block.vtk").string() + "\"");
    say("boundary slide");
  }
  const test::TemporaryFolder folder_;
};

TEST_F(KindsInASession, AreSaidUndoneAndMadeAutomaticAgain) {
  open_block();
  ASSERT_TRUE(domain().on_surface(12) && domain().on_curve(2)) << "on the lower side, and its front edge";
  say("corner 12 2-3");
  EXPECT_EQ(kinds().corners, (std::vector<Index>{2, 3, 12}));
  for (const Index v : kinds().corners) EXPECT_EQ(session_.active().fixed()[v], 1);
  EXPECT_EQ(session_.active().why_fixed(12), "it was made a corner by hand");
  EXPECT_THAT(session_.active().title(), HasSubstr("3 corners by hand"));
  EXPECT_THAT(messages_, Contains(HasSubstr("slide along the boundary")));
  say("undo");
  EXPECT_TRUE(kinds().empty() && domain().slides(12));
  say("redo");
  EXPECT_FALSE(domain().slides(12));
  say("no-corner 3");
  EXPECT_EQ(kinds().corners, (std::vector<Index>{2, 12}));
  EXPECT_EQ(kinds().no_corners, std::vector<Index>{3});
  say("auto-corner 12");
  EXPECT_TRUE(domain().slides(12));
  say("auto-corner");
  EXPECT_TRUE(kinds().empty());
  say("no-feature chain:1-2");
  EXPECT_EQ(kinds().no_features.size(), 4U);
  EXPECT_TRUE(domain().on_surface(2));
  say("feature 11-12-13");
  EXPECT_EQ(kinds().features, (std::vector<EdgeEnds>{{11, 12}, {12, 13}}));
  EXPECT_TRUE(domain().on_curve(12));
  say("auto-feature 0-1");
  EXPECT_EQ(kinds().no_features.size(), 3U);
  say("auto-feature");
  EXPECT_TRUE(kinds().empty());
}

TEST_F(KindsInASession, AChangeAfterAStepStartsARunBeside) {
  open_block();
  say("run 2");
  const std::vector<Vec3> there = positions();
  say("corner 12");
  ASSERT_EQ(session_.run_count(), 2U);
  say("run 2");
  EXPECT_EQ(positions()[12], session_.input()->mesh.positions[12]);
  EXPECT_NE(positions(), there);
  say("select-run 1");
  EXPECT_EQ(positions(), there);
  say("select-run 2");
  say("generate coast 300 2");
  EXPECT_TRUE(kinds().empty()) << "of another mesh";
}

TEST_F(KindsInASession, WhatCannotBeIsRefusedWithTheReason) {
  open_block();
  EXPECT_EQ(why("no-corner 0"), "vertex 0 stays: feature edges meet there");
  EXPECT_THAT(why("corner 62"), HasSubstr("vertex 62 lies on no boundary, interface or surface; 'fix' keeps it"));
  EXPECT_THAT(why("feature 0-2"), HasSubstr("there is no edge 0-2: those of 0 lead to 1, 5, 25"));
  EXPECT_THAT(why("feature 31-62"), HasSubstr("there is no edge"));
  EXPECT_THAT(why("feature 37-62"), HasSubstr("lies on no boundary, interface or surface"));
  EXPECT_THAT(why("no-feature chain:6-7"), HasSubstr("no feature edge"));
  EXPECT_THAT(why("corner 125"), HasSubstr("there is no vertex 125"));
  EXPECT_THAT(why("corner"), HasSubstr("corner VERTEX"));
  EXPECT_THAT(why("feature"), HasSubstr("feature A-B"));
  EXPECT_TRUE(kinds().empty());
  say("no-corner 0 2");
  EXPECT_THAT(messages_, Contains("vertex 0 stays: feature edges meet there")) << "the other one slides";
  say("auto-corner");
  say("boundary fixed");
  EXPECT_EQ(why("corner 12"), "");
  EXPECT_THAT(messages_, Contains(HasSubstr("vertex 12: nothing slides there now: it counts from 'boundary slide'")));
  EXPECT_THAT(session_.active().title(), Not(HasSubstr("by hand")));
  say("boundary slide");
  EXPECT_FALSE(domain().slides(12));
}

TEST_F(KindsInASession, StateFilesKeepThem) {
  const std::string file = (folder_.path() / "a.dmoscope").string();
  open_block();
  say("corner 12");
  say("no-corner 3");
  say("feature 6-7");
  say("no-feature chain:1-2");
  say("run 2");
  say("step vertex");
  const Kinds said = kinds();
  const std::vector<Vec3> there = positions();
  say("save-state " + file);
  say("generate coast 300 2");
  say("open-state " + file);
  EXPECT_EQ(kinds(), said);
  EXPECT_EQ(positions(), there);
  say("seek 0");
  say("run 2");
  say("step vertex");
  EXPECT_EQ(positions(), there) << "computed again";
  // Old sessions have none; damaged ones are refused.
  const auto reopened = [&](const auto& change) {
    auto json = nlohmann::ordered_json::parse(std::ifstream(file));
    json["version"] = 1;
    json.erase("checksums");
    for (auto& run : json["runs"]) {
      run.erase("checksums");
      run.erase("standing");
      change(run);
    }
    const std::string other = file + ".changed";
    std::ofstream(other) << json;
    return why("open-state " + other);
  };
  EXPECT_THAT(reopened([](auto& run) { run["parameters"]["kinds"]["features"][0] = {0, 2}; }), HasSubstr("there is no edge 0-2"));
  EXPECT_THAT(reopened([](auto& run) { run["parameters"]["kinds"]["features"][0] = {0}; }), HasSubstr("an edge is a pair"));
  EXPECT_THAT(reopened([](auto& run) { run["parameters"]["kinds"].erase("corners"); }), HasSubstr("something is missing"));
  EXPECT_EQ(kinds(), said);
  const auto start_anew = [](auto& run) {
    run["parameters"].erase("kinds");
    run["moment"] = {0, 0, 0};
    run.erase("positions");
    run["records"] = nlohmann::ordered_json::array({run["records"][0]});
  };
  EXPECT_EQ(reopened(start_anew), "");
  EXPECT_TRUE(kinds().empty());
}

TEST_F(KindsInASession, AFileThatHasOtherEdgesNowForgetsThem) {
  open_block();
  say("feature 6-7");
  say("corner 12");
  Mesh mesh = test::volume_grid(4, test::Fill::Hexahedra, 0.1, 4);
  Progress progress;
  write_mesh(folder_.path() / "block.vtk", mesh, mesh.positions, progress);
  say("reload");
  EXPECT_EQ(kinds().size(), 2U) << "the same vertices and edges elsewhere";
  mesh = test::volume_grid(3, test::Fill::Hexahedra);
  write_mesh(folder_.path() / "block.vtk", mesh, mesh.positions, progress);
  say("reload");
  EXPECT_TRUE(kinds().empty());
  EXPECT_THAT(messages_, Contains(HasSubstr("corners and feature edges are as file and angles say again")));
}

TEST_F(KindsInASession, AMadeCornerThatHoldsTheMinimumIsGivenBack) {
  Mesh mesh = test::volume_grid(4, test::Fill::Hexahedra);
  mesh.positions[12] = mesh.positions[12] + Vec3{0.2, 0, 0};  // on the lower side, almost to the next one
  Progress progress;
  write_mesh(folder_.path() / "spoiled.vtk", mesh, mesh.positions, progress);
  say("open \"" + (folder_.path() / "spoiled.vtk").string() + "\"");
  say("boundary slide");
  say("corner 12");
  say("until-converged");
  say("held-by");
  EXPECT_THAT(messages_, Contains(HasSubstr("auto-corner 12 would free it (giving up corners by hand: 12); tried ")));
}

}  // namespace
}  // namespace dmoscope
