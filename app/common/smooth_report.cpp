#include "app/common/smooth_report.h"

#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "app/common/console.h"
#include "app/common/quality_report.h"
#include "core/base/unknown_value.h"
#include "core/numeric/simd.h"
#include "core/reference/domain.h"
#include "core/run/ending.h"
#include "core/run/size_course.h"
#include "core/run/sliding.h"
#include "core/session/csv.h"
#include "core/session/json_values.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope::app {
namespace {

Json json_of(const CompositeTerms& combination, const Run& run) {
  Json object;
  object["first"] = info(run.parameters().metric).name;
  object["threshold"] = combination.threshold;
  object["second"] = combination.second_name();
  if (!run.size_field()) return object;
  object["size_function"] = combination.size_text();
  const auto [before, after] = size_course_of(run);
  object["size_correlation"] = {{"before", json_number(before.sizes)}, {"after", json_number(after.sizes)}};
  object["size_log_correlation"] = {{"before", json_number(before.logarithms)}, {"after", json_number(after.logarithms)}};
  return object;
}

std::string_view reason_name(StopReason reason) {
  constexpr std::array<std::string_view, 5> kNames{"nothing-moved", "no-rise", "certified", "no-joint-gain", "iteration-limit"};
  return kNames[static_cast<std::size_t>(reason)];  // in the order of StopReason
}

Json json_of(const Statistics& s, std::uint64_t inside_alone) {
  return {{"minimum", json_number(s.minimum)}, {"mean", json_number(s.mean)}, {"movable_minimum", json_number(s.movable_minimum)},
          {"ceiling", json_number(s.ceiling)}, {"inverted", s.inverted},      {"inverted_inside_alone", inside_alone}};
}

/// Result of joint moves, tried or in the run: the minimum, its bound, the number of holders, and the first holders with their multipliers.
Json json_of(const JointCluster& cluster) {
  constexpr std::size_t kMostNamed = 1000;
  const auto all = holders(cluster);
  Json elements = Json::array();
  for (const JointCluster::Active& one : all.first(std::min(kMostNamed, all.size())))
    elements.push_back({{"element", one.element}, {"multiplier", one.multiplier}});
  return {{"certified", cluster.certified},
          {"why_not", cluster.why_not.empty() ? Json(nullptr) : Json(cluster.why_not)},
          {"reaches", json_number(cluster.after)},
          {"bound", json_number(cluster.bound)},
          {"gap", json_number(cluster.gap)},
          {"vertices", cluster.vertices.size()},
          {"holders", all.size()},
          {"elements", std::move(elements)}};
}

Json json_of(const HeldMinimum& held) {
  Json vertices = Json::array();
  for (const HeldVertex& one : held.vertices) vertices.push_back({{"vertex", one.vertex}, {"held_by", name(one.by)}});
  Json object{{"element", held.element},
              {"quality", json_number(held.quality)},
              {"by", name(held.by)},
              {"vertices", std::move(vertices)},
              {"unchanged", json_number(held.unchanged)},
              {"switch", nullptr},
              {"gives_up", nullptr},
              {"tried", nullptr},
              {"not_looked_at", held.untried},
              {"sentence", held.sentence(true)}};
  if (held.change) {
    object["switch"] = held.options();
    if (const std::string given_up = held.gives_up(); !given_up.empty()) object["gives_up"] = given_up;
    if (const auto& trial = held.trial)
      object["tried"] = {{"from", json_number(trial->before)}, {"to", json_number(trial->after)}, {"iterations", trial->iterations}};
  }
  object["certificate"] = held.joint ? json_of(*held.joint) : Json(nullptr);
  return object;
}

/// Adds "combination": its terms, and for density how well local edge lengths follow the target sizes, before and after; and "then" and
/// "mean_since" for the second phase. Null if the run has no such aim.
void add_composite(Json& object, const Run& run) {
  const RunParameters& p = run.parameters();
  object["combination"] = p.combination ? json_of(*p.combination, run) : Json(nullptr);
  object["then"] = p.then_joint || p.then_mean ? Json(then_words(p)) : Json(nullptr);
  const RunPhases phases = run.phases();
  const auto say = [&](const char* key, const std::optional<std::uint64_t>& iteration) {
    object[key] = iteration ? Json(*iteration) : Json(nullptr);
  };
  say("joint_since", phases.joint_since);
  say("joint_from", phases.joint_from);
  say("joint_over", phases.joint_over);
  say("mean_since", phases.mean_since);
  say("mean_from", phases.mean_from);
}

/// Prints the second aim as lines of a summary.
void print_composite(const Run& run) {
  if (!run.size_field()) return;
  const auto [before, after] = size_course_of(run);
  if (std::isnan(after.sizes)) return;  // every size is the same
  print("  {:<16} {:>10} -> {}    (correlation of local edge length and target size)\n", "size", brief(before.sizes), brief(after.sizes));
  print("  {:<16} {:>10} -> {}    (the same of their logarithms)\n", "log size", brief(before.logarithms), brief(after.logarithms));
}

}  // namespace

Json card_json(const ReportCard& card) {
  Json figures = Json::array();
  for (const CardFigure& figure : card.figures)
    figures.push_back({{"of", figure.of.empty() ? Json(nullptr) : Json(figure.of)},
                       {"name", figure.name},
                       {"before", json_number(figure.before)},
                       {"after", json_number(figure.after)},
                       {"verdict", name(figure.verdict)},
                       {"kept_by", figure.kept_by.empty() ? Json(nullptr) : Json(figure.kept_by)},
                       {"helped_by", figure.helped_by.empty() ? Json(nullptr) : Json(figure.helped_by)}});
  return {{"verdict", name(card.verdict)}, {"sentence", card.sentence(true)}, {"figures", std::move(figures)}};
}

namespace {

bool on_cpu(const Run& run) { return run.backend() == Backend::Cpu; }

/// Whether packs compute: the grid search alone can use them.
bool in_packs(const RunParameters& p) { return method_info(p.method).searches_grid && p.search.precision == Precision::Float; }

/// Name of the instructions that the search used; null on a device.
Json simd_name(const Run& run) {
  const RunParameters& p = run.parameters();
  if (!on_cpu(run)) return nullptr;
  return in_packs(p) ? name(p.search.simd.value_or(best_simd_level())) : "scalar";
}

/// Units that the search ran on: "2 threads", "4 ranks of 2 threads each".
std::string where_computed(const SmoothReport& r) {
  if (!on_cpu(r.run)) return r.run.backend_reason();
  const std::string threads = counted(r.threads, "thread", "threads");
  return r.ranks > 0 ? fmt::format("{} of {}{}", counted(r.ranks, "rank", "ranks"), threads, r.ranks > 1 ? " each" : "") : threads;
}

Json json_of(const SmoothReport& r) {
  const RunParameters& p = r.run.parameters();
  Json object;
  object["input"] = r.input.string();
  object["output"] = r.output.string();
  object["vertices"] = r.vertices;
  object["elements"] = r.elements;
  object["free"] = r.free;
  object["method"] = p.method;
  object["metric"] = info(p.metric).name;
  object["backend"] = name(r.run.backend());
  object["backend_reason"] = r.run.backend_reason();
  if (r.ranks > 0) object["ranks"] = r.ranks;
  object["threads"] = r.threads;
  object["simd"] = simd_name(r.run);
  nlohmann::ordered_json parameters;
  for (const ParameterInfo& row : parameter_table())
    if (row.in_session) parameters[std::string(row.name)] = parameter_json(row, p);
  parameters["precision"] = in_packs(p) && !p.combination ? "float" : "double";  // the precision of the computation
  parameters["fixed_by_user"] = r.fixed_by_user;
  parameters["kinds_by_user"] = {{"corners", p.kinds.corners.size()},
                                 {"no_corners", p.kinds.no_corners.size()},
                                 {"features", p.kinds.features.size()},
                                 {"no_features", p.kinds.no_features.size()}};
  object["parameters"] = std::move(parameters);
  object["held_on_interfaces"] = p.interfaces == InterfaceRule::Free ? 0 : r.on_interfaces;
  if (p.interfaces == InterfaceRule::Slide) object["held_on_interfaces"] = r.on_interfaces - r.run.domain()->count_inside();
  object["sliding"] = count_sliding(r.run);
  object["geographic"] = r.run.input().mesh.degrees != nullptr;
  object["thin"] = r.run.input().mesh.thin != nullptr;
  object["iterations"] = r.outcome.iterations;
  object["stopped"] = reason_name(r.outcome.reason);
  object["last_rise"] = r.outcome.last_rise;
  object["written_iteration"] = r.after().iteration;
  object["left_inverted"] = nullptr;
  if (r.left)
    object["left_inverted"] = {{"count", r.left->all.all},
                               {"inside_alone", r.left->all.inside_alone},
                               {"element", r.left->element},
                               {"vertex", r.left->vertex},
                               {"elements", json_of_inverted(r.left->all)}};
  object["crossing_faces"] = nullptr;
  if (r.crossing) object["crossing_faces"] = {{"before", r.crossing->before}, {"after", r.crossing->after}};
  object["fit"] = nullptr;
  if (r.fit) object["fit"] = {{"before", app::json_of((*r.fit)[0])}, {"after", app::json_of((*r.fit)[1])}};
  object["report_card"] = r.card ? card_json(*r.card) : Json(nullptr);
  object["held_by"] = r.held ? json_of(*r.held) : Json(nullptr);
  std::vector<std::string> carried = r.fields.whole;
  carried.insert(carried.end(), r.fields.carried.begin(), r.fields.carried.end());
  object["fields"] = {{"placed", r.fields.placed}, {"carried", carried}, {"sentence", r.fields.sentence()}};
  object["before"] = json_of(r.before().statistics, r.inside_alone_before);
  object["after"] = json_of(r.after().statistics, r.left ? r.left->all.inside_alone : 0);
  add_composite(object, r.run);
  object["seconds"] = r.seconds;
  object["vertices_per_second"] = json_number(r.visits_per_second());
  object["warnings"] = r.warnings;
  if (r.provenance) object["provenance"] = json_of(*r.provenance);
  return object;
}

void print_summary(const SmoothReport& r) {
  const Statistics& before = r.before().statistics;
  const Statistics& after = r.after().statistics;
  print("{}: {}, {}, {} free; {}, {}\n", r.run.input().mesh.name, counted(r.vertices, "vertex", "vertices"),
        counted(r.elements, "element", "elements"), grouped(r.free), r.run.title(), name(r.run.backend()));
  if (r.card) print("  {}\n", r.card->sentence(true));
  if (r.run.input().mesh.degrees) print("  in degrees of longitude and latitude: judged on the Earth\n");
  if (const std::string text = sliding_sentence(r.run); !text.empty()) print("  {}\n", text);
  if (r.fit) print("  {}\n", fit_sentence(r.run.input(), (*r.fit)[0], (*r.fit)[1]));
  print("  {:<16} {:>10} -> {}\n", "minimum", brief(before.minimum), brief(after.minimum));
  print("  {:<16} {:>10} -> {}\n", "movable minimum", brief(before.movable_minimum), brief(after.movable_minimum));
  print("  {:<16} {:>10}    (elements whose corners are all fixed)\n", "ceiling", brief(after.ceiling));
  print("  {:<16} {:>10} -> {}\n", "mean", brief(before.mean), brief(after.mean));
  print("  {:<16} {:>10} -> {}\n", "inverted", grouped(before.inverted), grouped(after.inverted));
  print_composite(r.run);
  print("  {}\n", r.outcome.sentence());
  if (r.held) print("  {}\n", r.held->sentence(true));
  if (r.card)
    for (const std::string& line : r.card->lines()) print("  {}\n", line);
  print("  {} in {:.3f} s, {}vertices/s on {}\n", counted(r.outcome.iterations, "iteration", "iterations"), r.seconds,
        with_prefix(r.visits_per_second()), where_computed(r));
  if (const std::string fields = r.fields.sentence(); !fields.empty()) print("  fields: {}\n", fields);
  print("  wrote {}\n", r.output.string());
}

bool has_converged(const SmoothReport& r) { return !r.until_converged || r.outcome.reason != StopReason::IterationLimit; }

}  // namespace

void print_report(const SmoothReport& r, bool as_json) {
  if (as_json) {
    print_json(json_of(r));
  } else {
    print_summary(r);
  }
  if (!has_converged(r)) complain(fmt::format("not converged: {}", r.outcome.sentence()));
}

bool all_well(const SmoothReport& r, bool strict) {
  return has_converged(r) && !r.left && !(strict && r.card && r.card->verdict == Verdict::Worse);
}

void require_output_moment(const std::string& word) {
  if (word != "best" && word != "last")
    throw UsageError("--write: " + unknown_value("moment", word, std::array<std::string_view, 2>{"best", "last"}));
}

std::string seek_output_iteration(Run& run, const std::string& write, bool until_converged, Progress& progress) {
  const bool optimises = method_info(run.parameters().method).optimises;
  // A method that optimises makes nothing worse: the last of a given number of iterations is written, unless joint moves lost by it.
  const bool loses = joint_moves_lose(run.parameters(), run.history().records());
  if (write == "last" || (optimises && !until_converged && !loses)) return {};
  const std::uint64_t ended = run.moment().iteration;
  run.end_at_best(progress);
  run.sync_to_host();
  const std::uint64_t best = run.moment().iteration;
  if ((optimises && until_converged) || best == ended) return {};
  return fmt::format("{}. Wrote {}, the best one, instead of iteration {} (--write last writes the last)",
                     optimises ? "the minimum did not rise by joint moves, and the mean fell"
                               : fmt::format("{} {}", run.parameters().method, kMayMakeWorse),
                     iteration_name(best), ended);
}

std::string stats_of(const Run& run) {
  const std::vector<std::string> titles{stats_label(run.parameters())};
  const std::vector<const std::vector<IterationRecord>*> records{&run.history().records()};
  return stats_csv(titles, records);
}

double smoothing_seconds(const Run& run) {
  double seconds = 0.0;
  for (const IterationRecord& record : run.history().records()) seconds += record.seconds;
  return seconds;
}

}  // namespace dmoscope::app
