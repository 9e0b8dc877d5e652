#include "ui/state/panes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/commands/commands.h"

namespace dmoscope::ui {

namespace {

using ContentKind = PaneContent::Kind;

}  // namespace

std::size_t pane_count(PaneLayout layout) { return layout == PaneLayout::One ? 1 : layout == PaneLayout::Four ? 4 : 2; }

void Panes::set_layout(PaneLayout wanted) {
  layout = wanted;
  for (Pane& pane : panes)
    if (!pane.chosen) pane.content = {};
  if (one()) {  // always leaves a way back to the run that commands are about
    panes[0].content = {};
    panes[0].chosen = false;
  }
}

bool Panes::shows(std::size_t pane, std::uint64_t id) const {
  const PaneContent& content = panes[pane].content;
  return (content.kind == ContentKind::Active && id == active_id) || content == PaneContent{ContentKind::Run, id, std::nullopt};
}

void Panes::hide_run(std::uint64_t id, bool hidden) {
  if (!hidden) {
    hidden_runs.erase(id);
    return;
  }
  hidden_runs.insert(id);
  for (Pane& pane : panes) {
    if (pane.content.kind != ContentKind::Run || pane.content.run != id) continue;
    pane.content = {};
    pane.chosen = false;
  }
}

std::size_t Panes::follow(const SessionView& session) {
  run_ids.clear();
  reached.clear();
  for (const RunView& run : session.runs) {
    run_ids.push_back(run.id);
    reached.push_back(run.records.empty() ? 0 : run.records.back().iteration);
  }
  const std::uint64_t active = session.active < session.runs.size() ? session.runs[session.active].id : 0;
  std::erase_if(hidden_runs, [&](std::uint64_t id) { return std::ranges::find(run_ids, id) == run_ids.end(); });
  for (Pane& pane : panes) {
    if (pane.content.kind != ContentKind::Run || std::ranges::find(run_ids, pane.content.run) != run_ids.end()) continue;
    pane.content = {};
    pane.chosen = false;
  }
  const bool other_run = active_id != active;
  active_id = active;
  if (one()) {
    if (!panes[0].chosen) panes[0].content = {ContentKind::Active, 0, std::nullopt};
    return 0;
  }
  const PaneContent before = panes[focus].content;
  fill(count());
  const PaneContent& focused = panes[focus].content;
  // Commands stay about the run beside the pane of the input.
  if (focused.kind == ContentKind::Input && focused != before) return pane_of_active();
  const bool of_another = focused.kind == ContentKind::Run && !focused.iteration && focused.run != active;
  return other_run || of_another ? pane_of_active() : focus;
}

void Panes::fill(std::size_t visible) {
  const auto shown = [&](std::uint64_t id) {
    bool found = false;
    for (std::size_t k = 0; k < visible; ++k) found = found || shows(k, id);
    return found;
  };
  const auto vacant = [&](Pane& pane) { return !pane.chosen && pane.content.kind != ContentKind::Run; };
  const auto is_ours = [](const Pane& pane) { return !pane.chosen && !pane.content.iteration; };
  if (visible == 2 && run_ids.size() == 1 && is_ours(panes[0]) && is_ours(panes[1])) {
    // Before is on the left, after on the right.
    panes[0].content = {ContentKind::Input, 0, std::nullopt};
    panes[1].content = {ContentKind::Run, run_ids.front(), std::nullopt};
    return;
  }
  const auto end = panes.begin() + static_cast<std::ptrdiff_t>(visible);
  for (const std::uint64_t id : run_ids) {
    if (shown(id) || (hidden_runs.contains(id) && id != active_id)) continue;
    const auto at = std::find_if(panes.begin(), end, vacant);
    if (at == end) break;
    at->content = {ContentKind::Run, id, std::nullopt};
  }
  if (active_id != 0 && !shown(active_id)) {
    for (auto at = end; at != panes.begin();) {
      if ((--at)->chosen) continue;
      at->content = {ContentKind::Run, active_id, std::nullopt};
      break;
    }
  }
  if (visible == 2 && are_reversed(panes[0], panes[1])) std::swap(panes[0].content, panes[1].content);
  const bool has_input = std::any_of(panes.begin(), end, [](const Pane& pane) { return pane.content.kind == ContentKind::Input; });
  const auto at = std::find_if(panes.begin(), end, [](const Pane& pane) { return !pane.chosen && pane.content.kind == ContentKind::Free; });
  if (!has_input && !run_ids.empty() && at != end) at->content = {ContentKind::Input, 0, std::nullopt};
}

/// Whether both were filled automatically and show runs in the reverse order of the list.
bool Panes::are_reversed(const Pane& left, const Pane& right) const {
  const auto is_run = [](const Pane& pane) { return !pane.chosen && pane.content.kind == ContentKind::Run && !pane.content.iteration; };
  return is_run(left) && is_run(right) && std::ranges::find(run_ids, left.content.run) > std::ranges::find(run_ids, right.content.run);
}

std::size_t Panes::pane_of_active() const {
  for (std::size_t k = 0; k < count(); ++k)
    if (shows(k, active_id)) return k;
  return focus;
}

std::string Panes::words(const PaneContent& content) const {
  constexpr std::array<const char*, 6> kWords{"auto", "active", "run", "input", "mark a", "mark b"};  // in the order of the kinds
  std::string words = kWords[static_cast<std::size_t>(content.kind)];
  if (content.kind == ContentKind::Run) words += fmt::format(" {}", std::ranges::find(run_ids, content.run) - run_ids.begin() + 1);
  if (content.kind == ContentKind::Run && content.iteration) words += fmt::format(" {}", *content.iteration);
  return words;
}

PaneContent Panes::parse(const std::vector<std::string>& words) const {
  const std::string& first = words.empty() ? std::string() : words[0];
  if (words.size() == 1 && first == "auto") return {};
  if (words.size() == 1 && first == "active") return {ContentKind::Active, 0, std::nullopt};
  if (words.size() == 1 && first == "input") return {ContentKind::Input, 0, std::nullopt};
  if (words.size() == 2 && first == "mark" && (words[1] == "a" || words[1] == "b"))
    return {words[1] == "a" ? ContentKind::MarkA : ContentKind::MarkB, 0, std::nullopt};
  if (first == "run" && (words.size() == 2 || words.size() == 3)) {
    const std::uint64_t number = to_count(words[1], 1);
    if (number > run_ids.size()) throw UsageError(fmt::format("there is no run {}; the session has {}", number, run_ids.size()));
    PaneContent content{ContentKind::Run, run_ids[number - 1], std::nullopt};
    if (words.size() == 3) {
      content.iteration = to_count(words[2]);
      if (*content.iteration > reached[number - 1])
        throw UsageError(fmt::format("run {} has no iteration {}: it has come to {}", number, grouped(*content.iteration),
                                     grouped(reached[number - 1])));
    }
    return content;
  }
  throw UsageError("expected active, run N, run N ITERATION, input, mark a, mark b or auto");
}

std::vector<Rect> pane_rects(PaneLayout layout, const Rect& area, float gap, double aspect, float title) {
  const auto size = [&](float columns, float rows) {
    return Rect{0, 0, std::max(0.0F, std::floor((area.w - (columns - 1) * gap) / columns)),
                std::max(0.0F, std::floor((area.h - (rows - 1) * gap) / rows))};
  };
  const auto mesh_height = [&](const Rect& pane) {
    return std::min(static_cast<double>(pane.w) / aspect, static_cast<double>(pane.h - title));
  };
  float columns = layout == PaneLayout::Four ? 2 : 1, rows = columns;
  if (layout == PaneLayout::Two) columns = 2;
  const float all = columns * rows;
  if (all > 1) {  // other arrangements only when they are clearly better
    constexpr double kClearly = 1.15;
    double best = kClearly * mesh_height(size(columns, rows));
    for (const auto& [across, down] : {std::pair{all, 1.0F}, {1.0F, all}}) {
      if (!(mesh_height(size(across, down)) > best)) continue;
      best = mesh_height(size(across, down));
      columns = across;
      rows = down;
    }
  }
  const Rect pane = size(columns, rows);
  std::vector<Rect> rects;
  for (float row = 0; row < rows; ++row)
    for (float column = 0; column < columns; ++column)
      rects.push_back({area.x + column * (pane.w + gap), area.y + row * (pane.h + gap), pane.w, pane.h});
  if (layout == PaneLayout::Split) rects.push_back(rects.front());
  return rects;
}

}  // namespace dmoscope::ui
