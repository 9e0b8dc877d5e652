#include "app/subcommands/bench_report.h"

#include <algorithm>
#include <string>
#include <thread>

#include <fmt/format.h>

#include "app/common/console.h"
#include "app/common/line_plot.h"
#include "app/common/machine.h"

namespace dmoscope::app {
namespace {

constexpr std::size_t kDotted = 3;  // a value of PlotSeries::dash

constexpr std::string_view kReference =
    "the plain scalar search in double on one thread, measured in turn with the others; where a mesh has more than 20000 free vertices (a "
    "volume 2000), on a generated one of 10000 (2000) with the same kinds of elements, since its cost a visit does not depend on the size";

/// Name of the unit that searched: the processor's instructions, or a device.
std::string_view executor_name(const Measurement& f) { return !f.on_cpu() ? name(f.backend) : f.simd ? name(*f.simd) : "scalar"; }
Json json_of(const Spread& s) { return {{"median", s.median}, {"lowest", s.lowest}, {"highest", s.highest}}; }
/// Name of the precision: two aims are searched for in double, by packs or plainly.
std::string_view precision_name(const Measurement& f) { return f.precision == Precision::Double || f.combination ? "double" : "float"; }
std::string composite(const Measurement& f) { return f.combination ? to_text(f.metric, *f.combination) : std::string(info(f.metric).name); }
unsigned cores() { return std::max(1U, std::thread::hardware_concurrency()); }

Json json_of(const Measurement& f) {
  Json object{{"mesh", f.mesh},
              {"elements", f.elements},
              {"vertices", f.vertices},
              {"free", f.free},
              {"metric", info(f.metric).name},
              {"combination", f.combination ? Json(composite(f)) : Json(nullptr)},
              {"method", f.method},
              {"backend", name(f.backend)},
              {"precision", precision_name(f)},
              {"simd", f.on_cpu() ? Json(executor_name(f)) : Json(nullptr)},
              {"threads", f.threads},
              {"iterations", f.iterations},
              {"seconds", json_of(f.seconds)},
              {"step_seconds", json_of(f.step_seconds)},
              {"prepare_seconds", json_of(f.prepare_seconds)},
              {"prepare_share", json_number(f.prepare_share())},
              {"iterations_per_second", json_number(f.iterations_per_second())},
              {"vertices_per_second", json_number(f.vertices_per_second())},
              {"ns_per_visit", json_number(f.ns_per_visit())},
              {"reference", f.reference},
              {"reference_vertices_per_second", json_number(f.reference_vertices_per_second)},
              {"ratio", json_number(f.ratio())}};
  if (f.end_to_end_seconds) object["end_to_end_seconds"] = json_of(*f.end_to_end_seconds);
  if (f.settling) {
    object["settling"] = {{"iteration", f.settling->iteration},
                          {"first_seconds", f.settling->first_seconds},
                          {"seconds", f.settling->seconds},
                          {"ratio", json_number(f.settling->first_seconds / f.settling->seconds)}};
  }
  return object;
}

/// Name of a line of the plot: the properties that all its figures share.
std::string series_name(const Measurement& f) {
  const std::string what = fmt::format("{}, {}", f.elements, composite(f));
  if (f.reference) return what + ", plain double";
  if (!f.on_cpu()) return fmt::format("{}, {}", what, name(f.backend));
  return fmt::format("{}, {}, {}", what, executor_name(f), counted(f.threads, "thread", "threads"));
}

/// Million visits a second in `seconds`.
double rate(const Measurement& f, double seconds) { return 1e-6 * f.visits() / seconds; }

/// Colours and dashes of the series: a colour for elements, metric and SIMD level, a dash for the number of threads.
class PlotLook {
 public:
  explicit PlotLook(const std::vector<Measurement>& figures) {
    const Measurement& first = figures.front();
    single_ = std::ranges::all_of(figures, [&](const Measurement& f) { return f.elements == first.elements && f.metric == first.metric; });
  }

  /// A reference is dotted, and grey if it is the only one; else it has the colour of the first series it is compared with.
  [[nodiscard]] PlotSeries series(const Measurement& f, const Measurement& compared) {
    PlotSeries series{.name = series_name(f), .muted = f.reference && single_, .values = {}};
    if (!series.muted) {
      series.colour = place(colours_, fmt::format("{} {} {}", f.elements, info(f.metric).name, executor_name(f.reference ? compared : f)));
    }
    series.dash = f.reference ? kDotted : place(dashes_, f.threads);
    return series;
  }

 private:
  template <class Value>
  static std::size_t place(std::vector<Value>& known, const Value& value) {
    const auto found = std::find(known.begin(), known.end(), value);
    const auto index = static_cast<std::size_t>(found - known.begin());
    if (found == known.end()) known.push_back(value);
    return index;
  }
  bool single_;
  std::vector<std::string> colours_;
  std::vector<unsigned> dashes_;
};

}  // namespace

void print_head(const BenchPlan& plan) {
  print("{}, {}\n{}, {}, commit {}; flags {}\n\n", processor(), counted(cores(), "processor thread", "processor threads"), compiler(),
        DMOSCOPE_BUILD_TYPE, commit(), compiler_flags());
  if (plan.acceleration.accelerator) {
    print("{}: {}\n", name(plan.acceleration.accelerator->backend()), plan.acceleration.accelerator->description());
  } else {
    print("CUDA is not usable: {}\n", plan.acceleration.reason);
  }
  print("Smoothing alone, {} from the input; median of {} (lowest to highest).\nRatio to {}.\n\n",
        counted(plan.iterations, "iteration", "iterations"), counted(plan.repeats, "repeat", "repeats"), kReference);
  print("{:<20} {:<16} {:>9} {:>9} {:>7} {:>9} {:>8} {:>16} {:>9} {:>7} {:>9} {:>9}{}{}\n", "mesh", "metric", "free", "simd", "threads",
        "ms", "Mv/s", "spread", "ns/visit", "ratio", "it/s", "prepare",
        plan.end_to_end ? fmt::format(" {:>11} {:>20}", "end to end", "spread") : "",
        plan.active > 0 ? fmt::format("  iteration {} against 1", plan.active) : "");
}

void print_rows(const std::vector<Measurement>& figures) {
  for (const Measurement& f : figures) {
    const std::string spread = fmt::format("{:.3g} to {:.3g}", rate(f, f.seconds.highest), rate(f, f.seconds.lowest));
    print("{:<20} {:<16} {:>9} {:>9} {:>7} {:>9.3f} {:>8.4g} {:>16} {:>9.1f} {:>7.2f} {:>9.4g} {:>6.1f} ms", f.mesh, composite(f), f.free,
          f.reference ? "double" : executor_name(f), f.threads, 1e3 * f.seconds.median, rate(f, f.seconds.median), spread, f.ns_per_visit(),
          f.ratio(), f.iterations_per_second(), 1e3 * f.prepare_seconds.median);
    if (f.end_to_end_seconds) {
      const Spread& all = *f.end_to_end_seconds;
      print(" {:>8.2f} ms {:>20}", 1e3 * all.median, fmt::format("{:.4g} to {:.4g}", 1e3 * all.lowest, 1e3 * all.highest));
    }
    if (f.settling) {
      print("  {:.3f} ms against {:.3f} ms, {:.2f} x", 1e3 * f.settling->seconds, 1e3 * f.settling->first_seconds,
            f.settling->first_seconds / f.settling->seconds);
    }
    print("\n");
  }
  std::fflush(stdout);
}

Json json_of(const BenchPlan& plan, const std::vector<Measurement>& figures) {
  Json list = Json::array();
  for (const Measurement& figure : figures) list.push_back(json_of(figure));
  Json levels = Json::array();
  for (const SimdLevel level : supported_simd_levels()) levels.push_back(name(level));
  const auto memory = total_memory();
  const auto& [accelerator, reason] = plan.acceleration;
  Json cuda{{"measured", accelerator != nullptr}, {"device", accelerator ? Json(accelerator->description()) : Json(nullptr)}};
  cuda["reason"] = accelerator ? "" : reason;
  return {{"version", DMOSCOPE_VERSION},
          {"commit", commit()},
          {"date", date_and_time()},
          {"machine", {{"processor", processor()}, {"cores", cores()}, {"memory", memory ? Json(*memory) : Json(nullptr)}}},
          {"build", {{"compiler", compiler()}, {"type", DMOSCOPE_BUILD_TYPE}, {"flags", compiler_flags()}}},
          {"cuda", std::move(cuda)},
          {"simd", {{"levels", std::move(levels)}, {"used", name(best_simd_level())}}},
          {"repeats", plan.repeats},
          {"reference", kReference},
          {"figures", std::move(list)}};
}

LinePlot plot_of(const std::vector<Measurement>& figures) {
  LinePlot plot;
  plot.title = "Smoothing by size of the mesh";
  plot.subtitle =
      fmt::format("{}, {}; {}, {}; dmoscope {}, commit {}", processor(), counted(cores(), "processor thread", "processor threads"),
                  compiler(), DMOSCOPE_BUILD_TYPE, DMOSCOPE_VERSION, commit());
  plot.x_title = "vertices";
  plot.y_title = "million vertex visits per second";
  plot.note =
      "plain double: the scalar search on one thread; for meshes of more than 20 k free vertices measured on one of 10 k (volumes: 2 k)";
  PlotLook look(figures);
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const Measurement& f = figures[i];
    auto series = std::ranges::find(plot.series, series_name(f), &PlotSeries::name);
    // The first figure that is compared with a reference follows it.
    if (series == plot.series.end()) series = plot.series.insert(series, look.series(f, figures[f.reference ? i + 1 : i]));
    series->values.push_back(
        {static_cast<double>(f.subject_vertices), rate(f, f.seconds.median), rate(f, f.seconds.highest), rate(f, f.seconds.lowest)});
  }
  for (PlotSeries& series : plot.series) std::ranges::sort(series.values, {}, &PlotValue::x);
  return plot;
}

}  // namespace dmoscope::app
