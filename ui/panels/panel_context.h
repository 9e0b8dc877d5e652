#pragma once
// Input of panels, their state between frames, and the way in which they send commands.

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/commands/commands.h"
#include "core/view/drawing_path.h"
#include "core/view/view.h"
#include "ui/analysis/derived.h"
#include "ui/analysis/inspection.h"
#include "ui/analysis/mesh_parts.h"
#include "ui/panels/dialogs.h"
#include "ui/state/actions.h"
#include "ui/state/glyph_book.h"
#include "ui/state/view_state.h"
#include "ui/toolkit/file_browser.h"
#include "ui/toolkit/fonts.h"
#include "ui/toolkit/items.h"
#include "ui/toolkit/layout.h"
#include "ui/toolkit/theme.h"
#include "ui/toolkit/thumbnails.h"
#include "ui/viewports/viewports.h"

namespace dmoscope::ui {

/// Present activity of the engine and the machine.
struct Activity {
  bool busy = false;
  std::size_t pending = 0;
  std::string command;  // command at work, as typed
  std::string progress_label;
  double progress = 0.0;                 // 0 to 1
  double busy_seconds = 0.0;             // since the command began
  std::optional<double> seconds_left{};  // estimate for the command, if there is one
  double frames_per_second = 0.0;        // while something moves, else 0
  Backend backend = Backend::Cpu;        // backend that smooths
  std::string backend_reason;            // name of the device, or reason why not cuda
  DrawingPath drawing;                   // way of the mesh to the screen, as far as known
  std::string renderer;                  // "OpenGL 4.5, ..."
  bool reduced = false;                  // the mesh is drawn with fewer elements just now
};

/// A handle of the colour bar while it is held.
struct RangeGrip {
  int held = -1;                           // 0: the lower end, 1: the upper one
  std::pair<double, double> before{0, 1};  // range when it was taken
  float pressed_at = 0;                    // pixels
};

/// A part of the view of a volume's inside while the mouse holds it: shown at once, and sent as one command when it is released.
struct InsideGrip {
  bool held = false;
  ClippingView before;      // view when it was taken
  Vec2<double> pressed_at;  // place of the clip plane's handle, in pixels
};

/// A pointer that rests over a mesh.
struct PointerRest {
  std::size_t pane = 0;
  Vec2<double> at{};                 // place in the viewport, in pixels
  std::uint64_t picture = 0;         // PaneFacts::picture_serial
  double since = 0.0;                // seconds
  bool over = false;                 // whether it is over a mesh in this frame
  std::optional<Index> element{};    // element below it, once it rests; kNoIndex: none
  std::optional<double> wakes_in{};  // seconds until it rests; for this frame
};

/// An edge between panels while it is held.
struct SplitterGrip {
  double before = 0, pressed_at = 0;  // size in em when it was taken; place in pixels
  bool moved = false;
};

/// State of the list of runs.
struct RunListState {
  std::string name;           // name that is being typed
  std::uint64_t renamed = 0;  // run whose name it is; 0: none
  std::uint64_t active = 0;   // RunView::id of the active run in the last frame
  std::size_t over = 0;       // number of the run under the mouse in the last frame; 0: none
};

struct PlotCache;

/// State that only widgets need between frames.
struct WidgetState {
  OpenDialog open;
  ExportDialog exporting;
  ScreenshotDialog screenshot;
  PaletteDialog palette;
  FindDialog find;
  LogDialog log;
  SequenceDialog sequence;
  PlotDialog plot_dialog;
  SaveSessionDialog save_session;
  RecoverDialog recover;
  FormulaDialog formula;
  CompareDialog compare;
  TargetChoices target_choices;
  OutlineSource outline;
  ChooserTurn chooser;
  Dialog dialog_shown = Dialog::None;  // dialog of the last frame
  bool dialog_opened = false;          // set in this frame
  std::shared_ptr<PlotCache> plot;     // plot as drawn last
  RecentFiles recent;
  GlyphBook glyphs;
  RangeGrip range_grip;
  InsideGrip inside_grip;
  SplitterGrip splitter_grip;
  PointerRest pointer_rest;
  RunListState run_list;
  std::size_t worst_cells = 50;                            // number of elements for "only the worst"
  std::vector<Thumbnail> thumbnails;                       // pictures of the samples, made when the start page is first shown
  bool sample_pictures = true;                             // whether the samples have pictures
  bool dragged = false;                                    // the button held in the viewport has moved
  std::size_t menu_pane = 0, brush_pane = 0;               // viewport whose menu is open; viewport in which the brush paints
  std::pair<Index, Index> under_menu{kNoIndex, kNoIndex};  // vertex and element at the place where the menu was opened
  std::array<Index, 2> edge_under_menu{kNoIndex, kNoIndex};
  PickedFacts vertex_under_menu, element_under_menu;  // facts of these, to be copied
  float setup_height = 0;                             // height of the setup's contents in the last frame; 0: not drawn yet
  float notice_height = 0;                            // height of the unfolded note of a run's end in the last frame
  int note_lines = 0;                                 // lines of the note below the viewport's title in the last frame
  bool resized = false;                               // a part needs another height than it had: the next frame gives it that
  bool narrow = false;                                // columns lie over the mesh
  double moved_at = -1e9;                             // time when the view last moved
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
  std::function<void(const std::string&)> send;                            // sends one command line; errors become messages
  std::function<std::optional<Vec3>(std::size_t, Vec2<double>)> point_at;  // point of a volume mesh that is seen at a pixel of a viewport
  std::function<std::pair<Index, Index>(std::size_t, Vec2<double>)> pick;  // vertex and element at a pixel of a viewport
  std::function<std::vector<Index>(std::size_t, Vec2<double>, double)> vertices_near;  // vertices within so many pixels of a pixel
  std::span<const PaneFacts> panes;                                                    // the viewports
  const std::vector<CommandInfo>& commands;                                            // commands of the window, for the palette
  double now = 0.0;                                                                    // seconds

  [[nodiscard]] float em() const { return ImGui::GetFontSize(); }
  [[nodiscard]] float px(float at_scale_one) const { return at_scale_one * static_cast<float>(state.scale); }
  /// A text from a file, such as its name, in the form that ImGui can draw.
  [[nodiscard]] std::string shown(std::string_view text) const { return widgets.glyphs.shown(text); }
  [[nodiscard]] const Frame* frame() const { return session.frame.get(); }
  [[nodiscard]] const RunView* run() const { return session.runs.empty() ? nullptr : &session.runs[session.active]; }
  [[nodiscard]] std::uint64_t last_iteration() const {  // of the active run
    return run() == nullptr || run()->records.empty() ? 0 : run()->records.back().iteration;
  }
  [[nodiscard]] Situation situation() const;
};

}  // namespace dmoscope::ui
