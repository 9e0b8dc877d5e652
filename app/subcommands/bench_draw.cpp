#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "app/common/console.h"
#include "app/common/machine.h"
#include "app/common/text.h"
#include "app/subcommands/bench_pictures.h"
#include "core/base/error.h"
#include "core/mesh/generate.h"

#ifdef DMOSCOPE_HAVE_GUI
#include "app/window/draw_bench.h"
#endif

namespace dmoscope::app {

#ifdef DMOSCOPE_HAVE_GUI

namespace {

constexpr std::uint64_t kSeed = 1;

struct Row {
  std::string mesh;
  Index vertices = 0, elements = 0;
  Metric metric = Metric::MeanRatio;
  unsigned threads = 1;
  DrawFigure figure;
};

double milliseconds(const Row& row, double seconds) { return 1e3 * seconds / static_cast<double>(row.figure.frames); }

Json json_of(const Row& row) {
  const DrawFigure& f = row.figure;
  return {{"mesh", row.mesh},
          {"vertices", row.vertices},
          {"elements", row.elements},
          {"metric", info(row.metric).name},
          {"backend", name(f.backend)},
          {"threads", row.threads},
          {"path", f.path.name},
          {"reason", f.path.reason},
          {"renderer", f.renderer},
          {"frames", f.frames},
          {"frames_per_second", json_number(f.frames_per_second())},
          {"step_ms", json_number(milliseconds(row, f.step_seconds))},
          {"publish_ms", json_number(milliseconds(row, f.publish_seconds))},
          {"draw_ms", json_number(milliseconds(row, f.draw_seconds))},
          {"bytes_to_host", f.bytes_to_host}};
}

void print_head() {
  print("{}; {}, {}, commit {}\n\nAn iteration, its frame and its picture of 1280 x 800 pixels in turn; ms a frame.\n\n", processor(),
        compiler(), DMOSCOPE_BUILD_TYPE, commit());
  print("{:<16} {:>9}  {:<22} {:>8} {:>8} {:>8} {:>8}  {}\n", "mesh", "vertices", "path", "frames/s", "step", "frame", "drawing",
        "bytes to the host");
}

void print_row(const Row& row) {
  const DrawFigure& f = row.figure;
  print("{:<16} {:>9}  {:<22} {:>8.1f} {:>8.2f} {:>8.2f} {:>8.2f}  {}\n", row.mesh, row.vertices, f.path.name, f.frames_per_second(),
        milliseconds(row, f.step_seconds), milliseconds(row, f.publish_seconds), milliseconds(row, f.draw_seconds),
        f.backend == Backend::Cpu ? "-" : fmt::format("{}", f.bytes_to_host));
}

/// Steps and draws the mesh that is open in the session.
Row measure(Session& session, const BenchPlan& plan, const Acceleration& acceleration, std::uint64_t frames, Progress& progress) {
  RunParameters parameters = session.active().parameters();
  parameters.metric = plan.metrics.front();
  parameters.interfaces = InterfaceRule::Free;  // like all benchmarks
  session.change(std::move(parameters));
  session.show(plan.metrics.front());
  session.set_history_budget(0);
  const Mesh& mesh = session.input()->mesh;
  return {mesh.name,
          mesh.vertex_count(),
          static_cast<Index>(mesh.elements.size()),
          plan.metrics.front(),
          session.pool()->size(),
          measure_drawing({.session = session, .acceleration = acceleration, .frames = frames}, progress)};
}

}  // namespace

void bench_drawing(const BenchPlan& plan, const std::filesystem::path& file, std::uint64_t frames, bool json, Progress& progress) {
  Json rows = Json::array();
  if (!json) print_head();
  const auto on_each_backend = [&](const auto& open) {
    for (const Backend backend : {Backend::Cpu, Backend::Cuda}) {
      if (backend == Backend::Cpu ? !plan.cpu : !plan.acceleration.accelerator) continue;
      const Acceleration acceleration = backend == Backend::Cpu ? Acceleration{nullptr, "not asked for"} : plan.acceleration;
      Session session(*std::ranges::max_element(plan.threads), acceleration, backend);
      open(session);
      const Row row = measure(session, plan, acceleration, frames, progress);
      if (json) {
        rows.push_back(json_of(row));
      } else {
        print_row(row);
      }
    }
  };
  if (!file.empty()) on_each_backend([&](Session& session) { session.open(file, progress); });
  for (const BenchElements& elements : plan.elements) {
    for (const std::size_t size : file.empty() ? plan.sizes : std::vector<std::size_t>{}) {
      on_each_backend([&](Session& session) {
        Mesh mesh = generate_mesh(elements.generator, size, kSeed, progress);
        mesh.name = fmt::format("{} {}", elements.generator, size);
        session.open(std::move(mesh), progress);
      });
    }
  }
  if (!json) return;
  print_json({{"commit", commit()},
              {"build", DMOSCOPE_BUILD_TYPE},
              {"processor", processor()},
              {"no_cuda", plan.acceleration.reason},
              {"drawing", std::move(rows)}});
}

#else

void bench_drawing(const BenchPlan&, const std::filesystem::path&, std::uint64_t, bool, Progress&) {
  throw UsageError("--draw: this program was built without OpenGL, so it draws nothing");
}

#endif

}  // namespace dmoscope::app
