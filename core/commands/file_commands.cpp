// The session's commands: meshes and files.

#include <fmt/format.h>

#include "core/base/number_text.h"
#include "core/commands/command_rows.h"
#include "core/input/declared_floats.h"
#include "core/io/mesh_io.h"
#include "core/session/csv.h"
#include "core/session/state_file.h"

namespace dmoscope {

namespace {

void tell_report(CommandContext& context) {
  const InputMesh& input = *context.session.input();
  tell(context, fmt::format("{}: {}, {}", input.mesh.name, counted(input.mesh.vertex_count(), "vertex", "vertices"),
                            counted(input.mesh.elements.size(), "element", "elements")));
  for (std::string& sentence : input.report.sentences()) tell(context, std::move(sentence), Message::Kind::Warning);
  tell_interfaces(context);
}

void open(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  context.session.open(std::filesystem::path(arguments[0]), context.progress);
  tell_report(context);
}

void open_beside(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  context.session.open_beside(std::filesystem::path(arguments[0]), context.progress);
  tell_report(context);
}

void reload(CommandContext& context, Arguments arguments) {
  require(arguments, 0, 0);
  const std::string note = context.session.reload(context.progress);
  tell_report(context);
  if (!note.empty()) tell(context, note, Message::Kind::Warning);
}

void generate(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 3);
  std::string words = arguments[0];
  for (const std::string& word : arguments.subspan(1)) words += ' ' + word;
  context.session.generate(words, context.progress);
  tell_report(context);
}

void export_mesh(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  const Run& run = context.session.active();
  context.session.require_not_read(arguments[0], "export");
  std::vector<std::string> notes = write_mesh(arguments[0], run.input().mesh, run.positions(), context.progress);
  const std::string seen =
      written_as_floats(arguments[0], run.input(), run.positions(), run.parameters().metric, context.session.pool().get());
  if (!seen.empty()) notes.push_back(fmt::format("{}: {}", arguments[0], seen));
  tell(context, fmt::format("wrote {}", arguments[0]));
  for (std::string& note : notes) tell(context, std::move(note), Message::Kind::Warning);  // last, where the status bar shows it
}

void write_stats(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  std::vector<std::string> titles;
  std::vector<const std::vector<IterationRecord>*> records;
  (void)context.session.active();
  context.session.require_not_read(arguments[0], "stats");
  const bool several = context.session.inputs().size() > 1;
  for (std::size_t i = 0; i < context.session.run_count(); ++i) {
    const std::string label = stats_label(context.session.run(i).parameters());
    titles.push_back(several ? fmt::format("{}:{}", context.session.run(i).input().mesh.name, label) : label);
    records.push_back(&context.session.run(i).history().records());
  }
  std::vector<SharedVector<Percentiles>> percentiles;
  for (std::size_t i = 0; context.session.percentiles() && i < context.session.run_count(); ++i) {
    context.session.run(i).find_percentiles([&](double done) {
      context.progress.check();
      context.progress.set(done);
      return true;
    });
    percentiles.push_back(context.session.run(i).history().shared_percentiles());
  }
  write_file_atomically(arguments[0], stats_csv(titles, records, percentiles));
  tell(context, fmt::format("wrote {}", arguments[0]));
}

void write_elements(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  const Run& run = context.session.active();
  context.session.require_not_read(arguments[0], "elements");
  std::vector<Metric> metrics;
  for (const MetricInfo& entry : metric_table()) metrics.push_back(entry.metric);
  write_file_atomically(arguments[0], elements_csv(run.input().quality_context(), run.positions(), metrics));
  tell(context, fmt::format("wrote {}", arguments[0]));
}

void save_session(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 2);
  context.session.require_not_read(arguments[0], "save-state");
  save_state(arguments[0], context.session, arguments.size() > 1 ? arguments[1] : "", context.progress);
  tell(context, fmt::format("saved the session as {}", arguments[0]));
}

void open_session(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  const std::string note = open_state(arguments[0], context.session, context.progress);
  tell_report(context);
  if (!note.empty()) tell(context, note, Message::Kind::Warning);
  tell(context, fmt::format("{} run{} as saved", context.session.run_count(), context.session.run_count() == 1 ? "" : "s"));
}

}  // namespace

std::span<const CommandRow> file_commands() {
  static const std::vector<CommandRow> table{
      {{"open", "open FILE", "Opens a mesh and starts a run on it."}, open},
      {{"open-beside", "open-beside FILE", "Opens a mesh beside those that are open, and starts a run on it."}, open_beside},
      {{"reload", "reload", "Reads the active mesh's file again; its runs keep their parameters and start anew."}, reload},
      {{"generate", "generate KIND [SIZE [SEED]]", "Makes a sample mesh and starts a run on it."}, generate},
      {{"export", "export FILE", "Writes the active run's mesh; the extension chooses the format."}, export_mesh},
      {{"save-state", "save-state FILE [VIEW-JSON]", "Saves mesh, runs and where they stand; the view goes along."}, save_session},
      {{"open-state", "open-state FILE", "Opens what save-state saved."}, open_session},
      {{"stats", "stats FILE.csv", "Writes the statistics of every iteration of every run."}, write_stats},
      {{"elements", "elements FILE.csv", "Writes every element's quality by every metric."}, write_elements},
  };
  return table;
}

}  // namespace dmoscope
