#include "ui/plots/plot_interaction.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace dmoscope::ui {
namespace {

constexpr double kClick = 4.0;  // greatest movement of a click, in pixels at scale 1

/// One gesture in one frame.
class Gesture {
 public:
  Gesture(const PlotMouse& mouse, PlotDrag& drag, const Plot& plot, const PlotView& view, const PlotLayout& layout, double scale)
      : mouse_(mouse),
        drag_(drag),
        plot_(plot),
        view_(view),
        layout_(layout),
        scale_(scale),
        full_(x_extent(plot)),
        home_(plot.x_home.value_or(full_)) {}

  PlotOutcome handle() {
    if (mouse_.over && mouse_.wheel != 0.0) zoom_by_wheel();
    if (mouse_.over && mouse_.twice) {
      drag_ = {};
      send("plot-zoom all");
      return std::move(out_);
    }
    if (drag_.kind == PlotDrag::Kind::None) begin();
    if (drag_.kind != PlotDrag::Kind::None) go_on();
    return std::move(out_);
  }

 private:
  void send(std::string line) { out_.commands.push_back(std::move(line)); }

  void zoom_x(Range range) {
    range.first = std::max(range.first, full_.first);
    range.second = std::min(range.second, full_.second);
    const double hair = 1e-6 * (full_.second - full_.first);
    if (std::abs(range.first - home_.first) < hair && std::abs(range.second - home_.second) < hair) {
      if (view_.x_range) send("plot-zoom x all");
    } else if (range.second - range.first > hair) {
      send(fmt::format("plot-zoom x {} {}", range.first, range.second));
    }
  }
  void zoom_y(Range range) {
    if (range.second > range.first && std::isfinite(range.first) && std::isfinite(range.second))
      send(fmt::format("plot-zoom y {} {}", range.first, range.second));
  }

  /// Range of values after the axis' places have been stretched around `at` and moved.
  static Range stretched(const Axis& axis, double at, double factor, double move = 0.0) {
    const auto place = [&](double end) { return at + (end - at) * factor - move; };
    return {axis.value(place(axis.from)), axis.value(place(axis.to))};
  }

  void zoom_by_wheel() {
    const double factor = std::pow(0.8, mouse_.wheel);
    if (mouse_.x < layout_.left) {
      zoom_y(stretched(layout_.y, std::clamp(mouse_.y, layout_.y.to, layout_.y.from), factor));
    } else {
      zoom_x(stretched(layout_.x, std::clamp(mouse_.x, layout_.left, layout_.right), factor));
    }
  }

  void begin() {
    if (!mouse_.over) return;
    using Kind = PlotDrag::Kind;
    const bool inside = mouse_.x >= layout_.left && mouse_.y <= layout_.bottom;
    if (mouse_.right_pressed || (mouse_.left_pressed && mouse_.shift)) {
      if (inside) drag_.kind = Kind::Box;
    } else if (mouse_.left_pressed && inside) {
      drag_.kind = plot_.tab == PlotTab::Histogram ? Kind::Brush : Kind::Pan;
    }
    drag_.x0 = drag_.x = mouse_.x;
    drag_.y0 = drag_.y = mouse_.y;
    drag_.moved = false;
    drag_.right = mouse_.right_pressed;
  }

  void go_on() {
    const double dx = mouse_.x - drag_.x, dy = mouse_.y - drag_.y;
    drag_.x = mouse_.x;
    drag_.y = mouse_.y;
    drag_.moved = drag_.moved || std::hypot(drag_.x - drag_.x0, drag_.y - drag_.y0) > kClick * scale_;
    if (drag_.kind == PlotDrag::Kind::Pan && drag_.moved) pan(dx, dy);
    if (mouse_.left_down || mouse_.right_down) return;
    const PlotDrag done = drag_;
    drag_ = {};
    if (!done.moved) {
      click(done);
    } else if (done.kind == PlotDrag::Kind::Box) {
      zoom_to_box(done);
    } else if (done.kind == PlotDrag::Kind::Brush) {
      const Range range = brushed(plot_, layout_, done.x0, done.x);
      send(fmt::format("filter {} {}", range.first, range.second));
    }
  }

  void pan(double dx, double dy) {
    if (view_.x_range && dx != 0.0) {
      const Axis& x = layout_.x;  // no further than to either end of all x
      const double least = std::min(0.0, x.to - x.place(full_.second)), most = std::max(0.0, x.from - x.place(full_.first));
      zoom_x(stretched(x, layout_.left, 1.0, std::clamp(dx, least, most)));
    }
    if (view_.y_range && dy != 0.0) zoom_y(stretched(layout_.y, layout_.y.from, 1.0, dy));
  }

  void click(const PlotDrag& done) {
    if (done.right) {
      out_.menu = true;
    } else if (done.kind == PlotDrag::Kind::Brush) {
      if (plot_.brush) send("filter off");
    } else if (done.kind == PlotDrag::Kind::Pan) {
      out_.clicked = layout_.x.value(done.x);
    }
  }

  void zoom_to_box(const PlotDrag& done) {
    const auto along = [&](double x) { return std::clamp(x, layout_.left, layout_.right); };
    const auto upright = [&](double y) { return std::clamp(y, layout_.y.to, layout_.y.from); };
    const auto [left, right] = std::minmax({along(done.x0), along(done.x)});
    const auto [top, bottom] = std::minmax({upright(done.y0), upright(done.y)});
    if (right - left < kClick * scale_) return;
    const Range x{layout_.x.value(left), layout_.x.value(right)}, y{layout_.y.value(bottom), layout_.y.value(top)};
    if (bottom - top < 2.0 * kClick * scale_) {
      zoom_x(x);
    } else {
      send(fmt::format("plot-zoom box {} {} {} {}", x.first, x.second, y.first, y.second));
    }
  }

  const PlotMouse& mouse_;
  PlotDrag& drag_;
  const Plot& plot_;
  const PlotView& view_;
  const PlotLayout& layout_;
  double scale_;
  Range full_, home_;
  PlotOutcome out_;
};

}  // namespace

PlotOutcome handle_mouse(const PlotMouse& mouse, PlotDrag& drag, const Plot& plot, const PlotView& view, const PlotLayout& layout,
                         double scale) {
  return Gesture(mouse, drag, plot, view, layout, scale).handle();
}

Range brushed(const Plot& plot, const PlotLayout& layout, double from, double to) {
  const Range all = x_extent(plot);
  Range range{layout.x.value(std::min(from, to)), layout.x.value(std::max(from, to))};
  range.first = std::clamp(range.first, all.first, all.second);
  range.second = std::clamp(range.second, all.first, all.second);
  const auto bars = std::find_if(plot.series.begin(), plot.series.end(), [](const Series& s) { return s.bar_width > 0.0; });
  if (bars == plot.series.end()) return range;
  const double w = bars->bar_width, last = std::round((all.second - all.first) / w) - 1.0;
  const double first = std::clamp(std::floor((range.first - all.first) / w), 0.0, last);
  const double end = std::clamp(std::ceil((range.second - all.first) / w), first + 1.0, last + 1.0);
  return {all.first + first * w, all.first + end * w};
}

}  // namespace dmoscope::ui
