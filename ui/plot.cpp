#include "ui/plot.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/format.h"

namespace dmoscope::ui {
namespace {

/// From values to pixels and back.
struct Axis {
  double low = 0, high = 1;
  float from = 0, to = 1;
  bool logarithmic = false;
  [[nodiscard]] double shape(double value) const { return logarithmic ? std::log10(std::max(value, 1e-300)) : value; }
  [[nodiscard]] float pixel(double value) const {
    const double t = (shape(value) - shape(low)) / (shape(high) - shape(low));
    return from + static_cast<float>(std::clamp(t, -4.0, 5.0)) * (to - from);
  }
  [[nodiscard]] double value(float pixel_at) const {
    const double t = static_cast<double>((pixel_at - from) / (to - from));
    const double shaped = shape(low) + t * (shape(high) - shape(low));
    return logarithmic ? std::pow(10.0, shaped) : shaped;
  }
};

bool visible(const Series& series, const PlotView& view) { return !view.hidden.contains(series.name); }

std::pair<double, double> x_extent(const PlotSpec& spec, std::span<const Series> series) {
  if (spec.x_range) return *spec.x_range;
  double low = INFINITY, high = -INFINITY;
  for (const Series& s : series) {
    if (s.x.empty()) continue;
    low = std::min(low, s.x.front());
    high = std::max(high, s.x.back() + s.bar_width);
  }
  if (!(high >= low)) return {0.0, 1.0};
  if (high == low) high = low + 1.0;
  return {low, high};
}

void draw_legend(std::span<const Series> series, PlotView& view, const Palette& palette, float s) {
  const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
  bool first = true;
  for (const Series& one : series) {
    const float swatch = 20 * s;
    const float width = swatch + 6 * s + ImGui::CalcTextSize(one.name.c_str()).x;
    if (!first) {
      ImGui::SameLine(0, 16 * s);
      if (ImGui::GetCursorScreenPos().x + width > right) ImGui::NewLine();
    }
    first = false;
    ImGui::PushID(one.name.c_str());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton("legend", {width, ImGui::GetTextLineHeight()})) {
      if (!view.hidden.erase(one.name)) view.hidden.insert(one.name);
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("click to show or hide");
    ImGui::PopID();
    const float alpha = visible(one, view) ? 1.0F : 0.35F;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float y = at.y + ImGui::GetTextLineHeight() / 2;
    if (one.kind == Series::Kind::Bars) {
      list.AddRectFilled({at.x + 4 * s, y - 5 * s}, {at.x + swatch - 2 * s, y + 5 * s}, colour(one.colour, alpha * one.alpha));
    } else if (one.dashed) {
      for (const float x : {0.0F, 7.0F, 14.0F}) {
        list.AddLine({at.x + x * s, y}, {at.x + (x + 4) * s, y}, colour(one.colour, alpha), one.width * s);
      }
    } else {
      list.AddLine({at.x, y}, {at.x + 18 * s, y}, colour(one.colour, alpha * one.alpha), one.width * s);
    }
    list.AddText({at.x + swatch + 6 * s, at.y}, colour(palette.text, alpha), one.name.c_str());
  }
}

void draw_axes(const PlotSpec& spec, const Axis& x, const Axis& y, const Palette& palette, float s) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float line = ImGui::GetTextLineHeight();
  const auto many = [&](float pixels, float each) { return std::max(1, static_cast<int>(pixels / each)); };
  const auto x_ticks = spec.integer_x ? integer_ticks(x.low, x.high, many(x.to - x.from, 6 * line))
                                      : linear_ticks(x.low, x.high, many(x.to - x.from, 6 * line));
  const auto y_ticks = y.logarithmic ? log_ticks(y.low, y.high, many(y.from - y.to, 1.4F * line))
                                     : linear_ticks(y.low, y.high, many(y.from - y.to, 1.4F * line));
  for (const Tick& tick : x_ticks) {
    const float px = std::round(x.pixel(tick.value));
    list.AddLine({px, y.to}, {px, y.from}, colour(palette.grid), 1.0F);
    const float width = ImGui::CalcTextSize(tick.label.c_str()).x;
    list.AddText({px - width / 2, y.from + 3 * s}, colour(palette.dim), tick.label.c_str());
  }
  for (const Tick& tick : y_ticks) {
    const float py = std::round(y.pixel(tick.value));
    list.AddLine({x.from, py}, {x.to, py}, colour(palette.grid, tick.label.empty() ? 0.5F : 1.0F), 1.0F);
    const float width = ImGui::CalcTextSize(tick.label.c_str()).x;
    list.AddText({x.from - width - 6 * s, py - line / 2}, colour(palette.dim), tick.label.c_str());
  }
  list.AddLine({x.from, y.from}, {x.to, y.from}, colour(palette.dim, 0.7F), 1.0F);
  list.AddLine({x.from, y.from}, {x.from, y.to}, colour(palette.dim, 0.7F), 1.0F);
}

void draw_dashed(ImDrawList& list, const std::vector<ImVec2>& points, ImU32 ink, float width, float dash) {
  float left = dash;
  bool on = true;
  for (std::size_t k = 1; k < points.size(); ++k) {
    ImVec2 a = points[k - 1];
    const ImVec2 b = points[k];
    float length = std::hypot(b.x - a.x, b.y - a.y);
    while (length > 0) {
      const float part = std::min(left, length);
      const ImVec2 to{a.x + (b.x - a.x) * part / length, a.y + (b.y - a.y) * part / length};
      if (on) list.AddLine(a, to, ink, width);
      a = to;
      length -= part;
      left -= part;
      if (left <= 1e-3F) {
        on = !on;
        left = dash;
      }
    }
  }
}

void draw_series(const Series& one, const Axis& x, const Axis& y, float s) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = colour(one.colour, one.alpha);
  if (one.kind == Series::Kind::Bars) {
    for (std::size_t k = 0; k < one.x.size(); ++k) {
      if (!(one.y[k] > (y.logarithmic ? y.low : 0.0))) continue;
      const float left = x.pixel(one.x[k]), right = x.pixel(one.x[k] + one.bar_width);
      list.AddRectFilled({left, y.pixel(one.y[k])},
                         {std::max(right - 1.0F, left + 1.0F), y.pixel(y.logarithmic ? y.low : std::max(0.0, y.low))}, ink);
    }
    return;
  }
  std::vector<double> values = one.y;
  if (y.logarithmic) {
    for (double& value : values) value = value > 0.0 ? value : NAN;
  }
  for (const Stroke& stroke : decimate(one.x, values, x.low, x.high, static_cast<std::size_t>(std::max(1.0F, x.to - x.from)))) {
    std::vector<ImVec2> points;
    points.reserve(stroke.size());
    for (const PlotPoint& point : stroke) points.push_back({x.pixel(point.x), y.pixel(point.y)});
    if (points.size() == 1) {
      list.AddCircleFilled(points[0], 2.5F * s, ink);
    } else if (one.dashed) {
      draw_dashed(list, points, ink, one.width * s, 5 * s);
    } else {
      list.AddPolyline(points.data(), static_cast<int>(points.size()), ink, ImDrawFlags_None, one.width * s);
    }
  }
}

std::optional<std::size_t> nearest_sample(const Series& one, double at) {
  if (one.x.empty()) return std::nullopt;
  if (one.kind == Series::Kind::Bars) {
    const auto after = std::upper_bound(one.x.begin(), one.x.end(), at);
    if (after == one.x.begin() || at > one.x.back() + one.bar_width) return std::nullopt;
    return static_cast<std::size_t>(after - one.x.begin()) - 1;
  }
  const auto after = std::lower_bound(one.x.begin(), one.x.end(), at);
  if (after == one.x.end()) return one.x.size() - 1;
  const auto k = static_cast<std::size_t>(after - one.x.begin());
  return k > 0 && at - one.x[k - 1] < one.x[k] - at ? k - 1 : k;
}

void draw_hover(const PlotSpec& spec, std::span<const Series> series, const PlotView& view, const Axis& x, const Axis& y,
                const Palette& palette, float s) {
  const double at = x.value(ImGui::GetIO().MousePos.x);
  std::optional<double> snapped;
  double bar = 0;
  for (const Series& one : series) {
    if (const auto k = visible(one, view) ? nearest_sample(one, at) : std::nullopt) {
      if (!snapped || std::abs(one.x[*k] - at) < std::abs(*snapped - at)) snapped = one.x[*k];
      bar = one.bar_width;
    }
  }
  if (!snapped) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float px = x.pixel(*snapped + bar / 2);
  list.AddLine({px, y.to}, {px, y.from}, colour(palette.dim, 0.8F), 1.0F);
  ImGui::BeginTooltip();
  if (bar > 0) {
    ImGui::Text("%s %s to %s", spec.hover_x.c_str(), short_number(*snapped).c_str(), short_number(*snapped + bar).c_str());
  } else {
    ImGui::Text("%s %s", spec.hover_x.c_str(),
                spec.integer_x ? count(static_cast<std::uint64_t>(std::max(0.0, *snapped))).c_str() : short_number(*snapped).c_str());
  }
  for (const Series& one : series) {
    const auto k = visible(one, view) ? nearest_sample(one, at) : std::nullopt;
    if (!k || one.x[*k] != *snapped) continue;
    ImGui::TextColored(colour_vector(one.colour), "%s", one.kind == Series::Kind::Bars ? "■" : "—");
    ImGui::SameLine();
    ImGui::Text("%s  %s", one.name.c_str(),
                bar > 0 ? count(static_cast<std::uint64_t>(one.y[*k])).c_str() : full_number(one.y[*k]).c_str());
    if (bar == 0 && std::isfinite(one.y[*k])) list.AddCircleFilled({px, y.pixel(one.y[*k])}, 3.5F * s, colour(one.colour));
  }
  ImGui::EndTooltip();
}

/// Wheel zooms around the cursor, dragging moves, double click shows all of it.
void handle_zoom(PlotView& view, const Axis& x, std::pair<double, double> full) {
  const ImGuiIO& io = ImGui::GetIO();
  std::pair<double, double> range{x.low, x.high};
  bool changed = false;
  if (ImGui::IsItemHovered() && io.MouseWheel != 0) {
    const double at = x.value(io.MousePos.x), factor = std::pow(0.8, static_cast<double>(io.MouseWheel));
    range = {at + (range.first - at) * factor, at + (range.second - at) * factor};
    changed = true;
  }
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 4) && view.x_range) {
    const double move = static_cast<double>(io.MouseDelta.x / (x.to - x.from)) * (x.high - x.low);
    range = {range.first - move, range.second - move};
    changed = move != 0;
  }
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
    view.x_range.reset();
    return;
  }
  if (!changed) return;
  range.first = std::max(range.first, full.first);
  range.second = std::min(range.second, full.second);
  if (range.first <= full.first && range.second >= full.second) {
    view.x_range.reset();
  } else if (range.second - range.first > 1e-6 * (full.second - full.first)) {
    view.x_range = range;
  }
}

}  // namespace

std::optional<std::pair<double, double>> value_range(std::span<const Series> series, const PlotView& view,
                                                     std::pair<double, double> x_range) {
  double low = INFINITY, high = -INFINITY;
  bool bars = false;
  for (const Series& one : series) {
    if (!visible(one, view)) continue;
    bars = bars || one.kind == Series::Kind::Bars;
    for (std::size_t k = 0; k < one.x.size(); ++k) {
      if (one.x[k] + one.bar_width < x_range.first || one.x[k] > x_range.second) continue;
      if (!std::isfinite(one.y[k]) || ((view.axis == ValueAxis::Log) && one.y[k] <= 0.0)) continue;
      low = std::min(low, one.y[k]);
      high = std::max(high, one.y[k]);
    }
  }
  if (!(high >= low)) return std::nullopt;
  if (view.axis == ValueAxis::Log) return bars ? std::pair{0.7, high * 1.5} : std::pair{low / 1.1, high * 1.1};
  if (bars) return std::pair{0.0, std::max(1.0, high * 1.05)};
  const double margin = high > low ? 0.05 * (high - low) : std::max(1e-3, 0.05 * std::abs(high));
  return std::pair{low - margin, high + margin};
}

std::optional<double> draw_plot(const PlotSpec& spec, std::span<const Series> series, PlotView& view, const Palette& palette,
                                double scale) {
  const float s = static_cast<float>(scale);
  const float line = ImGui::GetTextLineHeight();
  ImGui::PushID(spec.id);
  if (!spec.y_title.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour_vector(palette.dim));
    ImGui::TextUnformatted(spec.y_title.c_str());
    ImGui::PopStyleColor();
    ImGui::SameLine(0, 24 * s);
  }
  draw_legend(series, view, palette, s);
  if (!spec.x_title.empty() && !series.empty()) {
    ImGui::SameLine();
    const float title = ImGui::CalcTextSize(spec.x_title.c_str()).x;
    const float at = ImGui::GetWindowContentRegionMax().x - title - 12 * s;
    ImGui::SetCursorPosX(std::max(at, ImGui::GetCursorPosX()));
    ImGui::TextColored(colour_vector(palette.dim), "%s", spec.x_title.c_str());
  }

  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const ImVec2 size{std::max(40.0F, ImGui::GetContentRegionAvail().x), std::max(30.0F, ImGui::GetContentRegionAvail().y)};
  const auto full = x_extent(spec, series);
  const auto x_range = view.x_range.value_or(full);
  const auto y_range = view.y_range ? view.y_range : value_range(series, view, x_range);
  std::optional<double> clicked;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (!y_range) {
    const float width = ImGui::CalcTextSize(spec.empty_text.c_str()).x;
    list.AddText({origin.x + (size.x - width) / 2, origin.y + (size.y - line) / 2}, colour(palette.dim), spec.empty_text.c_str());
    ImGui::Dummy(size);
    ImGui::PopID();
    return clicked;
  }
  const Axis x{x_range.first, x_range.second, origin.x + 4.2F * line, origin.x + size.x - 12 * s, false};
  const Axis y{y_range->first, y_range->second, origin.y + size.y - 1.4F * line, origin.y + 4 * s, (view.axis == ValueAxis::Log)};
  draw_axes(spec, x, y, palette, s);
  list.PushClipRect({x.from, y.to - 2 * s}, {x.to + 1, y.from + 1}, true);
  for (const Series& one : series) {
    if (visible(one, view)) draw_series(one, x, y, s);
  }
  if (spec.x_mark) list.AddLine({x.pixel(*spec.x_mark), y.to}, {x.pixel(*spec.x_mark), y.from}, colour(palette.accent, 0.8F), 1.5F * s);
  list.PopClipRect();

  ImGui::SetCursorScreenPos({x.from, y.to});
  ImGui::InvisibleButton("area", {std::max(1.0F, x.to - x.from), std::max(1.0F, y.from - y.to)});
  if (ImGui::IsItemHovered()) draw_hover(spec, series, view, x, y, palette, s);
  if (ImGui::IsItemHovered() && ImGui::IsMouseReleased(ImGuiMouseButton_Left) && ImGui::GetIO().MouseDragMaxDistanceSqr[0] < 16.0F) {
    clicked = x.value(ImGui::GetIO().MousePos.x);
  }
  handle_zoom(view, x, full);
  ImGui::PopID();
  return clicked;
}

}  // namespace dmoscope::ui
