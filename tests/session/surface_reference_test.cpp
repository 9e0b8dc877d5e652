// A mesh that slides on the surface of another one, in a session.

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/reference/domain.h"
#include "core/session/state_file.h"
#include "tests/session/spoken_session.h"
#include "tests/support/temporary_folder.h"

namespace dmoscope {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

class AReferenceInASession : public testing::SpokenSession {
 protected:
  AReferenceInASession() {
    say("generate can 3000 2");
    say("export " + fine());
    say("generate can 500 1");
    say("export " + coarse());
    say("open " + coarse());
  }
  [[nodiscard]] std::string fine() const { return (folder_.path() / "fine.off").string(); }
  [[nodiscard]] std::string coarse() const { return (folder_.path() / "coarse.off").string(); }
  [[nodiscard]] std::vector<Vec3> positions() { return {session_.active().positions().begin(), session_.active().positions().end()}; }

  test::TemporaryFolder folder_;
};

TEST_F(AReferenceInASession, IsSaidUndoneAndKeptWhenTheFileIsReadAgain) {
  say("run 2");
  const std::vector<Vec3> own = positions();
  say("surface " + fine());
  EXPECT_EQ(session_.active().moment().iteration, 0U);
  EXPECT_THAT(messages_, Contains(HasSubstr("slide on the surface")));
  EXPECT_EQ(session_.input()->surface->path.filename(), "fine.off");
  say("run 2");
  const std::vector<Vec3> there = positions();
  EXPECT_NE(there, own);
  say("undo");
  say("undo");
  EXPECT_EQ(positions(), own);
  say("redo");
  say("redo");
  EXPECT_EQ(positions(), there);
  say("reload");
  ASSERT_NE(session_.input()->surface, nullptr);
  say("run 2");
  EXPECT_EQ(positions(), there);
  say("surface own");
  EXPECT_EQ(session_.input()->surface, nullptr);
  say("run 2");
  EXPECT_EQ(positions(), own);
}

TEST_F(AReferenceInASession, IsSavedWithIt) {
  const std::string saved = (folder_.path() / "saved.dmoscope").string();
  say("surface " + fine());
  say("run 3");
  const std::vector<Vec3> there = positions();
  say("save-state " + saved);
  say("generate can 500 1");
  say("open-state " + saved);
  ASSERT_NE(session_.input()->surface, nullptr);
  EXPECT_EQ(positions(), there);
  say("back iteration");
  say("step iteration");
  EXPECT_EQ(positions(), there);

  // Another surface would lead the run elsewhere.
  const std::string other = (folder_.path() / "other.off").string();
  say("generate can 3000 3");
  say("export " + other);
  std::filesystem::rename(other, fine());
  EXPECT_TRUE(fails("open-state " + saved));
}

TEST_F(AReferenceInASession, IsNotWrittenOver) {
  say("surface " + fine());
  EXPECT_TRUE(fails("export " + fine()));
  EXPECT_TRUE(fails("surface " + (folder_.path() / "nothing.off").string()));
  EXPECT_NE(session_.input()->surface, nullptr);
  say("generate coast 300 2");
  EXPECT_TRUE(fails("surface " + fine())) << "a planar mesh slides in its plane";
}

}  // namespace
}  // namespace dmoscope
