#include "app/comparison/report.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <thread>

#include <fmt/format.h>

#include "app/common/machine.h"
#include "app/common/quality_report.h"
#include "app/common/smooth_report.h"
#include "app/pages/page.h"
#include "core/session/csv.h"

namespace dmoscope::app {

namespace {

std::string spread_sentence(const OrderSpread& s) {
  return fmt::format("{}: minimum {} to {}; largest difference of the sorted qualities {}, at rank {} of {}; mean difference {}", s.name,
                     brief(s.lowest_minimum), brief(s.highest_minimum), brief(s.largest_difference), grouped(s.rank + 1),
                     grouped(s.elements), brief(s.mean_difference));
}

std::vector<const JudgedRun*> every_run(const Comparison& comparison) {
  std::vector<const JudgedRun*> runs;
  for (const JudgedRun& run : comparison.runs) runs.push_back(&run);
  for (const JudgedRun& run : comparison.shuffled) runs.push_back(&run);
  return runs;
}

/// Sentences about the ends of runs that have gone back to an iteration before their last, or had later phases.
std::vector<std::string> endings(const Comparison& comparison) {
  std::vector<std::string> lines;
  for (const JudgedRun* run : every_run(comparison))
    if (run->outcome.best || run->outcome.phases != RunPhases{})
      lines.push_back(fmt::format("{}: {}{}{}", run->name, run->outcome.sentence(), run->held.empty() ? "" : ". ", run->held));
  return lines;
}

/// One line per run: the verdict of its report card.
std::vector<std::string> verdicts(const Comparison& comparison) {
  std::vector<std::string> lines;
  for (const JudgedRun& run : comparison.runs) lines.push_back(fmt::format("{}: {}", run.name, run.card.sentence(true)));
  return lines;
}

/// Adds all figures of the runs' report cards, a column a run; those worse than in the input are marked.
void add_cards(Page& page, const Comparison& comparison) {
  std::vector<std::string> head{"figure", "input"};
  std::vector<const CardFigure*> figures;  // figures of all cards
  const auto same = [](const CardFigure& a) { return [&a](const CardFigure* b) { return a.of == b->of && a.name == b->name; }; };
  for (const JudgedRun& run : comparison.runs) {
    head.push_back(run.name);
    for (const CardFigure& figure : run.card.figures)
      if (std::ranges::none_of(figures, same(figure))) figures.push_back(&figure);
  }
  std::vector<std::vector<PageCell>> rows;
  for (const CardFigure* figure : figures) {
    const std::string name = figure->of.empty() ? figure->name : fmt::format("{}: {}", figure->of, figure->name);
    auto& row = rows.emplace_back(std::vector<PageCell>{{name, name}, number_cell(brief(figure->before), figure->before)});
    for (const JudgedRun& run : comparison.runs) {
      const auto at = std::ranges::find_if(run.card.figures, [&](const CardFigure& one) { return same(one)(figure); });
      if (at == run.card.figures.end()) {
        row.push_back({});
        continue;
      }
      row.push_back(number_cell(brief(at->after), at->after));
      if (at->verdict == Verdict::Worse) row.back().style = "bad";
    }
  }
  page.heading("Against the input");
  for (const std::string& line : verdicts(comparison)) page.paragraph(line + ".");
  page.table(head, {}, rows);
}

/// Lines about the input and the runs with elements that are inverted inside alone, with places.
std::vector<std::string> inverted_inside(const Comparison& comparison) {
  std::vector<std::string> lines;
  const auto look_at = [&](const std::string& name, std::span<const Vec3> positions, Index inverted) {
    if (inverted == 0) return;
    const InvertedCount found = count_inverted(comparison.input->quality_context(), positions);
    if (found.inside_alone > 0) lines.push_back(fmt::format("{}: {}", name, sentence_of(found)));
  };
  look_at("input", comparison.input->mesh.positions, comparison.runs.front().before().inverted);
  for (const JudgedRun& run : comparison.runs) look_at(run.name, run.positions, run.after.inverted);
  return lines;
}

/// The input as a row beside the runs.
RunRow input_row(const Comparison& comparison) {
  return row_of_input(comparison.judge, comparison.runs.front().before(), comparison.input_percentiles);
}

std::vector<RunRow> shown_rows(const Comparison& comparison) {
  std::vector<RunRow> rows{input_row(comparison)};
  for (const JudgedRun& run : comparison.runs) rows.push_back(run.row);
  return rows;
}

/// Columns for the user; the CSV has all. Those of sizes are there only if a run has a size function.
std::vector<const RunColumn*> shown_columns(std::span<const RunRow> rows) {
  std::vector<const RunColumn*> columns;
  for (const char* name : {"run", "backend", "iterations", "min_quality", "movable_minimum", "mean_quality", "p1", "p5", "inverted",
                           "input_size_correlation", "size_correlation", "seconds", "vertices_per_second"}) {
    const RunColumn& column = run_column(name);
    if (!column.name.ends_with("size_correlation") || has_values(rows, column)) columns.push_back(&column);
  }
  return columns;
}

Json json_of(const JudgedRun& run) {
  const RunParameters& p = run.parameters;
  Json object{{"run", run.name},
              {"method", p.method},
              {"metric", info(p.metric).name},
              {"backend", run.row.backend},
              {"backend_reason", run.backend_reason},
              {"order", to_text(p.order)},
              {"iterations", run.row.iterations},
              {"judged_iteration", run.outcome.best.value_or(run.outcome.ended)},
              {"converged", run.outcome.reason != StopReason::IterationLimit},
              {"outcome", run.outcome.sentence()},
              {"held_by", run.held.empty() ? Json(nullptr) : Json(run.held)},
              {"report_card", card_json(run.card)}};
  for (const RunColumn& column : run_columns()) {
    if (column.is_word() || object.contains(column.name)) continue;
    const double value = std::get<double>(cell(run.row, column));
    object[std::string(column.name)] = column.is_count ? Json(static_cast<std::uint64_t>(value)) : json_number(value);
  }
  return object;
}

/// The largest quality of a column among the runs, if they differ; else NaN.
double best_of(const Comparison& comparison, const RunColumn& column) {
  if (column.is_word() || column.is_count || column.name == "seconds" || column.name == "vertices_per_second" ||
      column.name == "input_size_correlation")
    return RunRow::kUnknown;
  double best = RunRow::kUnknown, least = RunRow::kUnknown;
  for (const JudgedRun& run : comparison.runs) {
    const double value = std::get<double>(cell(run.row, column));
    if (!std::isfinite(value)) continue;
    best = std::fmax(best, value);
    least = std::fmin(least, value);
  }
  return best > least ? best : RunRow::kUnknown;
}

std::vector<std::vector<PageCell>> page_rows(const Comparison& comparison) {
  const std::vector<RunRow> rows = shown_rows(comparison);
  const auto columns = shown_columns(rows);
  std::vector<std::vector<PageCell>> cells;
  for (const RunRow& row : rows) {
    std::vector<PageCell>& line = cells.emplace_back();
    for (const RunColumn* column : columns) {
      std::string text = cell_text(row, *column);
      if (column->is_word()) {
        line.push_back({text, text});
      } else {
        const double value = std::get<double>(cell(row, *column));
        line.push_back(number_cell(std::move(text), value));
        if (&row != &rows.front() && value == best_of(comparison, *column)) line.back().style = "best";
      }
    }
  }
  return cells;
}

void add_orders(Page& page, const Comparison& comparison) {
  if (comparison.orders.empty()) return;
  page.heading("Robustness against the order of the vertices");
  page.paragraph(
      "Every run was done again with its vertices shuffled. The qualities of all elements are sorted, the worst first; the "
      "difference is between the highest and the lowest of these curves at one rank.");
  std::vector<std::vector<PageCell>> rows;
  for (const OrderSpread& s : comparison.orders) {
    rows.push_back({{s.name, s.name},
                    number_cell(fmt::format("{}", s.orders), static_cast<double>(s.orders)),
                    number_cell(brief(s.lowest_minimum), s.lowest_minimum),
                    number_cell(brief(s.highest_minimum), s.highest_minimum),
                    number_cell(brief(s.largest_difference), s.largest_difference),
                    number_cell(fmt::format("{} of {}", grouped(s.rank + 1), grouped(s.elements)), static_cast<double>(s.rank)),
                    number_cell(brief(s.mean_difference), s.mean_difference)});
  }
  page.table({"run", "orders", "lowest minimum", "highest minimum", "largest difference", "at rank", "mean difference"}, {}, rows);
}

/// Low end of the pictures' colours: the least quality in any of them, rounded down to a tenth. From 0 on, good meshes would have one
/// colour.
double low_end(const Comparison& comparison) {
  double worst = comparison.runs.front().before().minimum;
  for (const JudgedRun& run : comparison.runs) worst = std::fmin(worst, run.row.minimum);
  return std::clamp(std::floor(10.0 * worst) / 10.0, 0.0, 0.9);
}

void add_pictures(Page& page, const Comparison& comparison, const Progress& progress) {
  const double low = low_end(comparison);
  std::vector<std::pair<std::string, MeshPicture>> pictures;
  const auto add = [&](std::string caption, std::span<const Vec3> positions) {
    pictures.emplace_back(std::move(caption), picture_of_mesh(*comparison.input, positions, comparison.judge, progress, low));
  };
  add(fmt::format("input, minimum {}", brief(comparison.runs.front().before().minimum)), comparison.input->mesh.positions);
  for (const JudgedRun& run : comparison.runs) add(fmt::format("{}, minimum {}", run.name, brief(run.row.minimum)), run.positions);
  page.heading("Pictures");
  page.pictures(pictures, info(comparison.judge).name, low);
}

void add_settings(Page& page, const Comparison& comparison, const ComparisonFacts& facts) {
  const CompareOptions& options = facts.options;
  const SearchParameters& search = comparison.runs.front().parameters.search;
  const Mesh& mesh = comparison.input->mesh;
  std::vector<std::pair<std::string, std::string>> list{
      {"command", facts.command_line},
      {"mesh", fmt::format("{}: {}, {}, {} free to move", options.file.string(), counted(mesh.vertex_count(), "vertex", "vertices"),
                           counted(mesh.elements.size(), "element", "elements"), grouped(comparison.free))},
      {"goal", facts.goal},
      {"judged by", fmt::format("{}: {}", info(comparison.judge).name, info(comparison.judge).doc)},
      {"search of dmo", fmt::format("{0} x {0}{1} candidates, {2}, first grid {3:g} of the star's box, in {4}", search.grid_points,
                                    comparison.input->is_volume() ? fmt::format(" x {}", search.grid_points) : "",
                                    counted(static_cast<std::uint64_t>(search.levels), "level", "levels"), search.omega,
                                    options.run.combine.empty() ? name(search.precision) : "double")},
      {"order",
       options.run.parameters.at("order") + (options.shuffles > 0 ? fmt::format(", and {} shuffled ones", options.shuffles) : "")}};
  list.emplace_back("interfaces", options.run.parameters.at("interfaces"));
  if (const auto& fix = options.run.selections.fix.words; !fix.empty())
    list.emplace_back("kept where they are", fmt::format("{}", fmt::join(fix, "; ")));
  for (auto& fact : machine_facts(facts.threads)) list.push_back(std::move(fact));
  if (facts.command_line.empty()) list.erase(list.begin());
  page.heading("Settings");
  page.facts(list);
  for (const std::string& warning : facts.warnings) page.paragraph("Note: " + warning);
}

}  // namespace

std::string goal_sentence(const Goal& goal) {
  if (!goal.until_converged) return counted(goal.iterations, "iteration", "iterations");
  return fmt::format(
      "until converged: no vertex moves, or no rise of the minimum by {:g} in {}; at most {}; then back at the best iteration",
      goal.until_converged->rise, counted(goal.until_converged->patience, "iteration", "iterations"), goal.until_converged->max_iterations);
}

std::vector<std::pair<std::string, std::string>> machine_facts(unsigned threads) {
  return {{"program", fmt::format("dmoscope {}, commit {}; {}, {}", DMOSCOPE_VERSION, commit(), compiler(), DMOSCOPE_BUILD_TYPE)},
          {"machine",
           fmt::format("{}, {}; {} used", processor(),
                       counted(std::max(1U, std::thread::hardware_concurrency()), "processor thread", "processor threads"), threads)},
          {"date", date_and_time()}};
}

PageCell number_cell(std::string text, double value) {
  return {std::move(text), std::isfinite(value) ? fmt::format("{}", value) : std::string(), true};
}

std::string text_of(const Comparison& comparison) {
  const std::vector<RunRow> shown = shown_rows(comparison);
  const auto columns = shown_columns(shown);
  std::vector<std::string> head;
  std::string alignment;
  for (const RunColumn* column : columns) {
    head.emplace_back(column->title);
    alignment += column->is_word() ? 'l' : 'r';
  }
  std::vector<std::vector<std::string>> rows;
  for (const RunRow& row : shown) {
    auto& cells = rows.emplace_back();
    for (const RunColumn* column : columns) cells.push_back(cell_text(row, *column));
  }
  const Mesh& mesh = comparison.input->mesh;
  std::string text =
      fmt::format("{}: {}, {}, {} free; qualities by {}\n\n", mesh.name, counted(mesh.vertex_count(), "vertex", "vertices"),
                  counted(mesh.elements.size(), "element", "elements"), grouped(comparison.free), info(comparison.judge).name);
  text += text_table(head, rows, alignment);
  std::vector<std::string> lines = inverted_inside(comparison);
  std::ranges::move(endings(comparison), std::back_inserter(lines));
  std::ranges::move(verdicts(comparison), std::back_inserter(lines));
  text += '\n';
  for (const std::string& line : lines) text += line + '\n';
  if (!comparison.orders.empty())
    text += fmt::format("\n{}, the natural one included:\n", counted(comparison.orders.front().orders, "order", "orders"));
  for (const OrderSpread& spread : comparison.orders) text += "  " + spread_sentence(spread) + '\n';
  for (const LeftOut& left : comparison.left_out) text += fmt::format("left out: {}: {}\n", left.name, left.reason);
  return text;
}

Json json_of(const Comparison& comparison, const ComparisonFacts& facts) {
  const Mesh& mesh = comparison.input->mesh;
  const Statistics& before = comparison.runs.front().before();
  Json runs = Json::array(), orders = Json::array(), left = Json::array();
  for (const JudgedRun* run : every_run(comparison)) runs.push_back(json_of(*run));
  for (const OrderSpread& s : comparison.orders) {
    orders.push_back({{"run", s.name},
                      {"orders", s.orders},
                      {"lowest_minimum", json_number(s.lowest_minimum)},
                      {"highest_minimum", json_number(s.highest_minimum)},
                      {"largest_difference", json_number(s.largest_difference)},
                      {"rank", s.rank},
                      {"mean_difference", json_number(s.mean_difference)}});
  }
  for (const LeftOut& one : comparison.left_out) left.push_back({{"run", one.name}, {"reason", one.reason}});
  return {{"input", facts.options.file.string()},
          {"vertices", mesh.vertex_count()},
          {"elements", mesh.elements.size()},
          {"free", comparison.free},
          {"judged_by", info(comparison.judge).name},
          {"goal", facts.goal},
          {"threads", facts.threads},
          {"before",
           {{"min_quality", json_number(before.minimum)},
            {"movable_minimum", json_number(before.movable_minimum)},
            {"mean_quality", json_number(before.mean)},
            {"inverted", before.inverted}}},
          {"runs", std::move(runs)},
          {"orders", std::move(orders)},
          {"left_out", std::move(left)},
          {"warnings", facts.warnings}};
}

std::string statistics_csv(const Comparison& comparison) {
  std::vector<std::string> titles;
  std::vector<const std::vector<IterationRecord>*> records;
  for (const JudgedRun* run : every_run(comparison)) {
    titles.push_back(run->name);
    records.push_back(&run->records);
  }
  return stats_csv(titles, records);
}

std::string table_csv(const Comparison& comparison) {
  std::vector<RunRow> rows{input_row(comparison)};
  for (const JudgedRun* run : every_run(comparison)) rows.push_back(run->row);
  return run_table_csv(rows);
}

std::string html_of(const Comparison& comparison, const ComparisonFacts& facts, const Progress& progress) {
  Page page(fmt::format("{}: {} compared", comparison.input->mesh.name, counted(comparison.runs.size(), "run", "runs")));
  page.paragraph(
      fmt::format("{}. All qualities are by {}: 1 is the ideal element, 0 or less an inverted one. Click a column heading to sort.",
                  facts.goal, info(comparison.judge).name));
  std::vector<std::string> head, hints;
  for (const RunColumn* column : shown_columns(shown_rows(comparison))) {
    head.emplace_back(column->title);
    hints.emplace_back(column->doc);
  }
  page.table(head, hints, page_rows(comparison), 1);  // the input stays on top, as in the window
  for (const std::string& line : inverted_inside(comparison)) page.paragraph(line + ".");
  for (const std::string& line : endings(comparison)) page.paragraph(line + ".");
  for (const LeftOut& left : comparison.left_out) page.paragraph(fmt::format("Left out: {}: {}", left.name, left.reason));
  page.heading("Convergence");
  page.plot(draw(convergence_plot(comparison)));
  page.plot(draw(mean_plot(comparison)));
  page.heading("Sorted qualities");
  page.plot(draw(sorted_plot(comparison)));
  add_cards(page, comparison);
  add_orders(page, comparison);
  add_pictures(page, comparison, progress);
  add_settings(page, comparison, facts);
  return page.text();
}

}  // namespace dmoscope::app
