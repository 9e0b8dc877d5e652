// The corner of the mesh: the colour bar with its handles, or the legend of categories.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/drawing/ticks.h"
#include "ui/analysis/derived.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

constexpr std::size_t kMostEntries = 12;  // entries of a legend; the number of further ones is told

struct Swatch {
  std::string text;
  std::optional<render::Rgb> ink;
  ImVec2 at{};  // relative to the plate
  float width = 0;
};

/// Places of all parts of the bar; worked out twice a frame, before the mouse is handled and for drawing.
struct BarLayout {
  Rect plate;
  std::string title, right;  // texts of the first line
  std::string mode;          // choice of the range, at the line's end, which opens a menu; empty: there is none
  float mode_left = 0, mode_width = 0;
  bool has_bar = true;
  float left = 0, top = 0, width = 0, bar_top = 0, bar = 0;  // place of the bar
  float swatch = 0;                                          // side of a swatch
  float histogram = 0;                                       // height of the histogram of qualities, above the bar; 0: there is none
  std::vector<Swatch> swatches;                              // swatches of the categories, or beside the bar
  std::size_t entries = 0;                                   // the first so many are categories
};

std::string percentile_title(const ViewState& state) {
  return fmt::format("{:.4g} to {:.4g} % of the elements", state.range_low_percent, state.range_high_percent);
}

std::string range_title(const ViewState& state) {
  if (state.range_mode != RangeMode::Percentile) return std::string(info(state.range_mode).title);
  return fmt::format("{:.4g} to {:.4g} %", state.range_low_percent, state.range_high_percent);
}

std::string outside_text(const render::Legend& legend) {
  std::string text;
  if (legend.below > 0) text += fmt::format("{} below", count(legend.below));
  if (legend.above > 0) text += fmt::format("{}{} above", text.empty() ? "" : ", ", count(legend.above));
  return text;
}

/// Puts swatches side by side, in as many lines as they need. Returns the height.
float arrange(std::vector<Swatch>& swatches, float left, float top, float right, float bar, float gap, float line) {
  float x = left, y = top;
  for (Swatch& swatch : swatches) {
    swatch.width = (swatch.ink ? bar + gap / 2 : 0) + ImGui::CalcTextSize(swatch.text.c_str()).x;
    if (x > left && x + swatch.width > right) {
      x = left;
      y += 1.25F * line;
    }
    swatch.at = {x, y};
    x += swatch.width + 1.5F * gap;
  }
  return y + line - top;
}

BarLayout lay_out(const PanelContext& context, const Rect& rect) {
  const Frame& frame = *context.frame();
  const render::Legend legend = legend_of(context.state, context.derived, frame);
  const float pad = context.px(8), line = ImGui::GetTextLineHeight();
  BarLayout layout;
  layout.has_bar = !legend.has_categories && (!context.derived.colouring.colours || context.derived.colouring.colours->has_values);
  layout.bar = std::round(0.53F * line);
  layout.swatch = std::round(0.8F * line);
  layout.title = legend.title;
  layout.right = layout.has_bar ? outside_text(legend) : std::string();
  if (layout.has_bar && !context.derived.colouring.colours) layout.mode = fmt::format("range: {} ▾", range_title(context.state));
  layout.mode_width = layout.mode.empty() ? 0 : ImGui::CalcTextSize(layout.mode.c_str()).x;
  for (std::size_t k = 0; k < std::min(kMostEntries, legend.categories.size()); ++k) {
    const render::LegendEntry& entry = legend.categories[k];
    layout.swatches.push_back({fmt::format("{}: {}", context.shown(entry.name), count(entry.count)), entry.colour});
  }
  layout.entries = layout.swatches.size();
  if (legend.categories.size() > kMostEntries) {
    layout.swatches.push_back({fmt::format("and {} more", legend.categories.size() - kMostEntries), std::nullopt});
  }
  for (const render::LegendEntry& entry : legend.beside)
    layout.swatches.push_back({fmt::format("{} {}", count(entry.count), entry.name), entry.colour});
  if (legend.inverted > 0) layout.swatches.push_back({fmt::format("{} inverted", count(legend.inverted)), render::kInvertedColour});
  if (legend.undefined) layout.swatches.push_back({"not defined", render::kUndefinedColour});
  if (!legend.selection.empty()) layout.swatches.push_back({legend.selection, std::nullopt});
  if (!layout.has_bar && layout.swatches.empty()) layout.swatches.push_back({"none", std::nullopt});
  if (!layout.has_bar) {
    const ElementColours& colours = *context.derived.colouring.colours;
    if (!colours.counted.empty() && !colours.categories.empty()) layout.title += ", " + colours.counted;
    if (!colours.note.empty()) layout.title += " · " + colours.note;
  }
  const float inner = 1.25F * pad;
  const float widest = rect.w - 2 * pad - 2 * inner;
  float height = 0, right = 0;
  const bool roomy = context.state.panes.one() && rect.h > 26 * context.em();
  layout.histogram = layout.mode.empty() || !roomy ? 0.0F : std::round(1.1F * line);
  const float first = 0.6F * pad, second = first + 1.25F * line + layout.histogram;
  if (layout.has_bar) {
    layout.width = std::min(widest, std::clamp(rect.w * 0.42F, 10 * context.em(), 15 * context.em()));
    height = second + layout.bar + 1.15F * line + 0.6F * pad;
    arrange(layout.swatches, inner + layout.width + 1.5F * pad, second - 0.1F * line, widest + inner, layout.swatch, pad, line);
    right = inner + layout.width;
    const float words =
        ImGui::CalcTextSize(layout.title.c_str()).x + ImGui::CalcTextSize(layout.right.c_str()).x + layout.mode_width + 5 * pad;
    if (words > layout.width) right = std::min(widest + inner, inner + words);
  } else {
    height = second + arrange(layout.swatches, inner, second, widest + inner, layout.swatch, pad, line) + 0.9F * pad;
    right = inner + std::min(widest, ImGui::CalcTextSize(layout.title.c_str()).x);
  }
  for (const Swatch& swatch : layout.swatches) right = std::max(right, swatch.at.x + swatch.width);
  const float plate_width = std::min(rect.w - 2 * pad, right + inner);
  layout.plate = {rect.x + pad, rect.y + rect.h - pad - height, plate_width, height};
  layout.left = layout.plate.x + inner;
  layout.mode_left = layout.plate.x + plate_width - inner - layout.mode_width;
  layout.top = layout.plate.y + first;
  layout.bar_top = layout.plate.y + second;
  return layout;
}

/// The axis of the bar. It stays while a handle is held, so that the handle follows the mouse.
std::pair<double, double> axis(const PanelContext& context) {
  const auto range = shown_scale(context.state, context.derived);
  if (context.widgets.range_grip.held < 0) return {range.low, range.high};
  const auto before = context.widgets.range_grip.before;
  return {std::min(before.first, range.low), std::max(before.second, range.high)};
}

/// A value rounded to a thousandth of the range: nobody wants sixteen digits of a drag.
double rounded(double value, double span) {
  const double step = std::pow(10.0, std::floor(std::log10(span)) - 3.0);
  return std::round(value / step) * step;
}

void hold_handle(PanelContext& context, int end, float width) {
  RangeGrip& grip = context.widgets.range_grip;
  auto& held = context.state.colouring.held_range;
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemActivated()) grip = {end, context.derived.range, io.MousePos.x};
  if (grip.held != end) return;
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, context.px(2))) {
    const double span = grip.before.second - grip.before.first;
    const double moved = static_cast<double>((io.MousePos.x - grip.pressed_at) / width) * span;
    const double least = 0.01 * span;
    auto range = grip.before;
    if (end == 0) range.first = std::min(rounded(range.first + moved, span), range.second - least);
    if (end == 1) range.second = std::max(rounded(range.second + moved, span), range.first + least);
    held = range;
  }
  if (!ImGui::IsItemActive()) {
    grip.held = -1;
    if (held) context.send(fmt::format("range {:.12g} {:.12g}", held->first, held->second));
    held.reset();
  }
}

/// Draws the menu of ranges.
void draw_range_menu(PanelContext& context) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(10), context.px(8)});
  if (ImGui::BeginPopup("range menu")) {
    dim_text(context, "range of the colours", false);
    for (const RangeModeInfo& one : kRangeModes) {
      if (one.mode == RangeMode::Given) continue;
      const bool percentile = one.mode == RangeMode::Percentile;
      const std::string title = percentile ? percentile_title(context.state) : std::string(one.title);
      if (ImGui::MenuItem(title.c_str(), nullptr, context.state.range_mode == one.mode)) context.send(fmt::format("range {}", one.name));
      note_item(context, fmt::format("range-menu:{}", one.name), std::string(one.doc));
    }
    ImGui::Separator();
    dim_text(context, "from, to", false);
    ImGui::SetNextItemWidth(11 * context.em());
    pair_field(context, "range-menu:given", context.derived.range.first, context.derived.range.second, "range");
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar();
}

void handle_mode(PanelContext& context, const BarLayout& layout) {
  ImGui::SetCursorScreenPos({layout.mode_left, layout.top});
  if (ImGui::InvisibleButton("range:mode", {std::max(1.0F, layout.mode_width), ImGui::GetTextLineHeight()})) ImGui::OpenPopup("range menu");
  context.items.record_last("range:mode");
  next_item_tooltip(std::string(info(context.state.range_mode).doc) + " · click: other ranges");
  draw_range_menu(context);
}

void handle_bar(PanelContext& context, const BarLayout& layout) {
  const float reach = context.px(7);
  static constexpr std::array<const char*, 2> names{"range:low", "range:high"};
  bool reset = false;
  for (const int end : {0, 1}) {
    const float x = layout.left + (end == 0 ? 0 : layout.width);
    ImGui::SetCursorScreenPos({x - reach, layout.bar_top - reach / 2});
    ImGui::InvisibleButton(names[static_cast<std::size_t>(end)], {2 * reach, layout.bar + reach});
    context.items.record_last(names[static_cast<std::size_t>(end)]);
    if (ImGui::IsItemHovered()) {
      ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
      reset = reset || ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
      if (context.widgets.range_grip.held < 0) next_item_tooltip("drag to set the range · double click: 0 to 1");
    }
    hold_handle(context, end, layout.width);
  }
  ImGui::SetCursorScreenPos({layout.left, layout.bar_top});
  ImGui::InvisibleButton("range:bar", {layout.width, layout.bar});
  context.items.record_last("range:bar");
  if (layout.histogram > 0) next_item_tooltip("the bars above show how many elements have each quality");
  reset = reset || (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left));
  if (reset) context.send("range fixed");
  handle_mode(context, layout);
}

/// Draws the numbers at both ends, which are always there. Returns the interval between them that has room.
std::pair<float, float> draw_ends(const PanelContext& context, const BarLayout& layout, bool logarithmic, std::pair<double, double> range) {
  const auto text = [&](double value) { return fmt::format("{:.4g}", logarithmic ? std::pow(10.0, value) : value); };
  const std::string low = text(range.first), high = text(range.second);
  const float left = layout.left - context.px(2), right = layout.left + layout.width + context.px(2);
  const float y = layout.bar_top + layout.bar + context.px(3), gap = context.px(8);
  const float low_width = ImGui::CalcTextSize(low.c_str()).x, high_width = ImGui::CalcTextSize(high.c_str()).x;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText({left, y}, colour(context.palette.text), low.c_str());
  list.AddText({right - high_width, y}, colour(context.palette.text), high.c_str());
  return {left + low_width + gap, right - high_width - gap};
}

void draw_bar(const PanelContext& context, const BarLayout& layout) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const render::ColourScale scale = shown_scale(context.state, context.derived);
  const auto range = axis(context);
  const double low = range.first, high = range.second;  // not a structured binding, which clang does not let lambdas capture
  const auto at = [&](double value) { return layout.left + static_cast<float>((value - low) / (high - low)) * layout.width; };
  const float top = layout.bar_top, bottom = top + layout.bar;
  const int parts = std::max(1, static_cast<int>(layout.width));
  const auto value_at = [&](int k) { return low + (high - low) * (k + 0.5) / parts; };
  const auto& filter = context.state.colouring.filter;
  const bool by_quality = !context.derived.colouring.colours;
  int first = 0;
  for (int k = 1; k <= parts; ++k) {
    // Stretches of one colour are drawn in one piece.
    const render::Rgb ink = scale.colour(value_at(first));
    if (k < parts && scale.colour(value_at(k)) == ink) continue;
    const float a = layout.left + static_cast<float>(first) * layout.width / static_cast<float>(parts);
    const float b = layout.left + static_cast<float>(k) * layout.width / static_cast<float>(parts);
    list.AddRectFilled({a, top}, {b, bottom}, colour(ink));
    first = k;
  }
  const auto clamped = [&](double value) { return at(std::clamp(value, low, high)); };
  if (filter && by_quality) {
    // The parts that the filter leaves out are covered.
    list.AddRectFilled({layout.left, top + 0.35F * layout.bar}, {clamped(filter->first), bottom}, colour(context.palette.panel, 0.85F));
    list.AddRectFilled({clamped(filter->second), top + 0.35F * layout.bar}, {layout.left + layout.width, bottom},
                       colour(context.palette.panel, 0.85F));
  }
  const bool logarithmic = !by_quality && context.derived.colouring.colours->logarithmic;
  const int most = std::max(2, static_cast<int>(layout.width / (5 * ImGui::GetTextLineHeight())));
  std::vector<Tick> ticks = logarithmic ? log_ticks(std::pow(10.0, low), std::pow(10.0, high), most) : linear_ticks(low, high, most);
  // A single number, such as the 0 of a difference, would not say how far the colours reach.
  for (int more = most + 1; !logarithmic && ticks.size() < 2 && more <= 4 * most; ++more) ticks = linear_ticks(low, high, more);
  const auto [least, largest] = draw_ends(context, layout, logarithmic, {low, high});
  for (const Tick& tick : ticks) {
    const float x = at(logarithmic ? std::log10(tick.value) : tick.value);
    list.AddLine({x, bottom}, {x, bottom + context.px(3)}, colour(context.palette.text), 1.0F);
    const float half = ImGui::CalcTextSize(tick.label.c_str()).x / 2;
    if (x - half < least || x + half > largest) continue;  // the ends have their numbers already
    list.AddText({x - half, bottom + context.px(3)}, colour(context.palette.text), tick.label.c_str());
  }
  if (!by_quality) return;
  const RangeGrip& grip = context.widgets.range_grip;
  for (const int end : {0, 1}) {
    const double value = end == 0 ? scale.low : scale.high;
    const float x = at(value), half = context.px(2.5F), over = context.px(3);
    const bool held = grip.held == end;
    list.AddRectFilled({x - half, top - over}, {x + half, bottom + over}, colour(held ? context.palette.accent : context.palette.text),
                       context.px(2));
    list.AddRect({x - half, top - over}, {x + half, bottom + over}, colour(context.palette.panel), context.px(2));
    if (!held || !context.state.colouring.held_range) continue;
    const std::string text = short_number(value);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    draw_plate(context, {x - size.x / 2 - context.px(4), top - over - size.y - context.px(4)}, text, context.palette.text, context.px(4));
  }
}

/// Draws the histogram of qualities above the bar in its colours. The highest bin has the full height, and every bin with an element can be
/// seen.
void draw_histogram(const PanelContext& context, const BarLayout& layout) {
  const Histogram& histogram = context.frame()->now;
  const Index most = *std::ranges::max_element(histogram.counts);
  if (most == 0) return;
  const render::ColourScale scale = shown_scale(context.state, context.derived);
  const auto range = axis(context);
  const double bin = (histogram.highest - histogram.lowest) / static_cast<double>(Histogram::kBins);
  const auto at = [&](double value) {
    const double share = (value - range.first) / (range.second - range.first);
    return layout.left + static_cast<float>(std::clamp(share, 0.0, 1.0)) * layout.width;
  };
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (std::size_t k = 0; k < Histogram::kBins; ++k) {
    const double low = histogram.lowest + static_cast<double>(k) * bin;
    const float left = at(low), right = at(low + bin);
    if (histogram.counts[k] == 0 || right <= left) continue;
    const float share = static_cast<float>(histogram.counts[k]) / static_cast<float>(most);
    const float height = std::max(context.px(1), share * (layout.histogram - context.px(4)));
    list.AddRectFilled({left, layout.bar_top - height - context.px(1)}, {right, layout.bar_top - context.px(1)},
                       colour(scale.colour(low + bin / 2)));
  }
}

}  // namespace

float colour_bar_height(const PanelContext& context, const Rect& rect) { return lay_out(context, rect).plate.h + 2 * context.px(8); }

void handle_colour_bar(PanelContext& context, const Rect& rect) {
  const BarLayout layout = lay_out(context, rect);
  const ColourFacts& facts = context.derived.colouring;
  if (layout.has_bar && !facts.colours) {
    handle_bar(context, layout);
    return;
  }
  context.widgets.range_grip.held = -1;
  context.state.colouring.held_range.reset();
  if (layout.has_bar) return;
  const auto& isolated = context.state.colouring.isolated;
  for (std::size_t k = 0; k < layout.entries; ++k) {
    const Swatch& swatch = layout.swatches[k];
    const Category& category = facts.colours->categories[k];
    ImGui::SetCursorScreenPos({layout.plate.x + swatch.at.x, layout.plate.y + swatch.at.y});
    ImGui::PushID(static_cast<int>(k));
    const bool clicked = ImGui::InvisibleButton("category", {std::max(1.0F, swatch.width), ImGui::GetTextLineHeight()});
    ImGui::PopID();
    context.items.record_last(fmt::format("category:{}", category.name));
    const bool alone = isolated == Isolation{facts.colours->by, category.name};
    next_item_tooltip(alone ? "click: all again" : "click: look at these alone");
    if (clicked)
      context.send(alone ? "isolate off" : fmt::format("isolate {} {}", info(facts.colours->by).name, quote_word(category.name)));
  }
}

void draw_colour_bar(PanelContext& context, const Rect& rect) {
  const BarLayout layout = lay_out(context, rect);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Rect& plate = layout.plate;
  draw_plate(context, {plate.x, plate.y}, {plate.x + plate.w, plate.y + plate.h});
  const float taken = layout.mode.empty() ? 0 : layout.mode_width + context.px(16);
  const std::string title = fit_text(layout.title, plate.w - (layout.left - plate.x) * 2 - taken);
  list.AddText({layout.left, layout.top}, colour(context.palette.text), title.c_str());
  if (!layout.right.empty()) {
    const float end = layout.mode.empty() ? layout.left + layout.width : layout.mode_left - context.px(16);
    const float at =
        std::max(end - ImGui::CalcTextSize(layout.right.c_str()).x, layout.left + ImGui::CalcTextSize(title.c_str()).x + context.px(16));
    list.AddText({at, layout.top}, colour(context.palette.dim), layout.right.c_str());
  }
  if (!layout.mode.empty()) list.AddText({layout.mode_left, layout.top}, colour(context.palette.accent), layout.mode.c_str());
  if (layout.histogram > 0) draw_histogram(context, layout);
  if (layout.has_bar) draw_bar(context, layout);
  const auto& isolated = context.state.colouring.isolated;
  for (std::size_t k = 0; k < layout.swatches.size(); ++k) {
    const Swatch& swatch = layout.swatches[k];
    const float x = plate.x + swatch.at.x, y = plate.y + swatch.at.y, line = ImGui::GetTextLineHeight();
    float text = x;
    const ElementColours* colours = context.derived.colouring.colours.get();
    const bool dim = k < layout.entries && isolated && colours != nullptr && isolated->by == colours->by &&
                     isolated->name != colours->categories[k].name;
    if (swatch.ink) {
      const float middle = y + 0.5F * line;
      list.AddRectFilled({x, middle - layout.swatch / 2}, {x + layout.swatch, middle + layout.swatch / 2},
                         colour(*swatch.ink, dim ? 0.35F : 1.0F), context.px(2));
      text += layout.swatch + context.px(4);
    }
    list.AddText({text, y}, colour(dim ? context.palette.dim : context.palette.text), swatch.text.c_str());
  }
}

}  // namespace dmoscope::ui
