// Sliding boundaries in a session, step by step.

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/reference/domain.h"
#include "tests/session/spoken_session.h"
#include "tests/support/temporary_folder.h"

namespace dmoscope {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

class BoundaryInASession : public testing::SpokenSession {
 protected:
  [[nodiscard]] std::string boundary() { return std::string(name(session_.active().parameters().boundary)); }
  [[nodiscard]] std::vector<Vec3> positions() { return {session_.active().positions().begin(), session_.active().positions().end()}; }
};

TEST_F(BoundaryInASession, SlidesIsSaidAndUndone) {
  say("generate coast 300 2");
  const std::uint64_t before = session_.active().visits_per_iteration();
  say("boundary slide");
  EXPECT_THAT(messages_, Contains(HasSubstr("slide along the boundary, and ")));
  EXPECT_GT(session_.active().visits_per_iteration(), before);
  EXPECT_THAT(session_.active().title(), HasSubstr("boundary slide"));
  say("step iteration");
  say("step class");
  say("step vertex");
  const std::vector<Vec3> there = positions();
  say("step iteration");
  say("undo");
  EXPECT_EQ(positions(), there);
  say("corner-angle 1");
  EXPECT_THAT(session_.active().title(), HasSubstr("corner angle 1"));
  EXPECT_LT(session_.active().domain()->count(), session_.input()->mesh.vertex_count());
  say("generate coast 300 3");
  EXPECT_EQ(boundary(), "fixed") << "another mesh has a boundary of its own";
}

TEST_F(BoundaryInASession, OfAVolumeSlidesOnItsSurface) {
  say("generate hexahedra 200 2");
  say("boundary slide");
  EXPECT_THAT(messages_, Contains(HasSubstr("on feature edges")));
  say("run 2");
  say("step vertex");
  const std::vector<Vec3> there = positions();
  const Index on_edges = session_.active().domain()->count_on_curves();
  say("feature-angle 120");
  EXPECT_LT(session_.active().domain()->count_on_curves(), on_edges);
  say("undo");
  EXPECT_EQ(positions(), there);
}

TEST_F(BoundaryInASession, WhyFixedTellsCorners) {
  say("generate nested 100 1");
  say("boundary slide");
  EXPECT_EQ(session_.active().why_fixed(0), "it is a corner: the boundary or feature edge turns there by more than the corner angle");
  EXPECT_EQ(session_.active().why_fixed(1), "");
  say("visit 1");
}

TEST_F(BoundaryInASession, StateFilesKeepIt) {
  const test::TemporaryFolder folder;
  const std::string file = (folder.path() / "a.dmoscope").string();
  say("generate coast 300 2");
  say("boundary slide");
  say("max-deviation 0.01");
  say("run 3");
  say("step vertex");
  const std::vector<Vec3> there = positions();
  say("save-state " + file);
  say("generate coast 300 2");
  say("open-state " + file);
  EXPECT_EQ(boundary(), "slide");
  EXPECT_EQ(session_.active().parameters().max_deviation, 0.01);
  EXPECT_EQ(positions(), there);
  say("seek 0");
  say("run 3");
  say("step vertex");
  EXPECT_EQ(positions(), there) << "computed again";
  // Files from before there were sliding boundaries have fixed ones.
  say("generate coast 300 2");
  say("run 1");
  say("save-state " + file);
  auto json = nlohmann::ordered_json::parse(std::ifstream(file));
  json["version"] = 1;
  json.erase("checksums");
  for (auto& run : json["runs"]) {
    run.erase("checksums");
    for (const char* each : {"boundary", "corner-angle", "feature-angle", "max-deviation"}) run["parameters"].erase(each);
  }
  std::ofstream(file) << json;
  say("open-state " + file);
  EXPECT_EQ(boundary(), "fixed");
}

TEST_F(BoundaryInASession, WhatCannotBeIsRefused) {
  say("generate coast 300 1");
  for (const char* line : {"boundary up", "corner-angle 0", "corner-angle 181", "max-deviation -1", "max-deviation 1.5"})
    EXPECT_TRUE(fails(line)) << line;
  say("boundary slide");
  say("method dvr");
  EXPECT_EQ(session_.active().parameters().method, "dvr");
  say("generate globe 300 1");
  EXPECT_TRUE(fails("boundary slide"));
  EXPECT_EQ(boundary(), "fixed");
}

}  // namespace
}  // namespace dmoscope
