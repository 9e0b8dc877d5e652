#pragma once
// What the window shows, as plain data: no ImGui, no OpenGL. Commands change it, panels draw it, tests read it.

#include <array>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/clipping/clipped_view.h"
#include "core/engine/engine.h"
#include "core/engine/safe_copy.h"
#include "core/view/view.h"
#include "render/camera.h"
#include "render/colour_map.h"
#include "render/orbit_camera.h"
#include "ui/state/colouring_state.h"
#include "ui/state/command_log.h"
#include "ui/state/inspection_state.h"
#include "ui/state/keys.h"
#include "ui/state/panes.h"
#include "ui/state/plot_state.h"
#include "ui/state/result_line.h"
#include "ui/state/run_names.h"
#include "ui/state/selection.h"
#include "ui/state/sequence.h"
#include "ui/state/stepping_state.h"
#include "ui/state/timeline.h"
#include "ui/state/tour.h"
#include "ui/state/unsaved.h"

namespace dmoscope::ui {

enum class Theme { Dark, Light, Contrast };
/// What a file that is opened is for.
enum class OpenFor : std::uint8_t {
  Alone,   // in the place of all that is open
  Beside,  // another mesh beside those that are open
  Surface  // what the active mesh slides on
};
enum class Dialog {
  None,
  Open,
  Export,
  Screenshot,
  Find,
  Palette,
  Keys,
  About,
  Error,
  Log,
  Sequence,
  Plot,
  SaveSession,
  Unsaved,
  Recover,
  Formula,
  Compare
};

/// What a person picked.
struct Picked {
  enum class Kind { None, Vertex, Element };
  Kind kind = Kind::None;
  Index id = kNoIndex;
  friend bool operator==(const Picked&, const Picked&) = default;
};

/// Of the window on the desktop, in its coordinates; 0: not known.
struct WindowPlace {
  int width = 0, height = 0;  // while it is not maximised
  bool maximised = false;
  friend bool operator==(const WindowPlace&, const WindowPlace&) = default;
};

enum class Side : std::uint8_t { Left, Right };
/// What the dock of facts shows.
enum class FactsTab : std::uint8_t { Mesh, Selection, Worst, Colours, Inside };

/// Which panels are there. Two docks, of setup and of facts, stand in columns beside the mesh, the one above the other where they share
/// a side. The columns give way to the mesh in a small window and then open over it.
struct Panels {
  bool setup = true;  // runs, method and metric
  bool facts = true;  // mesh, selection, worst elements, colours
  Side setup_side = Side::Right, facts_side = Side::Right;
  FactsTab tab = FactsTab::Mesh;
  FactsTab tab_before = FactsTab::Mesh;        // the one to go back to when nothing is picked any more
  bool settings = false;                       // all parameters are unfolded
  bool holds = false;                          // what holds the minimum is unfolded
  bool notice = false;                         // the note about a run's end is unfolded
  bool loops = false;                          // the list of boundary loops is unfolded
  bool bottom = true;                          // plots; the timeline below them is always there
  bool plots_wait = true;                      // for the first step of a mesh, or for a plot that needs none; then they open
  bool left_over = false, right_over = false;  // opened over the mesh where the window is too small for both
  bool picked_over = false;                    // likewise the facts alone, of what was picked
  /// Whether a side's docks lie over the mesh in such a window.
  [[nodiscard]] bool over(Side side) const noexcept {
    return (side == Side::Left ? left_over : right_over) || (picked_over && has_facts(side));
  }
  [[nodiscard]] bool plots() const noexcept { return bottom && !plots_wait; }
  [[nodiscard]] bool has_setup(Side side) const noexcept { return setup && setup_side == side; }
  [[nodiscard]] bool has_facts(Side side) const noexcept { return facts && facts_side == side; }
  [[nodiscard]] bool has_column(Side side) const noexcept { return has_setup(side) || has_facts(side); }
  /// Whether a dock belongs there, open or not.
  [[nodiscard]] bool uses(Side side) const noexcept { return setup_side == side || facts_side == side; }
  /// Shows the facts of what is picked; `in_list`: from the list of the worst, which stays.
  void show_selection(bool in_list = false);
  /// Nothing is picked any more.
  void leave_selection();
  // In heights of the interface's font.
  double left_width = 16.0, right_width = 20.0, bottom_height = 13.0;
  double runs_height = 4.8;  // of the list of runs: three rows
};

struct ScreenshotOptions {
  std::filesystem::path path;
  int width = 0, height = 0;  // 0: as on screen
  int supersample = 2;
  bool transparent = false;
  bool window = false;  // the whole interface instead of the mesh
  bool quiet = false;   // one of many: only what goes wrong is said
};

/// Input that a script plays through the window's own event handling, one a frame.
struct SimulatedInput {
  enum class Kind { Move, Press, Release, Wheel, KeyDown, KeyUp, Text };
  Kind kind = Kind::Move;
  float x = 0, y = 0;  // pixels; amount for Wheel in y
  int button = 0;
  KeyChord chord;
  std::string text;
};

/// Wishes of commands to whoever runs the event loop; each is taken once.
struct Requests {
  bool quit = false;
  bool fit = false;
  bool fit_all = false;  // with it: the viewports under cameras of their own, too
  std::optional<bool> full_screen;
  std::optional<std::pair<int, int>> size;
  std::deque<ScreenshotOptions> screenshots;
  bool screenshot_failed = false;  // since somebody set it to false
  std::deque<PlotSave> plots;
  std::deque<SimulatedInput> input;
  std::optional<std::string> clipboard;
};

struct ViewState {
  // Camera and picture
  render::Camera2D camera;  // of the active pane, and of all while they are linked
  Panes panes;
  render::OrbitCamera orbit;              // of volume meshes, in all panes
  bool trackball = false;                 // a drag rolls them as a ball instead of turning them about the upright axis
  ClippingView inside;                    // what is seen of them
  bool in_space = false;                  // a volume or a curved surface is on show; set by follow()
  Vec2<double> viewport{800, 600};        // pixels of a pane, set by the drawing code
  std::pair<int, int> window_size{0, 0};  // likewise; 0: not known yet
  bool wireframe = true;
  bool vertices = false;
  bool worst_marker = true;
  bool pointer_value = false;  // the element's value is shown where the pointer rests; not in scripts, whose pictures shall be the same
  bool features = false;       // curves along which vertices slide, and what holds them
  std::optional<std::array<Index, 2>> edge_under_mouse;  // in the inspector or a menu, to be seen in the mesh
  bool holders = false;   // what holds the minimum: elements that hold one another, their forces, and the cluster
  bool shading = true;    // volumes' faces by a light, too: it changes what colours tell
  bool occlusion = true;  // volumes are darker in their corners and along their edges
  render::ColourMap colour_map = render::ColourMap::Beacon;
  RangeMode range_mode = RangeMode::Input;
  double range_low = 0.0, range_high = 1.0;                   // for RangeMode::Given
  double range_low_percent = 2.0, range_high_percent = 98.0;  // for RangeMode::Percentile
  ColouringState colouring;

  // Interface
  Theme theme = Theme::Dark;
  double scale = 1.0;          // of text and widgets
  double monitor_scale = 1.0;  // what of that is the monitor's; 1 for scripts, so that they draw the same everywhere
  Panels panels;
  Dialog dialog = Dialog::None;
  OpenFor open_for = OpenFor::Alone;  // of Dialog::Open
  PlotTab plot = PlotTab::Convergence;
  std::array<PlotView, kPlotTabs.size()> plots;
  PlotOptions plot_options;
  KnownRunNames run_names;  // that the plots' legends had last
  bool full_screen = false;
  WindowPlace place;

  // What would be lost
  bool asks_unsaved = false;              // before a person gives up what is in no file; scripts are not asked
  std::optional<Leaving> leaving;         // what waits for the answer
  std::vector<Recoverable> recoverable;   // what windows that came to no good end left, as long as a person has not said what becomes of it
  std::optional<Recoverable> recovering;  // of these, what the session came of
  bool native_dialogs = true;             // the desktop's file dialogs where there are any

  // Selection
  Picked picked;
  Picked pick_on_switch;  // of another open mesh, which is about to become the active one
  Selection selection;
  Brush brush;
  SteppingState stepping;
  InspectionState inspection;
  std::optional<std::uint64_t> renaming_run;  // RunView::id; its name is being typed in the list
  bool placing_size_point = false;            // the next click in the view places the point of the size function

  // Time
  Timeline timeline;
  std::optional<Sequence> sequence;  // of pictures that are being taken
  bool watch_file = false;           // read the mesh again whenever its file is written anew

  // Log
  std::deque<Message> log;       // newest last, at most 200
  std::uint64_t messages = 0;    // how many there have been
  CommandLog commands;           // and messages, all of them
  ResultLine result;             // what the status bar says
  std::string error_text;        // of the error dialog
  std::string dismissed_notice;  // Notice::key of the one that a person took away

  Tour tour;

  // Remembered
  std::vector<std::string> recent_files;  // newest first, at most 10

  Requests requests;

  /// Of a pane.
  [[nodiscard]] render::Camera2D& camera_of(std::size_t pane) {
    return panes.linked || pane == panes.focus ? camera : panes.panes[pane].camera;
  }
  /// All panes under one camera, that of the active one; or each under its own, from where it is.
  void link_cameras(bool linked);
  /// Makes a pane the active one.
  void focus_pane(std::size_t pane);
  /// Brings panes, what differences are taken from, and the runs' names up to date with the session.
  void follow(const SessionView& session);
  /// See Panes::set_layout.
  void set_layout(PaneLayout layout);
  /// The matrix of so many runs, and where four viewports have room for them a viewport each.
  void show_comparison(std::size_t runs);

  [[nodiscard]] PlotView& plot_view() { return plots[static_cast<std::size_t>(plot)]; }
};

/// The lowest and the highest quality of the shown metric, inverted elements apart; of a device-resident frame as far as its histogram
/// tells. None where no element has one.
[[nodiscard]] std::optional<std::pair<double, double>> own_range(const Frame& frame);
/// Range of qualities that the colours span now. `own`: see own_range; `seen`: what all the frames so far had, for RangeMode::Expanding;
/// `input`: null: not known, `own` stands in for it.
[[nodiscard]] std::pair<double, double> colour_range(const ViewState& state, std::optional<std::pair<double, double>> own,
                                                     std::optional<std::pair<double, double>> seen = {},
                                                     const InputSpread* input = nullptr);

/// The window has come to a monitor with another scale: what a person chose over it stays.
void move_to_monitor(ViewState& state, double monitor_scale);

/// Adds a line to the log; an error also opens the error dialog (unless one is open, then it is appended there).
void add_message(ViewState& state, Message message);

/// Puts a file at the front of the recent ones, by its whole path.
void remember_file(ViewState& state, const std::string& file);

}  // namespace dmoscope::ui
