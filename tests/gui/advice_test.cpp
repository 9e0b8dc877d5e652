// Advice is kept: on 30 meshes each command that the window offers is followed, and gives the result that was promised.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/engine/engine.h"
#include "core/io/mesh_io.h"
#include "core/run/trial.h"
#include "tests/support/meshes.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/volume_grids.h"
#include "ui/commands/notice.h"

namespace dmoscope::ui {
namespace {
namespace advice {

using ::testing::HasSubstr;

struct Case {
  std::string mesh;                   // words of a generator, or name of a mesh made here
  std::vector<std::string> before{};  // commands to run first
  std::string run = "until-converged best 20 60";
};

/// Meshes without a generator: a spoiled boundary, stretched cells, a fold with a crease, thin layers, the least that there is.
Mesh made(const std::string& name) {
  if (name == "tiny") return testing::lattice(2, 0.4, 7);
  if (name == "one triangle") {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    testing::add(mesh, {0, 1, 2});
    return mesh;
  }
  if (name == "block of hexahedra") {
    Mesh mesh = test::volume_grid(4, test::Fill::Hexahedra);
    mesh.positions[2 * 25 + 2].x -= 0.22;
    return mesh;
  }
  if (name == "corner of a block") {
    Mesh mesh = test::volume_grid(4, test::Fill::Hexahedra);
    mesh.positions[12] = mesh.positions[12] + Vec3{0.2, 0.2, 0};
    return mesh;
  }
  Mesh mesh = testing::lattice(8, name == "folded" || name == "roof" ? 0.25 : 0.35, 5, testing::Cells::Mixed);
  if (name == "spoiled boundary") mesh.positions[3].x -= 0.1;
  if (name == "two spoiled places") mesh.positions[3].x -= 0.1, mesh.positions[8 * 9 + 3].x -= 0.09;
  if (name == "stretched")
    for (Vec3& p : mesh.positions) p.x *= 30.0;
  if (name == "layers")
    for (Vec3& p : mesh.positions) p.y = p.y * p.y * p.y;
  if (name == "folded")
    for (Vec3& p : mesh.positions) p.z = 0.3 * std::abs(p.x - 0.5);
  if (name == "roof")
    for (Vec3& p : mesh.positions) p.z = 1.5 * std::min(p.x, 1 - p.x) + 0.2 * p.y * p.y;
  return mesh;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"generate coast 400"},
      {"generate coast 900", {}, "run 2"},
      {"generate block 300"},
      {"generate annulus 300"},
      {"generate random 300"},
      {"generate random 300 2", {"then mean"}},
      {"generate quads 300"},
      {"generate mixed 300"},
      {"generate tangled 200"},
      {"generate tangled 200 3", {"method dvr"}, "run 1"},
      {"generate grid 200", {"fix 24-40"}},
      {"generate wrapped 300"},
      {"generate globe 300"},
      {"generate tetrahedra 200"},
      {"generate hexahedra 150", {"boundary slide"}, "run 5"},
      {"generate solids 150"},
      {"generate tangled-solids 150", {}, "run 3"},
      {"generate screw 300"},
      {"generate elbow 150", {"boundary slide"}, "run 3"},
      {"generate can 300", {"boundary slide"}},
      {"generate nested 250"},
      {"generate nested-solids 200"},
      {"generate anisotropic 250"},
      {"generate biased 216"},
      {"tiny"},
      {"one triangle"},
      {"spoiled boundary"},
      {"two spoiled places", {"fix 73-77"}},
      {"stretched", {"boundary slide"}},
      {"layers"},
      {"folded", {"boundary slide"}},
      {"roof", {"feature-angle 20"}},
      {"block of hexahedra"},
      {"corner of a block", {"boundary slide", "corner 12"}},
      {"spoiled boundary", {"method laplace"}},
      {"generate random 200 4", {"combine mean-ratio:0.4:density h1:-1,-1"}},
  };
  return all;
}

class Advice : public ::testing::Test {
 protected:
  void good(const std::string& line) {
    engine_->post(line);
    engine_->wait_idle();
    for (const CommandEnd& end : engine_->take_ends()) ASSERT_EQ(end.kind, CommandEnd::Kind::Done) << line << ": " << errors();
  }
  [[nodiscard]] std::string errors() {
    std::string text;
    for (const Message& message : engine_->take_messages()) text += message.text + "\n";
    return text;
  }
  /// Begins a case in a session of its own: an opened mesh gets the parameters of the run before it.
  void begin(const Case& one) {
    engine_ = std::make_unique<Engine>(1);
    if (one.mesh.starts_with("generate ")) {
      good(one.mesh);
    } else {
      const Mesh mesh = made(one.mesh);
      Progress progress;
      const std::string file = (folder_.path() / "made.vtk").string();
      write_mesh(file, mesh, mesh.positions, progress);
      good("open \"" + file + "\"");
    }
    for (const std::string& line : one.before) good(line);
    good(one.run);
  }
  [[nodiscard]] RunView run() { return engine_->view()->runs.at(engine_->view()->active); }
  [[nodiscard]] Statistics now() {
    const RunView at = run();
    return at.records.whole()[at.moment.iteration].statistics;
  }
  /// The second number of "0.8035 -> 0.8062 in 20 iterations", as a person reads it.
  [[nodiscard]] static double said(const std::string& figures) { return std::stod(figures.substr(figures.find("-> ") + 3)); }

  std::unique_ptr<Engine> engine_;
  test::TemporaryFolder folder_;
};

TEST_F(Advice, IsKeptOnThirtyMeshes) {
  EXPECT_GE(cases().size(), 30U);
  std::size_t with_numbers = 0, followed = 0;
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.mesh + ", " + fmt::format("{}", fmt::join(one.before, ", ")));
    begin(one);
    const RunView ended = run();
    const Statistics before = now();
    const auto held = ended.held.found;
    if (held && held->has_advice()) {
      ++followed;
      for (const std::string& line : held->advice()) good(line);
      EXPECT_GE(now().minimum, before.minimum) << held->sentence();
      EXPECT_LE(now().inverted, before.inverted) << held->sentence();
      if (held->trial) {
        ++with_numbers;
        const double reached = now().minimum;
        EXPECT_GE(reached, said(held->trial->figures())) << held->sentence();
        EXPECT_THAT(held->sentence(), HasSubstr(held->trial->figures()));
      }
      RunParameters wanted = ended.parameters;
      for (const auto& change : {held->change, held->also}) {
        if (change) apply_switch(*change, wanted);
      }
      EXPECT_EQ(run().parameters, wanted) << "the trial was of what the command does";
    }
    if (held && held->trial && !held->trial->gains()) {
      EXPECT_THAT(held->sentence(), HasSubstr("no gain"));
    }
  }
  RecordProperty("followed", static_cast<int>(followed));
  EXPECT_GT(with_numbers, 8U);
}

TEST_F(Advice, OfTheNoticeIsKept) {
  std::size_t followed = 0;
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.mesh + ", " + fmt::format("{}", fmt::join(one.before, ", ")));
    begin(one);
    const RunView ended = run();
    const std::size_t place = engine_->view()->active;
    const Statistics before = now();
    for (const Offer& offer : notice_of(*engine_->view()).offers) {
      if (offer.command.starts_with("goto ")) continue;  // an action that only shows something
      ++followed;
      SCOPED_TRACE(offer.label);
      good(fmt::format("select-run {}", place + 1));
      good(offer.command);
      if (run().id != ended.id && run().moment == Moment{}) good("until-converged best 20 100");
      const Statistics reached = now();
      if (offer.id == "notice:method") {
        EXPECT_LE(reached.inverted, ended.ending->hint->left);
      }
      if (offer.id.starts_with("notice:keep-")) {
        ASSERT_TRUE(run().ending);
        for (const CardFigure* figure : run().ending->card.worse()) {
          EXPECT_NE(figure->kept_by, offer.command) << figure->name;
          EXPECT_NE(figure->helped_by, offer.command) << figure->name;
        }
        EXPECT_THAT(offer.tooltip, HasSubstr("may rise less"));
      } else {
        EXPECT_GE(reached.minimum, before.minimum - kLeastRise);
      }
    }
  }
  EXPECT_GT(followed, 8U);
}

}  // namespace advice
}  // namespace
}  // namespace dmoscope::ui
