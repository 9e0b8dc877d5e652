// Commands about meshes and files.

#include <algorithm>

#include <fmt/format.h>

#include "core/base/number_text.h"
#include "core/commands/command_rows.h"
#include "core/io/mesh_io.h"
#include "core/io/reading/source_file.h"
#include "core/io/writing/atomic_file.h"
#include "core/session/csv.h"
#include "core/session/read_files.h"
#include "core/session/state_file.h"
#include "core/transfer/moved_fields.h"
#include "core/transfer/thin_places.h"

namespace dmoscope {

namespace {

/// Reports on the active mesh, and `note`, if there is one.
void tell_report(CommandContext& context, const std::string& note = {}) {
  const InputMesh& input = *context.session.input();
  tell(context, fmt::format("{}: {}, {}", input.mesh.name, counted(input.mesh.vertex_count(), "vertex", "vertices"),
                            counted(input.mesh.elements.size(), "element", "elements")));
  for (std::string& sentence : input.report.sentences()) tell(context, std::move(sentence), Message::Kind::Warning);
  tell_interfaces(context);
  if (!note.empty()) tell(context, note, Message::Kind::Warning);
}

void open(CommandContext& context, Arguments arguments) {
  context.session.open(std::filesystem::path(arguments[0]), context.progress);
  tell_report(context);
}

void open_beside(CommandContext& context, Arguments arguments) {
  context.session.open_beside(std::filesystem::path(arguments[0]), context.progress);
  tell_report(context);
}

void reload(CommandContext& context, Arguments) { tell_report(context, context.session.reload(context.progress)); }

void surface(CommandContext& context, Arguments arguments) {
  const std::string note = context.session.slide_on_surface(arguments[0] == "own" ? "" : arguments[0], context.progress);
  tell_report(context);
  tell_sliding(context);
  const Run& run = context.session.active();
  if (run.input().surface && !run.domain())
    tell(context, fmt::format("nothing slides yet: 'boundary slide' lets vertices slide on {}", run.input().surface->mesh.name),
         Message::Kind::Warning);
  if (!note.empty()) tell(context, note, Message::Kind::Warning);
}

void materials(CommandContext& context, Arguments arguments) { tell_report(context, context.session.name_materials(arguments)); }

void generate(CommandContext& context, Arguments arguments) {
  std::string words = arguments[0];
  for (const std::string& word : arguments.subspan(1)) words += ' ' + word;
  context.session.generate(words, context.progress);
  tell_report(context);
}

/// Writes the active run's mesh, and reports that and all that the user should know.
void write_active(CommandContext& context, const std::string& file, const std::string& said) {
  const Run& run = context.session.active();
  const MovedFields fields =
      move_fields(run.input(), run.parameters().fields, run.positions(), context.session.pool().get(), context.progress);
  const std::vector<Vec3> places = places_with_back(run.input(), run.positions(), context.session.pool().get(), context.progress);
  std::vector<std::string> notes = write_mesh(file, run.input().mesh, {places, fields.values}, context.progress);
  context.session.note_exported(file);
  tell(context, said);
  if (const std::string sentence = fields.sentence(); !sentence.empty()) tell(context, fmt::format("fields: {}", sentence));
  for (std::string& note : notes) tell(context, std::move(note), Message::Kind::Warning);  // last, so that the status bar shows them
}

void export_mesh(CommandContext& context, Arguments arguments) {
  (void)context.session.active();
  context.session.require_not_read(arguments[0], "export");
  write_active(context, arguments[0], fmt::format("wrote {}", arguments[0]));
}

void export_over(CommandContext& context, Arguments arguments) {
  const InputMesh& input = context.session.active().input();
  if (input.path.empty() || !same_mesh(arguments[0], input.path))
    throw UsageError(fmt::format("{} is not the file that the mesh was read from: 'export' writes to another one", arguments[0]));
  std::vector<std::filesystem::path> files = mesh_files(input.path);
  if (input.mesh.source)  // leaves out a file that is never written
    std::erase_if(files, [&](const auto& file) { return file.filename() == input.mesh.source->beside(); });
  if (std::ranges::any_of(files, [&](const auto& file) { return !same_mesh(file, input.path); }))
    throw UsageError(fmt::format("{} is read together with {}, of which no copy is kept: 'export' writes to another file", arguments[0],
                                 files.back().filename().string()));
  const std::vector<std::filesystem::path> copies = keep_originals(files);
  const auto name = [](const std::filesystem::path& path) { return path.filename().string(); };
  std::string kept = name(copies.front());
  if (copies.size() > 1 && !copies[1].empty()) kept += " and " + name(copies[1]);
  try {
    write_active(context, arguments[0], fmt::format("wrote {}; what it held is kept beside it as {}", arguments[0], kept));
  } catch (...) {
    std::error_code ignored;
    for (const std::filesystem::path& copy : copies) std::filesystem::remove(copy, ignored);
    throw;
  }
  if (!copies.front().empty()) context.session.note_original(copies.front());
}

void write_stats(CommandContext& context, Arguments arguments) {
  std::vector<std::string> titles;
  std::vector<const std::vector<IterationRecord>*> records;
  (void)context.session.active();
  context.session.require_not_read(arguments[0], "stats");
  const bool several = context.session.inputs().size() > 1;
  for (std::size_t i = 0; i < context.session.run_count(); ++i) {
    const Run& run = context.session.run(i);
    const std::string label = run.given_name().empty() ? stats_label(run.parameters()) : run.given_name();
    titles.push_back(several ? fmt::format("{}:{}", run.input().mesh.name, label) : label);
    records.push_back(&run.history().records());
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
  const Run& run = context.session.active();
  context.session.require_not_read(arguments[0], "elements");
  std::vector<Metric> metrics;
  for (const MetricInfo& entry : metric_table()) metrics.push_back(entry.metric);
  for (const Metric own : {run.parameters().metric, context.session.shown()})
    if (!is_built_in(own) && std::ranges::find(metrics, own) == metrics.end()) metrics.push_back(own);
  write_file_atomically(arguments[0], elements_csv(run.input().quality_context(), run.positions(), metrics));
  tell(context, fmt::format("wrote {}", arguments[0]));
}

void save_session(CommandContext& context, Arguments arguments) {
  context.session.require_not_read(arguments[0], "save-state");
  save_state(arguments[0], context.session, arguments.size() > 1 ? arguments[1] : "", context.progress);
  context.session.note_saved(arguments[0]);
  tell(context, fmt::format("saved the session as {}", arguments[0]));
}

void open_saved(CommandContext& context, const std::string& file) {
  tell_report(context, open_state(file, context.session, context.progress));
}

std::string runs_as_saved(const Session& session) {
  return fmt::format("{} run{} as saved", session.run_count(), session.run_count() == 1 ? "" : "s");
}

void open_session(CommandContext& context, Arguments arguments) {
  open_saved(context, arguments[0]);
  context.session.note_saved(arguments[0]);
  tell(context, runs_as_saved(context.session));
}

void recover(CommandContext& context, Arguments arguments) {
  open_saved(context, arguments[0]);
  context.recovered.emplace_back(arguments[0]);
  tell(context, fmt::format("recovered {}, iteration {}; save it to keep it", runs_as_saved(context.session),
                            context.session.active().moment().iteration));
}

}  // namespace

std::span<const CommandRow> file_commands() {
  static const std::vector<CommandRow> table{
      {{"open", "open FILE", "Opens a mesh and starts a run on it."}, {1, 1, open}},
      {{"open-beside", "open-beside FILE", "Opens a mesh beside those that are open, and starts a run on it."}, {1, 1, open_beside}},
      {{"reload", "reload", "Reads the active mesh's file again; its runs keep their parameters and start anew."}, {0, 0, reload}},
      {{"surface", "surface FILE|own",
        "Lets vertices slide on the surface of another mesh, or on their own mesh's again; its runs keep their parameters and start anew."},
       {1, 1, surface}},
      {{"materials", "materials [FIELD...]",
        "Lets cell data name materials, whatever they are called, or again only those of known names; its runs keep their parameters and "
        "start "
        "anew."},
       {0, kAnyWords, materials}},
      {{"generate", "generate KIND [SIZE [SEED]]", "Makes a sample mesh and starts a run on it."}, {1, 3, generate}},
      {{"export", "export FILE", "Writes the active run's mesh; the extension chooses the format."}, {1, 1, export_mesh}},
      {{"export-over", "export-over FILE", "Writes it over the file that it was read from, and keeps a copy of that beside it."},
       {1, 1, export_over}},
      {{"save-state", "save-state FILE [VIEW-JSON]", "Saves mesh, runs and where they stand; the view goes along."}, {1, 2, save_session}},
      {{"open-state", "open-state FILE", "Opens what save-state saved."}, {1, 1, open_session}},
      {{"recover", "recover FILE", "Opens what was saved by itself; it counts as not saved."}, {1, 1, recover}},
      {{"stats", "stats FILE.csv", "Writes the statistics of every iteration of every run."}, {1, 1, write_stats}},
      {{"elements", "elements FILE.csv", "Writes every element's quality by every metric."}, {1, 1, write_elements}},
  };
  return table;
}

}  // namespace dmoscope
