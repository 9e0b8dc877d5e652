#include "app/pages/page.h"

#include <span>

#include <fmt/format.h>

#include "core/base/xml_text.h"
#include "core/session/json_values.h"

namespace dmoscope::app {

namespace {

// No <, > or & in the style; no < and & in the script: the page is XML too.
constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; --ink: #1b1e23; --dim: #5c626c; --page: #ffffff; --line: #d5d9df; --stripe: #f5f6f8; --accent: #0b63a5;
  --good: #0a6b3d; --bad: #a3160b; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6e9ee; --dim: #a4acb8; --page: #1b1e23; --line: #3a4049; --stripe: #23272e;
  --accent: #6db8f0; --good: #67d39a; --bad: #ff8f80; } .plot svg { filter: invert(1) hue-rotate(180deg); mix-blend-mode: screen; } }
body { margin: 0 auto; max-width: 76rem; padding: 1.5rem; background: var(--page); color: var(--ink);
  font: 16px/1.5 "DejaVu Sans", "Segoe UI", Roboto, Verdana, sans-serif; }
h1 { font-size: 1.6rem; margin: 0 0 .5rem; } h2 { font-size: 1.2rem; margin: 2.2rem 0 .6rem; } h3 { font-size: 1rem; margin: 1.4rem 0 .4rem; }
p { max-width: 60rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .85rem; font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .7rem; text-align: left; vertical-align: top; border-bottom: 1px solid var(--line); }
th { position: sticky; top: 0; background: var(--page); white-space: nowrap; } tbody tr:nth-child(even) { background: var(--stripe); }
td.number { text-align: right; white-space: nowrap; } th.number { text-align: right; }
th button { all: unset; cursor: pointer; font-weight: bold; } th button:focus-visible { outline: 2px solid var(--accent); }
th[aria-sort=ascending] button::after { content: " \2191"; } th[aria-sort=descending] button::after { content: " \2193"; }
.good { color: var(--good); } .best { font-weight: bold; } .bad { color: var(--bad); font-weight: bold; } .dim { color: var(--dim); }
.plot { margin: 1rem 0; overflow-x: auto; } .plot svg { max-width: 100%; height: auto; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(20rem, 1fr)); gap: 1rem; }
figure { margin: 0; } figure img { width: 100%; height: auto; } figcaption { font-size: .85rem; color: var(--dim); overflow-wrap: anywhere; }
.bar { display: flex; gap: .6rem; align-items: center; margin: .8rem 0; font-size: .85rem; color: var(--dim); }
.bar .map { display: inline-block; width: 16rem; height: .9rem; } .bar .inverted { display: inline-block; width: .9rem; height: .9rem;
  background: #ff00ff; margin-left: 1rem; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .2rem 1.2rem; font-size: .9rem; } dt { color: var(--dim); }
dd { margin: 0; overflow-wrap: anywhere; }
)";

constexpr std::string_view kScript = R"(
for (const table of document.querySelectorAll('table')) {
  const heads = Array.from(table.tHead.rows[0].cells);
  const made = Array.from(table.tBodies[0].rows).filter(row => row.className !== 'kept');
  heads.forEach((head, column) => {
    head.querySelector('button').addEventListener('click', () => {
      // Orders rows as the window does: numbers begin with the largest; then the other way; then as they were made.
      const ways = head.classList.contains('number') ? ['descending', 'ascending'] : ['ascending', 'descending'];
      const way = ways[ways.indexOf(head.getAttribute('aria-sort')) + 1];
      heads.forEach(other => other.removeAttribute('aria-sort'));
      const rows = made.slice();
      if (way) {
        head.setAttribute('aria-sort', way);
        const key = row => row.cells[column].dataset.key;
        rows.sort((a, b) => {
          const p = key(a), q = key(b);
          if (p === '' || q === '') return (p === '') - (q === '');
          const x = Number(p), y = Number(q);
          const order = Number.isNaN(x) || Number.isNaN(y) ? p.localeCompare(q) : x - y;
          return way === 'descending' ? -order : order;
        });
      }
      rows.forEach(row => table.tBodies[0].append(row));
    });
  });
}
)";

std::string base64_of(const std::string& bytes) {
  return to_base64(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
}

std::string class_of(const PageCell& cell) {
  std::string names = cell.is_number ? "number" : "";
  if (!cell.style.empty()) names += (names.empty() ? "" : " ") + cell.style;
  return names.empty() ? "" : fmt::format(" class=\"{}\"", names);
}

}  // namespace

void Page::heading(std::string_view text, int level) { body_ += fmt::format("<h{0}>{1}</h{0}>\n", level, xml_escaped(text)); }

void Page::paragraph(std::string_view text) { body_ += fmt::format("<p>{}</p>\n", xml_escaped(text)); }

void Page::facts(const std::vector<std::pair<std::string, std::string>>& facts) {
  body_ += "<dl>\n";
  for (const auto& [name, value] : facts) body_ += fmt::format("<dt>{}</dt><dd>{}</dd>\n", xml_escaped(name), xml_escaped(value));
  body_ += "</dl>\n";
}

void Page::table(const std::vector<std::string>& head, const std::vector<std::string>& hints,
                 const std::vector<std::vector<PageCell>>& rows, std::size_t kept) {
  body_ += "<div class=\"scroll\"><table>\n<thead><tr>";
  for (std::size_t i = 0; i < head.size(); ++i) {
    const bool number = !rows.empty() && rows.front()[i].is_number;
    const std::string hint = i < hints.size() && !hints[i].empty() ? fmt::format(" title=\"{}\"", xml_escaped(hints[i])) : "";
    body_ += fmt::format("<th scope=\"col\"{}{}><button type=\"button\">{}</button></th>", number ? " class=\"number\"" : "", hint,
                         xml_escaped(head[i]));
  }
  body_ += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) {
    body_ += static_cast<std::size_t>(&row - rows.data()) < kept ? "<tr class=\"kept\">" : "<tr>";
    for (const PageCell& cell : row)
      body_ += fmt::format("<td{} data-key=\"{}\">{}</td>", class_of(cell), xml_escaped(cell.key), xml_escaped(cell.text));
    body_ += "</tr>\n";
  }
  body_ += "</tbody>\n</table></div>\n";
}

void Page::plot(const Drawing& drawing) {
  const std::string svg = svg_of(drawing);
  body_ += "<div class=\"plot\">\n" + svg.substr(svg.find("<svg")) + "</div>\n";  // without the XML declaration in the file's first line
}

void Page::pictures(const std::vector<std::pair<std::string, MeshPicture>>& pictures, std::string_view metric, double low) {
  body_ += "<div class=\"pictures\">\n";
  bool any = false;
  for (const auto& [caption, picture] : pictures) {
    const std::string text = xml_escaped(caption);
    body_ += "<figure>";
    if (picture.png.empty()) {
      body_ += fmt::format("<p class=\"dim\">No picture: {}</p>", xml_escaped(picture.why_not));
    } else {
      any = true;
      body_ += fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\" />", text, base64_of(picture.png));
    }
    body_ += fmt::format("<figcaption>{}</figcaption></figure>\n", text);
  }
  body_ += "</div>\n";
  if (!any) return;
  body_ += fmt::format(
      "<div class=\"bar\">{} {:g} <span class=\"map\" style=\"background: {}\"></span> 1 <span class=\"inverted\"></span> inverted</div>\n",
      xml_escaped(metric), low, quality_gradient());
}

std::string Page::text() const {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n<meta charset=\"utf-8\" />\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n<title>{0}</title>\n<style>{1}</style>\n</head>\n"
      "<body>\n<h1>{0}</h1>\n{2}<script>{3}</script>\n</body>\n</html>\n",
      xml_escaped(title_), kStyle, body_, kScript);
}

}  // namespace dmoscope::app
