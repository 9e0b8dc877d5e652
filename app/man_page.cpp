#include "app/man_page.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/commands/session_commands.h"
#include "core/io/mesh_io.h"
#include "core/mesh/generate.h"
#include "core/quality/metric.h"
#include "core/run/run.h"
#ifdef DMOSCOPE_HAVE_GUI
#include "core/smooth/execution/method_table.h"
#include "ui/commands/view_commands.h"
#endif

namespace dmoscope::app {
namespace {

/// Escapes text so that roff shows it literally.
std::string roff(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) out += "\\&";
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
  }
  return out;
}

std::string item(std::string_view head, std::string_view body) { return fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(head), roff(body)); }

/// Heading of an option, as in --help: "--size WxH"; its names and, unless it is a flag, its value.
std::string heading(const CLI::Option& option) {
  std::string head = option.get_name(option.get_positional(), true);
  std::string separated;
  for (const char c : head) separated += c == ',' ? std::string(", ") : std::string(1, c);
  if (!option.get_positional() && option.get_items_expected_max() > 0 && !option.get_type_name().empty()) {
    separated += " " + option.get_type_name();
  }
  return separated;
}

void add_options(std::string& page, const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    const std::string usual = option->get_default_str();
    page += item(heading(*option), option->get_description() + (usual.empty() ? "" : fmt::format(" (unless given: {})", usual)));
  }
}

void add_subcommands(std::string& page, const CLI::App& app) {
  page += ".SH SUBCOMMANDS\n";
  for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (subcommand->get_group().empty()) continue;
    page += fmt::format(".SS dmoscope {}\n{}\n", roff(subcommand->get_name()), roff(subcommand->get_description()));
    add_options(page, *subcommand);
    if (!subcommand->get_footer().empty()) page += ".PP\n" + roff(subcommand->get_footer()) + "\n";
  }
}

void add_tables(std::string& page) {
  page += ".SH METRICS\nA metric is 1 for the ideal element and at most 0 for an inverted one.\n";
  for (const MetricInfo& metric : metric_table()) {
    page += item(metric.name, fmt::format("{} For {}; from {:g} to {:g}, acceptable from {:g}. {}", metric.doc, words(metric.kinds),
                                          metric.lowest, metric.highest, metric.acceptable, metric.formula));
  }
  page += ".SH METHODS\n";
  for (const MethodInfo& method : method_table()) page += item(method.name, method.doc);
  page += ".SH FORMATS\n";
  for (const FormatInfo& format : format_table()) {
    page += item(format.extensions, fmt::format("{}. {}", format.title, format.doc));
  }
  page += ".SH SAMPLES\nKinds of dmoscope generate:\n";
  for (const GeneratorInfo& generator : generator_table()) page += item(generator.name, generator.doc);
  page += ".SH COMMAND LANGUAGE\nOne command a line, for dmoscope script; # starts a comment, \"double quotes\" keep blanks.\n";
  for (const CommandInfo& command : session_commands()) page += item(command.usage, command.doc);
#ifdef DMOSCOPE_HAVE_GUI
  page += ".PP\nThe window's own, which script \\-\\-headless plays without a screen:\n";
  for (const CommandInfo& command : ui::view_command_infos()) page += item(command.usage, command.doc);
#endif
}

}  // namespace

std::string man_page(const CLI::App& app) {
  std::string page = fmt::format(".TH DMOSCOPE 1 \"\" \"dmoscope {}\" \"User Commands\"\n", DMOSCOPE_VERSION);
  page += ".SH NAME\ndmoscope \\- see, compare and run Discrete Mesh Optimization\n";
  page += ".SH SYNOPSIS\n\\fBdmoscope\\fR [\\fIFILE\\fR...]\n.br\n\\fBdmoscope\\fR \\fISUBCOMMAND\\fR [\\fIOPTION\\fR...]\n";
  page += ".SH DESCRIPTION\n" + roff(app.get_description()) + "\n.PP\n" + roff(app.get_footer()) + "\n";
  page += ".SH OPTIONS\n";
  add_options(page, app);
  add_subcommands(page, app);
  add_tables(page);
  page +=
      ".SH EXIT STATUS\n.TP\n0\ndone\n.TP\n1\nran but did not reach what was asked, or was cancelled\n.TP\n2\nwrong usage\n.TP\n3\nbad "
      "input "
      "or output\n";
  page += ".SH SEE ALSO\nDaniel Zint and Roberto Grosso: Discrete Mesh Optimization on GPU. 27th International Meshing Roundtable, 2018.\n";
  return page;
}

}  // namespace dmoscope::app
