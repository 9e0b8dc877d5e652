#include "ui/commands/view_commands.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "core/quality/quality.h"
#include "ui/commands/command_words.h"
#include "ui/commands/inspection_commands.h"
#include "ui/commands/notice.h"
#include "ui/commands/size_point.h"
#include "ui/commands/tour_commands.h"
#include "ui/commands/unsaved_commands.h"
#include "ui/state/view_geometry.h"

namespace dmoscope::ui {
namespace {

constexpr auto kDialogs = std::to_array<std::pair<std::string_view, Dialog>>({{"none", Dialog::None},
                                                                              {"open", Dialog::Open},
                                                                              {"export", Dialog::Export},
                                                                              {"screenshot", Dialog::Screenshot},
                                                                              {"find", Dialog::Find},
                                                                              {"palette", Dialog::Palette},
                                                                              {"keys", Dialog::Keys},
                                                                              {"about", Dialog::About},
                                                                              {"error", Dialog::Error},
                                                                              {"log", Dialog::Log},
                                                                              {"sequence", Dialog::Sequence},
                                                                              {"plot", Dialog::Plot},
                                                                              {"formula", Dialog::Formula},
                                                                              {"compare", Dialog::Compare},
                                                                              {"save-session", Dialog::SaveSession},
                                                                              {"unsaved", Dialog::Unsaved},
                                                                              {"recover", Dialog::Recover}});

Picked parse_pick(const CommandHost& host, Arguments words) {
  if (words.size() == 1 && words[0] == "none") return {};
  require(words, 2, 2);
  static constexpr std::array<std::pair<std::string_view, Picked::Kind>, 2> kinds{
      {{"vertex", Picked::Kind::Vertex}, {"element", Picked::Kind::Element}}};
  Picked picked{choose(words[0], kinds), kNoIndex};
  const auto view = open_view(host);
  const Mesh& mesh = view->input->mesh;
  const std::uint64_t id = to_count(words[1]);
  const std::uint64_t size = picked.kind == Picked::Kind::Vertex ? mesh.vertex_count() : mesh.elements.size();
  if (id >= size)
    throw UsageError(fmt::format("there is no {} {}: the mesh has {} (0 to {})", words[0], id, size, size == 0 ? 0 : size - 1));
  picked.id = static_cast<Index>(id);
  return picked;
}

void add_camera_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add({"pick", "pick vertex|element ID  or  pick none", "selects a vertex or an element"}, [&state, &host](Arguments words) {
    state.picked = parse_pick(host, words);
    if (state.picked.kind == Picked::Kind::None) return state.panels.leave_selection();
    state.panels.show_selection();
  });
  table.add({"goto", "goto vertex|element ID", "selects it and moves the view there"}, [&state, &host](Arguments words) {
    const Picked picked = parse_pick(host, words);
    if (picked.kind == Picked::Kind::None) throw UsageError("expected vertex or element");
    state.picked = picked;
    state.panels.show_selection(true);
    const auto view = host.session();
    if (view->frame) look_at_picked(state, *view->frame);
  });
  table.add({"fit", "fit", "shows the whole mesh"}, {0, 0}, [&state](Arguments) { state.requests.fit = true; });
  table.add({"zoom", "zoom FACTOR", "makes everything FACTOR times as big around the middle"}, {1, 1}, [&state](Arguments words) {
    const double factor = to_number(words[0]);
    if (!(factor > 0.0)) throw UsageError("the factor must be greater than 0");
    const Vec2<double> middle{state.viewport.x / 2, state.viewport.y / 2};
    state.camera.zoom_at(middle, state.viewport, factor);
    state.orbit.zoom_at(middle, state.viewport, factor);
  });
  table.add({"pan", "pan DX DY", "moves the picture by pixels"}, {2, 2}, [&state](Arguments words) {
    const Vec2<double> pixels{to_number(words[0]), to_number(words[1])};
    state.camera.pan(pixels);
    state.orbit.pan(pixels, state.viewport);
  });
}

void add_window_commands(CommandTable& table, ViewState& state) {
  table.add({"scale", "scale FACTOR|up|down", "size of the interface over what the monitor asks for"}, {1, 1}, [&state](Arguments words) {
    const double wanted = words[0] == "up"     ? state.scale * 1.125
                          : words[0] == "down" ? state.scale / 1.125
                                               : to_number(words[0]) * state.monitor_scale;
    if (!(wanted > 0.0)) throw UsageError("the scale must be greater than 0");
    state.scale = std::clamp(wanted, 0.5, 4.0);
  });
  table.add({"size", "size WIDTH HEIGHT", "size of the window in pixels"}, {2, 2}, [&state](Arguments words) {
    state.window_size = parse_size(words[0] + "x" + words[1]);
    state.requests.size = state.window_size;
  });
  table.add({"dialog", "dialog NAME|none",
             "opens or closes a dialog; open-beside, open-surface: that of open, for a mesh beside those that are open, or to slide on"},
            {1, 1}, [&state](Arguments words) {
              state.open_for = words[0] == "open-beside" ? OpenFor::Beside : words[0] == "open-surface" ? OpenFor::Surface : OpenFor::Alone;
              state.dialog = state.open_for != OpenFor::Alone ? Dialog::Open : choose(words[0], kDialogs);
            });
}

void add_output_commands(CommandTable& table, ViewState& state) {
  table.add({"screenshot", "screenshot FILE [--size WxH] [--supersample N] [--transparent] [--window]",
             "writes a PNG of the mesh, or of the whole window"},
            [&state](Arguments words) {
              ScreenshotOptions shot;
              read_options(words, shot.path, "one file and options", [&shot](const std::string& word, const auto& value) {
                if (word == "--size") {
                  std::tie(shot.width, shot.height) = parse_size(value());
                } else if (word == "--supersample") {
                  const std::uint64_t n = to_count(value(), 1);
                  if (n > 8) throw UsageError("--supersample goes from 1 to 8");
                  shot.supersample = static_cast<int>(n);
                } else if (word == "--transparent") {
                  shot.transparent = true;
                } else if (word == "--window") {
                  shot.window = true;
                } else {
                  return false;
                }
                return true;
              });
              if (shot.path.empty()) throw UsageError("a file name is missing");
              for (const std::string_view other : {".jpg", ".jpeg", ".gif", ".bmp", ".tif", ".tiff", ".webp", ".svg", ".pdf"})
                if (shot.path.extension() == other)
                  throw UsageError(fmt::format("{}: screenshots are written as .png", shot.path.string()));
              state.requests.screenshots.push_back(std::move(shot));
            });
  table.add({"copy", "copy TEXT", "puts a text on the clipboard"}, {1, 1},
            [&state](Arguments words) { state.requests.clipboard = words[0]; });
  table.add({"quit", "quit", "closes the window"}, {0, 0}, [&state](Arguments) { state.requests.quit = true; });
}

void seek_in_timeline(const CommandHost& host, const std::string& where) {
  const auto view = host.session();
  if (!view || view->runs.empty()) throw UsageError("no mesh is open");
  const RunView& run = view->runs[view->active];
  const std::uint64_t last = run.records.empty() ? 0 : run.records.back().iteration;
  const std::uint64_t now = run.moment.iteration;
  std::uint64_t target = now;
  if (where == "first") {
    target = 0;
  } else if (where == "last") {
    target = last;
  } else if (where == "back") {
    target = !run.moment.is_iteration_end() || now == 0 ? now : now - 1;
  } else if (where == "forward") {
    target = std::min(now + 1, last);
  } else {
    unexpected(where, "back, forward, first or last");
  }
  if (target != now || !run.moment.is_iteration_end()) host.post(fmt::format("seek {}", target));
}

void add_session_shortcuts(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add({"run-pause", "run-pause", "runs until converged, or stops what runs or plays"}, {0, 0}, [&state, &host](Arguments) {
    if (state.timeline.play.kind != Playback::Kind::Off) {
      state.timeline.play.kind = Playback::Kind::Off;
    } else if (host.busy()) {
      host.cancel();
    } else {
      host.post("until-converged best");
    }
  });
  table.add({"cancel", "cancel", "stops what runs and forgets what waits"}, {0, 0}, [&host](Arguments) { host.cancel(); });
  table.add({"timeline", "timeline back|forward|first|last", "shows another iteration of the history"}, {1, 1},
            [&host](Arguments words) { seek_in_timeline(host, words[0]); });
  table.add({"next-run", "next-run", "selects the next run"}, {0, 0}, [&host](Arguments) {
    const auto view = host.session();
    if (view && view->runs.size() > 1) host.post(fmt::format("select-run {}", (view->active + 1) % view->runs.size() + 1));
  });
  table.add({"next-metric", "next-metric", "shows the next metric that is defined for the mesh"}, {0, 0}, [&host](Arguments) {
    (void)open_view(host);
    host.post("show next");  // relative, so that each of several presses in a row goes one further
  });
  (void)state;
}

}  // namespace

CommandTable view_commands(ViewState& state, const CommandHost& host) {
  CommandTable table;
  add_camera_commands(table, state, host);
  add_option_commands(table, state);
  add_window_commands(table, state);
  add_colouring_commands(table, state, host);
  add_output_commands(table, state);
  add_plot_commands(table, state);
  add_input_commands(table, state, host);
  add_inspection_commands(table, state, host);
  add_session_shortcuts(table, state, host);
  add_desktop_commands(table, state, host);
  add_clipping_commands(table, state, host);
  add_timeline_commands(table, state, host);
  add_file_commands(table, state, host);
  add_notice_command(table, state, host);
  add_selection_commands(table, state, host);
  add_size_point_commands(table, state, host);
  add_pane_commands(table, state);
  add_unsaved_commands(table, state, host);
  add_tour_command(table, state);
  return table;
}

std::vector<CommandInfo> view_command_infos() {
  ViewState state;
  const CommandHost host;
  return view_commands(state, host).commands();
}

bool is_session_command(std::string_view line) {
  const auto words = split_words(line);
  if (words.empty()) return false;
  const auto& commands = session_commands();
  return std::any_of(commands.begin(), commands.end(), [&](const CommandInfo& command) { return command.name == words[0]; });
}

void require_known_command(const CommandTable& view, std::string_view line) {
  const auto words = split_words(line);
  if (words.empty() || view.knows(words[0]) || is_session_command(line)) return;
  std::vector<CommandInfo> known = view.commands();
  known.insert(known.end(), session_commands().begin(), session_commands().end());
  throw UsageError(unknown_command(words[0], known));
}

void dispatch(const CommandTable& view, const CommandHost& host, std::string_view line) {
  const auto words = split_words(line);
  if (words.empty()) return;
  require_known_command(view, line);
  if (is_session_command(line)) {
    host.post(std::string(line));
  } else {
    if (const auto session = host.session(); session && session->read_files) session->read_files->require_another(line);
    view.execute(line);
  }
}

std::pair<int, int> parse_size(const std::string& word) {
  constexpr int kLargest = 32768;
  const auto cross = word.find('x');
  std::array<int, 2> size{};
  if (cross != std::string::npos) {
    const std::array<std::string_view, 2> parts{std::string_view(word).substr(0, cross), std::string_view(word).substr(cross + 1)};
    bool good = true;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto [end, error] = std::from_chars(parts[k].data(), parts[k].data() + parts[k].size(), size[k]);
      good = good && error == std::errc() && end == parts[k].data() + parts[k].size() && size[k] >= 1 && size[k] <= kLargest;
    }
    if (good) return {size[0], size[1]};
  }
  throw UsageError(fmt::format("\"{}\": expected a size such as 1280x800, each from 1 to {}", word, kLargest));
}

}  // namespace dmoscope::ui
