// Visits of chosen vertices: they do the same as a normal visit, stay part of the run's path, and are found again bit for bit.

#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/engine/engine.h"
#include "core/run/run.h"
#include "core/smooth/execution/method_table.h"
#include "tests/support/fake_accelerator.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using testing::acceleration;
using testing::FakeDevice;
using ::testing::HasSubstr;
using testing::input;
using testing::lattice;

using Positions = std::vector<Vec3>;

Positions copy(const dmoscope::Run& run) { return {run.positions().begin(), run.positions().end()}; }
const std::shared_ptr<const InputMesh>& mesh() {
  static const auto shared = input(lattice(20, 0.45, 5));
  return shared;
}
dmoscope::Run edited_run(RunParameters parameters = {}, std::size_t budget = std::size_t{1} << 28U, Acceleration device = {}) {
  return {mesh(), std::move(parameters), std::make_shared<ThreadPool>(2), budget, std::move(device)};
}

/// The positions after visits by a smoother that knows no other vertices.
Positions smoothed(Positions positions, const dmoscope::Run& run, const std::vector<Index>& vertices) {
  auto restricted = std::make_shared<Colouring>();
  restricted->class_offsets.push_back(0);
  for (Index c = 0; c < run.colouring().class_count(); ++c) {
    for (const Index v : run.colouring().members(c))
      if (std::ranges::find(vertices, v) != vertices.end()) restricted->order.push_back(v);
    restricted->class_offsets.push_back(static_cast<Index>(restricted->order.size()));
  }
  const std::uint64_t count = restricted->order.size();
  const auto smoother =
      make_smoother({.input = mesh(), .colouring = restricted, .metric = run.parameters().metric, .search = run.parameters().search});
  smoother->visit(0, count, positions, nullptr);
  smoother->store(positions, nullptr);
  return positions;
}

/// Some free vertices, neighbours among them, in no order.
std::vector<Index> some_vertices(const dmoscope::Run& run, std::size_t count, std::uint64_t seed) {
  const auto shuffled_order = shuffled(run.colouring().order, seed);
  std::vector<Index> chosen(shuffled_order.begin(), shuffled_order.begin() + static_cast<std::ptrdiff_t>(count / 2));
  for (Index v = 0; chosen.size() < count; ++v)  // adds a row of the lattice
    if (run.fixed()[v] == 0 && std::ranges::find(chosen, v) == chosen.end()) chosen.push_back(v);
  return chosen;
}

TEST(Edits, AreTheVisitsOfASmootherThatKnowsOnlyThose) {
  Progress progress;
  RunParameters in_double;
  in_double.search.precision = Precision::Double;
  for (const RunParameters& parameters : {RunParameters{}, in_double}) {
    dmoscope::Run run = edited_run(parameters);
    run.iterate(1, progress);
    run.step(StepUnit::Vertex, progress);
    const auto vertices = some_vertices(run, 60, 7);
    const Positions expected = smoothed(copy(run), run, vertices);
    const Positions before = copy(run);
    const std::uint64_t moved = run.visit_vertices(vertices, progress);
    const Positions after = copy(run);
    EXPECT_TRUE(same_bits(after, expected));
    std::uint64_t differ = 0;
    for (Index v = 0; v < after.size(); ++v) {
      if (std::memcmp(&after[v], &before[v], sizeof(Vec3)) == 0) continue;
      ++differ;
      EXPECT_NE(std::ranges::find(vertices, v), vertices.end()) << v;
    }
    EXPECT_EQ(moved, differ);
    EXPECT_GT(moved, 0U);
    EXPECT_EQ(run.moment(), (Moment{1, 1, 1}));
  }
}

/// Steps, edits and steps again; returns the positions after every step with their moments.
std::vector<std::pair<Moment, Positions>> tour(dmoscope::Run& run, Progress& progress) {
  std::vector<std::pair<Moment, Positions>> trail{{run.moment(), copy(run)}};
  const auto note = [&] { trail.emplace_back(run.moment(), copy(run)); };
  const auto visit = [&](std::uint64_t seed) {
    run.visit_vertices(some_vertices(run, 40, seed), progress);
    note();
  };
  const auto step = [&](StepUnit unit) {
    run.step(unit, progress);
    note();
  };
  visit(1);
  visit(2);
  step(StepUnit::Vertex);
  step(StepUnit::Class);
  visit(3);
  step(StepUnit::Iteration);
  step(StepUnit::Iteration);
  visit(4);
  step(StepUnit::Iteration);
  step(StepUnit::Class);
  return trail;
}

TEST(Edits, AnyMomentOfThePathIsFoundAgainBitForBit) {
  Progress progress;
  const auto device = std::make_shared<FakeDevice>();
  std::vector<std::pair<Moment, Positions>> first;
  for (const std::size_t budget : {std::size_t{1} << 28U, std::size_t{0}}) {
    for (const bool accelerated : {false, true}) {
      dmoscope::Run run = edited_run({}, budget, accelerated ? acceleration(device) : Acceleration{});
      ASSERT_EQ(run.backend(), accelerated ? Backend::Cuda : Backend::Cpu);
      const auto trail = tour(run, progress);
      if (first.empty()) first = trail;
      ASSERT_EQ(trail.size(), first.size());
      std::vector<std::size_t> order(trail.size());
      std::iota(order.begin(), order.end(), 0U);
      testing::Random random(3);
      for (int round = 0; round < 40; ++round) {
        const auto& [moment, positions] = trail[static_cast<std::size_t>(random() * static_cast<double>(trail.size()))];
        run.seek(moment, progress);
        EXPECT_EQ(run.moment(), moment);
        EXPECT_TRUE(same_bits(copy(run), positions)) << moment.iteration << " " << moment.visits << " " << moment.edits;
      }
      for (std::size_t i = 0; i < trail.size(); ++i) {
        EXPECT_EQ(trail[i].first, first[i].first);
        EXPECT_TRUE(same_bits(trail[i].second, first[i].second)) << i;
      }
    }
  }
}

TEST(Edits, BackGoesOverThemAsOverOtherSteps) {
  Progress progress;
  dmoscope::Run run = edited_run();
  run.iterate(1, progress);
  const Positions at_end = copy(run);
  run.visit_vertices(std::vector<Index>{30}, progress);
  const Positions once = copy(run);
  run.visit_vertices(some_vertices(run, 30, 9), progress);
  const Positions twice = copy(run);
  run.step(StepUnit::Vertex, progress);
  EXPECT_EQ(run.moment(), (Moment{1, 1, 0}));
  for (const auto& [moment, positions] :
       {std::pair{Moment{1, 0, 2}, &twice}, std::pair{Moment{1, 0, 1}, &once}, std::pair{Moment{1, 0, 0}, &at_end}}) {
    EXPECT_TRUE(run.back(StepUnit::Vertex, progress));
    EXPECT_EQ(run.moment(), moment);
    EXPECT_TRUE(same_bits(copy(run), *positions));
  }
  for (const auto& [moment, positions] : {std::pair{Moment{1, 0, 1}, &once}, std::pair{Moment{1, 0, 2}, &twice}}) {
    run.step(StepUnit::Vertex, progress);
    EXPECT_EQ(run.moment(), moment);
    EXPECT_TRUE(same_bits(copy(run), *positions));
  }
  run.back(StepUnit::Iteration, progress);
  EXPECT_EQ(run.moment(), (Moment{1}));
  run.back(StepUnit::Iteration, progress);
  EXPECT_EQ(run.moment(), Moment{});
}

TEST(Edits, ForgetTheFutureOfBefore) {
  Progress progress;
  dmoscope::Run run = edited_run();
  run.iterate(6, progress);
  run.seek({2, 5}, progress);
  run.visit_vertices(std::vector<Index>{50, 51}, progress);
  EXPECT_EQ(run.history().records().size(), 3U);
  EXPECT_EQ(run.history().nearest(6).iteration, 2U);
  run.iterate(4, progress);
  const Positions with_edit = copy(run);
  dmoscope::Run fresh = edited_run();
  fresh.seek({2, 5}, progress);
  fresh.visit_vertices(std::vector<Index>{51, 50, 51}, progress);
  fresh.iterate(4, progress);
  EXPECT_TRUE(same_bits(copy(fresh), with_edit));
  // An earlier edit replaces the later one.
  run.seek({1}, progress);
  run.visit_vertices(std::vector<Index>{70}, progress);
  EXPECT_EQ(run.edits().all().size(), 1U);
  run.reset(progress);
  EXPECT_TRUE(run.edits().all().empty());
  run.iterate(6, progress);
  dmoscope::Run plain = edited_run();
  plain.iterate(6, progress);
  EXPECT_TRUE(same_bits(copy(run), copy(plain))) << "after a reset no edit is left";
}

TEST(Edits, StatisticsAndRecordsAreOfTheirMoments) {
  Progress progress;
  dmoscope::Run run = edited_run();
  run.iterate(2, progress);
  const Statistics recorded = run.statistics();
  run.visit_vertices(some_vertices(run, 100, 4), progress);
  const Statistics now = run.statistics();
  const Statistics plain = compute_statistics(run.input().quality_context(), run.positions(), Metric::MeanRatio, run.fixed(), nullptr);
  EXPECT_EQ(now.mean, plain.mean);
  EXPECT_NE(now.mean, recorded.mean);
  EXPECT_EQ(run.history().records()[2].statistics.mean, recorded.mean) << "the record is of the iteration's end, before the edit";
}

TEST(Edits, ManyAreSeveral) {
  Progress progress;
  const auto large = input(lattice(90, 0.3, 2));
  dmoscope::Run run(large, {}, std::make_shared<ThreadPool>(2), std::size_t{1} << 28U);
  run.visit_vertices(run.colouring().order, progress);
  EXPECT_EQ(run.moment(), (Moment{0, 0, 2})) << "89 * 89 vertices";
  dmoscope::Run iteration(large, {}, std::make_shared<ThreadPool>(2), std::size_t{1} << 28U);
  iteration.iterate(1, progress);
  EXPECT_TRUE(same_bits(copy(run), copy(iteration))) << "all of them, in the order of an iteration";

  // A cancel during the work: by the observer of the device, as if by another thread.
  const auto device = std::make_shared<FakeDevice>();
  dmoscope::Run far(large, {}, std::make_shared<ThreadPool>(2), std::size_t{1} << 28U, acceleration(device));
  far.iterate(1, progress);
  const Positions before = copy(far);
  device->after_visit = [&] { progress.request_cancel(); };
  EXPECT_THROW(far.visit_vertices(far.colouring().order, progress), Cancelled);
  device->after_visit = {};
  progress.clear_cancel();
  EXPECT_TRUE(same_bits(copy(far), before));
  EXPECT_EQ(far.moment(), (Moment{1}));
  EXPECT_TRUE(far.edits().all().empty());
  far.iterate(1, progress);
  iteration.iterate(1, progress);
  EXPECT_TRUE(same_bits(copy(far), copy(iteration)));
}

TEST(Edits, RefuseWhatCannotBeVisitedAndDoNothing) {
  Progress progress;
  dmoscope::Run run = edited_run({.fixed = {45}});
  for (const auto& [vertex, why] : {std::pair<Index, const char*>{0, "boundary"}, {45, "by hand"}, {100000, "441 vertices"}}) {
    try {
      run.visit_vertices(std::vector<Index>{46, vertex}, progress);
      FAIL() << vertex;
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), HasSubstr(why));
    }
  }
  EXPECT_EQ(run.moment(), Moment{});
  EXPECT_TRUE(run.edits().all().empty());
  EXPECT_THROW(run.seek({0, 0, 1}, progress), UsageError);
  EXPECT_THROW(run.seek({0, run.visits_per_iteration() + 1}, progress), UsageError);
}

TEST(Edits, TheVerbTakesRangesAndTellsOfFixedVertices) {
  Engine engine(2);
  const auto say = [&](const std::string& line) {
    engine.post(line);
    engine.wait_idle();
    std::string all;
    for (const Message& message : engine.take_messages()) all += message.text + "\n";
    return all;
  };
  say("generate random 200");
  const RunView start = engine.view()->runs[0];
  Index boundary = 0, free = 0;
  while (start.fixed[boundary] == 0) ++boundary;
  while (start.fixed[free] != 0) ++free;
  EXPECT_THAT(say(fmt::format("visit {}", boundary)), HasSubstr("lies on the boundary"));
  EXPECT_THAT(say(fmt::format("visit {} {}", boundary, free)), HasSubstr("1 of 2 vertices is fixed and not visited"));
  EXPECT_EQ(engine.view()->runs[0].edits, 1U);
  EXPECT_EQ(engine.view()->runs[0].edits_done, 1U);
  EXPECT_THAT(say("visit 0-199"), HasSubstr("vertices moved"));
  EXPECT_THAT(say("visit 5-2"), HasSubstr("ends before it begins"));
  EXPECT_THAT(say("visit 3-200"), HasSubstr("there is no vertex 200"));
  EXPECT_EQ(engine.view()->runs[0].edits, 2U);
  say("back vertex");
  EXPECT_EQ(engine.view()->runs[0].edits, 2U);
  EXPECT_EQ(engine.view()->runs[0].edits_done, 1U);
}

}  // namespace
}  // namespace dmoscope
