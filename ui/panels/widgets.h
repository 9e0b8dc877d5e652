#pragma once
// What panels are made of.

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ui/panels/panel_context.h"

namespace dmoscope::ui {

/// `overlay`: above the other panels. `scrolls`: with a scroll bar where the contents need one.
void begin_panel(const char* name, const Rect& rect, bool overlay = false, bool scrolls = false);
void end_panel();
void heading(const PanelContext& context, const char* text);
void dim_text(const PanelContext& context, const std::string& text, bool wrap = true);
/// The last item: its full text under the mouse, and on the clipboard by a click.
void copied_by_click(const PanelContext& context, const std::string& text);
/// "label            value", value right-aligned with its full precision as tooltip.
void value_row(const PanelContext& context, const char* label, const std::string& text, const std::string& full = {},
               std::optional<render::Rgb> ink = {}, const char* tooltip = nullptr);
void number_row(const PanelContext& context, const char* label, double value, const char* tooltip = nullptr);
void metric_tooltip(const PanelContext& context, const MetricInfo& metric);
/// A row that unfolds what stands below it; `aside` at its right end. True when it is clicked.
bool fold_row(PanelContext& context, const char* item, const char* title, const std::string& aside, bool open, const char* tooltip);
/// `primary`: in the accent's colour, as the one that most people want.
bool button(const PanelContext& context, const char* label, bool primary, float width = 0);
/// A button that is lit while what it does is in force.
bool lit_button(PanelContext& context, const std::string& item, const std::string& label, bool lit, const std::string& tooltip,
                bool small = false);
/// Small buttons at the right end of a line, after some words. One without a command is disabled.
struct SideButton {
  const char* label;
  std::string item, tooltip, command;
};
[[nodiscard]] float width_of(const PanelContext& context, std::span<const SideButton> buttons);
void side_buttons(PanelContext& context, float y, const std::string& words, std::span<const SideButton> buttons);
/// A button for an action, with tooltip and key; records the item under the action's id.
/// `width`: in pixels, for labels that change; 0: as the label needs.
bool action_button(PanelContext& context, std::string_view id, const char* label, bool primary = false, float width = 0);
/// The same as an entry of a menu.
void action_entry(PanelContext& context, std::string_view id);
/// Beside the last item where a button with this label has room, else below it.
void beside_or_below(const char* label, float gap = -1.0F);
/// Of a button whose label is one of these: what stands beside it stays where it is.
[[nodiscard]] float widest_button(std::initializer_list<const char*> labels);
void next_item_tooltip(const std::string& text);
/// The name of the last item for scripts, and what is said under the mouse.
void note_item(PanelContext& context, std::string_view item, const std::string& tooltip);
/// Text in as many lines as it needs; `ink`: in another colour than the panel's.
void wrapped_text(const std::string& text, std::optional<render::Rgb> ink = {});
/// A label before a field that fills the rest of the row.
void row_label(const PanelContext& context, const char* text, float width_em);
/// A drop-down list; its entries are the items "ITEM:WORD".
class Combo {
 public:
  Combo(PanelContext& context, std::string item, const std::string& shown, int flags = 0);
  ~Combo();
  Combo(const Combo&) = delete;
  Combo& operator=(const Combo&) = delete;
  [[nodiscard]] bool open() const noexcept { return open_; }
  /// Whether it is clicked.
  bool entry(std::string_view word, std::string_view title, bool chosen, const std::string& tooltip = {}, bool possible = true);

 private:
  PanelContext& context_;
  std::string item_;
  bool open_;
};
/// Two numbers that are sent as "COMMAND FIRST SECOND" once they were edited.
void pair_field(PanelContext& context, const char* item, double first, double second, const char* command);
/// A box that switches an option of the view, see view_options(). `item`: its name; empty: the command.
void option_box(PanelContext& context, const char* label, std::string_view command, std::string_view item = {});
/// A row with the option's label and its box, a list of its words, or a field for its number, a whole one.
void option_row(PanelContext& context, std::string_view command, std::string_view item = {});
/// Such rows of all options that are in this part of a panel.
void option_rows(PanelContext& context, std::string_view panel);
/// Closes the open dialog.
void close_button(PanelContext& context, const char* label);
/// Text on a plate in the panel's colour is readable on any mesh.
void draw_plate(const PanelContext& context, ImVec2 low, ImVec2 high);
/// A row "label [widget]" whose widget, drawn next, fills the right part; where it wants more pixels than there are, a line of its own.
/// The tooltip is of the whole row.
void labelled(const PanelContext& context, const char* label, const char* tooltip, float wanted = 0);
/// What a combo box wants whose widest entry is so wide.
[[nodiscard]] float combo_width(float widest);
[[nodiscard]] float metric_combo_width(const PanelContext& context);
/// An integer that is sent as "COMMAND value" once editing is done; as one word where the command ends with ':'.
void integer(PanelContext& context, const char* item, int value, int least, int most, const char* command);
/// Metric chooser that sends "COMMAND name".
void metric_combo(PanelContext& context, const char* item, Metric current, const char* command);
/// Text cut with "…" so that it is at most `width` pixels wide.
[[nodiscard]] std::string fit_text(const std::string& text, float width);
/// As many whole clauses of a sentence as fit; where none does, as fit_text.
[[nodiscard]] std::string fit_clauses(const std::string& text, float width);

}  // namespace dmoscope::ui
