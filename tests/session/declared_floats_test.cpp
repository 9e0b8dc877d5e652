// Text files that declare their points as float: every state of a run has such numbers, and is as sound as a reader of floats finds it.

#include <bit>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/io/mesh_io.h"
#include "core/quality/quality.h"
#include "tests/session/spoken_session.h"
#include "tests/support/temporary_folder.h"

namespace dmoscope {
namespace {
namespace declared_floats {

/// A grid of thin triangles, far from the origin: rows lie 1/16 apart, as floats do there, and digits put every other vertex 1/64 off.
std::string far_grid(const char* type) {
  constexpr int kColumns = 9, kRows = 9;
  std::string text =
      fmt::format("# vtk DataFile Version 3.0\nfar\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} {}\n", kColumns * kRows, type);
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < kColumns; ++i)
      text += fmt::format("{} {} 0\n", 1000000.0 + i * 0.25 + ((i + j) % 2) / 64.0, 1000000.0 + j * 0.1875 + ((i * j) % 3) / 70.0);
  constexpr int kTriangles = 2 * (kColumns - 1) * (kRows - 1);
  text += fmt::format("CELLS {} {}\n", kTriangles, 4 * kTriangles);
  for (int j = 0; j + 1 < kRows; ++j)
    for (int i = 0; i + 1 < kColumns; ++i) {
      const int a = j * kColumns + i, b = a + 1, c = a + kColumns, d = c + 1;
      text += fmt::format("3 {} {} {}\n3 {} {} {}\n", a, b, d, a, d, c);
    }
  text += fmt::format("CELL_TYPES {}\n", kTriangles);
  for (int e = 0; e < kTriangles; ++e) text += "5\n";
  return text;
}

class DeclaredFloats : public testing::SpokenSession {
 protected:
  DeclaredFloats() {
    std::ofstream(folder_ / "floats.vtk") << far_grid("float");
    std::ofstream(folder_ / "doubles.vtk") << far_grid("double");
  }
  [[nodiscard]] std::size_t not_floats() {
    std::size_t others = 0;
    for (const Vec3& p : session_.active().positions())
      for (const double c : {p.x, p.y, p.z}) others += static_cast<double>(static_cast<float>(c)) != c ? 1U : 0U;
    return others;
  }
  test::TemporaryFolder folder_;
};

TEST_F(DeclaredFloats, EveryStateStandsOnThem) {
  for (const char* method : {"dmo", "laplace", "smart-laplace", "pattern-search", "joint"}) {
    SCOPED_TRACE(method);
    say("open " + (folder_ / "floats.vtk").string());
    say(std::string("method ") + method);
    const auto& run = session_.active();
    EXPECT_EQ(not_floats(), 0U);
    for (int i = 0; i < 3; ++i) {
      say("step iteration");
      EXPECT_EQ(not_floats(), 0U) << i;
    }
    const std::string out = (folder_ / "out.vtk").string();
    say("export " + out);
    const Mesh digits = read_mesh(out, progress_);
    const auto again = load_input(out, Need::Smoothing, progress_);
    for (Index v = 0; v < digits.vertex_count(); ++v) {
      const Vec3 p = run.positions()[v], q = again->mesh.positions[v], d = digits.positions[v];
      EXPECT_EQ(p, q) << v;
      EXPECT_EQ(p, (Vec3{static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)})) << v;
    }
    const std::span<const Index> none;
    EXPECT_EQ(compute_statistics(run.input().quality_context(), run.positions(), Metric::MeanRatio, none, nullptr).inverted, 0U);
  }
}

TEST_F(DeclaredFloats, DoublesKeepTheirDigits) {
  say("open " + (folder_ / "doubles.vtk").string());
  EXPECT_GT(not_floats(), 0U);
  say("step iteration");
  EXPECT_GT(not_floats(), 0U);
}

}  // namespace declared_floats
}  // namespace
}  // namespace dmoscope
