#include "ui/plots/plot_drawing.h"

#include <algorithm>
#include <cmath>

namespace dmoscope::ui {
namespace {

using Point = Drawing::Point;
using Points = std::vector<Point>;

DrawingColour ink(render::Rgb c) { return {c.r, c.g, c.b}; }

/// Colour mixed with the background; `strength`: share of the colour.
DrawingColour mixed(render::Rgb colour, render::Rgb background, double strength) {
  const auto channel = [strength](std::uint8_t c, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(b + std::clamp(strength, 0.0, 1.0) * (c - b)));
  };
  return {channel(colour.r, background.r), channel(colour.g, background.g), channel(colour.b, background.b)};
}

struct PlotFrame {
  double left, top, right, bottom;
};

/// Cuts the stretch from a to b to the part inside the frame (Liang and Barsky). False: there is none.
bool clip(Point& a, Point& b, const PlotFrame& f) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  double t0 = 0.0, t1 = 1.0;
  const auto cut = [&](double step, double room) {  // demands step * t <= room
    if (step == 0.0) return room >= 0.0;
    if (step < 0.0) t0 = std::max(t0, room / step);
    if (step > 0.0) t1 = std::min(t1, room / step);
    return t0 <= t1;
  };
  if (!cut(-dx, a.x - f.left) || !cut(dx, f.right - a.x) || !cut(-dy, a.y - f.top) || !cut(dy, f.bottom - a.y)) return false;
  const Point from = a;
  if (t0 > 0.0) a = {from.x + t0 * dx, from.y + t0 * dy};
  if (t1 < 1.0) b = {from.x + t1 * dx, from.y + t1 * dy};
  return true;
}

/// The stretches of a line that lie inside the frame.
std::vector<Points> clipped(const Points& points, const PlotFrame& frame) {
  std::vector<Points> parts;
  bool joined = false;  // the last part ends where the next stretch begins
  for (std::size_t k = 1; k < points.size(); ++k) {
    Point a = points[k - 1], b = points[k];
    if (!clip(a, b, frame)) {
      joined = false;
      continue;
    }
    if (!joined) parts.push_back({a});
    parts.back().push_back(b);
    joined = b.x == points[k].x && b.y == points[k].y;
  }
  return parts;
}

bool inside(Point p, const PlotFrame& f) { return p.x >= f.left && p.x <= f.right && p.y >= f.top && p.y <= f.bottom; }

/// Draws the series of one plot.
class SeriesDrawer {
 public:
  SeriesDrawer(Drawing& drawing, const Plot& plot, const PlotLayout& layout, const PlotInk& colours, double unit)
      : drawing_(drawing), plot_(plot), layout_(layout), ink_(colours), unit_(unit) {}

  void draw(const Series& one) {
    if (one.strip && !layout_.strip) return;
    const Axis& y = one.strip ? *layout_.strip : layout_.y;
    const PlotFrame frame{layout_.left, y.to, layout_.right, y.from};
    if (one.kind == Series::Kind::Bars) {
      draw_bars(one, y, frame);
    } else if (one.kind == Series::Kind::Steps) {
      draw_steps(one, y, frame);
    } else {
      draw_line(one, y, frame);
    }
  }

 private:
  void add_line(const Series& one, const Points& points, const PlotFrame& frame) {
    for (Points& part : clipped(points, frame)) {
      drawing_.lines.push_back(
          {std::move(part), mixed(one.colour, ink_.background, one.strength), one.width * unit_, one.dash * unit_, full_name(plot_, one)});
    }
  }

  void draw_line(const Series& one, const Axis& y, const PlotFrame& frame) {
    std::vector<double> values = one.y;
    for (double& value : values) value = can_show(y.kind, value) ? value : NAN;
    const auto columns = static_cast<std::size_t>(std::max(1.0, (frame.right - frame.left) / std::min(1.0, unit_)));
    const Axis& x = layout_.x;  // its columns are even in the axis' shape
    std::vector<double> along = one.x;
    for (double& at : along) at = x.shape(at);
    for (const Stroke& stroke : decimate(along, values, x.shape(x.low), x.shape(x.high), columns)) {
      Points points;
      points.reserve(stroke.size());
      for (const PlotPoint& p : stroke) points.push_back({x.place_shaped(p.x), y.place(p.y)});
      if (points.size() > 1) {
        add_line(one, points, frame);
      } else if (inside(points[0], frame)) {
        drawing_.discs.push_back({points[0], 2.5 * unit_, mixed(one.colour, ink_.background, one.strength)});
      }
    }
  }

  [[nodiscard]] bool in_brush(const Series& one, std::size_t k) const {
    if (!plot_.brush) return true;
    const double middle = one.x[k] + one.bar_width / 2;
    return middle >= plot_.brush->first && middle <= plot_.brush->second;
  }

  void draw_bars(const Series& one, const Axis& y, const PlotFrame& f) {
    for (std::size_t k = 0; k < one.x.size(); ++k) {
      if (!(one.y[k] > 0.0) || !can_show(y.kind, one.y[k])) continue;
      Point from{std::clamp(layout_.x.place(one.x[k]), f.left, f.right), std::clamp(y.place(one.y[k]), f.top, f.bottom)};
      Point to{std::clamp(layout_.x.place(one.x[k] + one.bar_width), f.left, f.right), f.bottom};
      if (to.x - from.x > 3.0 * unit_) to.x -= unit_;  // a gap between bars
      if (to.x <= from.x || to.y <= from.y) continue;
      drawing_.boxes.push_back({from, to, ink(one.colour), one.strength * (in_brush(one, k) ? 1.0 : 0.3), full_name(plot_, one)});
    }
  }

  void draw_steps(const Series& one, const Axis& y, const PlotFrame& frame) {
    Points points;
    for (std::size_t k = 0; k < one.x.size(); ++k) {
      const double left = layout_.x.place(one.x[k]), right = layout_.x.place(one.x[k] + one.bar_width);
      const bool empty = !(one.y[k] > 0.0) || !can_show(y.kind, one.y[k]);
      if (!empty && points.empty()) points.push_back({left, y.from});
      if (!empty) points.insert(points.end(), {{left, y.place(one.y[k])}, {right, y.place(one.y[k])}});
      const bool last = k + 1 == one.x.size();
      if (points.empty() || (!empty && !last)) continue;
      points.push_back({points.back().x, y.from});
      add_line(one, points, frame);
      points.clear();
    }
  }

  Drawing& drawing_;
  const Plot& plot_;
  const PlotLayout& layout_;
  const PlotInk& ink_;
  double unit_;
};

double width_of(const std::string& text, double size) {
  const auto letters = std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; });
  return 0.62 * size * static_cast<double>(letters);  // approximate width in DejaVu Sans, generously
}

int how_many(double length, double each) { return std::max(1, static_cast<int>(length / each)); }

void draw_axes(Drawing& drawing, const Plot& plot, const PlotLayout& layout, const PlotInk& colours, double font, double unit) {
  const DrawingColour grid = ink(colours.grid), dim = ink(colours.dim), frame = mixed(colours.dim, colours.background, 0.7);
  const auto across = [&](double y, DrawingColour colour) {
    drawing.rules.push_back({{{layout.left, y}, {layout.right, y}}, colour, unit});
  };
  const double room = layout.x.pivot > 0.0 ? 4.0 : 6.0;  // most labels of a logarithm are short
  const double end = layout.right + 0.7 * font;          // behind it there is no room
  for (const PlacedTick& tick : place_ticks(layout.x, plot.x_unit, plot.integer_x, how_many(layout.right - layout.left, room * font))) {
    drawing.rules.push_back({{{tick.place, layout.top}, {tick.place, layout.bottom}}, grid, unit});
    const bool at_end = tick.place + width_of(tick.label, font) / 2 > end;
    const Point at{at_end ? end : tick.place, layout.bottom + 1.2 * font};
    drawing.labels.push_back({at, tick.label, font, dim, at_end ? Drawing::Anchor::End : Drawing::Anchor::Middle});
  }
  const auto upright = [&](const Axis& axis, const AxisUnit& units, bool integer, double each) {
    double last = INFINITY;
    for (const PlacedTick& tick : place_ticks(axis, units, integer, std::max(2, how_many(axis.from - axis.to, each * font)))) {
      if (tick.label.empty() && std::abs(tick.place - last) < 0.4 * font) continue;  // too dense to be useful
      last = tick.place;
      across(tick.place, tick.label.empty() ? mixed(colours.grid, colours.background, 0.5) : grid);
      drawing.labels.push_back({{layout.left - 0.45 * font, tick.place + 0.36 * font}, tick.label, font, dim, Drawing::Anchor::End});
    }
    drawing.rules.push_back({{{layout.left, axis.from}, {layout.left, axis.to}}, frame, unit});
    across(axis.from, frame);
  };
  upright(layout.y, plot.y_unit, false, 1.5);
  if (!layout.strip) return;
  upright(*layout.strip, plot.strip_unit, plot.strip_unit.name.empty(), 1.3);
  drawing.labels.push_back(
      {{layout.right - 0.5 * font, layout.strip->to - 0.35 * font}, plot.strip_title, font, dim, Drawing::Anchor::End});
}

void draw_brush(Drawing& drawing, const Plot& plot, const PlotLayout& layout, const PlotInk& colours, double unit) {
  if (!plot.brush) return;
  const double left = std::clamp(layout.x.place(plot.brush->first), layout.left, layout.right);
  const double right = std::clamp(layout.x.place(plot.brush->second), layout.left, layout.right);
  if (right > left) drawing.boxes.push_back({{left, layout.top}, {right, layout.bottom}, ink(colours.accent), 0.13});
  for (const double x : {left, right})
    drawing.rules.push_back({{{x, layout.top}, {x, layout.bottom}}, mixed(colours.accent, colours.background, 0.8), unit});
}

/// Draws marks with their labels, each in the highest line where it lies on no curve and no other label, else in the highest.
void draw_marks(Drawing& drawing, const Plot& plot, const PlotLayout& layout, const PlotInk& colours, double font, double unit) {
  std::vector<Points> taken;  // curves, and the middles of the labels so far
  for (const Drawing::Line& line : drawing.lines) taken.push_back(line.points);
  const auto is_free = [&](const PlotFrame& box) {
    return std::ranges::all_of(taken, [&](const Points& points) { return clipped(points, box).empty(); });
  };
  for (const PlotMark& mark : plot.marks) {
    const double x = layout.x.place(mark.x);
    if (x < layout.left - 0.5 || x > layout.right + 0.5) continue;
    drawing.lines.push_back({{{x, layout.top}, {x, layout.bottom}}, mixed(colours.accent, colours.background, 0.8), 1.5 * unit});
    if (mark.label.empty()) continue;
    const double wide = 0.3 * font + width_of(mark.label, font);
    const bool room = x + wide < layout.right;
    PlotFrame box{room ? x : x - wide, layout.top, room ? x + wide : x, layout.top + 1.1 * font};
    const PlotFrame highest = box;
    while (!is_free(box) && box.bottom < layout.bottom) box = {box.left, box.bottom, box.right, box.bottom + 1.1 * font};
    if (box.bottom > layout.bottom) box = highest;
    taken.push_back({{box.left, (box.top + box.bottom) / 2}, {box.right, (box.top + box.bottom) / 2}});
    const Point at{room ? x + 0.3 * font : x - 0.3 * font, box.bottom - 0.2 * font};
    drawing.labels.push_back({at, mark.label, font, ink(colours.accent), room ? Drawing::Anchor::Start : Drawing::Anchor::End});
  }
}

/// Writes the name of each curve at its end, to the right of the plot if there is `room`, in letters of its colour: of several runs the
/// number of each, at its first curve. Names that would lie on one another move apart.
void draw_end_names(Drawing& drawing, const Plot& plot, const PlotView& view, const PlotLayout& layout, const PlotInk& colours, double font,
                    double room) {
  struct EndName {
    std::string text;
    double y;
    DrawingColour ink;
  };
  std::vector<EndName> names;
  const auto runs = std::ranges::count_if(plot.legend, [](const LegendEntry& entry) { return entry.of_run; });
  std::string_view last;
  for (const Series& one : plot.series) {
    if (one.kind != Series::Kind::Line || one.strip || !is_visible(plot, view, one) || one.x.empty()) continue;
    const double y = can_show(layout.y.kind, one.y.back()) ? layout.y.place(one.y.back()) : NAN;
    if ((runs > 1 && one.run == last) || !(y >= layout.y.to && y <= layout.y.from)) continue;
    last = one.run;
    const std::string& whole = runs > 1 ? one.run : one.name;
    const bool fits = width_of(whole, font) <= room;
    const std::string text = fits ? whole : runs > 1 ? whole.substr(0, whole.find(' ')) : std::string();
    if (!text.empty() && width_of(text, font) <= room)
      names.push_back({text, y, mixed(one.colour, colours.background, 0.6 + 0.4 * one.strength)});
  }
  std::ranges::sort(names, {}, &EndName::y);
  double lowest = layout.y.from + 0.4 * font - font * static_cast<double>(names.size()), next = -INFINITY;
  for (const EndName& name : names) {
    const double y = std::max(std::min(name.y + 0.36 * font, lowest += font), next);
    next = y + font;
    drawing.labels.push_back({{layout.right + 0.5 * font, y}, name.text, font, name.ink, Drawing::Anchor::Start});
  }
}

}  // namespace

PlotInk ink_of(const Palette& palette) { return {palette.panel, palette.text, palette.dim, palette.grid, palette.accent}; }

void draw_sample(Drawing& drawing, const Series& look, double x, double y, const PlotInk& colours, double unit) {
  if (look.kind == Series::Kind::Bars) {
    drawing.boxes.push_back({{x + 4.0 * unit, y - 5.0 * unit}, {x + 18.0 * unit, y + 5.0 * unit}, ink(look.colour), look.strength});
  } else {
    drawing.lines.push_back(
        {{{x, y}, {x + 22.0 * unit, y}}, mixed(look.colour, colours.background, look.strength), look.width * unit, look.dash * unit});
  }
}

void draw_plot_area(Drawing& drawing, const Plot& plot, const PlotView& view, const PlotLayout& layout, const PlotInk& colours, double font,
                    double unit, double beside) {
  draw_axes(drawing, plot, layout, colours, font, unit);
  SeriesDrawer drawer(drawing, plot, layout, colours, unit);
  // Thick lines, the active run's, come over the others; among these the first over later ones, in the order of the legend.
  std::vector<const Series*> order;
  for (const Series& one : plot.series) {
    if (is_visible(plot, view, one)) order.push_back(&one);
  }
  std::ranges::reverse(order);
  std::ranges::stable_sort(order, {}, [](const Series* one) { return one->kind == Series::Kind::Line ? one->width : 0.0; });
  for (const Series* one : order) drawer.draw(*one);
  draw_brush(drawing, plot, layout, colours, unit);
  draw_marks(drawing, plot, layout, colours, font, unit);
  draw_end_names(drawing, plot, view, layout, colours, font, beside - 0.5 * font);
}

Drawing whole_plot(const Plot& plot, const PlotView& view, double width, double height, const PlotInk& colours) {
  constexpr double kFont = 12.0, kMargin = 14.0, kRow = 18.0;
  Drawing drawing;
  drawing.width = width;
  drawing.height = height;
  double y = kMargin + 12.0;
  drawing.labels.push_back({{kMargin, y}, plot.title, 15.0, ink(colours.text), Drawing::Anchor::Start});
  y += 0.6 * kRow;
  double x = width;  // no room: a row begins
  for (const LegendEntry& entry : plot.legend) {
    if (!is_on(plot, view, entry)) continue;
    const double needed = 28.0 + width_of(entry.name, kFont);
    if (x + needed > width - kMargin) {
      x = kMargin;
      y += kRow;
    }
    draw_sample(drawing, entry.look, x, y - 4.0, colours, 1.0);
    drawing.labels.push_back({{x + 28.0, y}, entry.name, kFont, ink(colours.text), Drawing::Anchor::Start});
    x += needed + 16.0;
  }
  y += 1.3 * kRow;
  drawing.labels.push_back({{kMargin, y}, plot.y_title, kFont, ink(colours.dim), Drawing::Anchor::Start});
  drawing.labels.push_back({{width - kMargin, height - 8.0}, plot.x_title, kFont, ink(colours.dim), Drawing::Anchor::End});
  const PlotArea area{kMargin, y + 4.0, width - 2.0 * kMargin + 0.8 * kFont, height - y - 4.0 - 22.0, kFont};
  if (const auto layout = lay_out(plot, view, area)) {
    draw_plot_area(drawing, plot, view, *layout, colours, kFont, 1.0);
  } else {
    drawing.labels.push_back({{width / 2, height / 2}, plot.empty_text, kFont, ink(colours.dim), Drawing::Anchor::Middle});
  }
  return drawing;
}

}  // namespace dmoscope::ui
