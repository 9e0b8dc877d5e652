#include "core/run/report_card.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/number_text.h"
#include "core/mesh/edges.h"
#include "core/mesh/faces.h"
#include "core/mesh/orientation.h"
#include "core/quality/metric_phrase.h"
#include "core/run/percentiles.h"
#include "core/target/boundary_layers.h"

namespace dmoscope {

namespace {

constexpr double kOfLeast = 0.01, kLeastFall = 1e-6, kOfOthers = 0.005, kOfCounts = 0.001, kOfGrowth = 1.25, kMuchGrowth = 2.0,
                 kOfWall = 1.1;
constexpr std::array kBounds{0.1, 0.2, 0.3};

Verdict compare(double before, double after, double tolerance) {
  if (after < before - tolerance) return Verdict::Worse;
  return after > before + tolerance ? Verdict::Better : Verdict::Same;
}
Verdict opposite(Verdict verdict) {
  if (verdict == Verdict::Same) return verdict;
  return verdict == Verdict::Worse ? Verdict::Better : Verdict::Worse;
}

/// Figures of all elements by one metric.
struct Qualities {
  double least = 0.0, mean = 0.0;
  Percentiles percentiles;
  std::array<double, kBounds.size()> below{};
  std::size_t count = 0;  // number of elements that the metric is defined for

  Qualities(const InputMesh& input, std::span<const Vec3> positions, Metric metric, ThreadPool* pool) {
    std::vector<double> all(input.mesh.elements.size());
    element_qualities(input.quality_context(), positions, metric, pool, all);
    std::erase_if(all, [](double q) { return std::isnan(q); });
    count = all.size();
    if (count == 0) return;
    least = std::ranges::min(all);
    mean = std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(count);
    for (std::size_t i = 0; i < kBounds.size(); ++i)
      below[i] = static_cast<double>(std::ranges::count_if(all, [&](double q) { return q < kBounds[i]; }));
    percentiles = percentiles_of(all);
  }
};

double measure(const Mesh& mesh, const Plane& plane, std::span<const Vec3> positions, Index element) {
  if (info(mesh.elements.kind(element)).dimension == 3) return std::abs(signed_volume(mesh.elements, positions, element));
  const auto corners = mesh.elements.corners(element);
  const auto from_first = [&](std::size_t i) { return plane.difference(positions[corners[i]], positions[corners[0]]); };
  Vec3 twice{};
  for (std::size_t i = 2; i < corners.size(); ++i) twice = twice + cross(from_first(i - 1), from_first(i));
  return 0.5 * length(twice);
}

std::vector<double> measures(const InputMesh& input, std::span<const Vec3> positions) {
  std::vector<double> all(input.mesh.elements.size());
  for (Index e = 0; e < all.size(); ++e) all[e] = measure(input.mesh, input.geometry.plane, positions, e);
  return all;
}

/// Calls visit(element, neighbour) once for each pair that shares an edge, in a volume a face.
template <class Visit>
void for_neighbours(const InputMesh& input, const Visit& visit) {
  if (!input.is_volume()) {
    for_each_edge(input.mesh, input.topology, [&](Edge, std::span<const EdgeSide> sides) {
      if (sides.size() == 2) visit(sides[0].element, sides[1].element);
    });
    return;
  }
  const FaceNeighbours neighbours(input.mesh);
  for (Index e = 0; e < input.mesh.elements.size(); ++e)
    for (const Index other : neighbours.of(e))
      if (other != kNoIndex && e < other) visit(e, other);
}

/// Numbers of inverted elements.
struct InvertedBeforeAndAfter {
  std::uint64_t before = 0, after = 0;
};

class Card {
 public:
  Card(const InputMesh& input, std::span<const Vec3> before, std::span<const Vec3> after, Metric raised, bool raises_mean,
       InvertedBeforeAndAfter inverted, ThreadPool* pool)
      : input_(input), before_(before), after_(after), raised_(raised), raises_mean_(raises_mean), inverted_(inverted), pool_(pool) {}

  void add_metric(Metric metric, bool tells) {
    const Qualities was(input_, before_, metric, pool_), is(input_, after_, metric, pool_);
    if (was.count == 0 || is.count == 0) return;
    const std::string of = metric_phrase(metric);
    const auto add = [&](std::string name, double from, double to, Verdict verdict, std::string_view kept_by, std::string_view helped_by) {
      card_.figures.push_back(
          {of, std::move(name), from, to, tells ? verdict : Verdict::Same, std::string(kept_by), std::string(helped_by)});
    };
    const double of_least = std::max(kLeastFall, kOfLeast * std::abs(was.least));
    const std::string guard = tells && metric != raised_ ? fmt::format("guard {}:input", info(metric).name) : std::string();
    add("least", was.least, is.least, compare(was.least, is.least, of_least), guard, "");
    const auto add_other = [&](std::string name, double from, double to, Verdict verdict) {
      add(std::move(name), from, to, verdict, "", raises_mean_ || inverted_.after > 0 ? "" : "then mean");
    };
    add_other("1 %", was.percentiles.p1, is.percentiles.p1, compare(was.percentiles.p1, is.percentiles.p1, kOfOthers));
    add_other("5 %", was.percentiles.p5, is.percentiles.p5, compare(was.percentiles.p5, is.percentiles.p5, kOfOthers));
    add_other("mean", was.mean, is.mean, compare(was.mean, is.mean, kOfOthers));
    const double few = kOfCounts * static_cast<double>(was.count);
    for (std::size_t i = 0; i < kBounds.size(); ++i)
      add_other(fmt::format("below {}", kBounds[i]), was.below[i], is.below[i], opposite(compare(was.below[i], is.below[i], few)));
  }

  void add_mesh(bool aimed) {
    add("inverted", static_cast<double>(inverted_.before), static_cast<double>(inverted_.after), 0.0, "", "");
    const std::vector<double> was = measures(input_, before_), is = measures(input_, after_);
    const auto growth = [&](const std::vector<double>& sizes) {
      double most = 1.0;
      for_neighbours(input_, [&](Index a, Index b) {
        const double ratio = std::max(sizes[a], sizes[b]) / std::min(sizes[a], sizes[b]);
        if (ratio > most && std::isfinite(ratio)) most = ratio;
      });
      return most;
    };
    const double from = growth(was), to = growth(is);
    add("growth", from, to, std::max((kOfGrowth - 1.0) * from, kMuchGrowth - from), "", aimed ? "" : "target input");
    add_walls();
  }

  ReportCard finish() {
    const auto any = [this](Verdict verdict) {
      return std::ranges::any_of(card_.figures, [verdict](const CardFigure& figure) { return figure.verdict == verdict; });
    };
    card_.verdict = any(Verdict::Worse) ? Verdict::Worse : any(Verdict::Better) ? Verdict::Better : Verdict::Same;
    return std::move(card_);
  }

 private:
  /// Adds a figure of the mesh, the less the better.
  void add(std::string name, double from, double to, double tolerance, std::string_view kept_by, std::string_view helped_by) {
    card_.figures.push_back(
        {"", std::move(name), from, to, opposite(compare(from, to, tolerance)), std::string(kept_by), std::string(helped_by)});
  }
  void add_walls() {
    const BoundaryLayers layers = find_boundary_layers(input_.mesh, input_.geometry);
    if (std::ranges::find(layers.pronounced, 1) == layers.pronounced.end()) return;
    double most = 1.0;
    for (std::size_t i = 0; i < layers.elements.size(); ++i) {
      if (layers.heights[i] != 1 || layers.pronounced[i] == 0) continue;
      const auto height = [&](std::span<const Vec3> positions) {
        return height_on(input_.mesh, input_.geometry, positions, layers.elements[i], layers.bases[i]);
      };
      const double was = height(before_), is = height(after_);
      if (was > 0.0 && is > 0.0) most = std::max({most, is / was, was / is});
    }
    add("wall cells", 1.0, most, kOfWall - 1.0, "layers keep", "");
  }

  const InputMesh& input_;
  std::span<const Vec3> before_, after_;
  Metric raised_;
  bool raises_mean_;
  InvertedBeforeAndAfter inverted_;
  ThreadPool* pool_;
  ReportCard card_;
};

}  // namespace

std::string_view name(Verdict verdict) {
  constexpr std::array<std::string_view, 3> kNames{"better", "same", "worse"};
  return kNames[static_cast<std::size_t>(verdict)];
}

std::string CardFigure::short_phrase() const {
  if (name == "wall cells") return fmt::format("wall cells up to {} times as high or as low", four_digits(after));
  const bool counts = name == "inverted" || name.starts_with("below");
  const auto text = [counts](double value) { return counts ? fmt::format("{:.0f}", value) : four_digits(value); };
  return fmt::format("{}{} {} -> {}", name, name.starts_with("below") ? ":" : "", text(before), text(after));
}

std::string CardFigure::phrase() const {
  if (of.empty()) return short_phrase();
  const std::string values = short_phrase().substr(name.size());
  if (name == "least") return fmt::format("least {}{}", of, values);
  if (name == "mean") return fmt::format("mean of {}{}", of, values);
  return name.starts_with("below") ? fmt::format("{} {}", of, short_phrase()) : fmt::format("{} at {}", of, short_phrase());
}

std::vector<const CardFigure*> ReportCard::worse() const {
  std::vector<const CardFigure*> found;
  for (const CardFigure& figure : figures)
    if (figure.verdict == Verdict::Worse) found.push_back(&figure);
  return found;
}

std::vector<std::string> ReportCard::lines() const {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < figures.size();) {
    const std::string& of = figures[i].of;
    std::vector<std::string> parts;
    for (; i < figures.size() && figures[i].of == of; ++i) parts.push_back(figures[i].short_phrase());
    lines.push_back(fmt::format("{}: {}", of.empty() ? "mesh" : of, fmt::join(parts, ", ")));
  }
  return lines;
}

std::string ReportCard::sentence(bool as_options) const {
  if (verdict == Verdict::Same) return "The same as the input, within small tolerances";
  if (verdict == Verdict::Better) return "Better than the input, and worse in nothing beyond small tolerances";
  // Groups the figures by what keeps or helps them, those that nothing does first, and names the first few of each group.
  constexpr std::size_t kNamed = 3;
  const auto remedy = [as_options](const CardFigure& figure) -> std::string {
    const bool kept = !figure.kept_by.empty();
    if (!kept && figure.helped_by.empty()) return {};
    const std::string& option = kept ? figure.kept_by : figure.helped_by;
    return fmt::format(" ({} {})", as_options ? "--" + option : fmt::format("'{}'", option), kept ? "keeps it" : "helps");
  };
  const auto all = worse();
  std::vector<std::string> remedies, parts;
  for (const CardFigure* figure : all)
    if (std::ranges::find(remedies, remedy(*figure)) == remedies.end()) remedies.push_back(remedy(*figure));
  std::ranges::stable_sort(remedies, {}, [](const std::string& each) { return !each.empty(); });
  for (const std::string& each : remedies) {
    std::vector<std::string> phrases;
    std::size_t others = 0;
    for (const CardFigure* figure : all) {
      if (remedy(*figure) != each) continue;
      if (phrases.size() < kNamed)
        phrases.push_back(figure->phrase());
      else
        ++others;
    }
    if (others > 0) phrases.push_back(fmt::format("{} more", others));
    parts.push_back(fmt::format("{}{}", fmt::join(phrases, ", "), each));
  }
  return fmt::format("Worse than the input: {}", fmt::join(parts, "; "));
}

namespace {

ReportCard make_card(const InputMesh& input, std::span<const Vec3> before, std::span<const Vec3> after, std::span<const Metric> raised,
                     bool raises_mean, InvertedBeforeAndAfter inverted, ThreadPool* pool) {
  Card card(input, before, after, raised.front(), raises_mean, inverted, pool);
  const bool aimed = std::ranges::any_of(raised, [](Metric metric) { return !target_of(metric).is_ideal(); });
  for (const Metric metric : raised) card.add_metric(metric, true);
  for (const Metric metric : {Metric::MeanRatio, Metric::ScaledJacobian})
    if (std::ranges::find(raised, metric) == raised.end()) card.add_metric(metric, !aimed);
  card.add_mesh(aimed);
  return card.finish();
}

}  // namespace

ReportCard report_card(const InputMesh& input, std::span<const Vec3> before, std::span<const Vec3> after, std::span<const Metric> raised,
                       bool raises_mean, ThreadPool* pool) {
  const auto inverted = [&](std::span<const Vec3> positions) { return count_inverted(input.quality_context(), positions).all; };
  return make_card(input, before, after, raised, raises_mean, {inverted(before), inverted(after)}, pool);
}

ReportCard report_card(const Run& run, ThreadPool* pool) {
  const RunParameters& p = run.parameters();
  std::vector<Metric> raised{p.metric};
  const auto* second = p.combination ? std::get_if<Metric>(&p.combination->second) : nullptr;
  if (second != nullptr) raised.push_back(*second);
  const InvertedBeforeAndAfter inverted{run.history().records().front().statistics.inverted, run.statistics().inverted};
  return make_card(run.input(), run.input().mesh.positions, run.positions(), raised, p.then_mean.has_value(), inverted, pool);
}

}  // namespace dmoscope
