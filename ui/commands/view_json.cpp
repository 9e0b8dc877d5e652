#include "ui/commands/view_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/commands/commands.h"
#include "core/view/run_table.h"
#include "ui/commands/clipping_commands.h"
#include "ui/state/view_options.h"

namespace dmoscope::ui {
namespace {

using nlohmann::json;

/// Writes members. It has the same functions as Reader, so that one description of the view serves both.
class Writer {
 public:
  [[nodiscard]] const json& result() const noexcept { return json_; }
  void flag(const char* name, bool value) { json_[name] = value; }
  void number(const char* name, double value, double /*least*/, double /*most*/) { json_[name] = value; }
  template <class Count>
  void count(const char* name, Count value, std::uint64_t /*most*/) {
    json_[name] = static_cast<std::uint64_t>(value);
  }
  template <class Value, class Choices>
  void choice(const char* name, Value value, const Choices& choices) {
    for (const auto& [word, one] : choices) {
      if (one == value) json_[name] = word;
    }
  }
  void range(const char* name, const std::optional<std::pair<double, double>>& value) {
    json_[name] = value ? json{value->first, value->second} : json();
  }
  void vector(const char* name, const Vec3& value) { json_[name] = {value.x, value.y, value.z}; }
  void words(const char* name, const std::set<std::string>& value) { json_[name] = value; }
  void ids(const char* name, const Selection& value) { json_[name] = id_ranges(value.vertices()); }
  void content(const char* name, const PaneContent& value, const Panes& panes) { json_[name] = panes.words(value); }
  void runs(const char* name, const std::set<std::uint64_t>& ids, const Panes& panes) {
    json numbers = json::array();
    for (std::size_t k = 0; k < panes.run_ids.size(); ++k)
      if (ids.contains(panes.run_ids[k])) numbers.push_back(k + 1);
    json_[name] = std::move(numbers);
  }
  void options(const ViewState& state) {
    for (const ViewOption& option : view_options())
      if (!option.kept.member.empty() && option.is_saved(state))
        json_[json::json_pointer(std::string(option.kept.member))] = option.saved(state);
  }
  template <class Body>
  void object(const char* name, Body body) {
    Writer inner;
    body(inner);
    json_[name] = inner.json_;
  }

 private:
  json json_ = json::object();
};

/// Reads members; throws UsageError with the whole name of one that is wrong. `vertices`: number of the mesh's vertices.
class Reader {
 public:
  Reader(const json& from, std::string path, Index vertices) : json_(from), path_(std::move(path)), vertices_(vertices) {
    if (!json_.is_object()) throw UsageError(path_ + ": expected an object");
  }
  void flag(const char* name, bool& value) {
    if (const json* at = find(name)) value = at->is_boolean() ? at->get<bool>() : (wrong(name, "true or false"), false);
  }
  void number(const char* name, double& value, double least, double most) {
    const json* at = find(name);
    if (at == nullptr) return;
    const double read = at->is_number() ? at->get<double>() : NAN;
    if (!(read >= least && read <= most)) wrong(name, fmt::format("a number from {} to {}", least, most));
    value = read;
  }
  template <class Count>
  void count(const char* name, Count& value, std::uint64_t most) {
    const json* at = find(name);
    if (at == nullptr) return;
    if (!at->is_number_unsigned() || at->get<std::uint64_t>() > most) wrong(name, fmt::format("a whole number from 0 to {}", most));
    value = static_cast<Count>(at->get<std::uint64_t>());
  }
  template <class Value, class Choices>
  void choice(const char* name, Value& value, const Choices& choices) {
    const json* at = find(name);
    if (at == nullptr) return;
    std::string names;
    for (const auto& [word, one] : choices) {
      names += (names.empty() ? "" : ", ") + std::string(word);
      if (!at->is_string() || at->get<std::string>() != word) continue;
      value = one;
      return;
    }
    wrong(name, "one of " + names);
  }
  void range(const char* name, std::optional<std::pair<double, double>>& value) {
    const json* at = find(name);
    if (at == nullptr) return;
    if (at->is_null()) {
      value.reset();
      return;
    }
    const bool pair = at->is_array() && at->size() == 2 && (*at)[0].is_number() && (*at)[1].is_number();
    const double low = pair ? (*at)[0].get<double>() : NAN, high = pair ? (*at)[1].get<double>() : NAN;
    if (!(low < high)) wrong(name, "null, or two numbers of which the second is greater");
    value = {low, high};
  }
  void vector(const char* name, Vec3& value) {
    const json* at = find(name);
    if (at == nullptr) return;
    const bool three = at->is_array() && at->size() == 3 && std::ranges::all_of(*at, [](const json& one) { return one.is_number(); });
    if (!three) wrong(name, "three numbers");
    value = {(*at)[0].get<double>(), (*at)[1].get<double>(), (*at)[2].get<double>()};
  }
  void words(const char* name, std::set<std::string>& value) {
    const json* at = find(name);
    if (at == nullptr) return;
    std::set<std::string> read;
    for (const json& word : at->is_array() ? *at : json{1}) {
      if (!word.is_string()) wrong(name, "an array of words");
      read.insert(word.get<std::string>());
    }
    value = std::move(read);
  }
  /// Writes or reads ids as "3-7 9".
  void ids(const char* name, Selection& value) {
    const json* at = find(name);
    if (at == nullptr) return;
    if (!at->is_string()) wrong(name, "numbers and ranges, such as \"3-7 9\"");
    try {
      value.assign(parse_id_ranges(split_words(at->get<std::string>()), vertices_));
    } catch (const UsageError& error) {
      wrong(name, error.what());
    }
  }
  /// Runs are given by their numbers.
  void content(const char* name, PaneContent& value, const Panes& panes) {
    const json* at = find(name);
    if (at == nullptr) return;
    if (!at->is_string()) wrong(name, "what is shown, such as \"run 2\"");
    try {
      value = panes.parse(split_words(at->get<std::string>()));
    } catch (const UsageError& error) {
      wrong(name, error.what());
    }
  }
  void runs(const char* name, std::set<std::uint64_t>& ids, const Panes& panes) {
    ids.clear();  // ids of the present runs; a view from before there were hidden ones hides none
    const json* at = find(name);
    if (at == nullptr) return;
    for (const json& number : at->is_array() ? *at : json{0}) {
      const std::uint64_t k = number.is_number_unsigned() ? number.get<std::uint64_t>() : 0;
      if (k == 0 || k > panes.run_ids.size()) wrong(name, "an array of runs' numbers");
      ids.insert(panes.run_ids[k - 1]);
    }
  }
  /// Options come after the objects that they are in.
  void options(ViewState& state) {
    for (const ViewOption& option : view_options()) {
      const json::json_pointer member{std::string(option.kept.member)};
      require_object(member.parent_pointer());
      if (option.kept.member.empty() || !json_.contains(member) || option.take(json_[member], state)) continue;
      std::string name(option.kept.member.substr(1));
      std::ranges::replace(name, '/', '.');
      wrong(name.c_str(), option.expected(true));
    }
  }
  template <class Body>
  void object(const char* name, Body body) {
    const json* at = find(name);
    if (at == nullptr) return;
    Reader inner(*at, path_ + "." + name, vertices_);
    body(inner);
  }

 private:
  /// Throws UsageError if there is something at this place that has no members.
  void require_object(const json::json_pointer& at) const {
    if (!at.empty()) require_object(at.parent_pointer());
    if (!json_.contains(at) || json_[at].is_object()) return;
    std::string name = path_ + at.to_string();
    std::ranges::replace(name, '/', '.');
    throw UsageError(name + ": expected an object");
  }
  [[nodiscard]] const json* find(const char* name) const {
    const auto at = json_.find(name);
    return at == json_.end() ? nullptr : &*at;
  }
  [[noreturn]] void wrong(const char* name, const std::string& expected) const {
    throw UsageError(fmt::format("{}.{}: expected {}", path_, name, expected));
  }

  const json& json_;
  std::string path_;
  Index vertices_;
};

constexpr double kFar = 1e300;

std::vector<std::pair<std::string_view, std::string>> sortable_columns() {
  std::vector<std::pair<std::string_view, std::string>> choices{{"off", ""}};
  for (const RunColumn& column : run_columns()) choices.emplace_back(column.name, column.name);
  return choices;
}

constexpr std::array<std::pair<std::string_view, Picked::Kind>, 3> kPicks{
    {{"none", Picked::Kind::None}, {"vertex", Picked::Kind::Vertex}, {"element", Picked::Kind::Element}}};

// State is const when it is written.

template <class Archive, class State>
void describe_plots(Archive& archive, State& state) {
  archive.choice("runs_sorted_by", state.plot_options.sorted_by, sortable_columns());
  for (const auto& [name, tab] : kPlotTabs) {
    auto& view = state.plots[static_cast<std::size_t>(tab)];
    archive.object(std::string(name).c_str(), [&view](auto& plot) {
      plot.choice("axis", view.axis, kValueAxes);
      plot.range("x_range", view.x_range);
      plot.range("y_range", view.y_range);
      plot.words("hidden", view.hidden);
    });
  }
}

template <class Archive, class Camera>
void describe_camera(Archive& archive, Camera& camera) {
  archive.number("x", camera.centre.x, -kFar, kFar);
  archive.number("y", camera.centre.y, -kFar, kFar);
  archive.number("units_per_pixel", camera.units_per_pixel, 1e-300, kFar);
}

/// The visible part of a volume mesh. Qualities are double, as the numbers of JSON are.
template <class Archive, class View>
void describe_inside(Archive& archive, View& view) {
  archive.object("clip", [&view](auto& clip) {
    clip.vector("normal", view.clip.normal);
    clip.number("offset", view.clip.offset, -kFar, kFar);
  });
  std::optional<std::pair<double, double>> keep;
  if (view.isolate) keep = *view.isolate;
  bool by_quality = view.peel_quality.has_value();
  double quality = by_quality ? static_cast<double>(*view.peel_quality) : 1.0;
  archive.flag("peel_by_quality", by_quality);
  archive.number("peel_quality", quality, -kFar, kFar);
  archive.range("keep_quality", keep);
  if constexpr (!std::is_const_v<View>) {
    view.peel_quality = by_quality ? std::optional(static_cast<float>(quality)) : std::nullopt;
    view.isolate.reset();
    if (keep) view.isolate = std::pair{static_cast<float>(keep->first), static_cast<float>(keep->second)};
  }
}

template <class Archive, class State>
void describe_volume(Archive& archive, State& state) {
  archive.vector("centre", state.orbit.centre);
  archive.number("height", state.orbit.height, 1e-150, 1e150);
  archive.vector("right", state.orbit.right);
  archive.vector("up", state.orbit.up);
  archive.object("inside", [&state](auto& inside) { describe_inside(inside, state.inside); });
}

template <class Archive, class Panes>
void describe_panes(Archive& archive, Panes& panes) {
  archive.count("active", panes.focus, Panes::kMost - 1);
  archive.runs("hidden", panes.hidden_runs, panes);
  for (std::size_t k = 0; k < Panes::kMost; ++k) {
    auto& pane = panes.panes[k];
    archive.object(fmt::format("pane{}", k + 1).c_str(), [&pane, &panes](auto& one) {
      one.content("shows", pane.content, panes);
      one.flag("chosen", pane.chosen);
      one.object("camera", [&pane](auto& camera) { describe_camera(camera, pane.camera); });
    });
  }
}

template <class Archive, class State>
void describe_colouring(Archive& archive, State& state) {
  archive.content("reference", state.colouring.reference, state.panes);
  archive.range("filter", state.colouring.filter);
}

/// The only description of those parts of the view that are no options.
template <class Archive, class State>
void describe(Archive& archive, State& state) {
  archive.object("camera", [&state](auto& camera) { describe_camera(camera, state.camera); });
  archive.object("volume", [&state](auto& volume) { describe_volume(volume, state); });
  archive.object("viewports", [&state](auto& viewports) { describe_panes(viewports, state.panes); });
  archive.object("colours", [&state](auto& colours) { describe_colouring(colours, state); });
  archive.ids("selection", state.selection);
  archive.object("plots", [&state](auto& plots) { describe_plots(plots, state); });
  archive.options(state);
  archive.object("picked", [&state](auto& picked) {
    picked.choice("kind", state.picked.kind, kPicks);
    picked.count("id", state.picked.id, kNoIndex);
  });
}

void check(const ViewState& state, const Mesh* mesh) {
  if (!(state.range_low < state.range_high)) throw UsageError("view.colours.range_high: it must be greater than range_low");
  if (!(state.range_low_percent < state.range_high_percent))
    throw UsageError("view.colours.range_high_percent: it must be greater than range_low_percent");
  if (!state.orbit.is_valid()) throw UsageError("view.volume.right, up: expected directions of length 1 and at right angles");
  const double normal = length(state.inside.clip.normal);
  if (!(normal > 0.0) || !std::isfinite(normal)) throw UsageError("view.volume.inside.clip.normal: expected a direction");
  const auto [kind, id] = state.picked;
  if (kind == Picked::Kind::None) return;
  const std::uint64_t size = mesh == nullptr ? 0 : kind == Picked::Kind::Vertex ? mesh->vertex_count() : mesh->elements.size();
  if (id >= size) throw UsageError(fmt::format("view.picked.id: there is no {}, the mesh has {}", id, size));
}

std::string range_line(const ViewState& state) {
  if (state.range_mode == RangeMode::Given) return fmt::format("range {} {}", state.range_low, state.range_high);
  const std::string_view name = info(state.range_mode).name;
  if (state.range_mode != RangeMode::Percentile) return fmt::format("range {}", name);
  return fmt::format("range {} {} {}", name, state.range_low_percent, state.range_high_percent);
}

}  // namespace

std::string view_json(const ViewState& state) {
  Writer writer;
  describe(writer, state);
  return writer.result().dump(-1, ' ', false, json::error_handler_t::replace);
}

void apply_view_json(std::string_view text, ViewState& state, const Mesh* mesh) {
  const json in = json::parse(text, nullptr, false);
  if (in.is_discarded()) throw UsageError("view: this is not JSON");
  ViewState next = state;
  Reader reader(in, "view", mesh == nullptr ? 0 : mesh->vertex_count());
  describe(reader, next);
  check(next, mesh);
  next.panes.focus = std::min(next.panes.focus, next.panes.count() - 1);
  state = std::move(next);
  state.requests.fit = false;
}

std::vector<std::string> view_lines(const ViewState& state, bool with_camera) {
  std::vector<std::string> lines;
  if (state.window_size.first > 0) lines.push_back(fmt::format("size {} {}", state.window_size.first, state.window_size.second));
  lines.push_back(fmt::format("scale {}", state.scale));
  // Default values are written, too: the settings of the person who runs the script may differ.
  for (const ViewOption& option : view_options())
    if (option.kept.in_scripts && (option.entry.needs != Needs::Volume || state.in_space))
      lines.push_back(option_line(state, option.command));
  if (!state.panels.plots_wait) lines.push_back(option_line(state, "panel bottom"));
  lines.push_back(range_line(state));
  const PlotView& plot = state.plots[static_cast<std::size_t>(state.plot)];
  for (const auto& [axis, range] : {std::pair{"x", plot.x_range}, {"y", plot.y_range}})
    lines.push_back(range ? fmt::format("plot-zoom {} {} {}", axis, range->first, range->second) : fmt::format("plot-zoom {} all", axis));
  const Panes& panes = state.panes;
  for (std::size_t k = 0; k < panes.count() && !panes.one(); ++k) {
    const Pane& pane = panes.panes[k];
    lines.push_back(fmt::format("pane {} {}", k + 1, pane.chosen ? panes.words(pane.content) : "auto"));
    if (panes.linked || k == panes.focus || !with_camera) continue;
    lines.push_back(fmt::format("pane-camera {} {} {} {}", k + 1, pane.camera.centre.x, pane.camera.centre.y, pane.camera.units_per_pixel));
  }
  if (!panes.one()) lines.push_back(fmt::format("focus-pane {}", panes.focus + 1));
  if (state.in_space) {
    for (std::string& line : inside_lines(state, with_camera)) lines.push_back(std::move(line));
    return lines;
  }
  const render::Camera2D& camera = state.camera;
  if (with_camera) lines.push_back(fmt::format("camera {} {} {}", camera.centre.x, camera.centre.y, camera.units_per_pixel));
  return lines;
}

}  // namespace dmoscope::ui
