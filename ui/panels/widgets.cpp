#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "ui/panels/icons.h"
#include "ui/panels/panels.h"
#include "ui/state/actions.h"
#include "ui/state/format.h"
#include "ui/state/view_options.h"

namespace dmoscope::ui {

Situation PanelContext::situation() const { return situation_of(session, state, activity.busy); }

void begin_panel(const char* name, const Rect& rect, bool overlay, bool scrolls) {
  ImGui::SetNextWindowPos({rect.x, rect.y});
  ImGui::SetNextWindowSize({rect.w, rect.h});
  ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
  if (!overlay) flags |= ImGuiWindowFlags_NoBringToFrontOnFocus;
  flags = scrolls ? flags & ~ImGuiWindowFlags_NoScrollbar : flags | ImGuiWindowFlags_NoScrollWithMouse;
  ImGui::Begin(name, nullptr, flags);
}

void end_panel() { ImGui::End(); }

void heading(const PanelContext& context, const char* text) {
  ImGui::PushFont(context.fonts.bold);
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
}

void dim_text(const PanelContext& context, const std::string& text, bool wrap) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour_vector(context.palette.dim));
  if (wrap) ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(context.shown(text).c_str());
  if (wrap) ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void next_item_tooltip(const std::string& text) {
  if (!text.empty() && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 30);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
}

void note_item(PanelContext& context, std::string_view item, const std::string& tooltip) {
  context.items.record_last(item);
  next_item_tooltip(tooltip);
}

void wrapped_text(const std::string& text, std::optional<render::Rgb> ink) {
  if (ink) ImGui::PushStyleColor(ImGuiCol_Text, colour_vector(*ink));
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  if (ink) ImGui::PopStyleColor();
}

void right_text(const std::string& text, const render::Rgb& ink) {
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0F, ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x));
  ImGui::TextColored(colour_vector(ink), "%s", text.c_str());
}

void row_label(const PanelContext& context, const char* text, float width_em) {
  ImGui::AlignTextToFramePadding();
  dim_text(context, text, false);
  ImGui::SameLine(width_em * context.em());
  ImGui::SetNextItemWidth(-1);
}

Combo::Combo(PanelContext& context, std::string item, const std::string& shown, int flags)
    : context_(context), item_(std::move(item)), open_(ImGui::BeginCombo(("##" + item_).c_str(), shown.c_str(), flags)) {
  context.items.record_last(item_);
}

Combo::~Combo() {
  if (open_) ImGui::EndCombo();
}

bool Combo::entry(std::string_view word, std::string_view title, bool chosen, const std::string& tooltip, bool possible) {
  const bool clicked = ImGui::Selectable(std::string(title).c_str(), chosen, possible ? 0 : ImGuiSelectableFlags_Disabled);
  note_item(context_, fmt::format("{}:{}", item_, word), tooltip);
  return clicked;
}

void pair_field(PanelContext& context, const char* item, double first, double second, const char* command) {
  double values[2] = {first, second};
  ImGui::InputScalarN(fmt::format("##{}", item).c_str(), ImGuiDataType_Double, values, 2, nullptr, nullptr, "%.4g");
  context.items.record_last(item);
  if (ImGui::IsItemDeactivatedAfterEdit()) context.send(fmt::format("{} {} {}", command, full_number(values[0]), full_number(values[1])));
}

namespace {
/// Tooltip of an option: its effect, and its key.
std::string option_tip(const ViewOption& option) {
  return std::string(option.doc) + (option.doc.empty() || option.entry.key.empty() ? "" : fmt::format("   {}", option.entry.key));
}

/// Draws a field for a whole number. Its buttons skip the numbers between none and the least.
void whole_number(PanelContext& context, const ViewOption& option) {
  const auto [least, most, rest] = std::array{option.at.number.least, option.at.number.most, option.at.number.rest};
  const int now = static_cast<int>(option.now(context.state));
  int edited = now;
  ImGui::InputInt(fmt::format("##{}", option.command).c_str(), &edited, 1, 10, ImGuiInputTextFlags_EnterReturnsTrue);
  context.items.record_last(option.command);
  if (edited == now || !(ImGui::IsItemDeactivatedAfterEdit() || !ImGui::IsItemActive())) return;
  const bool none = edited < least && rest < least && (edited < now || edited <= rest);
  context.send(fmt::format("{} {}", option.command, option.word(none ? rest : std::clamp<double>(edited, least, most))));
}
}  // namespace

void option_box(PanelContext& context, const char* label, std::string_view command, std::string_view item) {
  const ViewOption& option = view_option(command);
  bool now = option.now(context.state) != 0.0;
  if (ImGui::Checkbox(label, &now)) context.send(fmt::format("{} {}", command, option.word(now ? 1.0 : 0.0)));
  note_item(context, item.empty() ? command : item, option_tip(option));
}

void option_row(PanelContext& context, std::string_view command, std::string_view item) {
  const ViewOption& option = view_option(command);
  labelled(context, std::string(option.box.label).c_str(), option_tip(option).c_str());
  if (option.kind() == ViewOption::Kind::Flag) return option_box(context, fmt::format("##{}", command).c_str(), command, item);
  if (option.kind() == ViewOption::Kind::Number) return whole_number(context, option);
  const OptionChoice* now = &option.at.choices[static_cast<std::size_t>(option.now(context.state))];
  Combo combo(context, std::string(item.empty() ? command : item), std::string(now->title));
  for (const OptionChoice& choice : option.at.choices)
    if (combo.open() && combo.entry(choice.word, choice.title, &choice == now, std::string(choice.doc)))
      context.send(fmt::format("{} {}", command, choice.word));
}

void option_rows(PanelContext& context, std::string_view panel) {
  for (const ViewOption& option : view_options())
    if (option.box.panel == panel) option_row(context, option.command);
}

void close_button(PanelContext& context, const char* label) {
  if (ImGui::Button(label)) context.state.dialog = Dialog::None;
  context.items.record_last("dialog:close");
}

void draw_plate(const PanelContext& context, ImVec2 low, ImVec2 high) {
  ImGui::GetWindowDrawList()->AddRectFilled(low, high, colour(context.palette.panel, 0.90F), context.px(5));
}

Rect draw_plate(const PanelContext& context, ImVec2 low, const std::string& text, const render::Rgb& ink, float pad, float widest) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, widest);
  const Rect plate{low.x, low.y, size.x + 2 * pad, size.y + pad};
  draw_plate(context, low, {low.x + plate.w, low.y + plate.h});
  ImGui::GetWindowDrawList()->AddText(context.fonts.body, context.em(), {low.x + pad, low.y + pad / 2}, colour(ink), text.c_str(), nullptr,
                                      widest);
  return plate;
}

void copied_by_click(const PanelContext& context, const std::string& text) {
  next_item_tooltip(context.shown(text) + "\n(click copies it)");
  if (ImGui::IsItemClicked()) context.send("copy " + quote_word(text));
}

void value_row(const PanelContext& context, const char* label, const std::string& text, const std::string& full,
               std::optional<render::Rgb> ink, const char* tooltip) {
  const std::string name = label[1] == '\0' ? label : capitalised(label);  // coordinates stay small
  dim_text(context, name, false);
  if (tooltip != nullptr) next_item_tooltip(tooltip);
  const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(name.c_str()).x - context.px(8);
  const std::string shown = fit_text(context.shown(text), room);
  ImGui::SameLine();
  const float right = ImGui::GetWindowContentRegionMax().x;
  ImGui::SetCursorPosX(right - ImGui::CalcTextSize(shown.c_str()).x);
  ImGui::TextColored(colour_vector(ink.value_or(context.palette.text)), "%s", shown.c_str());
  copied_by_click(context, full.empty() ? text : full);
}

void number_row(const PanelContext& context, const char* label, double value, const char* tooltip) {
  value_row(context, label, short_number(value), full_number(value), {}, tooltip);
}

void metric_tooltip(const PanelContext& context, const MetricInfo& metric) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(context.em() * 30);
  heading(context, std::string(metric.title).c_str());
  ImGui::TextUnformatted(std::string(metric.doc).c_str());
  ImGui::Spacing();
  ImGui::TextUnformatted(std::string(metric.formula).c_str());
  ImGui::Spacing();
  dim_text(context, fmt::format("range {:g} to {:g} · usually acceptable from {:g}", metric.lowest, metric.highest, metric.acceptable));
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool fold_row(PanelContext& context, const char* item, const char* title, const std::string& aside, bool open, const char* tooltip) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, line = ImGui::GetTextLineHeight(), height = ImGui::GetFrameHeight();
  const bool clicked = ImGui::Selectable(fmt::format("##{}", item).c_str(), false, 0, {width, height});
  note_item(context, item, tooltip);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float y = at.y + (height - line) / 2, side = context.px(12);
  draw_icon(list, open ? Icon::kChevronDown : Icon::kChevronRight, {at.x + side / 2, at.y + height / 2}, side, colour(context.palette.dim));
  list.AddText({at.x + side + context.px(6), y}, colour(context.palette.text), title);
  list.AddText({at.x + width - ImGui::CalcTextSize(aside.c_str()).x, y}, colour(context.palette.dim), aside.c_str());
  return clicked;
}

bool button(const PanelContext& context, const char* label, bool primary, float width) {
  if (primary) {
    ImGui::PushStyleColor(ImGuiCol_Button, colour_vector(context.palette.accent));
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, colour_vector(context.palette.accent, 0.85F));
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, colour_vector(context.palette.accent, 0.7F));
    ImGui::PushStyleColor(ImGuiCol_Text, colour_vector(context.palette.on_accent));
  }
  const bool pressed = ImGui::Button(label, {width, 0});
  if (primary) ImGui::PopStyleColor(4);
  return pressed;
}

bool lit_button(PanelContext& context, const std::string& item, const std::string& label, bool lit, const std::string& tooltip,
                bool small) {
  if (lit) {
    ImGui::PushStyleColor(ImGuiCol_Button, colour_vector(context.palette.accent, 0.22F));
    ImGui::PushStyleColor(ImGuiCol_Text, colour_vector(context.palette.accent));
  }
  const std::string name = fmt::format("{}##{}", label, item);
  const bool clicked = small ? ImGui::SmallButton(name.c_str()) : ImGui::Button(name.c_str());
  if (lit) ImGui::PopStyleColor(2);
  note_item(context, item, tooltip);
  return clicked;
}

float width_of(const PanelContext& context, std::span<const SideButton> buttons) {
  float width = 0;
  for (const SideButton& button : buttons) width += widest_button({button.label}) + context.px(4);
  return width;
}

void side_buttons(PanelContext& context, float y, const std::string& words, std::span<const SideButton> buttons) {
  const float below = ImGui::GetCursorPosY();
  float x = ImGui::GetWindowContentRegionMax().x - width_of(context, buttons);
  ImGui::SetCursorPos({x - ImGui::CalcTextSize(words.c_str()).x, y});
  dim_text(context, words, false);
  for (const SideButton& button : buttons) {
    ImGui::SetCursorPos({x += context.px(4), y});
    ImGui::BeginDisabled(button.command.empty());
    if (ImGui::SmallButton(button.label)) context.send(button.command);
    ImGui::EndDisabled();
    note_item(context, button.item, button.tooltip);
    x += widest_button({button.label});
  }
  ImGui::SetCursorPosY(below);
}

std::string tooltip_of(const Action& action) {
  std::string tip(action.title);
  if (!action.key.empty()) tip += "   " + std::string(action.key);
  if (!action.about.empty()) tip += "\n" + std::string(action.about);
  return tip;
}

bool action_button(PanelContext& context, std::string_view id, const char* label, bool primary, float width) {
  const Action* action = find_action(id);
  const bool possible = enabled(*action, context.situation());
  if (!possible) ImGui::BeginDisabled();
  const bool pressed = button(context, label, primary, width);
  context.items.record_last(id);
  if (!possible) ImGui::EndDisabled();
  next_item_tooltip(tooltip_of(*action));
  if (pressed) context.send(std::string(action->command));
  return pressed;
}

void action_entry(PanelContext& context, std::string_view id) {
  const Action& action = *find_action(id);
  if (ImGui::MenuItem(std::string(action.title).c_str(), std::string(action.key).c_str(), false, enabled(action, context.situation())))
    context.send(std::string(action.command));
  context.items.record_last(id);
}

void beside_or_below(const char* label, float gap) {
  ImGui::SameLine(0, gap);
  if (ImGui::GetContentRegionAvail().x < widest_button({label})) ImGui::NewLine();
}

float widest_button(std::initializer_list<const char*> labels) {
  float widest = 0;
  for (const char* label : labels) widest = std::max(widest, ImGui::CalcTextSize(label).x);
  return widest + 2 * ImGui::GetStyle().FramePadding.x;
}

void labelled(const PanelContext& context, const char* name, const char* tooltip, float wanted) {
  const std::string label = capitalised(name);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const float beside_label = ImGui::GetCursorPosX() + ImGui::CalcTextSize(label.c_str()).x + ImGui::GetStyle().ItemSpacing.x;
  // All but the longest labels have one column.
  const float usual = ImGui::GetCursorPosX() + ImGui::CalcTextSize("Grid points").x + ImGui::GetStyle().ItemSpacing.x;
  const float at = std::max({ImGui::GetWindowContentRegionMax().x * 0.32F, usual, beside_label});
  const bool below = wanted > 0 && at + wanted > ImGui::GetWindowContentRegionMax().x;
  if (!below) ImGui::AlignTextToFramePadding();
  dim_text(context, label, false);
  if (below) {
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y / 2);
  } else {
    ImGui::SameLine();
    ImGui::SetCursorPosX(at);
  }
  // The field has the same tooltip as its label, except while somebody types into it.
  const float height = ImGui::GetFrameHeight() + (below ? ImGui::GetTextLineHeightWithSpacing() : 0.0F);
  const bool over = ImGui::IsMouseHoveringRect(corner, {corner.x + width, corner.y + height});
  if (over && ImGui::IsWindowHovered() && !ImGui::IsAnyItemActive()) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(context.em() * 30);
    ImGui::TextUnformatted(tooltip);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
  ImGui::SetNextItemWidth(-1);  // last, because the tooltip's window would take it
}

float combo_width(float widest) { return widest + ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().FramePadding.x; }

float metric_combo_width(const PanelContext& context) {
  float widest = 0;
  for (const Metric metric : context.derived.metrics)
    widest = std::max(widest, ImGui::CalcTextSize(std::string(info(metric).title).c_str()).x);
  return combo_width(widest);
}

/// ImGui's id of the text field of an InputInt.
unsigned field_of(const std::string& label) {
  ImGui::PushID(label.c_str());
  const unsigned id = ImGui::GetID("");
  ImGui::PopID();
  return id;
}

void integer(PanelContext& context, const char* item, int value, int least, int most, const char* command) {
  int edited = value;
  // Gaps are narrow, because digits need the room.
  ImGui::PushStyleVar(ImGuiStyleVar_ItemInnerSpacing, {context.px(2), context.px(4)});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {context.px(5), context.px(4)});
  const std::string label = fmt::format("##{}", item);
  const bool entered = ImGui::InputInt(label.c_str(), &edited, 1, 1, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::PopStyleVar(2);
  context.items.record_last(item);
  context.items.record_stop(field_of(label));
  if (ImGui::IsItemVisible()) {
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    const float side = ImGui::GetFrameHeight();
    context.items.record(fmt::format("{}+", item), {high.x - side, low.y, high.x, high.y});
    context.items.record(fmt::format("{}-", item), {high.x - 2 * side - context.px(2), low.y, high.x - side - context.px(2), high.y});
  }
  const bool stepped = edited != value && !ImGui::IsItemActive();
  if ((entered || stepped || ImGui::IsItemDeactivatedAfterEdit()) && edited != value) {
    const bool joined = std::string_view(command).ends_with(':');  // "shuffle:SEED" is one word
    context.send(fmt::format("{}{}{}", command, joined ? "" : " ", std::clamp(edited, least, most)));
  }
}

void metric_combo(PanelContext& context, const char* item, Metric current, const char* command) {
  if (context.derived.metrics.empty()) return;
  const bool open =
      ImGui::BeginCombo(fmt::format("##{}", item).c_str(), std::string(info(current).title).c_str(), ImGuiComboFlags_HeightLarge);
  context.items.record_last(item);
  if (!open) {
    metric_tooltip(context, info(current));
    return;
  }
  const auto choice = [&](Metric metric) {
    const MetricInfo& one = info(metric);
    ImGui::PushID(static_cast<int>(metric));
    if (ImGui::Selectable(context.shown(one.title).c_str(), metric == current))
      context.send(fmt::format("{} {}", command, quote_word(one.name)));
    ImGui::PopID();
    context.items.record_last(fmt::format("{}:{}", item, one.name));
    metric_tooltip(context, one);
  };
  for (const Metric metric : context.derived.metrics) choice(metric);
  ImGui::Separator();
  for (const Metric metric : further_metrics(context.session)) choice(metric);
  if (ImGui::Selectable("a formula…")) context.state.dialog = Dialog::Formula;
  note_item(context, fmt::format("{}:formula", item), "write a metric of your own, or choose the target shape of the elements");
  ImGui::EndCombo();
}

std::string fit_text(const std::string& text, float width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  std::string cut = text;
  while (!cut.empty()) {
    // Only whole characters are cut off: bytes 10xxxxxx continue one.
    while (!cut.empty() && (static_cast<unsigned char>(cut.back()) & 0xc0U) == 0x80U) cut.pop_back();
    if (!cut.empty()) cut.pop_back();
    if (ImGui::CalcTextSize((cut + "…").c_str()).x <= width) break;
  }
  return cut + "…";
}

std::string fit_clauses(const std::string& text, float width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  for (std::size_t end = text.rfind(' '); end != std::string::npos && end > 0; end = text.rfind(' ', end - 1)) {
    const bool stop = std::string_view(",;:").find(text[end - 1]) != std::string_view::npos;
    if (!stop && text[end + 1] != '(') continue;
    if (std::string clauses = text.substr(0, stop ? end - 1 : end); ImGui::CalcTextSize(clauses.c_str()).x <= width) return clauses;
  }
  return fit_text(text, width);
}

}  // namespace dmoscope::ui
