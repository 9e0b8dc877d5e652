// The visit of a vertex of a real mesh that grid inspection shows is the one that the smoother then makes, bit for bit.
#include <bit>
#include <filesystem>
#include <fstream>
#include <memory>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/inspect/visit_trace.h"
#include "core/quality/quality.h"
#include "tests/gui/headless_test.h"
#include "tests/gui/squares.h"
#include "tests/support/sanitized.h"
#include "tests/support/temporary_folder.h"
#include "ui/analysis/inspection_text.h"
#include "ui/commands/view_commands.h"

namespace dmoscope::app {
namespace {

using dmoscope::same_bits;
bool same_bits(Vec2<double> a, Vec2<double> b) { return same_bits(a.x, b.x) && same_bits(a.y, b.y); }
bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) { return same_bits(x, y); });
}

class Inspection : public HeadlessTest {
 protected:
  void SetUp() override {
    const auto file = std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes/ocean/east.14";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no shared meshes here";
    open(1280, 800, Backend::Cpu);
    if (IsSkipped()) return;
    good("open " + quote_word(file.string()));
    good("inspect on");
  }
  [[nodiscard]] const RunView& run() { return session()->runs[session()->active]; }

  /// Picks the vertex, compares the shown trace with a search of its own, then lets `move` visit it and compares with the stored position.
  void expect_the_truth(Index vertex, const std::string& move) {
    SCOPED_TRACE(fmt::format("vertex {}", vertex));
    good(fmt::format("pick vertex {}", vertex));
    ASSERT_TRUE(window_->app().inspection().trace.has_value()) << window_->app().inspection().trouble;
    const VisitTrace shown = *window_->app().inspection().trace;
    const auto before = session()->frame;
    ASSERT_EQ(shown.vertex, vertex);
    ASSERT_FALSE(shown.levels.empty());
    expect_same(shown, *before);
    expect_true_qualities(shown, *before);

    good(move);
    const auto after = session()->frame;
    ASSERT_NE(before, after);
    EXPECT_TRUE(same_bits(before->positions[vertex], shown.from));
    EXPECT_TRUE(same_bits(after->positions[vertex], shown.to)) << shown.sentence();
    EXPECT_EQ(!same_bits(after->positions[vertex], before->positions[vertex]), shown.end == VisitEnd::Moved) << shown.sentence();
    for (Index v = 0; v < before->vertex_count(); ++v) {
      if (v != vertex) {
        ASSERT_TRUE(same_bits(before->positions[v], after->positions[v])) << v;
      }
    }
    moved_ += shown.end == VisitEnd::Moved ? 1 : 0;
  }

  void expect_same(const VisitTrace& shown, const Frame& frame) {
    const RunParameters& parameters = run().parameters;
    const VisitTrace own = trace_visit(*frame.input, frame.positions, run().fixed, parameters.metric, parameters.search, shown.vertex, {},
                                       run().sweep.untangling);
    ASSERT_EQ(shown.levels.size(), own.levels.size());
    for (std::size_t i = 0; i < own.levels.size(); ++i) {
      const TracedLevel &a = shown.levels[i], &b = own.levels[i];
      EXPECT_TRUE(same_bits(a.centre, b.centre) && same_bits(a.size, b.size));
      ASSERT_EQ(a.offsets.size(), b.offsets.size());
      for (std::size_t k = 0; k < b.offsets.size(); ++k) EXPECT_TRUE(same_bits(a.offsets[k], b.offsets[k])) << k;
      EXPECT_TRUE(same_bits(a.values, b.values) && same_bits(a.quality, b.quality));
      EXPECT_EQ(a.best, b.best);
    }
    EXPECT_TRUE(same_bits(shown.to, own.to) && same_bits(shown.found, own.found));
  }

  /// Compares the qualities of the candidates with those of whole meshes.
  void expect_true_qualities(const VisitTrace& shown, const Frame& frame) {
    const InputMesh& input = *frame.input;
    std::vector<Vec3> positions = frame.positions;
    for (const TracedLevel& level : shown.levels)
      for (std::size_t k = 0; k < level.offsets.size(); ++k) {
        const Vec3 step = input.geometry.plane.lift(level.offsets[k]);
        positions[shown.vertex] = shown.from + step;
        double quality = 1e300, jacobian = 1e300;
        for (const ElementChange& change : shown.elements) {
          quality = std::min(quality, element_quality(input.quality_context(), positions, shown.metric, change.element));
          const double smallest = smallest_jacobian(input.quality_context(), positions, change.element);
          jacobian = std::min(jacobian, smallest / input.reference_measure[change.element]);
        }
        EXPECT_TRUE(same_bits(level.quality[k], jacobian > 0.0 ? quality : jacobian)) << k;
      }
  }

  int moved_ = 0;
};

TEST_F(Inspection, ShowsWhatTheNextStepDoes) {
  for (const char* precision : {"float", "double"}) {
    good(fmt::format("precision {}", precision));
    moved_ = 0;
    for (int i = 0; i < 12 && !HasFailure(); ++i) {
      good("step vertex 371");
      expect_the_truth(run().colouring->order[session()->frame->moment.visits], "step vertex");
    }
    EXPECT_GT(moved_, 3) << precision;
  }
}

TEST_F(Inspection, ShowsWhatAVisitOfAnyVertexDoes) {
  good("step iteration");
  for (const char* metric : {"mean-ratio", "min-angle", "radius-ratio"}) {
    good(fmt::format("metric {}", metric));
    moved_ = 0;
    for (std::size_t i = 0; i < (testing::kSanitized ? 5 : 12) && !HasFailure(); ++i) {
      const auto& order = run().colouring->order;
      const Index vertex = order[(i * 7919 + 13) % order.size()];
      expect_the_truth(vertex, fmt::format("visit {}", vertex));
    }
    EXPECT_GT(moved_, testing::kSanitized ? 0 : 3) << metric;
  }
}

/// Sixteen squares of two triangles, with a middle vertex far out.
class InspectionOfAStray : public HeadlessTest {
 protected:
  static constexpr Index kStray = 12;
  void open_it() {
    const std::filesystem::path file = folder_ / "stray.off";
    std::ofstream(file) << squares_with(4, kStray, "40 -3 0");
    good("open " + file.string());
    good("inspect on");
  }
  [[nodiscard]] const ui::Inspection& look(Index vertex) {
    good(fmt::format("pick vertex {}", vertex));
    return window_->app().inspection();
  }
  test::TemporaryFolder folder_;
};

TEST_F(InspectionOfAStray, NeighboursAreSaidToWaitAndNotToBeFixed) {
  open_it();
  const auto before = session()->frame;
  const Index sound = 18;  // in no element of the stray vertex
  const ui::Inspection& inspection = look(sound);
  ASSERT_NE(inspection.visit(), nullptr) << inspection.trouble;
  EXPECT_EQ(inspection.visit()->end, VisitEnd::Waits);
  EXPECT_EQ(ui::level_label(state().inspection, inspection), "waits");
  EXPECT_EQ(ui::search_phrase(*inspection.visit()), "not searched");
  EXPECT_EQ(ui::stuck_sentence(inspection).substr(0, 8), "It waits");
  EXPECT_EQ(look(kStray).visit()->end, VisitEnd::Moved);
  good("step iteration");
  const auto after = session()->frame;
  for (Index v = 0; v < 25; ++v) EXPECT_EQ(same_bits(before->positions[v], after->positions[v]), v != kStray) << v;
  EXPECT_EQ(look(sound).level_count(), 3U) << "the next iteration searches again";
}

}  // namespace
}  // namespace dmoscope::app
