#pragma once
// Report card: what a run made of a mesh as a whole, against its input, besides the minimum of its metric.

#include <span>
#include <string>
#include <vector>

#include "core/run/run.h"

namespace dmoscope {

enum class Verdict { Better, Same, Worse };
/// Name of a verdict: "better", "same" or "worse".
[[nodiscard]] std::string_view name(Verdict verdict);

/// One figure of a mesh, before and after.
struct CardFigure {
  std::string of;    // metric, "mean ratio"; empty for the mesh itself
  std::string name;  // "least", "1 %", "5 %", "mean", "below 0.1"; "inverted", "growth", "wall cells"
  double before = 0.0, after = 0.0;
  Verdict verdict = Verdict::Same;
  std::string kept_by{};    // the option that keeps it in any case; empty: none does
  std::string helped_by{};  // else an option with which it is usually better, though not always as good as before; empty: none
  /// Phrase for a person: "mean of mean ratio 0.957 -> 0.844".
  [[nodiscard]] std::string phrase() const;
  /// Phrase without the metric.
  [[nodiscard]] std::string short_phrase() const;
};

/// - By the metric that is raised, a combination's second one, mean ratio and scaled Jacobian: the least, the quality that a hundredth and
/// a
///   twentieth of the elements are not better than, the mean, and how many elements are below 0.1, 0.2 and 0.3.
/// - Inverted elements, proved. The growth: how many times as large as a neighbour across an edge (in a volume: a face) an element is, at
///   most. Wall cells, where the input has pronounced boundary layers: how many times as high the first one of a stack has become at most,
///   or as low.
/// Worse is: the least lower by more than a hundredth, another quality by more than 0.005, more elements inverted or below a bound (by more
/// than a thousandth of all), the growth more than a quarter greater and above 2, wall cells by more than a tenth. Against targets other
/// than ideal elements the metric that is raised alone tells.
struct ReportCard {
  std::vector<CardFigure> figures;
  Verdict verdict = Verdict::Same;  // Worse where any figure is; else Better where any is

  [[nodiscard]] std::vector<const CardFigure*> worse() const;
  /// Lines, one for each metric and one for the mesh: "mean ratio: least 0.301 -> 0.428, 1 % 0.402 -> 0.520, ...".
  [[nodiscard]] std::vector<std::string> lines() const;
  /// Verdict in words: "Better than the input, and worse in nothing beyond small tolerances", "Worse than the input: mean of mean ratio
  /// 0.957 -> 0.844 (--then mean helps)". `as_options`: name options of the command line, else commands.
  [[nodiscard]] std::string sentence(bool as_options) const;
};

/// Report card of the run's present state against its input. Brings the positions to the host; costs a few looks at each element.
[[nodiscard]] ReportCard report_card(const Run& run, ThreadPool* pool);

/// Report card of any two states of a mesh. `raised`: the metrics that were raised, at least one, the first aim first; `raises_mean`:
/// whether a phase raised a mean.
[[nodiscard]] ReportCard report_card(const InputMesh& input, std::span<const Vec3> before, std::span<const Vec3> after,
                                     std::span<const Metric> raised, bool raises_mean, ThreadPool* pool);

}  // namespace dmoscope
