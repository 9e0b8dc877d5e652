#pragma once
// Widgets of panels.

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ui/panels/panel_context.h"

namespace dmoscope::ui {

/// Begins a panel. `overlay`: above the other panels. `scrolls`: with a scroll bar if the contents need one.
void begin_panel(const char* name, const Rect& rect, bool overlay = false, bool scrolls = false);
void end_panel();
void heading(const PanelContext& context, const char* text);
void dim_text(const PanelContext& context, const std::string& text, bool wrap = true);
/// Makes the last item show its full text under the mouse, and copy it to the clipboard by a click.
void copied_by_click(const PanelContext& context, const std::string& text);
/// Draws a row "label            value", value right-aligned with its full precision as tooltip.
void value_row(const PanelContext& context, const char* label, const std::string& text, const std::string& full = {},
               std::optional<render::Rgb> ink = {}, const char* tooltip = nullptr);
void number_row(const PanelContext& context, const char* label, double value, const char* tooltip = nullptr);
void metric_tooltip(const PanelContext& context, const MetricInfo& metric);
/// Draws a row that unfolds the rows below it; `aside` at its right end. True when it is clicked.
bool fold_row(PanelContext& context, const char* item, const char* title, const std::string& aside, bool open, const char* tooltip);
/// Draws a button. `primary`: in the accent's colour, as the one that most people want.
bool button(const PanelContext& context, const char* label, bool primary, float width = 0);
/// Draws a button that is lit while its effect is in force.
bool lit_button(PanelContext& context, const std::string& item, const std::string& label, bool lit, const std::string& tooltip,
                bool small = false);
/// A small button at the right end of a line, after some words. One without a command is disabled.
struct SideButton {
  const char* label;
  std::string item, tooltip, command;
};
[[nodiscard]] float width_of(const PanelContext& context, std::span<const SideButton> buttons);
void side_buttons(PanelContext& context, float y, const std::string& words, std::span<const SideButton> buttons);
/// Title, key and explanation of an action.
[[nodiscard]] std::string tooltip_of(const Action& action);
/// Draws a button for an action, with tooltip and key; records the item under the action's id. `width`: in pixels, for labels that change;
/// 0: that of the label.
bool action_button(PanelContext& context, std::string_view id, const char* label, bool primary = false, float width = 0);
/// Draws an action as an entry of a menu, with its key.
void action_entry(PanelContext& context, std::string_view id);
/// Continues beside the last item if a button with this label has room there, else below it.
void beside_or_below(const char* label, float gap = -1.0F);
/// Width of a button whose label is one of these, so that everything beside it stays in place.
[[nodiscard]] float widest_button(std::initializer_list<const char*> labels);
void next_item_tooltip(const std::string& text);
/// Gives the last item a name for scripts, and a tooltip.
void note_item(PanelContext& context, std::string_view item, const std::string& tooltip);
/// Draws text in as many lines as it needs; `ink`: in another colour than the panel's.
void wrapped_text(const std::string& text, std::optional<render::Rgb> ink = {});
/// Draws text flush right in the remaining space.
void right_text(const std::string& text, const render::Rgb& ink);
/// Draws a label before a field that fills the rest of the row.
void row_label(const PanelContext& context, const char* text, float width_em);
/// A drop-down list; its entries are the items "ITEM:WORD".
class Combo {
 public:
  Combo(PanelContext& context, std::string item, const std::string& shown, int flags = 0);
  ~Combo();
  Combo(const Combo&) = delete;
  Combo& operator=(const Combo&) = delete;
  [[nodiscard]] bool open() const noexcept { return open_; }
  /// Draws an entry. True when it is clicked.
  bool entry(std::string_view word, std::string_view title, bool chosen, const std::string& tooltip = {}, bool possible = true);

 private:
  PanelContext& context_;
  std::string item_;
  bool open_;
};
/// Draws two numbers that are sent as "COMMAND FIRST SECOND" once they were edited.
void pair_field(PanelContext& context, const char* item, double first, double second, const char* command);
/// Draws a box that switches an option of the view, see view_options(). `item`: its name; empty: the command.
void option_box(PanelContext& context, const char* label, std::string_view command, std::string_view item = {});
/// Draws a row with the option's label and its box, a list of its words, or a field for its number.
void option_row(PanelContext& context, std::string_view command, std::string_view item = {});
/// Draws such rows for all options in this part of a panel.
void option_rows(PanelContext& context, std::string_view panel);
/// Draws a button that closes the open dialog.
void close_button(PanelContext& context, const char* label);
/// Draws a plate in the panel's colour, on which text is readable over any mesh.
void draw_plate(const PanelContext& context, ImVec2 low, ImVec2 high);
/// Draws text on a plate, `pad` pixels from its sides and half as many from its top; in several lines if it is wider than `widest` pixels
/// (0: in one). Returns the plate's place.
Rect draw_plate(const PanelContext& context, ImVec2 low, const std::string& text, const render::Rgb& ink, float pad, float widest = 0);
/// Draws the label of a row "label [widget]"; the widget, drawn next, fills the right part, or a line of its own if it wants more pixels
/// than there are. The tooltip belongs to the whole row.
void labelled(const PanelContext& context, const char* label, const char* tooltip, float wanted = 0);
/// Width that a combo box needs for its widest entry.
[[nodiscard]] float combo_width(float widest);
[[nodiscard]] float metric_combo_width(const PanelContext& context);
/// Draws an integer field that is sent as "COMMAND value" once editing is done; as one word if the command ends with ':'.
void integer(PanelContext& context, const char* item, int value, int least, int most, const char* command);
/// Draws a choice of metrics that sends "COMMAND name".
void metric_combo(PanelContext& context, const char* item, Metric current, const char* command);
/// Text cut with "…" so that it is at most `width` pixels wide.
[[nodiscard]] std::string fit_text(const std::string& text, float width);
/// The first clauses of a sentence that fit whole; if none does, the result of fit_text.
[[nodiscard]] std::string fit_clauses(const std::string& text, float width);

}  // namespace dmoscope::ui
