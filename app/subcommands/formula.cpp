// dmoscope formula: describes a formula, or lists the names that formulas may use.

#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/common/console.h"
#include "app/common/text.h"
#include "app/subcommands/subcommands.h"
#include "core/formula/vocabulary.h"
#include "core/quality/defined_metric.h"

namespace dmoscope::app {

namespace {

struct FormulaOptions {
  std::string text;
  bool json = false;
};

void print_vocabulary() {
  print("Names of an element\n");
  print("  {:<22} corners, in the element's order; differences of them are vectors\n", "p1, p2, ...");
  print("  {:<22} length from corner 1 to corner 2, and so on\n", "l12, l13, ...");
  const auto names_in = [](NameScope scope) {
    for (const FormulaName& name : formula_names())
      if (name.scope == scope) print("  {:<22} {}\n", name.name, name.doc);
  };
  names_in(NameScope::Element);
  print("\nNames of a corner: a formula with them is the least over the corners, if it does not gather them itself\n");
  names_in(NameScope::Corner);
  print("\nNames of an edge, for min_edge(...) and its like\n");
  names_in(NameScope::Edge);
  print("\nFunctions\n");
  for (const FormulaFunction& f : formula_functions()) print("  {:<22} {}\n", fmt::format("{}({})", f.name, f.arguments), f.doc);
  print("\nSigns: + - * / ^ ( ), < <= > >= == != for conditions, && || ! to join them. What is divided by 0 is 0.\n");
  print(
      "Parts have names, 'a = l12/l13; 2*a': several lines or ';' between. For some kinds of elements alone: triangle {{ ... }} "
      "quadrilateral {{ ... }}.\n");
  print("\nThe built-in metrics as formulas\n");
  for (const MetricInfo& m : metric_table()) print("  {:<22} {}\n", m.name, formula_of(m.metric));
  for (const NamedFormula& m : named_formulas()) print("  {:<22} {}\n", m.name, m.formula);
}

int formula(const FormulaOptions& options) {
  if (options.text.empty()) {
    print_vocabulary();
    return 0;
  }
  const Metric metric = parse_metric(options.text.starts_with("formula:") ? options.text : "formula:" + options.text);
  const DefinedMetric& known = defined(metric);
  if (options.json) {
    print_json({{"name", known.name},
                {"title", known.title},
                {"elements", words(known.info.kinds)},
                {"scale_free", known.formula->scale_free()},
                {"least", known.facts.least},
                {"greatest", known.facts.greatest},
                {"warnings", known.facts.warnings}});
    return 0;
  }
  print("{}\n", known.formula->text());
  print("  for       {}\n", words(known.info.kinds));
  print("  facts     {}\n", known.facts.summary);
  for (const std::string& warning : known.facts.warnings) print("  warning   {}\n", warning);
  if (known.facts.warnings.empty())
    print("  contract  kept: higher is better, 1 for the ideal element and at most, 0 or less where an element is inverted\n");
  return 0;
}

}  // namespace

void add_formula(CLI::App& app, Action& action) {
  auto options = std::make_shared<FormulaOptions>();
  CLI::App* subcommand =
      app.add_subcommand("formula", "Check a metric that is written as a formula; without one, list what formulas may use");
  subcommand->add_option("TEXT", options->text, "The formula, or @FILE for one in a file")->type_name("TEXT");
  subcommand->add_flag("--json", options->json, "Print one JSON object and nothing else on standard output");
  subcommand->callback([options, &action] { action = [options] { return formula(*options); }; });
}

}  // namespace dmoscope::app
