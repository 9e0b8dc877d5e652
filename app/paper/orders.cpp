// Figures 10 to 12: influence of the vertices' order on the result.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/comparison/results.h"
#include "app/paper/lab.h"
#include "core/view/summaries.h"

namespace dmoscope::app {

namespace {

/// Runs of DMO in the natural order and in shuffled ones.
struct Orders {
  OrderSpread spread;
  std::vector<JudgedRun> runs{};
};

Orders shuffle(Lab& lab, Figure& figure, const std::shared_ptr<const InputMesh>& input, const std::string& plot_name) {
  constexpr std::size_t kCurvePoints = 1000;
  const auto count = lab.choose<std::uint64_t>(6, 50, 50);
  Orders all;
  OrderCurves curves;
  LinePlot plot;
  plot.title = fmt::format("{}: all elements, worst first, {} orders", input->mesh.name, count);
  plot.x_title = "share of the elements, %";
  plot.y_title = quality_title(Metric::MeanRatio);
  plot.x_axis = plot.y_axis = AxisKind::Linear;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    RunParameters parameters;
    if (seed > 0) parameters.order.seed = seed;
    auto run = lab.run(input, parameters, lab.choose<std::uint64_t>(20, 50, 50), figure);
    if (!run) break;
    curves.add(run->qualities);
    const auto few = sorted_choice(std::vector<float>(run->qualities.begin(), run->qualities.end()), kCurvePoints);
    PlotSeries series = curve_series(seed == 0 ? "one line an order" : std::string(), few);
    series.width = 0.8;
    plot.series.push_back(std::move(series));
    all.runs.push_back(std::move(*run));
  }
  all.spread = curves.spread("dmo");
  figure.plots.emplace_back(plot_name, std::move(plot));
  return all;
}

void tell_spread(Figure& figure, const std::string& mesh, const OrderSpread& s) {
  figure.tell(mesh, fmt::format("lowest minimum of {} orders", s.orders), s.lowest_minimum, "", "");
  figure.tell(mesh, fmt::format("highest minimum of {} orders", s.orders), s.highest_minimum, "", "");
}

void good_meshes(Lab& lab, Figure& figure) {
  const char* why = "The paper shows plots alone, of meshes that it does not name.";
  const auto conduct = [&](const std::shared_ptr<const InputMesh>& input, const std::string& plot_name) {
    const Orders orders = shuffle(lab, figure, input, plot_name);
    tell_spread(figure, input->mesh.name, orders.spread);
    figure.check(input->mesh.name, "largest difference of the sorted qualities", orders.spread.largest_difference,
                 Claim::at_most("lines mostly overlap", 0.05, why));
    figure.check(input->mesh.name, "mean difference of the sorted qualities", orders.spread.mean_difference,
                 Claim::at_most("lines mostly overlap", 0.01, why));
  };
  if (const auto input = lab.mesh("east.14", figure)) conduct(input, "east");
  conduct(lab.stand_in("coast 4000 1"), "coast");
}

void random_mesh(Lab& lab, Figure& figure) {
  const auto input = lab.stand_in("random 100 1");
  const Orders orders = shuffle(lab, figure, input, "random");
  const char* why = "The paper's points are not known; ours are drawn by this program.";
  tell_spread(figure, input->mesh.name, orders.spread);
  figure.check(input->mesh.name, "largest difference of the sorted qualities", orders.spread.largest_difference,
               Claim::at_least("larger deviation", 0.05, why));
  lab.picture(figure, *input, input->mesh.positions, Metric::MeanRatio, "11, left: the triangulation");
}

/// The mean distance of the free vertices of two results, over the mesh's extent.
double distance_of(const InputMesh& input, const JudgedRun& a, const JudgedRun& b) {
  double sum = 0.0, reach = 0.0;
  std::size_t free = 0;
  for (Index v = 0; v < a.positions.size(); ++v) {
    const Vec3 d = a.positions[v] - b.positions[v], out = input.mesh.positions[v] - input.mesh.positions[0];
    reach = std::max(reach, std::sqrt(dot(out, out)));
    if (input.topology.boundary()[v] != 0) continue;
    sum += std::sqrt(dot(d, d));
    ++free;
  }
  return sum / (static_cast<double>(std::max<std::size_t>(1, free)) * reach);
}

void two_orders(Lab& lab, Figure& figure) {
  constexpr double kAlike = 0.02;  // greatest difference of minima
  const auto input = lab.stand_in("random 100 1");
  Figure unseen{figure.id, {}};  // the plot is that of Figure 11
  const Orders orders = shuffle(lab, unseen, input, "random");
  const JudgedRun *first = nullptr, *second = nullptr;
  double widest = -1.0;
  for (std::size_t i = 0; i < orders.runs.size(); ++i) {
    for (std::size_t k = i + 1; k < orders.runs.size(); ++k) {
      const JudgedRun &a = orders.runs[i], &b = orders.runs[k];
      const double apart = distance_of(*input, a, b);
      if (std::abs(a.after.minimum - b.after.minimum) > kAlike || apart <= widest) continue;
      first = &a, second = &b, widest = apart;
    }
  }
  figure.findings = std::move(unseen.findings);  // keeps the rows about impossible runs
  if (first == nullptr) {
    figure.lack(input->mesh.name, "two orders with approximately the same minimum", Verdict::NotPossible,
                fmt::format("No two of {} orders have minima within {} of each other.", orders.runs.size(), kAlike));
    return;
  }
  const auto caption = [](const JudgedRun& run) {
    return fmt::format("12: order {}, minimum {:.4f}", to_text(run.parameters.order), run.after.minimum);
  };
  figure.check(input->mesh.name, "difference of their minima", std::abs(first->after.minimum - second->after.minimum),
               Claim::at_most("approximately the same", kAlike));
  figure.check(input->mesh.name, "mean distance of their vertices, over the mesh's extent", widest,
               Claim::at_least("completely different", 0.01, "The paper shows two pictures; ours are below."));
  lab.picture(figure, *input, first->positions, Metric::MeanRatio, caption(*first));
  lab.picture(figure, *input, second->positions, Metric::MeanRatio, caption(*second));
}

}  // namespace

std::vector<Experiment> order_experiments() {
  return {{"10", "Orders on good meshes", good_meshes},
          {"11", "Orders on a triangulation of random points", random_mesh},
          {"12", "Two orders, two meshes", two_orders}};
}

}  // namespace dmoscope::app
