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
  for (const auto& [first, second, shift] : run.domain()->pairs())
    ASSERT_TRUE(same_bits(run.positions().subspan(first, 1), run.positions().subspan(second, 1))) << first << ", " << second;
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

}  // namespace
}  // namespace dmoscope::testing
