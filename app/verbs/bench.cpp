// dmoscope bench: how fast this machine smooths, against the plain search in double.

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/console.h"
#include "app/text.h"
#include "app/verbs/verbs.h"
#include "core/mesh/generate.h"
#include "core/session/run.h"

namespace dmoscope::app {
namespace {

constexpr std::size_t kRepeats = 5;
constexpr std::uint64_t kSeed = 1;

struct Options {
  std::filesystem::path file;
  bool full = false;
  bool json = false;
};

struct Figure {
  std::string mesh;
  Index vertices;
  std::uint64_t free;
  Precision precision;
  unsigned threads;
  double median, lowest, highest;  // vertices visited a second
  double ratio;                    // median over that of the double reference on one thread
};

std::string_view name_of(Precision precision) { return precision == Precision::Double ? "double" : "float"; }

/// The first iteration from the input, again and again: every repeat does the very same work.
Figure measure(const std::shared_ptr<const InputMesh>& input, Precision precision, unsigned threads, Progress& progress) {
  const auto pool = std::make_shared<ThreadPool>(threads);
  RunParameters parameters;
  parameters.search.precision = precision;
  std::array<double, kRepeats> speeds{};
  std::uint64_t visits = 0;
  for (double& speed : speeds) {
    Run run(input, parameters, pool, 0);
    visits = run.visits_per_iteration();
    run.step(StepUnit::Iteration, progress);
    const double seconds = run.history().records().back().seconds;
    speed = seconds > 0.0 ? static_cast<double>(visits) / seconds : 0.0;
  }
  std::sort(speeds.begin(), speeds.end());
  return {input->mesh.name,
          input->mesh.vertex_count(),
          visits,
          precision,
          pool->size(),
          speeds[kRepeats / 2],
          speeds.front(),
          speeds.back(),
          1.0};
}

std::vector<Figure> measure_all(const std::shared_ptr<const InputMesh>& input, Progress& progress) {
  const unsigned all = ThreadPool().size();
  std::vector<unsigned> counts{1};
  if (all > 1) counts.push_back(all);
  std::vector<Figure> figures;
  for (const Precision precision : {Precision::Double, Precision::Float}) {
    for (const unsigned threads : counts) {
      figures.push_back(measure(input, precision, threads, progress));
      figures.back().ratio = figures.front().median > 0.0 ? figures.back().median / figures.front().median : 0.0;
    }
  }
  return figures;
}

std::vector<std::shared_ptr<const InputMesh>> inputs_of(const Options& options, Progress& progress) {
  std::vector<std::shared_ptr<const InputMesh>> inputs;
  if (!options.file.empty()) {
    inputs.push_back(load_input(options.file, Need::Smoothing, progress));
    return inputs;
  }
  std::vector<std::size_t> sizes{10'000, 100'000};
  if (options.full) sizes.push_back(1'000'000);
  for (const std::size_t size : sizes) {
    Mesh mesh = generate_mesh("grid", size, kSeed, progress);
    mesh.name = fmt::format("grid {}", size);
    inputs.push_back(prepare_input(std::move(mesh), {}, Need::Smoothing, progress));
  }
  return inputs;
}

int bench(const Options& options) {
  Watch watch;
  std::vector<Figure> figures;
  for (const auto& input : inputs_of(options, watch.progress())) {
    const std::vector<Figure> more = measure_all(input, watch.progress());
    figures.insert(figures.end(), more.begin(), more.end());
  }
  if (options.json) {
    Json list = Json::array();
    for (const Figure& f : figures) {
      list.push_back({{"mesh", f.mesh},
                      {"vertices", f.vertices},
                      {"free", f.free},
                      {"backend", "cpu"},
                      {"precision", name_of(f.precision)},
                      {"threads", f.threads},
                      {"vertices_per_second", f.median},
                      {"lowest", f.lowest},
                      {"highest", f.highest},
                      {"ratio", f.ratio}});
    }
    print_json({{"version", DMOSCOPE_VERSION}, {"repeats", kRepeats}, {"figures", std::move(list)}});
    return 0;
  }
  fmt::print("vertices visited a second, median of {} (lowest to highest); ratio to double on one thread\n\n", kRepeats);
  fmt::print("{:<20} {:>9} {:>8} {:>9} {:>8} {:>12} {:>27} {:>7}\n", "mesh", "free", "backend", "precision", "threads", "vertices/s",
             "spread", "ratio");
  for (const Figure& f : figures) {
    fmt::print("{:<20} {:>9} {:>8} {:>9} {:>8} {:>12.0f} {:>27} {:>7.2f}\n", f.mesh, f.free, "cpu", name_of(f.precision), f.threads,
               f.median, fmt::format("{:.0f} to {:.0f}", f.lowest, f.highest), f.ratio);
  }
  return 0;
}

}  // namespace

void add_bench(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("bench", "Measure how fast this machine smooths");
  verb->add_option("FILE", options->file, "Mesh to smooth instead of generated grids");
  verb->add_flag("--full", options->full, "Also a grid of a million vertices");
  verb->add_flag("--json", options->json, "Print one JSON object and nothing else on standard output");
  verb->callback([options, &action] { action = [options] { return bench(*options); }; });
}

}  // namespace dmoscope::app
