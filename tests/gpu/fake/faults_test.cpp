// Every call of the runtime fails once, in every possible way: the work is done all the same, or the error tells the cause, and the mesh
// always is that of a finished iteration.

#include <algorithm>
#include <map>

#include "core/mesh/generate.h"
#include "core/run/retry_on_cpu.h"
#include "gpu/accelerator.h"
#include "tests/gpu/fake/opengl.h"
#include "tests/gpu/same_bits.h"
#include "tests/smooth/zoo.h"

namespace dmoscope::gpu::fake {
namespace {

using dmoscope::testing::lattice;
using gpu::testing::same;
using ::testing::AnyOf;
using ::testing::HasSubstr;

constexpr int kCodes[] = {kOutOfMemory, kUnavailable, kWrongPtxVersion, kOperatingSystem, kIllegalAddress, kTimeout};
/// The runtime's or the program's words for each error.
const std::map<int, std::string> kWords{
    {kOutOfMemory, "out of memory"},      {kUnavailable, "busy or unavailable"},      {kWrongPtxVersion, "unsupported toolchain"},
    {kOperatingSystem, "OS call failed"}, {kIllegalAddress, "illegal memory access"}, {kTimeout, "timed out"}};

/// The calls are the same however long a search takes.
const SearchParameters kShort{.grid_points = 4, .levels = 1};

class FakeFaults : public WithOpenGl {
 protected:
  void SetUp() override {
    WithOpenGl::SetUp();
    if (context != nullptr) begin(lattice(6, 0.35, 71, dmoscope::testing::Cells::Mixed), {.search = kShort});
  }
  /// Sets the mesh and the run of the test.
  void begin(Mesh mesh, const RunParameters& what) {
    Progress progress;
    parameters = what;
    input = prepare_input(std::move(mesh), {}, Need::Smoothing, progress);
    finished.clear();
    statistics.clear();
    drawn = std::make_unique<Drawn>(input->mesh.vertex_count(), input->mesh.elements.size());
    auto cpu = make_run(Backend::Cpu, {});
    for (std::uint64_t i = 0; i <= kIterations; ++i) {
      cpu.seek({i}, progress);
      finished.emplace_back(cpu.positions().begin(), cpu.positions().end());
      statistics.push_back(cpu.statistics());
    }
    ASSERT_FALSE(is_finished(2, finished[1])) << "they differ";
  }
  void TearDown() override {
    drawn.reset();
    WithOpenGl::TearDown();
  }
  void set_up_again() { set_up({.devices = std::vector<FakeDevice>(2), .gl = &gl}); }

  [[nodiscard]] dmoscope::Run make_run(Backend backend, Acceleration acceleration) const {
    RunParameters asked = parameters;
    asked.backend = backend;
    return {input, asked, std::make_shared<ThreadPool>(1), std::size_t{1} << 24U, std::move(acceleration)};
  }
  [[nodiscard]] bool is_finished(std::size_t iteration, std::span<const Vec3> positions) const {
    return std::ranges::equal(positions, finished[iteration], [](Vec3 a, Vec3 b) { return same(a, b); });
  }
  void expect_words(const std::string& what) {
    EXPECT_TRUE(has_failed()) << what;
    // If the first device was given up for the second, OpenGL draws on the other.
    EXPECT_THAT(what, AnyOf(HasSubstr(kWords.at(code)), HasSubstr("OpenGL draws on CUDA device 0, but device 1 smooths")));
  }
  /// Does `act`; returns whether it succeeded, and reports errors as the window does.
  template <class Act>
  bool attempt(const Act& act) {
    try {
      act();
      return true;
    } catch (const DeviceError& error) {
      expect_words(error.what());
      return false;
    }
  }

  /// A user's work: the program looks for a device, smooths, shows numbers and a picture, and closes.
  void live(Backend backend) {
    const Acceleration acceleration = make_accelerator();
    if (!acceleration.accelerator) expect_words(acceleration.reason);
    if (backend == Backend::Cuda && !acceleration.accelerator) return;  // the backend is refused in these words
    attempt([&] {
      dmoscope::Run run = make_run(backend, acceleration);
      work(run, backend);
    });
  }
  void work(dmoscope::Run& run, Backend backend) {
    Progress progress;
    const auto with_retry = [&](const auto& act) {
      try {
        retry_on_cpu(run, act, [this](const std::string& what) { expect_words(what); });
      } catch (const DeviceError& error) {
        EXPECT_EQ(backend, Backend::Cuda) << "the CPU goes on by itself: " << error.what();
        expect_words(error.what());
        const std::uint64_t here = run.moment().iteration;
        ASSERT_LE(here, kIterations);
        EXPECT_EQ(run.moment().visits, 0U);
        EXPECT_TRUE(is_finished(here, run.positions())) << "the mesh is that of a finished iteration";
        act();  // tries again
      }
    };
    with_retry([&] { run.iterate(kIterations - run.moment().iteration, progress); });
    with_retry([&] {
      run.seek({kIterations}, progress);
      EXPECT_TRUE(same(run.statistics().mean, statistics[kIterations].mean));
    });
    std::shared_ptr<const DevicePicture> picture;
    attempt([&] { picture = run.picture(Metric::MinAngle); });
    if (picture) draw(*picture);
    picture.reset();
    with_retry([&] {
      run.seek({kIterations}, progress);
      EXPECT_TRUE(is_finished(kIterations, run.positions())) << "the positions are those of the processor";
      EXPECT_TRUE(same(run.statistics().minimum, statistics[kIterations].minimum));
    });
  }
  /// Draws like render's DeviceFeed: by the device's own writing, else through the host, else not at all.
  void draw(const DevicePicture& picture) {
    std::vector<Vec2<float>> points(input->mesh.vertex_count());
    std::vector<float> shades(input->mesh.elements.size());
    std::unique_ptr<DeviceTarget> target;
    const bool direct = attempt([&] {
      target = picture.make_target(drawn->points_name(), drawn->shades_name());
      picture.write(*target, {});
    });
    if (direct) {
      points = drawn->points();
      shades = drawn->shades();
    } else {
      target.reset();
      if (!attempt([&] { picture.download(points, shades, {}); })) return;
    }
    for (std::size_t v = 0; v < points.size(); ++v) {
      ASSERT_EQ(points[v].x, static_cast<float>(finished[kIterations][v].x)) << v << (direct ? " drawn" : " copied");
      ASSERT_EQ(points[v].y, static_cast<float>(finished[kIterations][v].y)) << v;
    }
    for (std::size_t e = 0; e < shades.size(); ++e) {
      const double quality = element_quality(input->quality_context(), finished[kIterations], Metric::MinAngle, static_cast<Index>(e));
      ASSERT_EQ(shades[e], shade_of(static_cast<float>(quality), false)) << e;
    }
  }

  /// All calls with `backend` if nothing fails.
  std::vector<std::string> calls_of(Backend backend) {
    set_up_again();
    live(backend);
    EXPECT_THAT(breaches(), ::testing::IsEmpty());
    EXPECT_THAT(leaks(), ::testing::IsEmpty());
    return calls();
  }
  void fail(Backend backend, std::size_t call, const std::string& name) {
    SCOPED_TRACE(::testing::Message() << "call " << call << ", " << name << ", fails with " << code);
    set_up_again();
    fail_at(call, code);
    live(backend);
    EXPECT_TRUE(has_failed());
    EXPECT_THAT(breaches(), ::testing::IsEmpty());
    EXPECT_THAT(leaks(), ::testing::IsEmpty());
  }

  /// Makes every call fail in two ways: memory that is missing, and the loss of the device.
  void fail_all() {
    const std::vector<std::string> all = calls_of(Backend::Auto);
    EXPECT_THAT(all, ::testing::Contains("cudaGraphLaunch")) << "it runs on the device";
    for (const int each : {kOutOfMemory, kIllegalAddress}) {
      code = each;
      for (std::size_t n = 1; n <= all.size() && !HasFailure(); ++n) fail(Backend::Auto, n, all[n - 1]);
    }
  }

  static constexpr std::uint64_t kIterations = 2;
  RunParameters parameters;
  std::shared_ptr<const InputMesh> input;
  std::unique_ptr<Drawn> drawn;
  std::vector<std::vector<Vec3>> finished;  // positions after each iteration
  std::vector<Statistics> statistics;
  int code = 0;
};

TEST_F(FakeFaults, EveryCallWhereTheProcessorMayGoOn) {
  const std::vector<std::string> all = calls_of(Backend::Auto);
  std::size_t faults = 0;
  for (const int each : kCodes) {
    code = each;
    for (std::size_t n = 1; n <= all.size() && !HasFailure(); ++n, ++faults) fail(Backend::Auto, n, all[n - 1]);
  }
  std::printf("%zu calls of %zu kinds, %zu faults\n", all.size(), std::set<std::string>(all.begin(), all.end()).size(), faults);
}

/// One transient error and one loss of the device; unlike above the errors are reported, since the device is named.
TEST_F(FakeFaults, EveryCallWhereTheDeviceIsAskedForByName) {
  const std::vector<std::string> all = calls_of(Backend::Cuda);
  for (const int each : {kOperatingSystem, kIllegalAddress}) {
    code = each;
    for (std::size_t n = 1; n <= all.size() && !HasFailure(); ++n) fail(Backend::Cuda, n, all[n - 1]);
  }
}

TEST_F(FakeFaults, EveryCallOfAVolume) {
  Progress progress;
  begin(generate_mesh("tetrahedra", 64, 3, progress), {.search = {.levels = 1}});
  fail_all();
}

TEST_F(FakeFaults, EveryCallOfTwoAims) {
  begin(lattice(5, 0.35, 72), {.search = kShort, .combination = CompositeTerms{0.3, Metric::MinAngle}});
  fail_all();
}

}  // namespace
}  // namespace dmoscope::gpu::fake
