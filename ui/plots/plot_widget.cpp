#include "ui/plots/plot_widget.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/commands/commands.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

ImU32 opaque(DrawingColour c, double opacity = 1.0) { return colour({c.r, c.g, c.b}, static_cast<float>(opacity)); }
ImVec2 vec(Drawing::Point p) { return {static_cast<float>(p.x), static_cast<float>(p.y)}; }

void paint_dashed(ImDrawList& list, const Drawing::Line& line) {
  const auto dash = static_cast<float>(line.dash), width = static_cast<float>(line.width);
  float left = dash;
  bool on = true;
  for (std::size_t k = 1; k < line.points.size(); ++k) {
    ImVec2 a = vec(line.points[k - 1]);
    const ImVec2 b = vec(line.points[k]);
    float length = std::hypot(b.x - a.x, b.y - a.y);
    while (length > 0) {
      const float part = std::min(left, length);
      const ImVec2 to{a.x + (b.x - a.x) * part / length, a.y + (b.y - a.y) * part / length};
      if (on) list.AddLine(a, to, opaque(line.colour), width);
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

void paint(ImDrawList& list, const Drawing::Line& line) {
  if (line.points.size() < 2) return;
  if (line.dash > 0.0) return paint_dashed(list, line);
  std::vector<ImVec2> points;
  points.reserve(line.points.size());
  for (const Drawing::Point& p : line.points) {
    const ImVec2 at = vec(p);
    // Stretches shorter than a pixel have no direction that ImGui could join well.
    if (points.empty() || std::abs(at.x - points.back().x) > 0.7F || std::abs(at.y - points.back().y) > 0.7F) points.push_back(at);
  }
  list.AddPolyline(points.data(), static_cast<int>(points.size()), opaque(line.colour), ImDrawFlags_None, static_cast<float>(line.width));
}

void paint_rule(ImDrawList& list, const Drawing::Line& line) {
  // Places are whole pixels, so that the grid's lines are all alike.
  const auto whole = [](Drawing::Point p) { return ImVec2{std::round(static_cast<float>(p.x)), std::round(static_cast<float>(p.y))}; };
  list.AddLine(whole(line.points.front()), whole(line.points.back()), opaque(line.colour), std::max(1.0F, static_cast<float>(line.width)));
}

void paint(ImDrawList& list, const Drawing::Label& label) {
  ImFont* font = ImGui::GetFont();
  const auto size = static_cast<float>(label.size);
  const float width = font->CalcTextSizeA(size, 1e9F, 0.0F, label.text.c_str()).x;
  const float shift = label.anchor == Drawing::Anchor::Start ? 0.0F : label.anchor == Drawing::Anchor::End ? width : width / 2;
  const ImVec2 at{std::round(static_cast<float>(label.at.x) - shift),
                  std::round(static_cast<float>(label.at.y) - font->Ascent * size / font->FontSize)};
  list.AddText(font, size, at, opaque(label.colour), label.text.c_str());
}

void paint(ImDrawList& list, const Drawing& drawing) {
  for (const Drawing::Line& line : drawing.rules) paint_rule(list, line);
  for (const Drawing::Box& box : drawing.boxes) list.AddRectFilled(vec(box.from), vec(box.to), opaque(box.colour, box.opacity));
  for (const Drawing::Line& line : drawing.lines) paint(list, line);
  for (const Drawing::Disc& disc : drawing.discs)
    list.AddCircleFilled(vec(disc.centre), static_cast<float>(disc.radius), opaque(disc.colour));
  for (const Drawing::Label& label : drawing.labels) paint(list, label);
}

class Widget {
 public:
  Widget(PlotCache& cache, const PlotView& view, const Palette& palette, double scale, Items& items, std::optional<Range> inside)
      : cache_(cache),
        plot_(cache.plot),
        view_(view),
        palette_(palette),
        scale_(scale),
        s_(static_cast<float>(scale)),
        items_(items),
        inside_(inside) {}

  PlotOutcome draw() {
    draw_head();
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const ImVec2 size{std::max(40.0F, ImGui::GetContentRegionAvail().x), std::max(30.0F, ImGui::GetContentRegionAvail().y)};
    refresh_drawing(origin, size);
    paint(*ImGui::GetWindowDrawList(), cache_.drawing);
    ImGui::SetCursorScreenPos(origin);
    if (!cache_.layout) {
      ImGui::Dummy(size);
      return std::move(out_);
    }
    const PlotLayout& layout = *cache_.layout;
    const auto f = [](double v) { return static_cast<float>(v); };
    items_.record("plot", {f(layout.left), f(layout.top), f(layout.right), f(layout.bottom)});
    items_.record("plot-y", {origin.x, f(layout.top), f(layout.left), f(layout.bottom)});
    ImGui::InvisibleButton("area", size, ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    const bool hovered = ImGui::IsItemHovered();
    take_mouse(hovered, layout);
    draw_drag(layout);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const bool inside = mouse.x >= f(layout.left) && mouse.x <= f(layout.right) && mouse.y <= f(layout.bottom);
    if (hovered && inside && cache_.drag.kind == PlotDrag::Kind::None) draw_reading(layout);
    return std::move(out_);
  }

 private:
  void draw_head() {
    if (!plot_.y_title.empty() && !plot_.legend_in_a_row) {
      ImGui::PushStyleColor(ImGuiCol_Text, colour_vector(palette_.dim));
      ImGui::TextUnformatted(plot_.y_title.c_str());
      ImGui::PopStyleColor();
      ImGui::SameLine(0, 24 * s_);
    }
    draw_legend();
    if (plot_.legend_in_a_row && !plot_.legend.empty()) return;
    if (plot_.x_title.empty() || plot_.series.empty()) return ImGui::NewLine();
    const float title = ImGui::CalcTextSize(plot_.x_title.c_str()).x;
    const float at = ImGui::GetWindowContentRegionMax().x - title - 12 * s_;
    if (!plot_.legend.empty()) ImGui::SameLine();
    if (ImGui::GetCursorPosX() > at) ImGui::NewLine();
    ImGui::SetCursorPosX(std::max(at, ImGui::GetCursorPosX()));
    ImGui::TextColored(colour_vector(palette_.dim), "%s", plot_.x_title.c_str());
  }

  /// Name of an entry in the legend; in a single row it is cut in its middle if it takes more than half of the room.
  [[nodiscard]] std::string shown_name(const LegendEntry& entry) const {
    if (!plot_.legend_in_a_row) return entry.name;
    const float room = std::max(60 * s_, (ImGui::GetWindowContentRegionMax().x - 16 * s_) / 2 - 26 * s_);
    std::string text = entry.brief;
    for (std::size_t letters = text.size(); letters > 4 && ImGui::CalcTextSize(text.c_str()).x > room;)
      text = without_middle(entry.brief, --letters);
    return text;
  }
  [[nodiscard]] float width_of(const LegendEntry& entry) const { return 26 * s_ + ImGui::CalcTextSize(shown_name(entry).c_str()).x; }

  [[nodiscard]] static std::string more_text(std::size_t runs) { return fmt::format("… {} more", runs); }

  /// Number of lines that the legend and the title of x take with only the first `runs` runs.
  [[nodiscard]] int lines_with(std::size_t runs, std::size_t all, float left, float right) const {
    float x = left;
    int lines = 1;
    const auto put = [&](float width, float gap) {
      if (x > left && x + gap + width > right) {
        x = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMin().x;
        ++lines;
        x += width;
      } else {
        x += (x > left ? gap : 0.0F) + width;
      }
    };
    for (std::size_t k = 0; k < plot_.legend.size(); ++k) {
      if (k < runs || k >= all) put(width_of(plot_.legend[k]), (k == all ? 32 : 16) * s_);
      if (k + 1 == all && runs < all) put(ImGui::CalcTextSize(more_text(all - runs).c_str()).x, 16 * s_);
    }
    if (!plot_.legend_in_a_row) put(ImGui::CalcTextSize(plot_.x_title.c_str()).x + 24 * s_, 16 * s_);
    return lines;
  }

  /// Number of runs, of `all`, that are named, so that the plot keeps most of the height; the others are in a menu.
  [[nodiscard]] std::size_t runs_with_room(std::size_t all, float right) const {
    const float left = ImGui::GetCursorScreenPos().x;
    const int most = plot_.legend_in_a_row
                         ? 1
                         : std::max(2, static_cast<int>(0.3F * ImGui::GetContentRegionAvail().y / ImGui::GetTextLineHeightWithSpacing()));
    std::size_t runs = all;
    while (runs > 1 && lines_with(runs, all, left, right) > most) --runs;
    return runs;
  }

  void take_press(const LegendEntry& entry) {
    const bool twice = ImGui::GetIO().MouseClickedLastCount[ImGuiMouseButton_Left] > 1;
    out_.commands.push_back(fmt::format("plot-series {} {}", quote_word(entry.name), twice ? "only" : "toggle"));
  }

  void draw_legend_entry(const LegendEntry& entry) {
    const float line = ImGui::GetTextLineHeight();
    ImGui::PushID(entry.name.c_str());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::InvisibleButton("legend", {width_of(entry), line});
    ImGui::PopID();
    items_.record_last("legend:" + entry.name);
    if (pressed) take_press(entry);
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip("%s%sclick: show or hide; double click: show this one only", entry.tip.c_str(), entry.tip.empty() ? "" : "\n");
    const float alpha = is_on(plot_, view_, entry) ? 1.0F : 0.35F;
    Drawing sample;
    Series look = entry.look;
    look.strength *= static_cast<double>(alpha);
    draw_sample(sample, look, static_cast<double>(at.x), static_cast<double>(at.y + line / 2), ink_of(palette_), scale_);
    paint(*ImGui::GetWindowDrawList(), sample);
    ImGui::GetWindowDrawList()->AddText({at.x + 26 * s_, at.y}, colour(palette_.text, alpha), shown_name(entry).c_str());
  }

  /// Draws the menu of the runs from `first` on, behind a word in the legend.
  void draw_more_runs(std::size_t first, std::size_t all) {
    const std::string text = more_text(all - first);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton("more runs", {ImGui::CalcTextSize(text.c_str()).x, ImGui::GetTextLineHeight()})) ImGui::OpenPopup("runs");
    items_.record_last("legend-more");
    ImGui::GetWindowDrawList()->AddText(at, colour(ImGui::IsItemHovered() ? palette_.text : palette_.accent), text.c_str());
    if (!ImGui::BeginPopup("runs")) return;
    for (std::size_t k = first; k < all; ++k) {
      const LegendEntry& entry = plot_.legend[k];
      if (ImGui::MenuItem(entry.name.c_str(), nullptr, is_on(plot_, view_, entry))) take_press(entry);
      items_.record_last("legend:" + entry.name);
    }
    ImGui::EndPopup();
  }

  void draw_legend() {
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    const auto all =
        static_cast<std::size_t>(std::count_if(plot_.legend.begin(), plot_.legend.end(), [](const auto& e) { return e.of_run; }));
    const std::size_t runs = runs_with_room(all, right);
    const auto go_on = [&](std::size_t k, float width) {
      if (k > 0) ImGui::SameLine(0, (k == all ? 32 : 16) * s_);
      if (ImGui::GetCursorScreenPos().x + width > right) ImGui::NewLine();
    };
    for (std::size_t k = 0; k < plot_.legend.size(); ++k) {
      if (k < runs || k >= all) {
        go_on(k, width_of(plot_.legend[k]));
        draw_legend_entry(plot_.legend[k]);
      }
      if (k + 1 == all && runs < all) {
        go_on(runs, ImGui::CalcTextSize(more_text(all - runs).c_str()).x);
        draw_more_runs(runs, all);
      }
    }
  }

  void refresh_drawing(ImVec2 origin, ImVec2 size) {
    std::string key = fmt::format("{} {} {} {} {} {} {} {}", cache_.plot_key, origin.x, origin.y, size.x, size.y, palette_.text.r,
                                  palette_.accent.r, scale_);
    const auto add = [&key](const std::optional<Range>& range) {
      key += range ? fmt::format(" {}:{}", range->first, range->second) : " -";
    };
    add(view_.x_range);
    add(view_.y_range);
    add(plot_.brush);
    add(inside_);
    key += ' ' + view_.isolated;
    for (const std::string& name : view_.hidden) key += '|' + name;
    if (key == cache_.drawing_key) return;
    cache_.drawing_key = std::move(key);
    cache_.drawing = {};
    const double font = static_cast<double>(ImGui::GetFontSize());
    const bool numbers_runs = std::ranges::count_if(plot_.legend, &LegendEntry::of_run) > 1;
    cache_.layout = lay_out(plot_, view_, {origin.x, origin.y, size.x, size.y, font, numbers_runs ? 2.2 : 0.8, inside_});
    if (cache_.layout) {
      draw_plot_area(cache_.drawing, plot_, view_, *cache_.layout, ink_of(palette_), font, scale_,
                     origin.x + size.x - cache_.layout->right);
    } else {
      const std::string text = plot_.series.empty() ? plot_.empty_text : "this axis can show none of the values";
      const DrawingColour dim{palette_.dim.r, palette_.dim.g, palette_.dim.b};
      cache_.drawing.labels.push_back({{origin.x + size.x / 2, origin.y + size.y / 2}, text, font, dim, Drawing::Anchor::Middle});
    }
  }

  void take_mouse(bool hovered, const PlotLayout& layout) {
    const ImGuiIO& io = ImGui::GetIO();
    PlotMouse mouse;
    mouse.x = static_cast<double>(io.MousePos.x);
    mouse.y = static_cast<double>(io.MousePos.y);
    mouse.over = hovered;
    mouse.left_pressed = ImGui::IsMouseClicked(ImGuiMouseButton_Left);
    mouse.right_pressed = ImGui::IsMouseClicked(ImGuiMouseButton_Right);
    mouse.left_down = io.MouseDown[ImGuiMouseButton_Left];
    mouse.right_down = io.MouseDown[ImGuiMouseButton_Right];
    mouse.twice = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    mouse.shift = io.KeyShift;
    mouse.wheel = static_cast<double>(io.MouseWheel);
    PlotOutcome outcome = handle_mouse(mouse, cache_.drag, plot_, view_, layout, scale_);
    out_.clicked = outcome.clicked;
    out_.menu = outcome.menu;
    std::move(outcome.commands.begin(), outcome.commands.end(), std::back_inserter(out_.commands));
  }

  void draw_drag(const PlotLayout& layout) {
    const PlotDrag& drag = cache_.drag;
    if (!drag.moved || drag.kind == PlotDrag::Kind::Pan || drag.kind == PlotDrag::Kind::None) return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto f = [](double v) { return static_cast<float>(v); };
    const auto box = [&](double x0, double y0, double x1, double y1) {
      list.AddRectFilled({f(x0), f(y0)}, {f(x1), f(y1)}, colour(palette_.accent, 0.15F));
      list.AddRect({f(x0), f(y0)}, {f(x1), f(y1)}, colour(palette_.accent, 0.9F));
    };
    if (drag.kind == PlotDrag::Kind::Brush) {
      const Range range = brushed(plot_, layout, drag.x0, drag.x);
      box(layout.x.place(range.first), layout.top, layout.x.place(range.second), layout.bottom);
      ImGui::SetTooltip("quality %s to %s", short_number(range.first).c_str(), short_number(range.second).c_str());
      return;
    }
    const auto along = [&](double x) { return std::clamp(x, layout.left, layout.right); };
    const auto upright = [&](double y) { return std::clamp(y, layout.y.to, layout.y.from); };
    box(along(drag.x0), upright(drag.y0), along(drag.x), upright(drag.y));
  }

  [[nodiscard]] std::string number(const Series& one, double value, bool full) const {
    const AxisUnit& unit = one.strip ? plot_.strip_unit : plot_.y_unit;
    if (!std::isfinite(value)) return "–";
    if (!unit.name.empty()) return short_number(value * unit.factor) + " " + unit.name;
    if (one.kind != Series::Kind::Line || one.strip || plot_.tab == PlotTab::Moved)
      return count(static_cast<std::uint64_t>(std::llround(std::max(0.0, value))));
    return full ? full_number(value) : short_number(value);
  }

  void say_x(double x, double bar) {
    if (bar > 0.0) {
      ImGui::Text("%s %s to %s", plot_.x_name.c_str(), short_number(x).c_str(), short_number(x + bar).c_str());
    } else if (plot_.integer_x) {
      ImGui::Text("%s %s", plot_.x_name.c_str(), count(static_cast<std::uint64_t>(std::llround(std::max(0.0, x)))).c_str());
    } else if (!plot_.x_unit.name.empty()) {
      ImGui::Text("%s %s", short_number(x * plot_.x_unit.factor).c_str(), plot_.x_unit.name.c_str());
    } else {
      ImGui::Text("%s %s", plot_.x_name.c_str(), short_number(x).c_str());
    }
  }

  /// Draws the values in one row a series; with several runs, in one row a run and one column a quantity.
  void draw_values(const std::vector<Reading>& readings) {
    std::vector<std::string> runs, names;
    for (const Reading& reading : readings) {
      if (std::find(runs.begin(), runs.end(), reading.series->run) == runs.end()) runs.push_back(reading.series->run);
      if (std::find(names.begin(), names.end(), reading.series->name) == names.end()) names.push_back(reading.series->name);
    }
    const bool table = runs.size() > 1 && names.size() > 1;
    const int columns = table ? 1 + static_cast<int>(names.size()) : 2;
    if (!ImGui::BeginTable("values", columns, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoHostExtendX)) return;
    if (table) {
      ImGui::TableNextRow();
      for (std::size_t k = 0; k < names.size(); ++k) {
        ImGui::TableSetColumnIndex(static_cast<int>(k) + 1);
        ImGui::TextColored(colour_vector(palette_.dim), "%s", names[k].c_str());
      }
    }
    for (std::size_t r = 0; r < (table ? runs.size() : readings.size()); ++r) {
      ImGui::TableNextRow();
      bool named = false;
      for (std::size_t k = 0; k < readings.size(); ++k) {
        const Series& one = *readings[k].series;
        if (table ? one.run != runs[r] : k != r) continue;
        if (!named) {
          ImGui::TableSetColumnIndex(0);
          ImGui::TextColored(colour_vector(one.colour), "%s", one.kind == Series::Kind::Line ? "—" : "■");
          ImGui::SameLine();
          ImGui::TextUnformatted((table ? (one.run.empty() ? std::string("all") : one.run) : full_name(plot_, one)).c_str());
          named = true;
        }
        const auto column = table ? std::find(names.begin(), names.end(), one.name) - names.begin() + 1 : 1;
        ImGui::TableSetColumnIndex(static_cast<int>(column));
        ImGui::TextUnformatted(number(one, one.y[readings[k].sample], !table).c_str());
      }
    }
    ImGui::EndTable();
  }

  void draw_reading(const PlotLayout& layout) {
    const double at = layout.x.value(static_cast<double>(ImGui::GetIO().MousePos.x));
    const std::vector<Reading> readings = read_plot(plot_, view_, at);
    if (readings.empty()) return;
    const auto x_of = [](const Reading& reading) { return reading.series->x[reading.sample] + reading.series->bar_width / 2; };
    const auto nearest = *std::min_element(readings.begin(), readings.end(), [&](const Reading& a, const Reading& b) {
      return std::abs(x_of(a) - at) < std::abs(x_of(b) - at);
    });
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto f = [](double v) { return static_cast<float>(v); };
    const float px = f(layout.x.place(x_of(nearest)));
    list.AddLine({px, f(layout.top)}, {px, f(layout.bottom)}, colour(palette_.dim, 0.8F), 1.0F);
    for (const Reading& reading : readings) {
      const Series& one = *reading.series;
      const Axis& y = one.strip && layout.strip ? *layout.strip : layout.y;
      const double value = one.y[reading.sample], place = y.place(value);
      if (one.kind != Series::Kind::Line || !can_show(y.kind, value) || place < y.to - 1 || place > y.from + 1) continue;
      list.AddCircleFilled({f(layout.x.place(x_of(reading))), f(place)}, 3.5F * s_, colour(one.colour));
    }
    ImGui::BeginTooltip();
    say_x(nearest.series->x[nearest.sample], nearest.series->bar_width);
    draw_values(readings);
    ImGui::EndTooltip();
  }

  PlotCache& cache_;
  const Plot& plot_;
  const PlotView& view_;
  const Palette& palette_;
  double scale_;
  float s_;
  Items& items_;
  std::optional<Range> inside_;
  PlotOutcome out_;
};

}  // namespace

PlotOutcome draw_plot(PlotCache& cache, const PlotView& view, const Palette& palette, double scale, Items& items,
                      std::optional<Range> inside) {
  ImGui::PushID("plot");
  PlotOutcome outcome = Widget(cache, view, palette, scale, items, inside).draw();
  ImGui::PopID();
  return outcome;
}

}  // namespace dmoscope::ui
