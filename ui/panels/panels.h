#pragma once
// The parts of the window. Each reads the context and sends command lines; none changes the session, none calls OpenGL.

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "core/commands/commands.h"
#include "core/view/drawing_path.h"
#include "core/view/view.h"
#include "ui/analysis/derived.h"
#include "ui/analysis/inspection.h"
#include "ui/state/actions.h"
#include "ui/state/view_state.h"
#include "ui/toolkit/file_browser.h"
#include "ui/toolkit/items.h"
#include "ui/toolkit/layout.h"
#include "ui/toolkit/recent_files.h"
#include "ui/toolkit/theme.h"
#include "ui/toolkit/thumbnails.h"
#include "ui/viewports/viewports.h"

namespace dmoscope::ui {

/// What the engine and the machine are doing, as of this frame.
struct Activity {
  bool busy = false;
  std::size_t pending = 0;
  std::string command;  // at work, as typed
  std::string progress_label;
  double progress = 0.0;           // 0 to 1
  double busy_seconds = 0.0;       // since it began
  double frames_per_second = 0.0;  // while something moves, else 0
  Backend backend = Backend::Cpu;  // what smooths
  std::string backend_reason;      // which device, or why not cuda
  DrawingPath drawing;             // how it gets to the screen, as far as is known
  std::string renderer;            // "OpenGL 4.5, ..."
  bool reduced = false;            // the mesh is drawn with fewer elements just now
};

/// A handle of the colour bar while it is held.
struct RangeGrip {
  int held = -1;                           // 0: the lower end, 1: the upper one
  std::pair<double, double> before{0, 1};  // the range when it was taken
  float pressed_at = 0;                    // pixels
};

/// A part of the view of a volume's inside while the mouse holds it: shown at once, and told as one command when it is let go.
struct InsideGrip {
  bool held = false;
  ClippingView before;      // when it was taken
  Vec2<double> pressed_at;  // pixels, of the clip plane's handle
};

/// What the log's dialog shows.
struct LogWidgets {
  std::string filter, script_name = "session.txt";
  bool commands = true, messages = true;
  std::size_t seen = 0;  // lines there were in the last frame
};

/// What the dialog of picture sequences asks for.
struct SequenceWidgets {
  std::string folder = "pictures";
  int from = 0, to = 0, every = 1, width = 0, height = 0;
  bool window = false, overwrite = false;
};

struct PlotCache;

/// What the dialog that saves a plot holds.
struct PlotDialog {
  std::string name = "plot.svg";
  int width = 800, height = 450, scale = 2;
};

/// State that only widgets need between frames.
struct WidgetState {
  std::string open_folder, open_text, open_error;
  std::vector<FolderEntry> open_entries;
  int open_selected = -1;
  bool show_all_files = false;
  int export_what = 0;
  std::shared_ptr<PlotCache> plot;  // as drawn last
  PlotDialog plot_dialog;
  std::string export_name, screenshot_name = "dmoscope.png";
  std::string palette_text, find_text;
  LogWidgets log;
  SequenceWidgets sequence;
  std::string session_name;
  RecentFiles recent;
  RangeGrip range_grip;
  InsideGrip inside_grip;
  std::size_t worst_cells = 50;       // how many "only the worst" means
  std::vector<Thumbnail> thumbnails;  // of the samples, made when the start page is first shown
  bool sample_pictures = true;        // with pictures
  int screenshot_width = 0, screenshot_height = 0, screenshot_supersample = 2;
  bool screenshot_transparent = false, screenshot_window = false;
  int palette_selected = 0;
  int find_kind = 0;
  Dialog dialog_shown = Dialog::None;                      // in the last frame
  bool dialog_opened = false;                              // in this frame
  bool dragged = false;                                    // the button held in the viewport has moved
  std::size_t menu_pane = 0, brush_pane = 0;               // viewport whose menu is open; in which the brush paints
  std::pair<Index, Index> under_menu{kNoIndex, kNoIndex};  // vertex and element where the menu was opened
  PickedFacts vertex_under_menu, element_under_menu;       // and what there is to copy of them
  double moved_at = -1e9;                                  // when the view last moved
};

struct PanelContext {
  ViewState& state;
  WidgetState& widgets;
  const SessionView& session;
  const Activity& activity;
  const Derived& derived;
  const Inspection& inspection;
  const Palette& palette;
  const Fonts& fonts;
  Items& items;
  std::function<void(const std::string&)> send;                            // one command line; errors become messages
  std::function<std::optional<Vec3>(std::size_t, Vec2<double>)> point_at;  // of a volume mesh, what is seen at a pixel of a viewport
  std::function<std::pair<Index, Index>(std::size_t, Vec2<double>)> pick;  // vertex and element at a pixel of a viewport
  std::function<std::vector<Index>(std::size_t, Vec2<double>, double)> vertices_near;  // the same, within so many pixels
  std::span<const PaneFacts> panes;                                                    // the viewports
  const std::vector<CommandInfo>& commands;                                            // of the window, for the palette
  double now = 0.0;                                                                    // seconds

  [[nodiscard]] float em() const { return ImGui::GetFontSize(); }
  [[nodiscard]] float px(float at_scale_one) const { return at_scale_one * static_cast<float>(state.scale); }
  [[nodiscard]] const Frame* frame() const { return session.frame.get(); }
  [[nodiscard]] const RunView* run() const { return session.runs.empty() ? nullptr : &session.runs[session.active]; }
  [[nodiscard]] Situation situation() const;
};

// widgets.cpp: what panels are made of
/// `overlay`: above the other panels. `scrolls`: with a scroll bar where the contents need one.
void begin_panel(const char* name, const Rect& rect, bool overlay = false, bool scrolls = false);
void end_panel();
void heading(const PanelContext& context, const char* text);
void dim_text(const PanelContext& context, const std::string& text, bool wrap = true);
/// "label            value", value right-aligned with its full precision as tooltip.
void value_row(const PanelContext& context, const char* label, const std::string& text, const std::string& full = {},
               std::optional<render::Rgb> ink = {}, const char* tooltip = nullptr);
void number_row(const PanelContext& context, const char* label, double value, const char* tooltip = nullptr);
void metric_tooltip(const PanelContext& context, const MetricInfo& metric);
/// A button for an action, with tooltip and key; records the item under the action's id.
bool action_button(PanelContext& context, std::string_view id, const char* label, bool primary = false);
void next_item_tooltip(const std::string& text);
/// Text on a plate in the panel's colour is readable on any mesh.
void draw_plate(const PanelContext& context, ImVec2 low, ImVec2 high);
/// A row "label [widget]" whose widget, drawn next, fills the right part.
void labelled(const PanelContext& context, const char* label, const char* tooltip);
/// An integer that is sent as "COMMAND value" once editing is done; as one word where the command ends with ':'.
void integer(PanelContext& context, const char* item, int value, int least, int most, const char* command);
/// Metric chooser that sends "COMMAND name".
void metric_combo(PanelContext& context, const char* item, Metric current, const char* command);
/// Text cut with "…" so that it is at most `width` pixels wide.
[[nodiscard]] std::string fit_text(const std::string& text, float width);

// one file each
float draw_menu(PanelContext& context);  // returns its height
void draw_toolbar(PanelContext& context, const Rect& rect);
void draw_runs(PanelContext& context);
void draw_parameters(PanelContext& context);
/// Of the active run, as a part of its parameters: a second phase, and a second aim.
void draw_composite(PanelContext& context, const RunView& run);
void draw_colours(PanelContext& context);
/// The mesh's groups; nothing of a mesh without any.
void draw_groups(PanelContext& context);
/// What is seen of a volume mesh, and from where; nothing of another one.
void draw_clipping(PanelContext& context);
/// The clip plane in a viewport: what of it takes the mouse, to be called before whatever lies below it; and its picture.
void handle_clip_plane(PanelContext& context, const PaneFacts& pane);
void draw_clip_plane(const PanelContext& context, const PaneFacts& pane);
void draw_inspector(PanelContext& context);
void draw_worst(PanelContext& context);
void draw_inspection(PanelContext& context);
/// The quality around the inspected vertex over the mesh, when it is wanted, and over it the marks that it covers.
void draw_field_in_view(PanelContext& context, const PaneFacts& pane);
void draw_viewports(PanelContext& context, const Rect& rect);
/// What a viewport among several shows, in its upper left corner: what of it takes the mouse, to be called before whatever lies below it;
/// and its picture.
void handle_pane_title(PanelContext& context, const PaneFacts& pane);
void draw_pane_title(PanelContext& context, const PaneFacts& pane);
/// Entries that choose what a viewport shows.
void draw_pane_entries(PanelContext& context, const PaneFacts& pane);
/// The brush under the mouse over the mesh's item, drawn last; `at`: the mouse in the viewport. True: dragging is the brush's.
bool handle_brush(PanelContext& context, const PaneFacts& pane, Vec2<double> at);
/// The colour bar, or the legend of categories, in the lower left corner: what of it takes the mouse, to be called before whatever lies
/// below it; and its picture.
void handle_colour_bar(PanelContext& context, const Rect& rect);
void draw_colour_bar(PanelContext& context, const Rect& rect);
/// With the space around it.
[[nodiscard]] float colour_bar_height(const PanelContext& context, const Rect& rect);
/// The ids on the mesh.
void draw_labels(PanelContext& context, const PaneFacts& pane);
/// Over the meshes: what is to be said of the run that has come to its end, if anything.
void draw_notice(PanelContext& context, const Rect& rect);
void draw_start_page(PanelContext& context, const Rect& rect);
/// `timeline_only`: there is no room for more.
void draw_plots(PanelContext& context, const Rect& rect, bool timeline_only);
void draw_timeline(PanelContext& context);
void draw_status(PanelContext& context, const Rect& rect);
void draw_strips(PanelContext& context, const Layout& layout);
void draw_splitters(PanelContext& context, const Layout& layout);
void draw_dialogs(PanelContext& context);

// dialogs
void draw_open_dialog(PanelContext& context);
void draw_export_dialog(PanelContext& context);
void draw_screenshot_dialog(PanelContext& context);
void draw_palette_dialog(PanelContext& context);
void draw_find_dialog(PanelContext& context);
void draw_keys_dialog(PanelContext& context);
void draw_about_dialog(PanelContext& context);
void draw_error_dialog(PanelContext& context);
void draw_log_dialog(PanelContext& context);
void draw_sequence_dialog(PanelContext& context);
void draw_plot_dialog(PanelContext& context);
void draw_save_session_dialog(PanelContext& context);
/// Begins a modal window of the open dialog; false when it is closed. Escape closes it.
bool begin_dialog(PanelContext& context, const char* title, float width_em, float height_em = 0);
void end_dialog();

}  // namespace dmoscope::ui
