#include "app/subcommands/bench_measure.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "app/common/text.h"
#include "core/base/error.h"
#include "core/mesh/generate.h"
#include "core/run/run.h"

namespace dmoscope::app {
namespace {

constexpr std::uint64_t kMeshSeed = 1;
/// Size of the reference's work, for it is slow: in a volume a visit costs some hundred times as much.
struct ReferenceWork {
  std::uint64_t visits;  // about the most visits, and the most free vertices of a mesh to measure
  std::size_t size;      // vertices of the mesh that is generated in place of a larger one
};
ReferenceWork reference_work(const BenchElements& elements) {
  return elements.volume() ? ReferenceWork{2'000, 2'000} : ReferenceWork{20'000, 10'000};
}

using SharedInput = std::shared_ptr<const InputMesh>;

SharedInput generate(const BenchElements& elements, std::size_t size, Progress& progress) {
  Mesh mesh = generate_mesh(elements.generator, size, kMeshSeed, progress);
  mesh.name = fmt::format("{} {}", elements.generator, size);
  return prepare_input(std::move(mesh), {}, Need::Smoothing, progress);
}

std::uint64_t free_vertices(const InputMesh& input) {
  std::uint64_t free = 0;
  for (Index v = 0; v < input.mesh.vertex_count(); ++v) {
    if (input.topology.boundary()[v] == 0 && !input.topology.star(v).empty()) ++free;
  }
  return free;
}

/// The first row of bench_elements() that has all kinds of the mesh's elements; else the last row.
const BenchElements& elements_of(const Mesh& mesh) {
  unsigned kinds = 0;
  for (const ElementKind kind : mesh.elements.kinds()) kinds |= kind_set(kind);
  const auto known = bench_elements();
  const auto found = std::ranges::find_if(known, [&](const BenchElements& e) { return (kinds & ~unsigned{e.kinds}) == 0; });
  return found != known.end() ? *found : known.back();
}

Spread spread_of(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  const double median = values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
  return {median, values.front(), values.back()};
}

/// Repeats of one way to smooth one mesh.
struct Series {
  Measurement figure;  // all but the times
  SharedInput input;
  std::shared_ptr<ThreadPool> pool;
  std::uint64_t steps = 0;  // number of iterations; figure.iterations of them are timed
  Acceleration acceleration{};
  std::vector<double> seconds{}, first{}, last{}, prepare{}, step{}, end_to_end{};

  [[nodiscard]] std::string title() const {
    const std::string what = fmt::format("{}, {}", figure.mesh, info(figure.metric).name);
    if (!figure.on_cpu()) return fmt::format("{}, {}", what, name(figure.backend));
    return fmt::format("{}, {}, {}", what, figure.simd ? name(*figure.simd) : "scalar double",
                       counted(figure.threads, "thread", "threads"));
  }
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Measures a fresh run from the input, so that every repeat does the same work.
void repeat(Series& series, Progress& progress) {
  RunParameters parameters;
  parameters.method = series.figure.method;
  parameters.metric = series.figure.metric;
  parameters.combination = series.figure.combination;
  parameters.search.precision = series.figure.precision;
  parameters.search.simd = series.figure.simd;
  parameters.interfaces = InterfaceRule::Free;  // groups of a file do not affect the comparison
  parameters.backend = series.figure.backend;
  const auto start = std::chrono::steady_clock::now();
  Run run(series.input, parameters, series.pool, 0, series.acceleration);
  series.prepare.push_back(seconds_since(start));
  const auto ready = std::chrono::steady_clock::now();
  run.iterate(series.steps, progress);
  series.step.push_back(seconds_since(ready) / static_cast<double>(series.steps));
  (void)run.positions();  // copies them to the host
  series.end_to_end.push_back(seconds_since(start));
  const std::vector<IterationRecord>& records = run.history().records();
  double seconds = 0.0;
  for (std::uint64_t i = 1; i <= series.figure.iterations; ++i) seconds += records[i].seconds;
  series.seconds.push_back(seconds);
  series.first.push_back(records[1].seconds);
  series.last.push_back(records[series.figure.settling ? series.figure.settling->iteration : series.steps].seconds);
}

class Bench {
 public:
  Bench(const BenchPlan& plan, Progress& progress, const TakeFigures& take) : plan_(plan), progress_(progress), take_(take) {
    for (const unsigned count : plan.threads) pools_.push_back(std::make_shared<ThreadPool>(count));
  }

  void measure_all_of(const SharedInput& input) {
    if (free_vertices(*input) == 0) {
      throw UsageError(fmt::format("{}: no vertex is free to move, so there is nothing to measure", input->mesh.name));
    }
    const BenchElements& elements = elements_of(input->mesh);
    std::vector<Series> all;
    for (const Metric metric : plan_.metrics) {
      if (!elements.suits(info(metric))) continue;
      all.push_back(reference(input, elements, metric));
      if (plan_.acceleration.accelerator) all.push_back(on_device(input, elements, metric));
      if (!plan_.cpu) continue;
      for (const SimdLevel level : plan_.levels) {
        for (const auto& pool : pools_) all.push_back(variant(input, elements, metric, level, pool));
      }
    }
    for (std::size_t i = 1; i <= plan_.repeats; ++i) {
      for (Series& series : all) {
        progress_.begin(fmt::format("{}: repeat {} of {}", series.title(), i, plan_.repeats));
        repeat(series, progress_);
      }
    }
    take_(figures_of(all));
  }

 private:
  [[nodiscard]] Measurement figure_of(const SharedInput& input, const BenchElements& elements, Metric metric) const {
    Measurement figure;
    figure.mesh = input->mesh.name;
    figure.elements = elements.name;
    figure.vertices = figure.subject_vertices = input->mesh.vertex_count();
    figure.free = free_vertices(*input);
    figure.metric = metric;
    figure.combination = plan_.combination;
    figure.method = RunParameters{}.method;
    return figure;
  }

  [[nodiscard]] Series timed(const SharedInput& input, Measurement figure, const std::shared_ptr<ThreadPool>& pool) const {
    figure.threads = pool->size();
    figure.iterations = plan_.iterations;
    if (plan_.active > 0) figure.settling.emplace().iteration = plan_.active;
    return {std::move(figure), input, pool, std::max(plan_.iterations, plan_.active), plan_.acceleration};
  }

  /// Makes a series on the device, prepared by the pool.
  [[nodiscard]] Series on_device(const SharedInput& input, const BenchElements& elements, Metric metric) const {
    Measurement figure = figure_of(input, elements, metric);
    figure.backend = plan_.acceleration.accelerator->backend();
    return timed(input, std::move(figure), pools_.back());
  }

  [[nodiscard]] Series variant(const SharedInput& input, const BenchElements& elements, Metric metric, SimdLevel level,
                               const std::shared_ptr<ThreadPool>& pool) const {
    Measurement figure = figure_of(input, elements, metric);
    figure.simd = level;
    return timed(input, std::move(figure), pool);
  }

  [[nodiscard]] Series reference(const SharedInput& subject, const BenchElements& elements, Metric metric) {
    const auto [visits, size] = reference_work(elements);
    const bool large = free_vertices(*subject) > visits;
    if (large && reference_elements_ != elements.name) {
      reference_input_ = generate(elements, size, progress_);
      reference_elements_ = elements.name;
    }
    const SharedInput& input = large ? reference_input_ : subject;
    Measurement figure = figure_of(input, elements, metric);
    figure.subject_vertices = subject->mesh.vertex_count();
    figure.precision = Precision::Double;
    figure.reference = true;
    figure.iterations = std::clamp<std::uint64_t>(visits / figure.free, 1, plan_.iterations);
    const std::uint64_t steps = figure.iterations;
    return {std::move(figure), input, single_, steps};
  }

  [[nodiscard]] std::vector<Measurement> figures_of(const std::vector<Series>& all) const {
    std::vector<Measurement> figures;
    double reference = 0.0;
    for (const Series& series : all) {
      Measurement figure = series.figure;
      figure.seconds = spread_of(series.seconds);
      figure.prepare_seconds = spread_of(series.prepare);
      figure.step_seconds = spread_of(series.step);
      if (plan_.end_to_end) figure.end_to_end_seconds = spread_of(series.end_to_end);
      if (figure.reference) reference = figure.vertices_per_second();
      figure.reference_vertices_per_second = reference;
      if (figure.settling) {
        figure.settling->first_seconds = spread_of(series.first).median;
        figure.settling->seconds = spread_of(series.last).median;
      }
      figures.push_back(std::move(figure));
    }
    return figures;
  }

  const BenchPlan& plan_;
  Progress& progress_;
  const TakeFigures& take_;
  std::vector<std::shared_ptr<ThreadPool>> pools_;
  std::shared_ptr<ThreadPool> single_ = std::make_shared<ThreadPool>(1);
  SharedInput reference_input_;
  std::string_view reference_elements_;
};

}  // namespace

void measure(const BenchPlan& plan, const std::filesystem::path& file, Progress& progress, const TakeFigures& take) {
  Bench bench(plan, progress, take);
  if (!file.empty()) {
    const SharedInput input = load_input(file, Need::Smoothing, progress);
    if (!plan.all_metrics) {
      for (const Metric metric : plan.metrics) require_defined(metric, *input);
    }
    bench.measure_all_of(input);
    return;
  }
  for (const BenchElements& elements : plan.elements) {
    for (const std::size_t size : plan.sizes) bench.measure_all_of(generate(elements, size, progress));
  }
}

}  // namespace dmoscope::app
