#include <algorithm>

#include <fmt/format.h>

#include "app/common/console.h"
#include "app/common/machine.h"
#include "app/common/text.h"
#include "app/subcommands/bench_pictures.h"
#include "core/base/error.h"

#ifdef DMOSCOPE_HAVE_GUI
#include "app/window/seek_bench.h"
#endif

namespace dmoscope::app {

#ifdef DMOSCOPE_HAVE_GUI

namespace {

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

}  // namespace

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

#else

void bench_seeking(const BenchPlan&, const std::filesystem::path&, std::uint64_t, bool, Progress&) {
  throw UsageError("--seek: this program was built without OpenGL, so it draws nothing");
}

#endif

}  // namespace dmoscope::app
