// Figure 5 and the two examples of Section 5.2: the speed of methods, by the iteration and to a goal.

#include <algorithm>

#include <fmt/format.h>

#include "app/paper/lab.h"
#include "core/base/error.h"

namespace dmoscope::app {

namespace {

constexpr const char* kAnotherMachine =
    "The paper's figure is of a GTX 1070 and an i7-6700K with the authors' own code; only ratios within one run compare.";

struct Racer {
  std::string name;
  RunParameters parameters;
  std::vector<PlotValue> speeds{};
};

/// DMO on every backend of this machine, and the figure's two other methods.
std::vector<Racer> racers(const Lab& lab) {
  std::vector<Racer> all{{"dmo, cpu", {.backend = Backend::Cpu}}};
  if (lab.workshop().acceleration.accelerator) all.push_back({"dmo, cuda", {.backend = Backend::Cuda}});
  all.push_back({"laplace, cpu", {.method = "laplace", .backend = Backend::Cpu}});
  all.push_back({"dvr, cpu", {.method = "dvr", .backend = Backend::Cpu}});
  return all;
}

/// Million visits a second in the first two iterations, which leave out no settled vertices: the median of three.
std::optional<PlotValue> speed(Lab& lab, const std::shared_ptr<const InputMesh>& input, const Racer& racer, Figure& figure) {
  std::vector<double> speeds;
  for (int repeat = 0; repeat < 3; ++repeat) {
    const auto run = lab.run(input, racer.parameters, 2, figure);
    if (!run) return std::nullopt;
    speeds.push_back(run->row.vertices_per_second);
  }
  std::ranges::sort(speeds);
  constexpr double kMillion = 1e-6;
  return PlotValue{static_cast<double>(input->mesh.vertex_count()), kMillion * speeds[1], kMillion * speeds.front(),
                   kMillion * speeds.back()};
}

void throughput(Lab& lab, Figure& figure) {
  std::vector<std::string> sizes{"1000", "10000"};
  if (lab.extent() != Extent::Quick) sizes.emplace_back("100000");
  if (lab.extent() == Extent::Full) sizes.emplace_back("1000000");
  std::vector<Racer> all = racers(lab);
  std::string largest;
  for (const std::string& size : sizes) {
    const auto input = lab.stand_in("grid " + size);
    largest = input->mesh.name;
    std::erase_if(all, [&](Racer& racer) {
      const auto value = speed(lab, input, racer, figure);
      if (value) racer.speeds.push_back(*value);
      return !value;
    });
  }
  LinePlot plot;
  plot.title = "Smoothed vertices a second";
  plot.x_title = "vertices";
  plot.y_title = "million vertex visits per second";
  plot.note = fmt::format("the first two iterations; {} threads", lab.workshop().pool->size());
  for (std::size_t k = 0; k < all.size(); ++k) plot.series.push_back({.name = all[k].name, .colour = k, .values = all[k].speeds});
  figure.plots.emplace_back("speed", std::move(plot));
  const auto last = [&](std::string_view name) {
    const auto found = std::ranges::find(all, name, &Racer::name);
    return found == all.end() ? std::numeric_limits<double>::quiet_NaN() : 1e6 * found->speeds.back().y;
  };
  const auto tell = [&](std::string what, double ours, const char* paper) {
    if (ours == ours) figure.tell(largest, std::move(what), ours, paper, kAnotherMachine);
  };
  tell("dmo on the cpu, vertices/s", last("dmo, cpu"), "1e5");
  tell("dmo on cuda, vertices/s", last("dmo, cuda"), "2e7");
  tell("laplace, vertices/s", last("laplace, cpu"), "2e7");
  tell("dvr, vertices/s", last("dvr, cpu"), "1e5");
  tell("laplace over dmo on the cpu", last("laplace, cpu") / last("dmo, cpu"), "200");
  tell("dmo on the cpu over dvr", last("dmo, cpu") / last("dvr, cpu"), "1");
  tell("dmo on cuda over laplace", last("dmo, cuda") / last("laplace, cpu"), "1");
  if (!lab.workshop().acceleration.accelerator)
    figure.lack(largest, "dmo on cuda", Verdict::NotPossible, fmt::format("No cuda: {}.", lab.workshop().acceleration.reason));
}

double seconds_up_to(const JudgedRun& run, std::uint64_t iteration) {
  double seconds = 0.0;
  for (std::uint64_t i = 1; i <= iteration; ++i) seconds += run.records.at(i).seconds;
  return seconds;
}

/// The paper's figures of a race: DMO's and DVR's seconds on its CPU, and their ratio; and the number of iterations that DVR must need
/// here.
struct PaperRace {
  const char *free, *minimum, *iterations, *dmo_seconds, *dvr_seconds, *ratio;
  double least_iterations;
};

/// Runs DMO for four iterations, and DVR until it is as good, less `slack`.
void race_to_quality(Lab& lab, Figure& figure, const std::shared_ptr<const InputMesh>& input, std::uint64_t most, double slack,
                     const PaperRace& paper) {
  const std::string mesh = input->mesh.name;
  const auto dmo = lab.run(input, {.backend = Backend::Cpu}, 4, figure);
  const auto dvr = lab.run(input, {.method = "dvr", .backend = Backend::Cpu}, most, figure);
  if (!dmo || !dvr) return;
  figure.tell(mesh, "free vertices", static_cast<double>(dmo->free), paper.free, "");
  figure.tell(mesh, "dmo: minimum after 4 iterations", dmo->after.minimum, paper.minimum, "");
  const auto reached = first_at_least(*dvr, dmo->after.minimum - slack);
  if (!reached) {
    figure.tell(
        mesh, fmt::format("dvr: minimum after {} iterations", most), dvr->after.minimum, "",
        fmt::format("It has not reached DMO's by then, so there is no time to compare; the paper has {} iterations.", paper.iterations));
    return;
  }
  figure.check(mesh, fmt::format("dvr: iterations to the same minimum (less {:g})", slack), static_cast<double>(*reached),
               Claim::at_least(paper.iterations, paper.least_iterations));
  const double dmo_seconds = seconds_up_to(*dmo, 4), dvr_seconds = seconds_up_to(*dvr, *reached);
  figure.tell(mesh, "dmo: seconds on the cpu, 4 iterations", dmo_seconds, paper.dmo_seconds, kAnotherMachine);
  figure.tell(mesh, "dvr: seconds to the same minimum", dvr_seconds, paper.dvr_seconds, kAnotherMachine);
  figure.tell(mesh, "seconds of dvr over those of dmo on the cpu", dvr_seconds / dmo_seconds, paper.ratio, kAnotherMachine);
}

void million(Lab& lab, Figure& figure) {
  const auto input = lab.stand_in(lab.choose("grid 10000", "grid 100000", "grid 1333540"));
  figure.notes.emplace_back("The paper's mesh of 1 333 540 free vertices, minimum 0.033, is not named there; ours is a jittered lattice.");
  race_to_quality(lab, figure, input, lab.choose<std::uint64_t>(50, 100, 100), 0.0, {"1333540", "0.34", "43", "31", "435", "14", 10.0});
}

void small(Lab& lab, Figure& figure) {
  const auto input = lab.mesh("east.14", figure);
  if (!input) return;
  race_to_quality(lab, figure, input, 60, 0.001, {"8429", "0.82", "10", "0.1", "0.78", "7.8", 5.0});
}

}  // namespace

std::vector<Experiment> speed_experiments() {
  return {{"5", "Vertices a second by the mesh's size", throughput},
          {"5.2-large", "Time to a quality, a large mesh", million},
          {"5.2-east", "Time to a quality, \"east\"", small}};
}

}  // namespace dmoscope::app
