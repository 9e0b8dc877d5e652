#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/mesh/vertex_words.h"
#include "ui/commands/command_words.h"
#include "ui/commands/inspection_commands.h"

namespace dmoscope::ui {
namespace {

const SessionView& open_session(const std::shared_ptr<const SessionView>& view) {
  if (!view || !view->frame) throw UsageError("no mesh is open");
  return *view;
}

/// The vertices within a box of the plane.
std::vector<Index> vertices_in(const Frame& frame, Vec2<double> a, Vec2<double> b) {
  if (frame.device) throw UsageError("the vertices are on their way: select when the run rests");
  const auto [low_x, high_x] = std::minmax(a.x, b.x);
  const auto [low_y, high_y] = std::minmax(a.y, b.y);
  std::vector<Index> found;
  for (Index v = 0; v < frame.vertex_count(); ++v) {
    const Vec2<double> p = frame.input->geometry.plane.place(frame.positions[v]);
    if (p.x >= low_x && p.x <= high_x && p.y >= low_y && p.y <= high_y) found.push_back(v);
  }
  return found;
}

void select(ViewState& state, const CommandHost& host, Arguments words) {
  require(words, 1, words.size() + 1);
  const std::string& how = words[0];
  const Arguments rest = words.subspan(1);
  if (how == "none") {
    require(words, 1, 1);
    state.selection.clear();
    return;
  }
  const auto view = host.session();
  const Frame& frame = *open_session(view).frame;
  if (how == "all-in") {
    require(words, 5, 5);
    if (host.busy()) throw UsageError("the run is at work: wait until it rests, or cancel it");
    state.selection.assign(vertices_in(frame, {to_number(words[1]), to_number(words[2])}, {to_number(words[3]), to_number(words[4])}));
    return;
  }
  require(words, 2, words.size());
  const bool named = std::ranges::any_of(rest, [](const std::string& word) { return word.find_first_of(":=") != std::string::npos; });
  std::vector<Index> vertices = named ? vertices_named(frame.input->mesh, rest) : parse_id_ranges(rest, frame.vertex_count());
  if (how == "vertex") {
    state.selection.assign(std::move(vertices));
  } else if (how == "add") {
    state.selection.add(vertices);
  } else if (how == "remove") {
    state.selection.remove(std::move(vertices));
  } else {
    unexpected(how, "vertex, add, remove, none or all-in");
  }
}

/// Those of the selected vertices that may be moved; throws UsageError if there is none.
std::vector<Index> free_of(const ViewState& state, const SessionView& view) {
  const RunView& run = view.runs[view.active];
  std::vector<Index> free;
  for (const Index v : state.selection.vertices())
    if (v >= run.fixed.size() || run.fixed[v] == 0) free.push_back(v);
  if (state.selection.empty()) throw UsageError("no vertices are selected: paint some with the brush, or type 'select vertex ID...'");
  if (free.empty()) throw UsageError("all selected vertices are fixed");
  return free;
}

/// The selected vertices, or else the one that is picked, as words of a command.
std::string chosen_vertices(const ViewState& state, const SessionView& view) {
  if (!state.selection.empty()) {
    std::string list = id_ranges(state.selection.vertices());
    std::ranges::replace(list, ' ', ',');
    return "vertices:" + list;
  }
  if (state.picked.kind != Picked::Kind::Vertex || state.picked.id >= view.frame->vertex_count())
    throw UsageError("no vertex is picked: click one, or select some with the brush");
  return fmt::format("vertices:{}", state.picked.id);
}

/// Leaves one thing at a time, the latest first: the mouse's mode, then the pick.
void leave(ViewState& state) {
  if (std::exchange(state.placing_size_point, false)) return;
  if (state.renaming_run) return state.renaming_run.reset();
  if (std::exchange(state.brush.on, false)) {
    state.brush.painting = false;
    return;
  }
  if (state.inspection.open) return close_inspection(state);
  state.picked = {};
  state.panels.leave_selection();
}

}  // namespace

void add_selection_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add({"select", "select vertex|add|remove ID|A-B|loop:N|part:N|group:NAME...  or  select none  or  select all-in X0 Y0 X1 Y1",
             "the vertices to smooth or to fix; all-in: those in a box of the plane"},
            [&state, &host](Arguments words) { select(state, host, words); });
  table.add({"leave", "leave", "ends what the mouse is doing besides picking, such as brushing; else clears the selection"}, {0, 0},
            [&state](Arguments) { leave(state); });
  table.add({"smooth-selected", "smooth-selected", "visits the free ones of the selected vertices, each once"}, {0, 0},
            [&state, &host](Arguments) {
              const auto view = host.session();
              host.post("visit " + id_ranges(free_of(state, open_session(view))));
            });
  table.add({"fix-selected", "fix-selected", "fixes the selected vertices"}, {0, 0}, [&state, &host](Arguments) {
    const auto view = host.session();
    std::string list = id_ranges(free_of(state, open_session(view)));
    std::ranges::replace(list, ' ', ',');
    host.post("fix vertices:" + list);  // a number alone may also be the name of a group
  });
  table.add({"make", "make corner|no-corner|auto-corner", "gives the selected vertices, or else the picked one, this kind"}, {1, 1},
            [&state, &host](Arguments words) {
              if (words[0] != "corner" && words[0] != "no-corner" && words[0] != "auto-corner")
                unexpected(words[0], "corner, no-corner or auto-corner");
              const auto view = host.session();
              host.post(words[0] + ' ' + chosen_vertices(state, open_session(view)));
            });
}

}  // namespace dmoscope::ui
