// Doubled vertices of a seam slide as one: never apart, judged by both their stars, by every method and objective.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/smooth/execution/method_table.h"
#include "tests/smooth/sliding.h"
#include "tests/support/meshes.h"

namespace dmoscope::testing {
namespace {

/// Two sheets side by side that have the line x = 1 in common, each with vertices of its own. The second is turned up by an angle.
Mesh two_sheets(Cells cells, double up) {
  Mesh mesh = mapped(lattice(7, 0.35, 41, cells), [](Vec3 p) { return Vec3{p.x, p.y * p.y + p.y, 0.0}; });
  const Mesh other = mapped(lattice(7, 0.35, 42, cells), [](Vec3 p) { return Vec3{p.x, p.y * p.y + p.y, 0.0}; });
  double width = 0.0;
  for (const Vec3& p : mesh.positions) width = std::max(width, p.x);
  const Index n = mesh.vertex_count();
  for (const Vec3& p : other.positions)
    mesh.positions.push_back({p.x == 0.0 ? width : width + p.x * std::cos(up), p.y, p.x * std::sin(up)});
  for (Index e = 0; e < other.elements.size(); ++e) {
    std::vector<Index> corners(other.elements.corners(e).begin(), other.elements.corners(e).end());
    for (Index& v : corners) v += n;
    mesh.elements.add(other.elements.kind(e), corners);
  }
  return mesh;
}

std::size_t moved_pairs(const dmoscope::Run& run) {
  const std::span<const Vec3> before = run.input().mesh.positions;
  return static_cast<std::size_t>(
      std::ranges::count_if(run.domain()->pairs(), [&](const Partners& p) { return run.positions()[p.first] != before[p.first]; }));
}
void expect_together(const dmoscope::Run& run) {
  for (const auto& [first, second, shift] : run.domain()->pairs()) {
    const Vec3 expected = run.positions()[first] + shift;
    ASSERT_TRUE(same_bits(std::span(&expected, 1), run.positions().subspan(second, 1))) << first << ", " << second;
  }
}

TEST(Pairs, StayTogetherByEveryMethodAndObjective) {
  struct PlainComposite {
    std::string name;
    std::optional<CompositeTerms> combination{};
    bool then_mean = false;
    const char* metric = "mean-ratio";
  };
  const std::vector<PlainComposite> all{{"one"},
                                        {"mean", {}, true},
                                        {"two", CompositeTerms{0.3, Metric::ScaledJacobian}},
                                        {"formula", {}, true, "formula:det/norm^2"},
                                        {"target", {}, true, "mean-ratio@input:2"}};
  for (const double up : {0.0, 1.0})
    for (const Cells cells : {Cells::Triangles, Cells::Mixed}) {
      const auto mesh = input(two_sheets(cells, up));
      ASSERT_EQ(mesh->is_surface(), up > 0.0);
      for (const MethodInfo& method : method_table())
        for (const PlainComposite& aims : all) {
          RunParameters parameters = sliding_by();
          parameters.method = method.name;
          parameters.metric = parse_metric(aims.metric);
          parameters.combination = aims.combination;
          if (aims.then_mean) parameters.then_mean = PhaseBegin{.patience = 2};
          if (aims.name != "one" && (method.name.find("laplace") != std::string_view::npos || method.name == "angle-based")) continue;
          SCOPED_TRACE(std::string(method.name) + ", " + aims.name + ", " + std::to_string(up));
          std::optional<dmoscope::Run> run;
          try {
            run.emplace(make_run(mesh, parameters));
          } catch (const UsageError&) {
            continue;  // curved surfaces do not have the method, or not with such aims
          }
          EXPECT_EQ(run->domain()->pairs().size(), 6U);
          Progress progress;
          double least = run->statistics().minimum;
          for (int i = 0; i < 6; ++i) {
            run->iterate(1, progress);
            expect_together(*run);
            if (method.name != "laplace" && method.name != "angle-based") {
              EXPECT_GE(run->statistics().minimum, aims.combination ? std::min(least, aims.combination->threshold) : least);
            }
            least = run->statistics().minimum;
          }
          if (method.name == "dmo") {
            EXPECT_GT(moved_pairs(*run), 2U);
          }
          if (method.name != "dmo" || HasFailure()) continue;
          dmoscope::Run threads = make_run(mesh, parameters, 3);
          threads.iterate(6, progress);
          EXPECT_TRUE(same_bits(threads.positions(), run->positions()));
        }
    }
}

/// One vertex on either side of the line from (0, 0) to (0, 1), beside triangles whose best place for it is y and 1 - y: the best for both
/// together is in the middle.
TEST(Pairs, AreJudgedByBothStars) {
  Mesh mesh;
  const double height = 0.15;
  mesh.positions = {{0, 0, 0}, {0, 0.3, 0}, {0, 1, 0}, {-1, height, 0}, {0, 0, 0}, {0, 0.3, 0}, {0, 1, 0}, {1, 1 - height, 0}};
  for (const auto& corners : {std::array<Index, 3>{0, 1, 3}, {1, 2, 3}, {4, 7, 5}, {5, 7, 6}})
    mesh.elements.add(ElementKind::Triangle, corners);
  const auto seam = input(std::move(mesh));
  for (const char* method : {"dmo", "pattern-search", "active-set"}) {
    SCOPED_TRACE(method);
    RunParameters parameters = sliding_by();
    parameters.method = method;
    dmoscope::Run run = make_run(seam, parameters);
    ASSERT_EQ(run.domain()->pairs().size(), 1U);
    Progress progress;
    run.iterate(60, progress);
    expect_together(run);
    EXPECT_NEAR(run.positions()[1].y, 0.5, 1e-3);
    EXPECT_EQ(run.positions()[1].x, 0.0);
  }
}

/// Vertices between more than two, or beside one that stays, stay.
TEST(Pairs, StayWhereTheyWouldPart) {
  Mesh mesh = two_sheets(Cells::Triangles, 0.0);
  const Index n = mesh.vertex_count() / 2;
  Index on_seam = kNoIndex, partner = kNoIndex;
  for (Index v = 0; v < n; ++v)
    for (Index w = n; w < 2 * n; ++w)
      if (mesh.positions[v] == mesh.positions[w] && mesh.positions[v].y > 0.5) on_seam = v, partner = w;
  ASSERT_NE(on_seam, kNoIndex);
  RunParameters parameters = sliding_by();
  parameters.fixed = {partner};
  dmoscope::Run run = make_run(input(std::move(mesh)), parameters);
  Progress progress;
  const Vec3 before = run.positions()[on_seam];
  run.iterate(5, progress);
  expect_together(run);
  EXPECT_EQ(run.positions()[on_seam], before);
  EXPECT_GT(moved_pairs(run), 1U);
}

TEST(Pairs, NoClassHasTwoWhoseStarsTouch) {
  const auto mesh = input(two_sheets(Cells::Mixed, 0.0));
  const dmoscope::Run run = make_run(mesh, sliding_by());
  for (Index c = 0; c < run.colouring().class_count(); ++c) {
    std::set<Index> elements;
    std::size_t count = 0;
    for (const Index v : run.colouring().members(c)) {
      ASSERT_EQ(run.domain()->leader(v), kNoIndex) << "it is visited with another one";
      for (const Index one : {v, run.domain()->follower(v)}) {
        if (one == kNoIndex) continue;
        for (const Incidence& at : mesh->topology.star(one)) elements.insert(at.element), ++count;
      }
    }
    EXPECT_EQ(elements.size(), count) << "class " << c;
  }
}

/// A square whose left and right sides are drawn towards y = 1 alike, and which the file pairs; `turn`: how far the right half is turned.
Mesh periodic_square(double turn) {
  constexpr Index kCells = 6;
  Mesh mesh = mapped(lattice(kCells, 0.3, 7, Cells::Mixed), [turn](Vec3 p) {
    const Vec3 at{p.x, p.y * std::sqrt(p.y), 0.0};
    return turn == 0.0 ? at : Vec3{(1.0 + at.y) * std::sin(turn * at.x), (1.0 + at.y) * std::cos(turn * at.x), 0.0};
  });
  for (Index row = 0; row <= kCells; ++row) mesh.periodic.push_back({row * (kCells + 1) + kCells, row * (kCells + 1)});
  return mesh;
}

TEST(Pairs, PeriodicOnesMoveAlike) {
  for (const char* method : {"dmo", "pattern-search", "active-set", "laplace"}) {
    SCOPED_TRACE(method);
    RunParameters parameters = sliding_by();
    parameters.method = method;
    dmoscope::Run run = make_run(input(periodic_square(0.0)), parameters);
    EXPECT_EQ(run.domain()->pairs().size(), 5U) << "not the corners";
    Progress progress;
    run.iterate(8, progress);
    expect_together(run);
    EXPECT_GT(moved_pairs(run), 3U);
  }
}

/// Nothing is told of how one moves where the other does.
TEST(Pairs, PeriodicOnesThatAreTurnedStay) {
  dmoscope::Run run = make_run(input(periodic_square(0.8)), sliding_by());
  EXPECT_TRUE(run.domain()->pairs().empty());
  const std::vector<Vec3> before(run.positions().begin(), run.positions().end());
  Progress progress;
  run.iterate(8, progress);
  for (const auto& pair : run.input().mesh.periodic)
    for (const Index v : pair) EXPECT_EQ(run.positions()[v], before[v]) << v;
}

/// A block of hexahedra or wedges, x from 0 to 1; its inner and boundary vertices are moved within the block and along its faces.
Mesh block(Index n, bool wedges, std::uint64_t seed) {
  Mesh mesh;
  Random random(seed);
  const double h = 1.0 / n;
  for (Index k = 0; k <= n; ++k)
    for (Index j = 0; j <= n; ++j)
      for (Index i = 0; i <= n; ++i) {
        const auto moved = [&](Index at) { return h * (at + (at > 0 && at < n ? random(-0.25, 0.25) : 0.0)); };
        mesh.positions.push_back({h * i + (i > 0 && i < n ? random(-0.25, 0.25) * h : 0.0), moved(j), moved(k)});
      }
  const Index row = n + 1, layer = row * row;
  for (Index k = 0; k < n; ++k)
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) {
        const Index a = k * layer + j * row + i, b = a + 1, c = b + row, d = a + row;
        const auto add_prism = [&](ElementKind kind, std::vector<Index> corners) {
          const std::size_t count = corners.size();
          for (std::size_t corner = 0; corner < count; ++corner) corners.push_back(corners[corner] + layer);
          mesh.elements.add(kind, corners);
        };
        if (!wedges) {
          add_prism(ElementKind::Hexahedron, {a, b, c, d});
        } else {
          add_prism(ElementKind::Wedge, {a, b, c});
          add_prism(ElementKind::Wedge, {a, c, d});
        }
      }
  return mesh;
}

/// Faces of volumes: two blocks that have the face x = 1 in common, each with vertices of its own, and one whose ends the file pairs.
TEST(Pairs, OfVolumesMoveAlike) {
  constexpr Index kCells = 4;
  for (const bool wedges : {false, true}) {
    Mesh doubled = block(kCells, wedges, 3);
    Mesh periodic = doubled;
    const Index n = doubled.vertex_count();
    const Mesh other = block(kCells, wedges, 4);
    for (Index v = 0; v < n; ++v) {
      const bool at_begin = v % (kCells + 1) == 0;
      const Vec3 p = at_begin ? doubled.positions[v + kCells] : other.positions[v];
      doubled.positions.push_back(at_begin ? p : Vec3{1.0 + p.x, p.y, p.z});
      if (at_begin) {
        periodic.periodic.push_back({v, v + kCells});
        periodic.positions[v + kCells] = periodic.positions[v] + Vec3{1.0, 0.0, 0.0};
      }
    }
    for (Index e = 0; e < other.elements.size(); ++e) {
      std::vector<Index> corners(other.elements.corners(e).begin(), other.elements.corners(e).end());
      for (Index& v : corners) v += n;
      doubled.elements.add(other.elements.kind(e), corners);
    }
    for (const Mesh& mesh : {doubled, periodic})
      for (const char* method : {"dmo", "pattern-search"}) {
        SCOPED_TRACE(std::string(method) + (wedges ? ", wedges" : ", hexahedra") + (mesh.periodic.empty() ? ", doubled" : ", periodic"));
        RunParameters parameters = sliding_by();
        parameters.method = method;
        const auto specimen = input(mesh);
        dmoscope::Run run = make_run(specimen, parameters);
        constexpr std::size_t kInside = (kCells - 1) * (kCells - 1), kEdges = 4 * (kCells - 1);
        EXPECT_EQ(run.domain()->pairs().size(), kInside + kEdges) << "not the corners";
        Progress progress;
        double least = run.statistics().minimum;
        for (int i = 0; i < 5; ++i) {
          run.iterate(1, progress);
          expect_together(run);
          EXPECT_GE(run.statistics().minimum, least);
          least = run.statistics().minimum;
        }
        EXPECT_GT(moved_pairs(run), kInside);
        for (const Partners& pair : run.domain()->pairs()) EXPECT_NEAR(run.positions()[pair.first].x, mesh.positions[pair.first].x, 1e-12);
        dmoscope::Run threads = make_run(specimen, parameters, 3);
        threads.iterate(5, progress);
        EXPECT_TRUE(same_bits(threads.positions(), run.positions()));
      }
  }
}

}  // namespace
}  // namespace dmoscope::testing
