// dmoscope paper: repeats the experiments of the paper.

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/common/acceleration.h"
#include "app/common/console.h"
#include "app/common/option_checks.h"
#include "app/common/output_checks.h"
#include "app/common/run_options.h"
#include "app/common/text.h"
#include "app/comparison/report.h"
#include "app/paper/lab.h"
#include "app/paper/pages.h"
#include "app/subcommands/subcommands.h"
#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/io/writing/atomic_file.h"

namespace dmoscope::app {
namespace {

struct PaperOptions {
  std::filesystem::path meshes, output;
  std::vector<std::string> only;
  std::string backend = "auto";
  unsigned threads = 0;
  bool quick = false, full = false;
};

std::vector<Experiment> chosen(const std::vector<std::string>& only) {
  std::vector<Experiment> all = experiments();
  for (const std::string& id : only) {
    if (std::ranges::find(all, id, &Experiment::id) != all.end()) continue;
    std::vector<std::string_view> known;
    for (const Experiment& e : all) known.push_back(e.id);
    throw UsageError("--only: " + unknown_value("figure", id, known));
  }
  if (!only.empty()) std::erase_if(all, [&](const Experiment& e) { return std::ranges::find(only, e.id) == only.end(); });
  return all;
}

/// Makes the output folder. Throws OutputError before the long work if a file or a figure's folder could not be written after it.
void make_output(const std::filesystem::path& folder, const std::vector<Experiment>& wanted) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw OutputError(folder.string(), error.message());
  for (const char* file : {"index.html", "table.csv"}) require_writable(folder / file);
  for (const Experiment& experiment : wanted) {
    const std::filesystem::path here = folder / experiment.id;
    if (std::filesystem::exists(here, error)) require_writable(here / "picture-1.png");
  }
}

int paper(const PaperOptions& options, const std::string& command_line) {
  const std::vector<Experiment> wanted = chosen(options.only);
  const Extent extent = options.quick ? Extent::Quick : options.full ? Extent::Full : Extent::Usual;
  const Acceleration acceleration = acceleration_for(parse_backend(options.backend));
  Watch watch;
  Progress& progress = watch.progress();
  const auto pool = std::make_shared<ThreadPool>(options.threads);
  Lab lab(options.meshes, extent, {pool, acceleration, progress, [](const std::string& sentence) { complain(sentence); }});
  make_output(options.output, wanted);

  std::vector<Figure> figures;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Progress::Part part(progress, i, wanted.size());
    figures.push_back({std::string(wanted[i].id), std::string(wanted[i].title)});
    wanted[i].conduct(lab, figures.back());
  }
  auto facts = machine_facts(pool->size());
  facts.insert(facts.begin(), {"extent", lab.choose("quick", "usual", "full")});
  facts.insert(facts.begin(), {"command", command_line});
  const std::string page = findings_page(figures, facts);
  write_file_atomically(options.output / "table.csv", findings_csv(figures));
  write_file_atomically(options.output / "index.html", page);
  write_figures(options.output, figures);

  print_lines(findings_text(figures));
  print("\nwrote {}\n", (options.output / "index.html").string());
  bool all_hold = true;
  for (const Figure& figure : figures) {
    for (const Finding& f : figure.findings) {
      if (f.verdict != Verdict::Differs) continue;
      complain(fmt::format("figure {}, {}: {}: {}, not {}{}", f.figure, f.mesh, f.what, brief(f.ours), f.paper,
                           f.why.empty() ? "" : ". " + f.why));
      all_hold = false;
    }
  }
  return all_hold ? 0 : 1;
}

}  // namespace

void add_paper(CLI::App& app, Action& action, const std::string& command_line) {
  auto options = std::make_shared<PaperOptions>();
  CLI::App* subcommand = app.add_subcommand("paper", "Do the experiments of the paper again, and compare");
  subcommand->add_option("--meshes", options->meshes, "Folder in or below which the paper's meshes are: east.14, bahamas.14, shashkov.vtk")
      ->type_name("DIR");
  subcommand->add_option("-o,--output", options->output, "Folder to write to: index.html, table.csv, and a folder per figure")
      ->required()
      ->type_name("DIR");
  auto* quick = subcommand->add_flag("--quick", options->quick, "Fewer iterations, orders and sizes: a minute instead of several");
  subcommand->add_flag("--full", options->full, "As many as in the paper: an hour")->excludes(quick);
  subcommand->add_option("--only", options->only, "One figure, such as 4a; may be given again")->type_name("NAME")->expected(1)->take_all();
  add_backend_option(*subcommand, options->backend);
  subcommand->add_option("--threads", options->threads, "Number of threads; 0 uses every processor thread")
      ->transform(whole_number(0, kMostThreads))
      ->type_name("N")
      ->capture_default_str();
  subcommand->footer("Exit code 1 says that something the paper claims did not come out within the tolerance that the table states.");
  subcommand->callback(
      [options, command_line = &command_line, &action] { action = [options, command_line] { return paper(*options, *command_line); }; });
}

}  // namespace dmoscope::app
