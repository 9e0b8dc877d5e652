#include "app/subcommands/bench_pictures.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/common/console.h"
#include "app/common/machine.h"
#include "app/common/text.h"
#include "core/base/error.h"
#include "core/base/words.h"
#include "core/mesh/generate.h"

#ifdef DMOSCOPE_HAVE_GUI
#include "app/window/draw_bench.h"
#include "app/window/window_bench.h"
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

constexpr std::uint64_t kIterations = 200;

struct Milliseconds {
  double median = 0.0, worst = 0.0;
};
Milliseconds of(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  return {1e3 * seconds[seconds.size() / 2], 1e3 * seconds.back()};
}

Json json_of(const Milliseconds& m) { return {{"median_ms", json_number(m.median)}, {"worst_ms", json_number(m.worst)}}; }

/// Sends a command and waits until it is done. Throws Error with its message.
void say(Engine& engine, const std::string& line) {
  engine.post(line);
  engine.wait_idle();
  for (const Message& message : engine.take_messages())
    if (message.kind == Message::Kind::Error) throw UsageError(message.text);
}

struct Line {
  const char *what, *key;
  WindowCost WindowFigure::*cost;
};
constexpr auto kLines = std::to_array<Line>({{"start to first picture", "first", &WindowFigure::first},
                                             {"start to full picture", "full", &WindowFigure::full},
                                             {"start to rest", "rest", &WindowFigure::rest},
                                             {"zoom, until seen", "zoom", &WindowFigure::zoom},
                                             {"zoom in the midst of drawing", "zoom_in_midst", &WindowFigure::zoom_in_midst},
                                             {"drag, until seen", "drag", &WindowFigure::pan},
                                             {"pick, until seen", "pick", &WindowFigure::pick},
                                             {"fit, until seen", "fit", &WindowFigure::fit},
                                             {"an iteration, until seen", "iteration", &WindowFigure::iteration},
                                             {"metric shown during a run", "metric", &WindowFigure::metric},
                                             {"60 iterations, drawn", "run", &WindowFigure::run}});

void print_figure(const WindowFigure& figure) {
  print("{}; {}, {}, commit {}\n{} vertices, {} elements; {}\n\n", processor(), compiler(), DMOSCOPE_BUILD_TYPE, commit(),
        grouped(figure.vertices), grouped(figure.elements), figure.renderer);
  print("{:<30} {:>12} {:>12}\n", "", "ms", "processor ms");
  for (const Line& line : kLines) {
    const WindowCost& cost = figure.*line.cost;
    print("{:<30} {:>12.0f} {:>12.0f}\n", line.what, 1e3 * cost.seconds, 1e3 * cost.processor);
  }
  print("{:<30} {:>12} frames at most, {:.0f} ms\n", "metric shown during a run", figure.metric_frames, 1e3 * figure.metric_longest);
  print("{:<30} {:>12.0f}\n", "longest answer", 1e3 * figure.longest);
  for (const auto& [what, bytes] : {std::pair{"memory, most until open", figure.memory_open}, {"memory, most after 60", figure.memory_run}})
    print("{:<30} {:>9.2f} GB\n", what, 1e-9 * static_cast<double>(bytes));
}

Json json_of(const WindowFigure& figure) {
  Json costs;
  for (const Line& line : kLines) {
    const WindowCost& cost = figure.*line.cost;
    costs[line.key] = {{"seconds", json_number(cost.seconds)}, {"processor_seconds", json_number(cost.processor)}};
  }
  return {{"commit", commit()},
          {"build", DMOSCOPE_BUILD_TYPE},
          {"processor", processor()},
          {"renderer", figure.renderer},
          {"vertices", figure.vertices},
          {"elements", figure.elements},
          {"costs", std::move(costs)},
          {"metric_frames", figure.metric_frames},
          {"metric_longest", json_number(figure.metric_longest)},
          {"longest_answer", json_number(figure.longest)},
          {"memory_open", figure.memory_open},
          {"memory_after_60", figure.memory_run}};
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

void bench_seeking(const BenchPlan& plan, const std::filesystem::path& file, std::uint64_t seeks, bool json, Progress& progress) {
  std::vector<std::string> meshes;
  if (!file.empty()) meshes.push_back("open " + quote_word(file.string()));
  for (const BenchElements& elements : plan.elements)
    for (const std::size_t size : file.empty() ? plan.sizes : std::vector<std::size_t>{})
      meshes.push_back(fmt::format("generate {} {}", elements.generator, size));
  Json rows = Json::array();
  if (!json) {
    print("{}; {}, {}, commit {}\n\nSeeks to random ones of {} iterations; ms, median and worst of {}.\n\n", processor(), compiler(),
          DMOSCOPE_BUILD_TYPE, commit(), kIterations, seeks);
    print("{:<24} {:>9} {:>9} {:>17} {:>17} {:>17} {:>9}\n", "mesh", "vertices", "kept every", "seek", "drawing", "seek and drawing",
          "in frames");
  }
  for (const std::string& mesh : meshes) {
    Engine engine(*std::ranges::max_element(plan.threads), plan.acceleration, plan.cpu ? Backend::Cpu : Backend::Cuda);
    say(engine, mesh);
    say(engine, fmt::format("metric {}", info(plan.metrics.front()).name));
    say(engine, fmt::format("run {}", kIterations));
    const auto view = engine.view();
    const SeekFigure figure = measure_seeks(engine, plan.acceleration, kIterations, seeks, progress);
    const Milliseconds seek = of(figure.seeks), frame = of(figure.full_frames), drawn = of(figure.drawn);
    const std::string& note = view->runs[0].history_note;
    if (json) {
      rows.push_back({{"mesh", mesh},
                      {"vertices", view->input->mesh.vertex_count()},
                      {"history", note},
                      {"seek", json_of(seek)},
                      {"full_frame", json_of(frame)},
                      {"seek_and_draw", json_of(drawn)},
                      {"renderer", figure.renderer}});
    } else {
      print("{:<24} {:>9} {:>10} {:>8.2f} {:>8.2f} {:>8.2f} {:>8.2f} {:>8.2f} {:>8.2f} {:>9.2f}\n", mesh, view->input->mesh.vertex_count(),
            note.empty() ? "1" : "more", seek.median, seek.worst, frame.median, frame.worst, drawn.median, drawn.worst,
            drawn.median / frame.median);
    }
  }
  if (json) print_json({{"commit", commit()}, {"build", DMOSCOPE_BUILD_TYPE}, {"processor", processor()}, {"seeking", std::move(rows)}});
}

void bench_window(const BenchPlan& plan, const std::filesystem::path& file, bool json, Progress& progress) {
  WindowSubject subject;
  subject.line = file.empty() ? fmt::format("generate {} {}", plan.elements.front().generator, plan.sizes.front())
                              : "open " + quote_word(file.string());
  subject.acceleration = plan.cpu ? Acceleration{nullptr, "not asked for"} : plan.acceleration;
  subject.threads = *std::ranges::max_element(plan.threads);
  const WindowFigure figure = measure_window(subject, progress);
  if (json) {
    print_json(json_of(figure));
  } else {
    print_figure(figure);
  }
}

#else

namespace {

[[noreturn]] void refuse(const char* option) {
  throw UsageError(fmt::format("{}: this program was built without OpenGL, so it draws nothing", option));
}

}  // namespace

void bench_drawing(const BenchPlan&, const std::filesystem::path&, std::uint64_t, bool, Progress&) { refuse("--draw"); }
void bench_seeking(const BenchPlan&, const std::filesystem::path&, std::uint64_t, bool, Progress&) { refuse("--seek"); }
void bench_window(const BenchPlan&, const std::filesystem::path&, bool, Progress&) { refuse("--window"); }

#endif

}  // namespace dmoscope::app
