#include "core/drawing/drawing.h"

#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "core/base/xml_text.h"

namespace dmoscope {
namespace {

std::string hex(DrawingColour c) { return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b); }

std::string_view name(Drawing::Anchor anchor) {
  if (anchor == Drawing::Anchor::Start) return "start";
  return anchor == Drawing::Anchor::Middle ? "middle" : "end";
}

/// The end of an SVG element, with a title element before it if there is a title.
std::string close(std::string_view element, const std::string& title) {
  return title.empty() ? "/>\n" : fmt::format("><title>{}</title></{}>\n", xml_escaped(title), element);
}

void add_lines(std::string& svg, const std::vector<Drawing::Line>& lines) {
  const auto out = std::back_inserter(svg);
  for (const Drawing::Line& line : lines) {
    fmt::format_to(out, "<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"", hex(line.colour), line.width);
    if (line.dash > 0.0) fmt::format_to(out, " stroke-dasharray=\"{:g}\"", line.dash);
    svg += " points=\"";
    for (const Drawing::Point& p : line.points) fmt::format_to(out, "{:.2f},{:.2f} ", p.x, p.y);
    svg += '"' + close("polyline", line.name);
  }
}

}  // namespace

std::string svg_of(const Drawing& drawing) {
  std::string svg = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" "
      "viewBox=\"0 0 {0:g} {1:g}\" font-family=\"DejaVu Sans, Verdana, sans-serif\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"white\"/>\n",
      drawing.width, drawing.height);
  const auto out = std::back_inserter(svg);
  add_lines(svg, drawing.rules);
  for (const Drawing::Box& box : drawing.boxes) {
    fmt::format_to(out, "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"", box.from.x, box.from.y,
                   box.to.x - box.from.x, box.to.y - box.from.y, hex(box.colour));
    if (box.opacity < 1.0) fmt::format_to(out, " fill-opacity=\"{:g}\"", box.opacity);
    svg += close("rect", box.name);
  }
  add_lines(svg, drawing.lines);
  for (const Drawing::Disc& disc : drawing.discs) {
    fmt::format_to(out, "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:g}\" fill=\"{}\"/>\n", disc.centre.x, disc.centre.y, disc.radius,
                   hex(disc.colour));
  }
  for (const Drawing::Label& label : drawing.labels) {
    fmt::format_to(out, "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:g}\" fill=\"{}\" text-anchor=\"{}\">{}</text>\n", label.at.x,
                   label.at.y, label.size, hex(label.colour), name(label.anchor), xml_escaped(label.text));
  }
  return svg + "</svg>\n";
}

}  // namespace dmoscope
