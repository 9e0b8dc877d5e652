// Runs on a device, with the host in the device's place: steps, seeks and comparisons are the same as on the processor.

#include "core/run/run.h"

#include "core/mesh/generate.h"
#include "gpu/host_queue.h"
#include "tests/gpu/same_bits.h"
#include "tests/support/meshes.h"

namespace dmoscope::gpu {
namespace {

using namespace testing;

class HostAccelerator final : public Accelerator {
 public:
  std::string description() const override { return queue->description(); }
  std::unique_ptr<Smoother> make_dmo(const SmoothingTask& task) const override { return make_device_dmo(queue, task); }
  std::shared_ptr<HostQueue> queue = make_host_queue({});
};

struct Pair {
  std::shared_ptr<const InputMesh> input;
  std::shared_ptr<HostAccelerator> accelerator = std::make_shared<HostAccelerator>();
  Run cpu, device;
  Progress progress;

  explicit Pair(Mesh mesh, Metric metric = Metric::MeanRatio, const SearchParameters& search = {})
      : Pair(std::move(mesh), parameters_of(metric, search)) {}
  Pair(Mesh mesh, const RunParameters& parameters)
      : input(prepare(std::move(mesh))), cpu(run(parameters, Backend::Cpu)), device(run(parameters, Backend::Cuda)) {}
  static RunParameters parameters_of(Metric metric, const SearchParameters& search) {
    RunParameters parameters;
    parameters.search = search;
    parameters.metric = metric;
    parameters.guard = std::nullopt;  // the processor alone keeps it
    return parameters;
  }
  static std::shared_ptr<const InputMesh> prepare(Mesh mesh) {
    Progress none;
    return prepare_input(std::move(mesh), {}, Need::Smoothing, none);
  }
  [[nodiscard]] Run run(RunParameters parameters, Backend backend) const {
    parameters.backend = backend;
    return {input, parameters, std::make_shared<ThreadPool>(2), std::size_t{1} << 24U, {accelerator, ""}};
  }
  void expect_same_place() {
    EXPECT_EQ(cpu.moment(), device.moment());
    const auto here = cpu.positions(), there = device.positions();
    for (Index v = 0; v < here.size(); ++v) ASSERT_TRUE(same(here[v], there[v])) << v;
    EXPECT_TRUE(same(cpu.statistics().mean, device.statistics().mean));
    EXPECT_TRUE(same(cpu.statistics().minimum, device.statistics().minimum));
  }
};

TEST(DeviceRun, StepsGoBackAndSeekAlike) {
  Pair pair(dmoscope::testing::lattice(20, 0.35, 95));
  EXPECT_EQ(pair.device.backend(), Backend::Cuda);
  EXPECT_EQ(pair.cpu.backend(), Backend::Cpu);
  const auto both = [&](const auto& act) {
    act(pair.cpu);
    act(pair.device);
    pair.expect_same_place();
  };
  for (const StepUnit unit :
       {StepUnit::Iteration, StepUnit::Vertex, StepUnit::Class, StepUnit::Class, StepUnit::Vertex, StepUnit::Iteration})
    both([&](auto& run) { run.step(unit, pair.progress); });
  for (const StepUnit unit : {StepUnit::Vertex, StepUnit::Class, StepUnit::Iteration})
    both([&](auto& run) { run.back(unit, pair.progress); });
  both([&](auto& run) { run.iterate(7, pair.progress); });
  both([&](auto& run) { run.seek({3, 41}, pair.progress); });
  both([&](auto& run) { run.seek({0, 0}, pair.progress); });
  both([&](auto& run) { run.seek({9, 5}, pair.progress); });
  ASSERT_EQ(pair.cpu.history().records().size(), pair.device.history().records().size());
  for (std::size_t i = 0; i < pair.cpu.history().records().size(); ++i) {
    const IterationRecord &here = pair.cpu.history().records()[i], &there = pair.device.history().records()[i];
    EXPECT_TRUE(same(here.statistics.mean, there.statistics.mean)) << i;
    EXPECT_EQ(here.statistics.worst_element, there.statistics.worst_element) << i;
    EXPECT_EQ(here.moved, there.moved) << i;
  }
}

/// Steps by a formula and by targets: vertex by vertex, class by class, back, and from anywhere.
TEST(DeviceRun, StepsByFormulasAndTargetsAlike) {
  for (const char* words :
       {"formula:if(det > 0, smin/smax, det/norm^2)", "formula:min(1, area*60)*lmin/lmax", "mean-ratio@input:1", "aspect@aspect:2:20"}) {
    SCOPED_TRACE(words);
    Pair pair(dmoscope::testing::lattice(9, 0.7, 97), parse_metric(words));
    EXPECT_EQ(pair.device.backend(), Backend::Cuda);
    for (dmoscope::Run* run : {&pair.cpu, &pair.device}) {
      run->step(StepUnit::Vertex, pair.progress);
      run->step(StepUnit::Class, pair.progress);
      run->iterate(3, pair.progress);
      run->back(StepUnit::Class, pair.progress);
    }
    pair.expect_same_place();
    for (dmoscope::Run* run : {&pair.cpu, &pair.device}) run->seek({2, 11}, pair.progress);
    pair.expect_same_place();
    for (dmoscope::Run* run : {&pair.cpu, &pair.device}) run->iterate(2, pair.progress);
    pair.expect_same_place();
  }
}

/// Work that devices cannot do is reported, and done by the processor if that is allowed.
TEST(DeviceRun, FormulasBesideAnotherAimAreTheProcessors) {
  RunParameters parameters;
  parameters.metric = parse_metric("formula:smin/smax");
  parameters.then_mean = PhaseBegin{};
  const auto accelerator = std::make_shared<HostAccelerator>();
  const auto mesh = Pair::prepare(dmoscope::testing::lattice(6, 0.3, 98));
  const auto run_on = [&](Backend backend) {
    parameters.backend = backend;
    return dmoscope::Run(mesh, parameters, std::make_shared<ThreadPool>(1), std::size_t{1} << 24U, {accelerator, ""});
  };
  try {
    (void)run_on(Backend::Cuda);
    FAIL() << "it is not possible there";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("formulas and targets are joined with another aim on the CPU alone"), std::string::npos)
        << error.what();
  }
  EXPECT_EQ(run_on(Backend::Auto).backend(), Backend::Cpu);
}

/// A run that released its device's memory continues at its present iteration, not from the input.
TEST(DeviceRun, GoesOnAfterARest) {
  for (const Moment& place : {Moment{0, 0}, Moment{2, 0}, Moment{1, 7}}) {
    Pair pair(dmoscope::testing::lattice(12, 0.35, 98));
    for (dmoscope::Run* run : {&pair.cpu, &pair.device}) {
      run->seek(place, pair.progress);
      run->rest();
      run->iterate(2, pair.progress);
    }
    pair.expect_same_place();
  }
}

TEST(DeviceRun, ConvergesAlike) {
  Pair pair(dmoscope::testing::lattice(12, 0.35, 96, dmoscope::testing::Cells::Mixed), Metric::ScaledJacobian);
  const Outcome here = pair.cpu.until_converged({}, pair.progress), there = pair.device.until_converged({}, pair.progress);
  EXPECT_EQ(here.iterations, there.iterations);
  EXPECT_EQ(here.last_rise, there.last_rise);
  EXPECT_EQ(here.reason, there.reason);
  pair.expect_same_place();
}

void expect_alike_until_converged(Pair& pair) {
  EXPECT_EQ(pair.device.backend(), Backend::Cuda);
  const Outcome here = pair.cpu.until_converged({}, pair.progress), there = pair.device.until_converged({}, pair.progress);
  EXPECT_EQ(here.iterations, there.iterations);
  EXPECT_EQ(here.reason, there.reason);
  pair.expect_same_place();
  for (dmoscope::Run* run : {&pair.cpu, &pair.device}) run->seek({2, 5}, pair.progress);
  pair.expect_same_place();
}

/// The second phase is the same, too; it starts at the best of the first, from the history.
TEST(DeviceRun, RaisesTheMeanAlike) {
  RunParameters parameters;
  parameters.then_mean = PhaseBegin{};
  for (const double jitter : {0.35, 0.9}) {  // the latter with inverted elements
    Pair pair(dmoscope::testing::lattice(10, jitter, 99, dmoscope::testing::Cells::Mixed), parameters);
    expect_alike_until_converged(pair);
    const auto& records = pair.device.history().records();
    EXPECT_GT(records.back().statistics.mean, records.front().statistics.mean);
  }
  Progress progress;
  Pair volume(generate_mesh("tetrahedra", 64, 9, progress), parameters);
  expect_alike_until_converged(volume);
}

TEST(DeviceRun, CombinesAlike) {
  for (const CompositeTerms& combination :
       {CompositeTerms{0.4, Metric::MinAngle}, CompositeTerms{0.4, SizeFunction{SizeFunction::Kind::Distance, {2, 3, 0}, {}}}}) {
    RunParameters parameters;
    parameters.combination = combination;
    Pair pair(dmoscope::testing::lattice(10, 0.9, 93), parameters);
    expect_alike_until_converged(pair);
  }
}

TEST(DeviceRun, OfAVolumeIsAlikeInEitherPrecision) {
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    Progress progress;
    Pair pair(generate_mesh("solids", 125, 9, progress), Metric::MeanRatio, {.levels = 2, .precision = precision});
    EXPECT_EQ(pair.device.backend(), Backend::Cuda);
    const auto both = [&](const auto& act) {
      act(pair.cpu);
      act(pair.device);
      pair.expect_same_place();
    };
    for (const StepUnit unit : {StepUnit::Vertex, StepUnit::Class, StepUnit::Iteration})
      both([&](auto& run) { run.step(unit, pair.progress); });
    both([&](auto& run) { run.seek({2, 5}, pair.progress); });
    both([&](auto& run) { run.seek({1, 3}, pair.progress); });
    EXPECT_EQ(pair.device.picture(Metric::MeanRatio), nullptr) << "it is drawn from the host";
  }
}

TEST(DeviceRun, GoesOnWithoutItsDevice) {
  Pair pair(dmoscope::testing::lattice(20, 0.35, 97));
  pair.device.iterate(2, pair.progress);
  (void)pair.device.positions();
  pair.accelerator->queue->lose_after(5);
  EXPECT_THROW(pair.device.iterate(4, pair.progress), DeviceError);
  EXPECT_EQ(pair.device.backend(), Backend::Cpu);
  pair.device.seek({6, 0}, pair.progress);
  pair.cpu.iterate(6, pair.progress);
  pair.expect_same_place();
}

}  // namespace
}  // namespace dmoscope::gpu
