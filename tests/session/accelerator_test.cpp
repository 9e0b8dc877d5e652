// Runs on an accelerator: the choice of it and its reason, the same bits, positions on the device, and failures of the device.

#include <cstring>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/commands/session_commands.h"
#include "core/engine/engine.h"
#include "core/run/retry_on_cpu.h"
#include "core/run/run.h"
#include "tests/support/fake_accelerator.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using testing::acceleration;
using testing::FakeDevice;
using ::testing::HasSubstr;
using testing::input;
using testing::lattice;

constexpr std::size_t kPlenty = std::size_t{1} << 28U;

std::vector<Vec3> positions_now(const dmoscope::Run& run) { return {run.positions().begin(), run.positions().end()}; }
bool same_bits(const Statistics& a, const Statistics& b) {
  return a.minimum == b.minimum && a.mean == b.mean && a.movable_minimum == b.movable_minimum && a.ceiling == b.ceiling &&
         a.worst_element == b.worst_element && a.inverted == b.inverted;
}

const std::shared_ptr<const InputMesh>& rough_lattice() {
  static const auto shared = input(lattice(30, 0.3, 31));
  return shared;
}
dmoscope::Run run_with(RunParameters parameters, Acceleration acceleration, std::size_t budget = kPlenty) {
  return {rough_lattice(), std::move(parameters), std::make_shared<ThreadPool>(2), budget, std::move(acceleration)};
}
dmoscope::Run on_device(const std::shared_ptr<FakeDevice>& device, std::size_t budget = kPlenty) {
  return run_with({.backend = Backend::Cuda}, acceleration(device), budget);
}
dmoscope::Run on_cpu(std::size_t budget = kPlenty) { return run_with({.backend = Backend::Cpu}, {}, budget); }

/// Positions at the end of each iteration, the input first.
std::vector<std::vector<Vec3>> states_on_cpu(std::uint64_t iterations) {
  Progress progress;
  dmoscope::Run run = on_cpu();
  std::vector<std::vector<Vec3>> states{positions_now(run)};
  run.iterate(iterations, progress, [&](const dmoscope::Run& now) { states.push_back(positions_now(now)); });
  return states;
}

TEST(Backend, NamesReadBack) {
  for (const Backend backend : {Backend::Auto, Backend::Cpu, Backend::Cuda}) EXPECT_EQ(parse_backend(name(backend)), backend);
  EXPECT_THROW((void)parse_backend("abacus"), UsageError);
}

TEST(Backend, AutoTakesTheAcceleratorWhereItCan) {
  const auto device = std::make_shared<FakeDevice>();
  dmoscope::Run run = run_with({}, acceleration(device));
  EXPECT_EQ(run.backend(), Backend::Cuda);
  EXPECT_EQ(run.backend_sentence(), "cuda: Fake H1");
  EXPECT_EQ(run.take_warning(), "");
  EXPECT_EQ(run_with({.backend = Backend::Cpu}, acceleration(device)).backend_sentence(), "cpu, 2 threads");
}

TEST(Backend, AutoTakesTheCpuForWhatADeviceCannotDoAndSaysWhy) {
  const auto device = std::make_shared<FakeDevice>();
  RunParameters in_double, in_lanes;
  in_double.search.precision = Precision::Double;
  in_lanes.search.simd = best_simd_level();
  for (const auto& [parameters, reason] : {std::pair{in_double, "double"}, std::pair{in_lanes, "SIMD"}}) {
    dmoscope::Run run = run_with(parameters, acceleration(device));
    EXPECT_EQ(run.backend(), Backend::Cpu);
    EXPECT_THAT(run.backend_reason(), HasSubstr(reason));
    EXPECT_EQ(run.take_warning(), "") << "nothing went wrong";
    RunParameters insisting = parameters;
    insisting.backend = Backend::Cuda;
    EXPECT_THROW(run_with(insisting, acceleration(device)), UsageError);
  }
}

TEST(Backend, TwoAimsAreADevicesUnlessSizesAreLookedUp) {
  const auto device = std::make_shared<FakeDevice>();
  RunParameters mean, metrics, sizes;
  mean.then_mean = PhaseBegin{};
  metrics.combination = {0.5, Metric::MinAngle};
  metrics.search.precision = Precision::Double;  // the precision of two aims anyway
  sizes.combination = {0.5, SizeFunction{SizeFunction::Kind::Distance, {0.3, 0.4, 0}, {}}};
  for (const RunParameters& parameters : {mean, metrics, sizes})
    EXPECT_EQ(run_with(parameters, acceleration(device)).backend(), Backend::Cuda);
  Mesh mesh = lattice(6, 0.2, 31);
  mesh.fields.push_back({.name = "depth", .role = "depth", .values = std::vector<double>(mesh.vertex_count(), 2.0)});
  sizes.combination->second = SizeFunction{SizeFunction::Kind::Field, {}, "depth"};
  const dmoscope::Run looked_up(input(std::move(mesh)), sizes, std::make_shared<ThreadPool>(2), kPlenty, acceleration(device));
  EXPECT_EQ(looked_up.backend(), Backend::Cpu);
  EXPECT_THAT(looked_up.backend_reason(), HasSubstr("nodal field"));
}

TEST(Backend, WithoutAnAcceleratorTheReasonIsGiven) {
  const Acceleration none{nullptr, "built without a CUDA toolkit"};
  EXPECT_EQ(run_with({}, none).backend_sentence(), "cpu, 2 threads (no cuda: built without a CUDA toolkit)");
  try {
    (void)run_with({.backend = Backend::Cuda}, none);
    FAIL() << "there is no cuda";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("built without a CUDA toolkit"));
  }
}

TEST(Backend, ADeviceThatCannotBeMadeUseOfIsAWarningForAutoAndAnErrorByName) {
  const auto device = std::make_shared<FakeDevice>();
  device->fail_to_make = true;
  dmoscope::Run run = run_with({}, acceleration(device));
  EXPECT_EQ(run.backend(), Backend::Cpu);
  EXPECT_THAT(run.take_warning(), AllOf(HasSubstr("3 GiB asked for, 2 GiB free"), HasSubstr("smoothing on the CPU")));
  EXPECT_EQ(run.take_warning(), "") << "told once";
  EXPECT_THAT(run.backend_sentence(), HasSubstr("3 GiB"));
  EXPECT_THROW(on_device(device), DeviceError);
}

TEST(Accelerated, EveryStepGivesTheBitsOfTheCpu) {
  Progress progress;
  dmoscope::Run far = on_device(std::make_shared<FakeDevice>()), near = on_cpu();
  const auto step = [&](const std::function<void(dmoscope::Run&)>& action) {
    action(far);
    action(near);
    ASSERT_EQ(far.moment(), near.moment());
    EXPECT_TRUE(same_bits(far.statistics(), near.statistics()));
    EXPECT_TRUE(same_bits(positions_now(far), positions_now(near)));
  };
  step([&](dmoscope::Run& run) { run.iterate(3, progress); });
  step([&](dmoscope::Run& run) { run.step(StepUnit::Class, progress); });
  step([&](dmoscope::Run& run) { run.step(StepUnit::Vertex, progress); });
  step([&](dmoscope::Run& run) { run.back(StepUnit::Class, progress); });
  step([&](dmoscope::Run& run) { run.back(StepUnit::Iteration, progress); });
  step([&](dmoscope::Run& run) { run.seek({1, 7}, progress); });
  step([&](dmoscope::Run& run) { run.seek({5, 0}, progress); });
  for (std::size_t i = 0; i < near.history().records().size(); ++i) {
    EXPECT_EQ(far.history().records()[i].moved, near.history().records()[i].moved) << i;
    EXPECT_TRUE(same_bits(far.history().records()[i].statistics, near.history().records()[i].statistics)) << i;
  }
}

TEST(BlockPlan, TakesAboutTheSameTimeWhateverVisitsTake) {
  BlockPlan plan;
  EXPECT_GE(plan.visits(), 1U);
  EXPECT_LE(plan.visits(), 10000U) << "nothing is known: each may take long";
  plan.learn(1000, 0.001);
  EXPECT_NEAR(static_cast<double>(plan.visits()), 20000.0, 1.0);
  plan.learn(1000, 1.0);
  EXPECT_NEAR(static_cast<double>(plan.visits()), 20.0, 1.0);
  plan.learn(20, 20e-6);
  EXPECT_LT(plan.visits(), 40U) << "the slow ones are not forgotten at once";
  for (int i = 0; i < 100; ++i) plan.learn(1000, 0.001);
  EXPECT_NEAR(static_cast<double>(plan.visits()), 20000.0, 1.0);
  plan.learn(1, 1000.0);
  EXPECT_EQ(plan.visits(), 1U);
}

TEST(BlockPlan, OfADeviceIsAWholeIterationUnlessThatTakesLong) {
  constexpr std::uint64_t kMillions = 30'000'000;
  BlockPlan far(BlockPlan::On::Device), near(BlockPlan::On::Host);
  EXPECT_GE(far.visits(), kMillions) << "nothing is known, but calls are dear";
  far.learn(kMillions, 10.0);
  EXPECT_GE(far.visits(), kMillions) << "the first call is no measure";
  for (BlockPlan* plan : {&far, &near}) plan->learn(kMillions, 0.015);
  EXPECT_GE(far.visits(), kMillions);
  EXPECT_LT(near.visits(), kMillions);
  far.learn(kMillions, 0.1);
  EXPECT_NEAR(static_cast<double>(far.visits()), 0.2 * kMillions, 1.0);
}

/// A volume's iteration may take a small device minutes: a cancel by the user, or a display's watchdog, must not wait for it.
TEST(BlockPlan, OfADevicesVolumeBeginsSmallAndGrowsToAWholeIteration) {
  constexpr std::uint64_t kMillions = 30'000'000;
  BlockPlan fast(BlockPlan::On::DeviceSolids), slow = fast;
  for (const bool warming_up : {true, false}) {
    EXPECT_LE(fast.visits(), 100'000U) << "nothing is known";
    EXPECT_GE(fast.visits(), 16'384U) << "enough for all lanes";
    if (warming_up)
      for (BlockPlan* plan : {&fast, &slow}) plan->learn(plan->visits(), 2.0);
  }
  slow.learn(slow.visits(), 0.1);
  EXPECT_LE(slow.visits(), 20'000U);
  for (int i = 0; i < 40; ++i) fast.learn(fast.visits(), 1e-9 * static_cast<double>(fast.visits()));
  EXPECT_GE(fast.visits(), kMillions / 2);
}

TEST(Accelerated, NothingIsCopiedUntilPositionsAreAskedFor) {
  Progress progress;
  const auto device = std::make_shared<FakeDevice>();
  dmoscope::Run run = on_device(device, 0);
  run.iterate(5, progress);
  EXPECT_EQ(device->stores, 0U);
  EXPECT_EQ(device->statistics, 5U);
  (void)run.positions();
  (void)run.positions();
  EXPECT_EQ(device->stores, 1U) << "once for a moment";
}

TEST(Accelerated, ADeviceWithoutStatisticsStillHasThem) {
  Progress progress;
  const auto device = std::make_shared<FakeDevice>();
  device->has_statistics = false;
  dmoscope::Run far = on_device(device), near = on_cpu();
  for (dmoscope::Run* run : {&far, &near}) run->iterate(3, progress);
  EXPECT_TRUE(same_bits(far.history().records()[3].statistics, near.history().records()[3].statistics));
}

TEST(History, FarPositionsAreBroughtForAFifthOfTheTimeAtMost) {
  EXPECT_TRUE(worth_downloading(0.0, 0.001)) << "nothing is known of it: try";
  EXPECT_FALSE(worth_downloading(0.010, 0.001));
  EXPECT_FALSE(worth_downloading(0.010, 0.049));
  EXPECT_TRUE(worth_downloading(0.010, 0.051));
}

TEST(History, KeepsFewPositionsOfAFarRunAndComputesTheOthersAgain) {
  Progress progress;
  const auto states = states_on_cpu(12);
  const auto device = std::make_shared<FakeDevice>();
  device->store_takes = std::chrono::milliseconds(100);  // a hundred times the time of an iteration
  dmoscope::Run run = on_device(device);
  run.iterate(12, progress);
  EXPECT_LT(device->stores, 12U);
  EXPECT_FALSE(run.history().kept(12));
  EXPECT_THAT(run.history().sentence(), HasSubstr("computed again when asked for"));
  for (const std::uint64_t iteration : {7U, 0U, 12U, 3U}) {
    run.seek({iteration, 0}, progress);
    EXPECT_TRUE(same_bits(positions_now(run), states[iteration])) << iteration;
  }
}

TEST(History, KeepsTheFarPositionsThatSomebodyAskedFor) {
  Progress progress;
  const auto device = std::make_shared<FakeDevice>();
  device->store_takes = std::chrono::milliseconds(100);
  dmoscope::Run run = on_device(device);
  run.iterate(6, progress);
  ASSERT_FALSE(run.history().kept(6));
  (void)run.positions();
  run.iterate(1, progress);
  EXPECT_TRUE(run.history().kept(6));
  (void)run.positions();
  run.seek({2, 0}, progress);
  EXPECT_TRUE(run.history().kept(7));
}

/// The number of the failing iteration, and whether positions were asked for just before.
class Failure : public ::testing::TestWithParam<std::tuple<std::uint64_t, bool>> {};

TEST_P(Failure, WhileSteppingLeavesTheLastPositionsOfTheHostAndGoesOnOnTheCpu) {
  const auto [fails_at, asked] = GetParam();
  Progress progress;
  const auto states = states_on_cpu(8);
  const auto device = std::make_shared<FakeDevice>();
  dmoscope::Run run = on_device(device, 0);
  run.iterate(fails_at - 1, progress);
  if (asked) (void)run.positions();
  device->fail_at_visit = device->visits + 1;
  try {
    run.iterate(1, progress);
    FAIL() << "the device is lost";
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.exit_code(), 3);
    EXPECT_THAT(error.what(), AllOf(HasSubstr("cuda failed"), HasSubstr("the fake device was lost"), HasSubstr("the CPU can go on")));
  }
  const std::uint64_t stands = asked ? fails_at - 1 : 0;
  EXPECT_EQ(run.moment(), (Moment{stands, 0}));
  EXPECT_EQ(run.history().records().size(), stands + 1);
  EXPECT_TRUE(same_bits(positions_now(run), states[stands]));
  EXPECT_EQ(run.backend(), Backend::Cpu);
  EXPECT_THAT(run.backend_reason(), HasSubstr("the fake device was lost"));
  EXPECT_EQ(run.take_warning(), "") << "the error said it";

  run.iterate(8 - stands, progress);
  EXPECT_EQ(run.moment(), (Moment{8, 0}));
  EXPECT_TRUE(same_bits(positions_now(run), states[8]));
  dmoscope::Run whole = on_cpu();
  whole.iterate(8, progress);
  for (std::size_t i = 0; i <= 8; ++i) {
    EXPECT_TRUE(same_bits(run.history().records()[i].statistics, whole.history().records()[i].statistics)) << i;
    EXPECT_EQ(run.history().records()[i].moved, whole.history().records()[i].moved) << i;
  }
}
INSTANTIATE_TEST_SUITE_P(Iterations, Failure, ::testing::Combine(::testing::Values(1U, 2U, 6U), ::testing::Bool()));

TEST(Accelerated, AFailureInTheMidstOfAnIterationGoesOnFromThePositionsBroughtThere) {
  Progress progress;
  const auto device = std::make_shared<FakeDevice>();
  dmoscope::Run run = on_device(device, 0), near = on_cpu();
  for (dmoscope::Run* each : {&run, &near}) {
    each->iterate(2, progress);
    each->step(StepUnit::Class, progress);
  }
  const Moment stands = run.moment();
  EXPECT_TRUE(same_bits(positions_now(run), positions_now(near)));
  device->fail_at_visit = device->visits + 1;
  EXPECT_THROW(run.step(StepUnit::Vertex, progress), DeviceError);
  EXPECT_EQ(run.moment(), stands);
  for (dmoscope::Run* each : {&run, &near}) each->step(StepUnit::Iteration, progress);
  EXPECT_EQ(run.moment(), (Moment{3, 0}));
  EXPECT_TRUE(same_bits(positions_now(run), positions_now(near)));
  EXPECT_EQ(run.history().records()[3].moved, near.history().records()[3].moved);
}

TEST(Accelerated, AFailureWhileCopyingGoesBackToPositionsThatWereKept) {
  Progress progress;
  const auto states = states_on_cpu(5);
  const auto device = std::make_shared<FakeDevice>();
  dmoscope::Run run = on_device(device);
  run.iterate(1, progress);
  (void)run.positions();
  device->store_takes = std::chrono::milliseconds(100);
  run.iterate(3, progress);  // the first of them keeps the positions that were asked for
  const std::uint64_t kept = run.history().nearest(4).iteration;
  ASSERT_GE(kept, 1U);
  ASSERT_LT(kept, 4U);
  device->fail_at_store = device->stores + 1;
  EXPECT_THROW((void)run.positions(), DeviceError);
  EXPECT_THROW((void)run.positions(), DeviceError) << "never half copied ones";
  run.recover();
  EXPECT_THAT(run.take_warning(), HasSubstr("lost while copying"));
  EXPECT_EQ(run.moment(), (Moment{kept, 0}));
  EXPECT_TRUE(same_bits(positions_now(run), states[kept]));
  run.iterate(5 - kept, progress);
  EXPECT_TRUE(same_bits(positions_now(run), states[5]));
}

TEST(Accelerated, AFailureWhileGoingOverThePastAgainGoesBackToTheLastThatWasKept) {
  Progress progress;
  const auto states = states_on_cpu(4);
  const auto device = std::make_shared<FakeDevice>();
  dmoscope::Run run = on_device(device);
  run.iterate(4, progress, [](const dmoscope::Run& now) { (void)now.positions(); });
  run.seek({1, 0}, progress);
  ASSERT_TRUE(run.history().kept(3));
  run.iterate(2, progress);  // positions are not asked for
  device->fail_at_visit = device->visits + 1;
  EXPECT_THROW(run.iterate(1, progress), DeviceError);
  EXPECT_EQ(run.moment(), (Moment{3, 0}));
  EXPECT_TRUE(same_bits(positions_now(run), states[3]));
}

TEST(Accelerated, WorkThatDidNotAskForTheDeviceCarriesOnWithoutIt) {
  Progress progress;
  for (const Backend backend : {Backend::Auto, Backend::Cuda}) {
    const auto device = std::make_shared<FakeDevice>();
    device->fail_at_visit = 3;
    dmoscope::Run run = run_with({.backend = backend}, acceleration(device), 0);
    std::vector<std::string> told;
    const auto work = [&] { return run.iterate(5, progress); };
    const auto tell = [&](std::string sentence) { told.push_back(std::move(sentence)); };
    if (backend == Backend::Cuda) {
      EXPECT_THROW(retry_on_cpu(run, work, tell), DeviceError);
      EXPECT_TRUE(told.empty());
      continue;
    }
    EXPECT_EQ(retry_on_cpu(run, work, tell).iterations, 5U);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_THAT(told[0], HasSubstr("the fake device was lost"));
    EXPECT_EQ(run.moment(), (Moment{5, 0}));
    EXPECT_TRUE(same_bits(positions_now(run), states_on_cpu(5)[5]));
  }
}

TEST(Accelerated, AnObserverThatMeetsTheFailureEndsTheStepWithIt) {
  Progress progress;
  const auto device = std::make_shared<FakeDevice>();
  dmoscope::Run run = on_device(device, 0);
  device->fail_at_store = 1;
  run.set_observer([](const dmoscope::Run& now) { (void)now.positions(); });
  EXPECT_THROW(run.iterate(2, progress), DeviceError);
  EXPECT_EQ(run.backend(), Backend::Cpu);
  EXPECT_EQ(run.moment(), Moment{});
  run.iterate(2, progress);
  EXPECT_TRUE(same_bits(positions_now(run), states_on_cpu(2)[2]));
}

TEST(Session, BackendIsACommandAndEveryRunSaysWhatItRunsOn) {
  const auto device = std::make_shared<FakeDevice>();
  Session session(2, acceleration(device));
  Progress progress;
  std::vector<Message> said;
  CommandContext context{session, progress, [&](Message message) { said.push_back(std::move(message)); }};
  CommandTable commands;
  add_session_commands(commands, context);
  commands.execute("generate grid 500");
  EXPECT_EQ(session.active().backend(), Backend::Cuda);
  commands.execute("backend cpu");
  EXPECT_EQ(session.active().backend(), Backend::Cpu);
  EXPECT_EQ(session.run_count(), 1U);
  EXPECT_EQ(said.back().text, "cpu, 2 threads");
  commands.execute("run 1");
  commands.execute("backend cuda");
  EXPECT_EQ(session.run_count(), 2U) << "the run before is kept";
  EXPECT_EQ(session.active().backend(), Backend::Cuda);
  EXPECT_THROW(commands.execute("backend abacus"), UsageError);
  EXPECT_THROW(commands.execute("backend"), UsageError);
  commands.execute("generate grid 600");
  EXPECT_EQ(session.active().parameters().backend, Backend::Cuda) << "the next mesh keeps the choice";
  Session plain(1, acceleration(device), Backend::Cpu);
  plain.open(lattice(4, 0.1, 1), progress);
  EXPECT_EQ(plain.active().backend(), Backend::Cpu);

  device->fail_to_make = true;
  EXPECT_THROW(commands.execute("levels 2"), DeviceError);
  EXPECT_EQ(session.active().parameters().search.levels, 3) << "as it was";
  said.clear();
  commands.execute("backend auto");
  EXPECT_EQ(session.active().backend(), Backend::Cpu);
  ASSERT_FALSE(said.empty());
  EXPECT_EQ(said.back().kind, Message::Kind::Warning);
  EXPECT_THAT(said.back().text, HasSubstr("2 GiB free"));
}

TEST(Engine, OutlivesALostDevice) {
  for (const bool while_copying : {false, true}) {
    const auto device = std::make_shared<FakeDevice>();
    device->store_takes = std::chrono::milliseconds(50);  // expensive: only the end of a command copies
    Engine engine(2, acceleration(device));
    engine.post("generate grid 500");
    engine.post("run 2");
    engine.wait_idle();
    (void)engine.take_messages();
    (while_copying ? device->fail_at_store : device->fail_at_visit) = 1;
    engine.post("run 2");
    engine.wait_idle();
    const auto messages = engine.take_messages();
    const auto tells = [](const Message& message) {
      return message.kind == Message::Kind::Error && message.exit_code == 3 && message.text.find("device was lost") != std::string::npos;
    };
    EXPECT_TRUE(std::ranges::any_of(messages, tells)) << "a script must not go on as if nothing had been";
    engine.post("run 3");
    engine.post("expect iteration >= 3");
    engine.wait_idle();
    for (const Message& message : engine.take_messages()) EXPECT_NE(message.kind, Message::Kind::Error) << message.text;
    EXPECT_EQ(engine.view()->frame->moment, engine.view()->runs[0].moment);
  }
}

}  // namespace
}  // namespace dmoscope
