#include "app/paper/pages.h"

#include <cmath>

#include <fmt/format.h>

#include "app/common/text.h"
#include "app/comparison/report.h"
#include "app/pages/page.h"
#include "core/base/csv_text.h"
#include "core/base/error.h"
#include "core/io/writing/atomic_file.h"

namespace dmoscope::app {

namespace {

std::string short_number(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-"; }
std::string short_number(const std::optional<double>& value) { return value ? short_number(*value) : ""; }

std::string exact_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::string style_of(Verdict verdict) {
  if (verdict == Verdict::Holds) return "good";
  return verdict == Verdict::Differs ? "bad" : "dim";
}

std::string plot_csv(const LinePlot& plot) {
  std::string text = "series,x,y\n";
  std::size_t unnamed = 0;
  for (const PlotSeries& series : plot.series) {
    const std::string title = series.name.empty() ? fmt::format("curve {}", ++unnamed) : series.name;
    for (const PlotValue& v : series.values) text += fmt::format("{},{},{}\n", csv_text(title), v.x, exact_number(v.y));
  }
  return text;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw OutputError(folder.string(), error.message());
}

std::vector<PageCell> page_row(const Finding& f) {
  return {{f.figure, f.figure},
          {f.mesh, f.mesh},
          {f.what, f.what},
          {f.paper, f.paper},
          number_cell(std::isnan(f.ours) ? "" : short_number(f.ours), f.ours),
          number_cell(short_number(f.difference), f.difference.value_or(std::nan(""))),
          {f.tolerance, f.tolerance},
          {std::string(name(f.verdict)), std::string(name(f.verdict)), false, style_of(f.verdict)},
          {f.why, f.why}};
}

const std::vector<std::string> kHead{"figure", "mesh", "what", "paper", "ours", "difference", "tolerance", "verdict", "why"};

}  // namespace

std::string findings_text(const std::vector<Figure>& figures) {
  std::vector<std::vector<std::string>> rows;
  for (const Figure& figure : figures)
    for (const Finding& f : figure.findings)
      rows.push_back({f.figure, f.mesh, f.what, f.paper, std::isnan(f.ours) ? "" : short_number(f.ours), short_number(f.difference),
                      f.tolerance, std::string(name(f.verdict))});
  return text_table({kHead.begin(), kHead.end() - 1}, rows, "llllrrll");
}

std::string findings_csv(const std::vector<Figure>& figures) {
  std::string text = "figure,mesh,what,paper,ours,difference,tolerance,verdict,why\n";
  for (const Figure& figure : figures)
    for (const Finding& f : figure.findings)
      text += fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_text(f.figure), csv_text(f.mesh), csv_text(f.what), csv_text(f.paper),
                          exact_number(f.ours), f.difference ? exact_number(*f.difference) : "", csv_text(f.tolerance), name(f.verdict),
                          csv_text(f.why));
  return text;
}

std::string findings_page(const std::vector<Figure>& figures, const std::vector<std::pair<std::string, std::string>>& facts) {
  Page page("Discrete Mesh Optimization on GPU: the paper's figures again");
  page.paragraph(
      "The experiments of Sections 5.1 to 5.4 of the paper by Zint and Grosso (2018), done by this program. \"Holds\" and \"differs\" say "
      "whether "
      "what is claimed is so within its tolerance; \"told\" is a figure beside the paper's of which nothing is claimed. A stand-in is a "
      "mesh that "
      "this program makes where the paper's was not published.");
  std::vector<std::vector<PageCell>> rows;
  for (const Figure& figure : figures)
    for (const Finding& f : figure.findings) rows.push_back(page_row(f));
  page.table(kHead, {}, rows);
  for (const Figure& figure : figures) {
    if (figure.plots.empty() && figure.pictures.empty() && figure.notes.empty()) continue;
    page.heading(fmt::format("{}: {}", figure.id, figure.title));
    for (const std::string& note : figure.notes) page.paragraph(note);
    for (const auto& [file, plot] : figure.plots) page.plot(draw(plot));
    if (!figure.pictures.empty()) page.pictures(figure.pictures, figure.pictured_metric);
  }
  page.heading("Settings");
  page.facts(facts);
  return page.text();
}

void write_figures(const std::filesystem::path& folder, const std::vector<Figure>& figures) {
  for (const Figure& figure : figures) {
    const std::filesystem::path here = folder / figure.id;
    if (!figure.plots.empty() || !figure.pictures.empty()) make_folder(here);
    for (const auto& [file, plot] : figure.plots) {
      write_file_atomically(here / (file + ".svg"), svg_of(draw(plot)));
      write_file_atomically(here / (file + ".csv"), plot_csv(plot));
    }
    std::size_t number = 0;
    for (const auto& [caption, picture] : figure.pictures) {
      ++number;
      if (!picture.png.empty()) write_file_atomically(here / fmt::format("picture-{}.png", number), picture.png);
    }
  }
}

}  // namespace dmoscope::app
