// Reading a file again, by hand and because it has changed.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "tests/gui/headless_test.h"
#include "tests/support/temporary_folder.h"

namespace dmoscope::app {
namespace {

namespace fs = std::filesystem;

class Reload : public HeadlessTest {
 protected:
  void SetUp() override {
    open();
    if (IsSkipped()) return;
    write(0.0);
    good("open \"" + file_.string() + "\"");
  }
  /// Writes a square of nine vertices whose middle one is off by `x`; `more`: with one vertex more.
  void write(double x, bool more = false) {
    std::ofstream file(file_);
    file << "OFF\n" << (more ? 10 : 9) << (more ? " 9 0\n" : " 8 0\n");
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) file << i + (i == 1 && j == 1 ? 0.3 + x : 0.0) << ' ' << j << " 0\n";
    if (more) file << "3 0 0\n";
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        const int a = 3 * j + i;
        file << "3 " << a << ' ' << a + 1 << ' ' << a + 4 << "\n3 " << a << ' ' << a + 4 << ' ' << a + 3 << '\n';
      }
    if (more) file << "3 2 9 5\n";
  }

  const test::TemporaryFolder folder_;
  const fs::path file_ = folder_ / "to reload.off";
};

TEST_F(Reload, KeepsParametersSelectionAndCamera) {
  good("grid 9");
  good("step iteration");
  good("metric min-angle");  // makes a run of its own
  good("fix 4");
  good("select-run 1");
  good("pick vertex 4");
  good("zoom 2");
  const auto camera = state().camera;
  const std::size_t runs = session()->runs.size();
  write(0.25);
  good("key F5");
  const auto view = session();
  EXPECT_EQ(view->input->mesh.positions[4].x, 1.55);
  ASSERT_EQ(view->runs.size(), runs);
  EXPECT_EQ(view->active, 0U);
  EXPECT_EQ(view->runs[0].parameters.search.grid_points, 9);
  EXPECT_EQ(view->runs.back().parameters.fixed, std::vector<Index>{4});
  EXPECT_EQ(view->frame->moment, Moment{});
  EXPECT_EQ(state().picked, (ui::Picked{ui::Picked::Kind::Vertex, 4}));
  EXPECT_EQ(state().camera, camera);
}

TEST_F(Reload, AnotherNumberOfVerticesForgetsWhatWasAboutThem) {
  good("fix 4");
  good("pick vertex 4");
  write(0.0, true);
  good("reload");
  EXPECT_EQ(session()->input->mesh.vertex_count(), 10U);
  EXPECT_TRUE(session()->runs[0].parameters.fixed.empty());
  EXPECT_EQ(state().picked, ui::Picked{});
}

TEST_F(Reload, AFailureKeepsWhatIsOpenAndSaysSo) {
  good("step iteration");
  const auto before = session();
  std::ofstream(file_) << "OFF\n3 1 0\nnonsense\n";
  const auto failure = window_->run("reload");
  ASSERT_TRUE(failure.has_value());
  EXPECT_NE(failure->text.find("to reload.off:2"), std::string::npos) << failure->text;
  EXPECT_EQ(session()->input, before->input);
  EXPECT_EQ(session()->frame->moment.iteration, 1U);
  good("dialog none");
  good("generate annulus");
  EXPECT_TRUE(window_->run("reload").has_value());  // there is no file
}

TEST_F(Reload, AWatchedFileIsReadAgainByItself) {
  good("watch on");
  for (int k = 0; k < 20; ++k) {  // the watching begins with the first look at the file
    window_->frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  write(0.125);
  for (int k = 0; k < 600 && session()->input->mesh.positions[4].x != 1.425; ++k) {
    window_->frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_EQ(session()->input->mesh.positions[4].x, 1.425);
  EXPECT_EQ(state().dialog, ui::Dialog::None);
}

}  // namespace
}  // namespace dmoscope::app
