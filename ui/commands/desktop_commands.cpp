#include <algorithm>
#include <tuple>

#include "core/io/writing/atomic_file.h"
#include "ui/commands/command_words.h"
#include "ui/commands/view_json.h"

namespace dmoscope::ui {
namespace {

void set_camera(ViewState& state, Arguments words) {
  const render::Camera2D camera{{to_number(words[0]), to_number(words[1])}, to_number(words[2])};
  if (!(camera.units_per_pixel > 0.0)) throw UsageError("units per pixel must be greater than 0");
  state.camera = camera;
  state.requests.fit = false;
}

void add_session_file_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add(
      {"save-session", "save-session FILE", "writes runs, histories and the view, to go on from there another time"}, {1, 1},
      [&state, &host](Arguments words) { host.post(fmt::format("save-state {} {}", quote_word(words[0]), quote_word(view_json(state)))); });
  table.add({"open-session", "open-session FILE", "opens what save-session wrote"}, {1, 1},
            [&host](Arguments words) { host.post("open-state " + quote_word(words[0])); });
}

SequenceOptions parse_sequence(Arguments words) {
  SequenceOptions options;
  read_options(words, options.folder, "one folder and options", [&options](const std::string& word, const auto& value) {
    if (word == "--from") {
      options.from = to_count(value());
    } else if (word == "--to") {
      options.to = to_count(value());
    } else if (word == "--every") {
      options.every = to_count(value(), 1);
    } else if (word == "--size") {
      std::tie(options.width, options.height) = parse_size(value());
    } else if (word == "--window") {
      options.window = true;
    } else if (word == "--overwrite") {
      options.overwrite = true;
    } else {
      return false;
    }
    return true;
  });
  if (options.folder.empty()) throw UsageError("a folder is missing");
  if (options.window && options.width > 0) throw UsageError("--size is of the mesh; the window has its own: size W H");
  return options;
}

}  // namespace

void add_desktop_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add({"camera", "camera X Y UNITS-PER-PIXEL", "looks at that point of the mesh's plane, so close"}, {3, 3},
            [&state](Arguments words) { set_camera(state, words); });
  if (is_session_command("save-state")) add_session_file_commands(table, state, host);
  table.add({"drawing-path", "drawing-path", "says what smooths and how it reaches the screen"}, {0, 0}, [&state, &host](Arguments) {
    add_message(state, {Message::Kind::Info, host.drawing_path(), 0});
  });
  table.add({"save-script", "save-script FILE", "writes what was done so far as a script that does it again"}, {1, 1},
            [&state, &host](Arguments words) {
              const auto view = host.session();
              write_file_atomically(words[0], state.commands.script(view_lines(state, view && view->frame)));
              add_message(state, {Message::Kind::Info, "wrote " + words[0], 0});
            });
}

void add_file_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add({"sequence", "sequence FOLDER [--from I] [--to J] [--every K] [--size WxH] [--window] [--overwrite]",
             "a picture of every iteration, for a video"},
            [&state, &host](Arguments words) {
              const SequenceOptions options = parse_sequence(words);
              if (host.busy() || state.sequence) throw UsageError("something runs: wait until it is done, or cancel it");
              const auto view = host.session();
              if (!view) throw UsageError("no mesh is open");
              state.sequence = plan_sequence(options, *view);
              state.timeline.shown = Shown::Now;
              state.timeline.play.kind = Playback::Kind::Off;
            });
}

}  // namespace dmoscope::ui
