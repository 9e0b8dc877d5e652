// Left, below the parameters: the active run's aims besides the minimum of its metric.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/mesh/geographic.h"
#include "core/smooth/execution/method_table.h"
#include "core/smooth/size_field.h"
#include "ui/commands/size_point.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

using SizeKind = SizeFunction::Kind;

void say(PanelContext& context, Metric first, const CompositeTerms& combination) {
  const SizeFunction* size = combination.size();
  const std::string text = to_text(first, combination);
  context.send(size == nullptr ? fmt::format("combine {}", text) : fmt::format("combine {} {}", text, quote_word(to_text(*size))));
}

CompositeTerms with(const CompositeTerms& combination, const SizeFunction& size) { return {combination.threshold, size}; }

/// Middle of the mesh: the point of a size function until one is chosen.
Vec3 middle(const InputMesh& input) {
  Vec3 sum{};
  const Plane& plane = input.geometry.plane;
  for (const Vec3& p : input.mesh.positions) sum = sum + (plane.period > 0.0 ? plane.lift(plane.place(p)) : p);
  return in_file(input.mesh, (1.0 / std::max<double>(1.0, static_cast<double>(input.mesh.positions.size()))) * sum);
}

bool moves_jointly(const RunParameters& p) { return p.then_joint || method_info(p.method).joint; }

/// Combination to begin with: joint moves know metrics alone.
CompositeTerms usual(const PanelContext& context, const RunParameters& p) {
  CompositeTerms combination;
  const auto other = std::ranges::find_if(context.derived.metrics, [&p](Metric one) { return one != p.metric; });
  if (moves_jointly(p) && other != context.derived.metrics.end()) combination.second = *other;
  return combination;
}

void draw_second(PanelContext& context, const RunParameters& p) {
  labelled(context, "second aim", "the aim once the first metric is above its threshold", metric_combo_width(context));
  const auto* metric = std::get_if<Metric>(&p.combination->second);
  Combo combo(context, "second-aim", metric != nullptr ? metric_title(*metric) : "Density");
  if (!combo.open()) return;
  if (!moves_jointly(p) &&
      combo.entry("density", "Density", metric == nullptr,
                  "element sizes by a size function: each vertex moves towards the mean of its neighbours, weighted by 1 / size"))
    say(context, p.metric, with(*p.combination, {}));
  for (const Metric one : context.derived.metrics)
    if (one != p.metric && combo.entry(info(one).name, metric_title(one), metric != nullptr && *metric == one))
      say(context, p.metric, {p.combination->threshold, one});
}

void draw_point(PanelContext& context, const SizeFunction& size) {
  labelled(context, "point", "the point of the size function, in the mesh's coordinates; Place puts it where you click next");
  const bool placing = context.state.placing_size_point;
  if (lit_button(context, "place-size-point", "Place", placing, "the next click in the mesh places it", true))
    context.send("place-size-point");
  if (placing) {
    dim_text(context, "click to place it");
  } else {
    // Coordinates have a line of their own: they are long, and half of one says nothing.
    ImGui::TextUnformatted(fit_text(fmt::format("{:.7g}, {:.7g}", size.point.x, size.point.y), ImGui::GetContentRegionAvail().x).c_str());
    next_item_tooltip(fmt::format("{}, {}", full_number(size.point.x), full_number(size.point.y)));
  }
}

/// Draws how well the sizes are met.
void draw_size_course(PanelContext& context, const RunView& run) {
  const char* tip =
      "correlation of the local mean edge length with the target size over the free vertices, at the input → now: 1 when they go together";
  labelled(context, "size corr.", tip);
  ImGui::TextUnformatted(run.summary ? size_course_text(run.summary->sizes.before.sizes, run.summary->sizes.after.sizes).c_str() : "…");
  context.items.record_last("size-course");
  next_item_tooltip(run.summary ? fmt::format("{}\n{}", tip, size_course_details(run.summary->sizes))
                                : "computed while no run is going on");
}

void draw_size(PanelContext& context, const RunView& run, const SizeFunction& size) {
  const RunParameters& p = run.parameters;
  labelled(context, "size", "the wanted element size, up to a common factor");
  const bool open = ImGui::BeginCombo(
      "##size", size.kind == SizeKind::Field ? size.field.c_str() : to_text(size).substr(0, to_text(size).find(':')).c_str());
  context.items.record_last("size-function");
  if (open) {
    const auto choice = [&](const char* name, const SizeFunction& wanted, const char* tip) {
      if (ImGui::Selectable(name, size.kind == wanted.kind && size.field == wanted.field))
        say(context, p.metric, with(*p.combination, wanted));
      note_item(context, fmt::format("size-function:{}", name), tip);
    };
    const InputMesh& input = *context.session.input;
    const Vec3 point = size.has_point() ? size.point : middle(input);
    choice("constant", {}, "the same everywhere");
    choice("h1", {SizeKind::Distance, point, {}}, "grows with the distance to a point (paper, eq. 12)");
    choice("h2", {SizeKind::InverseDistance, point, {}}, "falls with the distance to a point (paper, eq. 13)");
    for (const std::string& field : scalar_fields(input.mesh))
      choice(field.c_str(), {SizeKind::Field, {}, field}, "a nodal field of the file, at the vertex");
    ImGui::EndCombo();
  }
  if (size.has_point()) draw_point(context, size);
  if (size.kind != SizeKind::Constant) draw_size_course(context, run);
}

}  // namespace

namespace {

bool joint_possible(const RunView& run) {
  const RunParameters& p = run.parameters;
  return run.input && !method_info(p.method).joint && why_not_joint(*run.input, {p.metric, p.combination}).empty();
}

void draw_phases(PanelContext& context, const RunView& run) {
  const RunParameters& p = run.parameters;
  bool then_joint = p.then_joint.has_value(), then_mean = p.then_mean.has_value();
  const auto say_then = [&] {
    RunParameters wanted;
    wanted.mean = p.mean;
    if (then_joint) wanted.then_joint.emplace();
    if (then_mean) wanted.then_mean.emplace();
    context.send("then " + then_words(wanted));
  };
  if (joint_possible(run)) {
    if (ImGui::Checkbox("then joint", &then_joint)) say_then();
    note_item(context, "then-joint",
              "once the minimum has converged, moves vertices together where single ones gain nothing, until nothing does");
  }
  if (p.combination && p.combination->size() != nullptr) return;  // the mean phase would undo the sizes
  if (ImGui::Checkbox("then mean", &then_mean)) say_then();
  note_item(context, "then-mean", "once the minimum has converged, raises the mean quality, with the minimum as floor");
}

}  // namespace

void draw_composite(PanelContext& context, const RunView& run) {
  const RunParameters& p = run.parameters;
  draw_phases(context, run);
  if (!method_info(p.method).optimises) return;
  bool combined = p.combination.has_value();
  if (ImGui::Checkbox("combine", &combined)) {
    if (combined)
      say(context, p.metric, usual(context, p));
    else
      context.send("combine off");
  }
  note_item(context, "combine",
            "two aims: the metric up to a threshold, and beyond it a second one, such as sizes of elements (paper, Section 4.2)");
  if (!p.combination) return;
  labelled(context, "threshold", "quality above 0 and below 1 from which on the second aim counts");
  double threshold = p.combination->threshold;
  ImGui::InputDouble("##threshold", &threshold, 0, 0, "%.4g");
  context.items.record_last("threshold");
  if (ImGui::IsItemDeactivatedAfterEdit() && threshold != p.combination->threshold)
    say(context, p.metric, {threshold, p.combination->second});
  draw_second(context, p);
  if (const SizeFunction* size = p.combination->size()) draw_size(context, run, *size);
}

}  // namespace dmoscope::ui
