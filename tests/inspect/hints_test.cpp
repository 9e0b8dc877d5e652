// Hints after a run: for any mix of mesh, method and aims, ended at any moment, without promising more than was tried.

#include "core/run/hints.h"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/run/run_task.h"
#include "core/run/trial.h"
#include "tests/support/meshes.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {
namespace hints {

using testing::Cells;
using ::testing::HasSubstr;
using testing::input;
using testing::lattice;
using ::testing::Not;

constexpr Index kCells = 6;
Index vertex_at(Index i, Index j) { return j * (kCells + 1) + i; }

/// A lattice of squares of which vertices were moved along x, by cells.
Mesh squares(std::initializer_list<std::pair<Index, double>> moved) {
  Mesh mesh = lattice(kCells, 0.0, 1, Cells::Quadrilaterals);
  for (const auto& [vertex, by] : moved) mesh.positions[vertex].x += by / kCells;
  return mesh;
}

dmoscope::Run run_of(std::shared_ptr<const InputMesh> mesh, const RunParameters& parameters, std::uint64_t iterations) {
  dmoscope::Run run(std::move(mesh), parameters, std::make_shared<ThreadPool>(1), 0);
  Progress progress;
  run.iterate(iterations, progress);
  return run;
}

HeldMinimum held_of(const dmoscope::Run& run, const std::function<bool()>& go_on = {}) {
  Progress progress;
  auto held = what_holds(run, nullptr, progress, {.go_on = go_on});
  EXPECT_TRUE(held);
  return *held;
}

/// A function that returns true so many times.
std::function<bool()> yes(int times) {
  return [times]() mutable { return times-- > 0; };
}

/// Tangled meshes of every kind.
std::vector<std::shared_ptr<const InputMesh>> tangled() {
  Mesh bowl = lattice(5, 0.8, 3, Cells::Mixed);  // vertices of curved surfaces do not untangle together
  for (Vec3& p : bowl.positions) p.z = 0.3 * (p.x * p.x + p.y * p.y);
  return {input(lattice(5, 0.9, 3)),
          input(lattice(5, 0.9, 4, Cells::Mixed)),
          input(std::move(bowl)),
          input(test::volume_grid(2, test::Fill::Tetrahedra, 2.5)),
          input(test::volume_grid(2, test::Fill::Hexahedra, 2.5)),
          input(test::volume_grid(2, test::Fill::Mixed, 2.5))};
}

RunParameters any_mix(testing::Random& random) {
  const auto one_of = [&random](std::initializer_list<const char*> words) {
    return std::string(words.begin()[static_cast<std::size_t>(random(0.0, static_cast<double>(words.size())))]);
  };
  RunParameters p;
  p.method = method_table()[static_cast<std::size_t>(random(0.0, static_cast<double>(method_table().size())))].name;
  if (random() < 0.25)
    std::tie(p.metric, p.combination) =
        parse_composite(one_of({"mean-ratio:0.3:scaled-jacobian", "mean-ratio:0.3:density", "scaled-jacobian:0.2:mean-ratio"}));
  else
    p.metric = parse_metric(one_of({"mean-ratio", "scaled-jacobian", "min-angle", "formula:det/norm^2", "mean-ratio@input"}));
  set_then(p, one_of({"nothing", "mean", "joint", "joint,mean"}), {});
  if (random() < 0.5) p.boundary = BoundaryRule::Slide;
  return p;
}

TEST(HintsAfterARun, AskOnlyForWhatCanBeAndChangeNothing) {
  const auto meshes = tangled();
  testing::Random random(44);
  std::size_t looked = 0, found = 0;
  for (int i = 0; i < 100; ++i) {
    const auto& mesh = meshes[static_cast<std::size_t>(i) % meshes.size()];
    const RunParameters p = any_mix(random);
    const std::string why_not = why_no_run(mesh, p);
    const std::string mix = fmt::format("{}: {}, {}, {}", i, p.method, info(p.metric).name, then_words(p));
    if (!why_not.empty()) {
      EXPECT_THROW((void)run_of(mesh, p, 0), UsageError) << mix;
      continue;
    }
    const dmoscope::Run run = run_of(mesh, p, 1);
    const std::vector<Vec3> before(run.positions().begin(), run.positions().end());
    Progress progress;
    UntanglingLook look;
    EXPECT_NO_THROW(look = untangling_hint(run, std::make_shared<ThreadPool>(1), progress)) << mix;
    EXPECT_TRUE(look.to_the_end) << mix;
    if (look.hint) {
      EXPECT_LT(look.hint->left, run.statistics().inverted) << mix;
      ++found;
    }
    EXPECT_NO_THROW((void)what_holds(run, nullptr, progress)) << mix;
    EXPECT_EQ(before, std::vector<Vec3>(run.positions().begin(), run.positions().end())) << mix;
    ++looked;
  }
  EXPECT_GT(looked, 25U);
  EXPECT_GT(found, 3U);
}

TEST(HintsAfterARun, EndAtAnyMomentAndSayWhatWasNotLookedAt) {
  const dmoscope::Run run = run_of(input(squares({{vertex_at(3, 0), -0.9}})), {}, 40);
  const HeldMinimum all = held_of(run);
  EXPECT_TRUE(all.untried.empty());
  EXPECT_THAT(all.sentence(true), Not(HasSubstr("Not looked at")));
  ASSERT_TRUE(all.change);

  const HeldMinimum none = held_of(run, yes(0));
  EXPECT_EQ(none.quality, all.quality);
  EXPECT_EQ(none.vertices.size(), 4U);
  ASSERT_FALSE(none.untried.empty());
  EXPECT_EQ(none.untried.front(), kMoreIterations);
  EXPECT_EQ(none.sentence(true),
            fmt::format("Element {} at {:#.4g} is the worst of all. Held by the fixed boundary: 2 of its 4 vertices, 2 "
                        "free. Not looked at further: more iterations, switches that could free it, joint moves, two "
                        "switches together (--hints full does).",
                        all.element, all.quality));
  std::size_t untried = none.untried.size();
  int asked = 1;
  for (; untried > 0 && asked < 10000; ++asked) {
    const HeldMinimum some = held_of(run, yes(asked));
    EXPECT_EQ(some.sentence().find("Not looked at further: ") == std::string::npos, some.untried.empty());
    if (some.change) {
      EXPECT_EQ(some.change->command(), all.change->command()) << asked;
    }
    untried = some.untried.size();
  }
  EXPECT_LT(asked, 10000);
  EXPECT_EQ(held_of(run, yes(1000000)).sentence(), all.sentence());

  Progress cancelled;
  cancelled.request_cancel();
  EXPECT_EQ(what_holds(run, nullptr, cancelled)->sentence(), none.sentence());
}

TEST(HintsAfterARun, ALookForAMethodThatIsEndedKeepsWhatItFound) {
  RunParameters p;
  p.method = "smart-laplace";
  const dmoscope::Run run = run_of(tangled()[0], p, 0);
  const auto pool = std::make_shared<ThreadPool>(1);
  Progress progress;
  EXPECT_FALSE(untangling_hint(run, pool, progress, yes(0)).to_the_end);
  const UntanglingLook all = untangling_hint(run, pool, progress);
  ASSERT_TRUE(all.hint);
  UntanglingLook some;
  for (int asked = 1; asked < 1000 && !some.hint; ++asked) some = untangling_hint(run, pool, progress, yes(asked));
  ASSERT_TRUE(some.hint);
  EXPECT_FALSE(some.to_the_end && all.hint->left < some.hint->left);
  progress.request_cancel();
  EXPECT_FALSE(untangling_hint(run, pool, progress).to_the_end);
}

TEST(HintsAfterARun, TheThresholdOfTwoAimsIsNamed) {
  RunParameters p;
  std::tie(p.metric, p.combination) = parse_composite("mean-ratio:0.4:density", "h1:-1,-1");
  const auto mesh = input(lattice(kCells, 0.45, 8));
  const dmoscope::Run run = run_of(mesh, p, 300);
  const HeldMinimum held = held_of(run);
  ASSERT_GT(held.quality, 0.39) << "else the threshold does not hold it";
  EXPECT_EQ(held.by, Holding::Threshold) << held.sentence();
  EXPECT_FALSE(held.rises());
  ASSERT_TRUE(held.change) << held.sentence();
  EXPECT_EQ(held.change->name, "combine");
  EXPECT_THAT(held.change->command(), ::testing::EndsWith(":density h1:-1,-1"));
  EXPECT_THAT(held.sentence(true), HasSubstr("held by the threshold of two aims"));
  EXPECT_THAT(held.sentence(true), HasSubstr("--combine mean-ratio:0."));
  EXPECT_THAT(held.sentence(true), Not(HasSubstr("more iterations")));
  RunParameters raised = p;
  raised.combination->threshold = held.change->number;
  EXPECT_GT(run_of(mesh, raised, 300).statistics().minimum, held.quality + 0.02) << held.change->command();
}

/// Two elements at the boundary, nearly equally bad: the user fixed the vertices of the second.
TEST(HintsAfterARun, WhatGainsInOnePlaceIsNoPromiseForTheMesh) {
  const Index other = vertex_at(3, kCells);
  for (const bool two : {false, true}) {
    RunParameters p;
    for (const Index i : {2U, 3U, 4U}) p.fixed.insert(p.fixed.end(), {vertex_at(i, kCells), vertex_at(i, kCells - 1)});
    const auto mesh = input(squares({{vertex_at(3, 0), -0.9}, {other, two ? -0.66 : 0.0}}));
    const dmoscope::Run run = run_of(mesh, p, 60);
    const HeldMinimum held = held_of(run);
    ASSERT_TRUE(held.change) << held.sentence();
    ASSERT_EQ(held.change->command(), "boundary slide");
    EXPECT_GT(held.changed, held.quality + 0.2);
    const auto now = run.positions();
    const auto here = std::make_shared<const std::vector<Vec3>>(now.begin(), now.end());
    const auto pool = std::make_shared<ThreadPool>(1);
    Progress progress;
    HeldMinimum tried = held;
    tried.trial = try_switch(run, held, {here}, {}, pool, progress);
    ASSERT_TRUE(tried.trial);
    EXPECT_DOUBLE_EQ(tried.trial->before, run.statistics().minimum);
    EXPECT_EQ(tried.trial->after > held.changed - 0.1, !two) << "another element keeps the minimum";
    EXPECT_TRUE(tried.has_advice());
    EXPECT_THAT(tried.sentence(true),
                HasSubstr("--boundary slide would free it (giving up the fixed boundary); tried: " + tried.trial->figures()));
    RunParameters sliding = p;
    sliding.boundary = BoundaryRule::Slide;
    dmoscope::Run followed(mesh, sliding, pool, 0, {}, here);
    followed.iterate(60, progress);
    EXPECT_GE(followed.statistics().minimum, tried.trial->after);
    EXPECT_GE(followed.statistics().minimum, run.statistics().minimum);
  }
}

TEST(ATrial, LeavesTheRunAndEndsWhenItIsTold) {
  const auto mesh = input(squares({{vertex_at(3, 0), -0.9}}));
  const dmoscope::Run run = run_of(mesh, {}, 60);
  const HeldMinimum held = held_of(run);
  ASSERT_TRUE(held.change);
  const std::vector<Vec3> before(run.positions().begin(), run.positions().end());
  const auto pool = std::make_shared<ThreadPool>(1);
  Progress progress;
  const auto attempt = [&](TrialBudget budget) {
    return try_switch(run, held, {std::make_shared<const std::vector<Vec3>>(before)}, budget, pool, progress);
  };
  const auto whole = attempt({});
  ASSERT_TRUE(whole && whole->gains());
  EXPECT_LE(whole->iterations, 20U);
  TrialBudget budget;
  budget.iterations = 2;
  ASSERT_TRUE(attempt(budget));
  EXPECT_EQ(attempt(budget)->iterations, 2U);
  EXPECT_LE(attempt(budget)->after, whole->after);
  budget = {};
  budget.visits = 3 * run_of(mesh, {.boundary = BoundaryRule::Slide}, 0).visits_per_iteration();
  EXPECT_EQ(attempt(budget)->iterations, 3U);
  budget.visits = 10;
  EXPECT_FALSE(attempt(budget)) << "no room for one iteration";
  budget = {};
  budget.go_on = yes(7);
  EXPECT_FALSE(attempt(budget)) << "given up";
  budget = {};
  budget.time_left = yes(7);
  const auto shorter = attempt(budget);
  ASSERT_TRUE(shorter) << "what was done by then";
  EXPECT_LT(shorter->iterations, whole->iterations);
  budget.time_left = yes(0);
  EXPECT_FALSE(attempt(budget));
  EXPECT_EQ(before, std::vector<Vec3>(run.positions().begin(), run.positions().end()));
  EXPECT_EQ(run.moment(), (Moment{60}));
}

TEST(ATrial, SaysNoMoreThanItReached) {
  const auto figures = [](double before, double after) { return SwitchTrial{before, after, 20}.figures(); };
  EXPECT_EQ(figures(0.80351, 0.80629), "0.8035 -> 0.8062 in 20 iterations");
  EXPECT_EQ(figures(0.0, 0.99999), "0.000 -> 0.9999 in 20 iterations");
  EXPECT_EQ(figures(-0.5, -0.12341), "-0.5000 -> -0.1235 in 20 iterations");
  EXPECT_EQ((SwitchTrial{0.5, 0.50009, 1}.sentence()), "tried in 1 iteration: no gain");
  EXPECT_EQ((SwitchTrial{0.5, 0.6, 1, 12}.sentence()), "tried from iteration 12 on: 0.5000 -> 0.6000 in 1 iteration");
  EXPECT_FALSE((SwitchTrial{0.5, 0.6, 20, {}, 0.6}.gains())) << "as much without it";
  testing::Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const double after = random(-1.0, 1.0) * std::pow(10.0, random(-6.0, 0.0));
    const std::string text = figures(0.0, after);
    EXPECT_LE(std::stod(text.substr(text.find("-> ") + 3)), after) << text;
    EXPECT_NEAR(std::stod(text.substr(text.find("-> ") + 3)), after, 2e-3 * std::abs(after)) << text;
  }
}

TEST(HintBudget, IsATenthOfTheRunAndItsHalvesLieWithin) {
  double now = 100.0;
  const HintBudget::Clock clock = [&now] { return now; };
  const HintBudget budget = HintBudget::of_run(50.0, clock), least = HintBudget::of_run(0.1, clock);
  const HintBudget half = budget.half();
  now = 100.19;
  EXPECT_TRUE(budget.left() && half.left() && least.left());
  now = 100.21;
  EXPECT_TRUE(budget.left() && half.left() && !least.left());
  now = 102.6;
  EXPECT_TRUE(budget.left() && !half.left());
  now = 105.1;
  EXPECT_FALSE(budget.left() || budget.half().left());
  EXPECT_FALSE(HintBudget(0.0, clock).left());
  EXPECT_TRUE(HintBudget().left() && HintBudget().half().left());
}

}  // namespace hints
}  // namespace
}  // namespace dmoscope
