#include <tuple>

#include "ui/commands/command_words.h"

namespace dmoscope::ui {
namespace {

SequenceOptions parse_sequence(Arguments words) {
  SequenceOptions options;
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::string& word = words[k];
    const auto value = [&]() -> const std::string& {
      if (++k >= words.size()) throw UsageError(word + ": a value is missing");
      return words[k];
    };
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
    } else if (options.folder.empty() && !word.starts_with("--")) {
      options.folder = word;
    } else {
      unexpected(word, "one folder and options");
    }
  }
  if (options.folder.empty()) throw UsageError("a folder is missing");
  if (options.window && options.width > 0) throw UsageError("--size is of the mesh; the window has its own: size W H");
  return options;
}

}  // namespace

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
