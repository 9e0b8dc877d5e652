// The report card of a run, against figures worked out here.

#include "core/run/report_card.h"

#include <algorithm>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/run/run.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using testing::add;
using testing::Cells;
using ::testing::HasSubstr;
using testing::input;
using testing::lattice;

const CardFigure& figure(const ReportCard& card, std::string_view of, std::string_view name) {
  const auto found = std::ranges::find_if(card.figures, [&](const CardFigure& each) { return each.of == of && each.name == name; });
  if (found == card.figures.end()) throw std::logic_error("no such figure");
  return *found;
}

ReportCard card_of(const InputMesh& mesh, std::span<const Vec3> after) {
  const std::array<Metric, 1> raised{Metric::MeanRatio};
  return report_card(mesh, mesh.mesh.positions, after, raised, false, nullptr);
}

TEST(ReportCard, OfTheInputItselfIsTheSame) {
  const auto mesh = input(lattice(8, 0.3, 4));
  const ReportCard card = card_of(*mesh, mesh->mesh.positions);
  EXPECT_EQ(card.verdict, Verdict::Same);
  EXPECT_TRUE(card.worse().empty());
}

/// A unit square of two halves whose common edge goes from 0.5 to 0.9: areas of 0.5 and 0.5 become 0.9 and 0.1.
TEST(ReportCard, TellsTheGrowthAndCountsTheBad) {
  Mesh two;
  two.positions = {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5, 1, 0}, {0, 1, 0}};
  add(two, {0, 1, 4, 5});
  add(two, {1, 2, 3, 4});
  const auto mesh = input(std::move(two));
  std::vector<Vec3> after(mesh->mesh.positions);
  after[1].x = after[4].x = 0.9;
  const ReportCard card = card_of(*mesh, after);
  EXPECT_NEAR(figure(card, "", "growth").before, 1.0, 1e-12);
  EXPECT_NEAR(figure(card, "", "growth").after, 9.0, 1e-9);
  EXPECT_EQ(figure(card, "", "growth").verdict, Verdict::Worse);
  // A rectangle of sides a and b has the mean ratio 2 a b / (a^2 + b^2).
  EXPECT_NEAR(figure(card, "mean ratio", "least").before, 0.8, 1e-12);
  EXPECT_NEAR(figure(card, "mean ratio", "least").after, 0.2 / 1.01, 1e-12);
  EXPECT_NEAR(figure(card, "mean ratio", "mean").after, 0.5 * (0.2 / 1.01 + 1.8 / 1.81), 1e-12);
  EXPECT_EQ(figure(card, "mean ratio", "below 0.1").after, 0.0);
  EXPECT_EQ(figure(card, "mean ratio", "below 0.2").after, 1.0);
  EXPECT_EQ(figure(card, "mean ratio", "below 0.2").verdict, Verdict::Worse);
  EXPECT_EQ(figure(card, "scaled Jacobian", "least").after, 1.0) << "it is blind to how long an element is";
  EXPECT_EQ(card.verdict, Verdict::Worse);
  EXPECT_THAT(card.sentence(true), HasSubstr("least mean ratio 0.8000 -> 0.1980"));
  const auto bad = std::ranges::find(card.figures, "below 0.2", &CardFigure::name);
  EXPECT_EQ(bad->phrase(), "mean ratio below 0.2: 0 -> 1") << "the bound is no count";
}

TEST(ReportCard, IsBetterWhereNothingIsWorse) {
  const auto mesh = input(lattice(8, 0.3, 4, Cells::Quadrilaterals));
  const auto regular = input(lattice(8, 0.0, 4, Cells::Quadrilaterals));
  const ReportCard better = card_of(*mesh, regular->mesh.positions);
  EXPECT_EQ(better.verdict, Verdict::Better);
  const std::array<Metric, 1> raised{Metric::MeanRatio};
  const ReportCard back = report_card(*mesh, regular->mesh.positions, mesh->mesh.positions, raised, false, nullptr);
  EXPECT_EQ(back.verdict, Verdict::Worse);
}

TEST(ReportCard, CountsInvertedElements) {
  const auto mesh = input(lattice(6, 0.0, 1));
  std::vector<Vec3> after(mesh->mesh.positions);
  after[7 + 1] = after[3 * 7 + 3];  // far outside its star
  const ReportCard card = card_of(*mesh, after);
  const auto inverted = count_inverted(mesh->quality_context(), after).all;
  ASSERT_GT(inverted, 0U);
  EXPECT_EQ(figure(card, "", "inverted").after, static_cast<double>(inverted));
  EXPECT_EQ(figure(card, "", "inverted").verdict, Verdict::Worse);
}

/// A mean phase raises one mean of one metric, so other figures may still end below the input's: it helps, and keeps nothing for sure. It
/// does not begin while elements are inverted.
TEST(ReportCard, SaysWhatKeepsAndWhatOnlyHelps) {
  const auto regular = input(lattice(8, 0.0, 4, Cells::Quadrilaterals));
  const auto distorted = input(lattice(8, 0.3, 4, Cells::Quadrilaterals));
  const ReportCard card = card_of(*regular, distorted->mesh.positions);
  for (const auto& [of, name] : std::vector<std::pair<std::string, std::string>>{
           {"mean ratio", "mean"}, {"mean ratio", "1 %"}, {"scaled Jacobian", "mean"}, {"scaled Jacobian", "5 %"}}) {
    const CardFigure& each = figure(card, of, name);
    EXPECT_EQ(each.verdict, Verdict::Worse) << of << name;
    EXPECT_EQ(each.kept_by, "") << of << name;
    EXPECT_EQ(each.helped_by, "then mean") << of << name;
  }
  EXPECT_EQ(figure(card, "scaled Jacobian", "least").kept_by, "guard scaled-jacobian:input");
  EXPECT_THAT(card.sentence(true), HasSubstr("(--then mean helps)"));
  EXPECT_THAT(card.sentence(true), HasSubstr("(--guard scaled-jacobian:input keeps it)"));
  EXPECT_THAT(card.sentence(false), HasSubstr("('then mean' helps)"));

  std::vector<Vec3> tangled(distorted->mesh.positions);
  tangled[10] = tangled[40];
  const ReportCard left = card_of(*regular, tangled);
  ASSERT_GT(figure(left, "", "inverted").after, 0.0);
  EXPECT_EQ(figure(left, "mean ratio", "mean").helped_by, "");
}

/// Layers of heights 0.01, 0.02, 0.04 ... on a wall of width 1, whose first line rises by half.
TEST(ReportCard, TellsHowHighWallCellsHaveBecome) {
  Mesh layers;
  constexpr Index kAlong = 6, kUp = 6;
  double y = 0.0, height = 0.01;
  for (Index j = 0; j <= kUp; ++j, y += height, height *= 2.0)
    for (Index i = 0; i <= kAlong; ++i) layers.positions.push_back({0.2 * static_cast<double>(i), y, 0.0});
  for (Index j = 0; j < kUp; ++j)
    for (Index i = 0; i < kAlong; ++i) {
      const Index a = j * (kAlong + 1) + i;
      add(layers, {a, a + 1, a + kAlong + 2, a + kAlong + 1});
    }
  const auto mesh = input(std::move(layers));
  std::vector<Vec3> after(mesh->mesh.positions);
  for (Index i = 1; i < kAlong; ++i) after[kAlong + 1 + i].y *= 1.5;
  const ReportCard card = card_of(*mesh, after);
  EXPECT_NEAR(figure(card, "", "wall cells").after, 1.5, 1e-9);
  EXPECT_EQ(figure(card, "", "wall cells").verdict, Verdict::Worse);
  EXPECT_THAT(card.sentence(true), HasSubstr("--layers keep keeps"));
}

}  // namespace
}  // namespace dmoscope
