#pragma once
// State of the window, as plain data: no ImGui, no OpenGL. Commands change it, panels draw it, tests read it.

#include <array>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/vec.h"
#include "core/clipping/clipped_view.h"
#include "core/engine/engine.h"
#include "core/engine/safe_copy.h"
#include "core/run/moment.h"
#include "core/view/view.h"
#include "render/camera.h"
#include "render/colour_map.h"
#include "render/orbit_camera.h"
#include "ui/state/colouring_state.h"
#include "ui/state/command_log.h"
#include "ui/state/keys.h"
#include "ui/state/panes.h"
#include "ui/state/plot_state.h"
#include "ui/state/result_line.h"
#include "ui/state/run_names.h"
#include "ui/state/selection.h"
#include "ui/state/timeline.h"
#include "ui/state/tour.h"
#include "ui/state/unsaved.h"

namespace dmoscope::ui {

/// State that arrows and ghosts compare the mesh with.
enum class Reference {
  None,
  Input,
  Previous,  // before the last command that moved something
  A,
  B  // moments marked on the timeline
};

/// Whether vertices that a step moved are tinted: for a moment after it, or until the next one.
enum class Flash { Off, On, Hold };

/// Effect of the last step.
struct StepNews {
  std::string sentence;                 // empty: nothing to say
  std::vector<Index> moved;             // vertices
  Index vertex = kNoIndex;              // vertex that was visited and stayed
  std::shared_ptr<const Frame> before;  // positions before the step
  std::uint64_t messages = 0;           // number of messages before it: a later one replaces the sentence
  std::uint64_t serial = 0;             // serial of the frame that it is about
  double since = 0.0;                   // time of the step, in seconds of a steady clock
};

struct SteppingState {
  Flash flash = Flash::Off;
  int flash_level = 0;  // present strength of the tint, 0 to kFlashLevels
  StepNews news;
  bool next_class = false;             // dots on the vertices of the colour class that moves next
  Reference arrows = Reference::None;  // start of the arrows, which end at the present positions
  double arrow_scale = 0.0;            // factor of the arrows' length; 0: chosen so that the longest in view can be seen
  Reference ghost = Reference::None;   // state whose edges are drawn
  bool click_smooths = false;          // a click on a free vertex moves it to its best candidate
};

inline constexpr int kFlashLevels = 8;

/// A candidate of the grid of a level (from 1).
struct CandidateName {
  int level = 0, index = 0;
  friend bool operator==(const CandidateName&, const CandidateName&) = default;
};

struct InspectionState {
  bool open = false;
  Index vertex = kNoIndex;  // vertex under inspection; none: `note` says why
  std::string note;         // reason why there is no vertex to inspect
  int level = 1;            // level whose grid is shown; 0: none
  bool all_levels = false;  // the grids of all levels at once
  bool applied = false;     // the vertex has been moved to where its visit takes it
  std::string take_back;    // command that undoes the applied move; empty: nothing moved
  Moment applied_from;      // moment of the run before that
  bool in_order = false;    // whether the run visits this vertex next, so that applying is the run's own step
  bool zoom = true;         // whether the view goes as close as a level's grid needs
  bool field = true;        // whether the inspector shows the quality around the vertex
  bool field_in_view = false;
  bool own_range = false;  // whether the inspector's heat maps span each level's own qualities instead of the view's range
  bool playing = false;
  double level_since = -1.0;  // time when playing came to this level, in seconds of the window; < 0: not drawn yet
  // Camera before a level was shown closer than the star, and the close camera. A camera that a person moved stays.
  std::optional<std::pair<render::Camera2D, render::Camera2D>> close_up;
  std::optional<std::pair<render::OrbitCamera, render::OrbitCamera>> space_close_up;  // cameras of close_up for a volume mesh
  // Slice of a volume's grid that the maps show.
  int slice_axis = 2;                    // axis at right angles to the slice: 0 x, 1 y, 2 z
  std::optional<int> slice;              // number of the slice, from 0; none: for each level the one with its chosen candidate
  bool alone = true;                     // whether the rest of the mesh is drawn faintly meanwhile
  std::optional<CandidateName> hovered;  // candidate under the mouse in the inspector
};

enum class Theme { Dark, Light, Contrast };
/// Role of a file that is opened.
enum class OpenFor : std::uint8_t {
  Alone,   // in place of all open meshes
  Beside,  // another mesh beside those that are open
  Surface  // surface that the active mesh slides on
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

/// The element or vertex that a person picked.
struct Picked {
  enum class Kind { None, Vertex, Element };
  Kind kind = Kind::None;
  Index id = kNoIndex;
  friend bool operator==(const Picked&, const Picked&) = default;
};

/// Place of the window on the desktop, in its coordinates; 0: not known.
struct WindowPlace {
  int width = 0, height = 0;  // size while it is not maximised
  bool maximised = false;
  friend bool operator==(const WindowPlace&, const WindowPlace&) = default;
};

enum class Side : std::uint8_t { Left, Right };
/// Content of the dock of facts.
enum class FactsTab : std::uint8_t { Mesh, Selection, Worst, Colours, Inside };

/// Panels of the window. Two docks, of setup and of facts, stand in columns beside the mesh, one above the other when they share a side.
/// The columns give way to the mesh in a small window and then open over it.
struct Panels {
  bool setup = true;  // runs, method and metric
  bool facts = true;  // mesh, selection, worst elements, colours
  Side setup_side = Side::Right, facts_side = Side::Right;
  FactsTab tab = FactsTab::Mesh;
  FactsTab tab_before = FactsTab::Mesh;        // tab to go back to when nothing is picked any more
  bool settings = false;                       // whether all parameters are unfolded
  bool holds = false;                          // whether the list of what holds the minimum is unfolded
  bool notice = false;                         // whether the note about a run's end is unfolded
  bool loops = false;                          // whether the list of boundary loops is unfolded
  bool bottom = true;                          // plots; the timeline below them is always there
  bool plots_wait = true;                      // closed until the first step of a mesh, or until a plot that needs none
  bool left_over = false, right_over = false;  // opened over the mesh because the window is too small for both
  bool picked_over = false;                    // only the facts of what was picked are opened so
  /// Whether a side's docks lie over the mesh in a window that is too small for both.
  [[nodiscard]] bool over(Side side) const noexcept {
    return (side == Side::Left ? left_over : right_over) || (picked_over && has_facts(side));
  }
  [[nodiscard]] bool plots() const noexcept { return bottom && !plots_wait; }
  [[nodiscard]] bool has_setup(Side side) const noexcept { return setup && setup_side == side; }
  [[nodiscard]] bool has_facts(Side side) const noexcept { return facts && facts_side == side; }
  [[nodiscard]] bool has_column(Side side) const noexcept { return has_setup(side) || has_facts(side); }
  /// Whether a dock belongs to that side, open or not.
  [[nodiscard]] bool uses(Side side) const noexcept { return setup_side == side || facts_side == side; }
  /// Shows the facts of what is picked; `in_list`: picked in the list of the worst, which stays.
  void show_selection(bool in_list = false);
  /// Goes back to the tab before, when nothing is picked any more.
  void leave_selection();
  // Sizes of panels, in heights of the interface's font.
  double left_width = 16.0, right_width = 20.0, bottom_height = 13.0;
  double runs_height = 4.8;  // height of the list of runs: three rows
};

struct ScreenshotOptions {
  std::filesystem::path path;
  int width = 0, height = 0;  // size in pixels; 0: as on screen
  int supersample = 2;
  bool transparent = false;
  bool window = false;  // the whole interface instead of the mesh
  bool quiet = false;   // one of many: only failures are reported
};

/// Input that a script sends through the window's own event handling, one a frame.
struct SimulatedInput {
  enum class Kind { Move, Press, Release, Wheel, KeyDown, KeyUp, Text };
  Kind kind = Kind::Move;
  float x = 0, y = 0;  // pixels; for Wheel, the amount in y
  int button = 0;
  KeyChord chord;
  std::string text;
};

/// Requests of commands to the event loop; each is taken once.
struct Requests {
  bool quit = false;
  bool fit = false;
  bool fit_all = false;  // with `fit`: also viewports with cameras of their own
  std::optional<bool> full_screen;
  std::optional<std::pair<int, int>> size;
  std::deque<ScreenshotOptions> screenshots;
  bool screenshot_failed = false;  // set when one fails, until it is reset by the caller
  std::deque<PlotSave> plots;
  std::deque<SimulatedInput> input;
  std::optional<std::string> clipboard;
};

struct ViewState {
  // Camera and picture
  render::Camera2D camera;  // camera of the active pane, and of all while they are linked
  Panes panes;
  render::OrbitCamera orbit;              // camera of volume meshes, in all panes
  bool trackball = false;                 // a drag rolls volume meshes as a ball instead of turning them about the upright axis
  ClippingView inside;                    // visible part of volume meshes
  bool in_space = false;                  // a volume or a curved surface is on show; set by follow()
  Vec2<double> viewport{800, 600};        // size of a pane in pixels, set by the drawing code
  std::pair<int, int> window_size{0, 0};  // size in pixels, set by the drawing code; 0: not known yet
  bool wireframe = true;
  bool vertices = false;
  bool worst_marker = true;
  bool pointer_value = false;  // the element's value is shown at the pointer; not in scripts, whose pictures must always be the same
  bool features = false;       // shows curves along which vertices slide, and what holds vertices in place
  std::optional<std::array<Index, 2>> edge_under_mouse;  // edge under the mouse in the inspector or a menu, shown in the mesh
  bool holders = false;   // shows what holds the minimum: elements that hold one another, their forces, and the cluster
  bool shading = true;    // lights volumes' faces, which changes colours
  bool occlusion = true;  // darkens volumes in their corners and along their edges
  render::ColourMap colour_map = render::ColourMap::Beacon;
  RangeMode range_mode = RangeMode::Input;
  double range_low = 0.0, range_high = 1.0;                   // range for RangeMode::Given
  double range_low_percent = 2.0, range_high_percent = 98.0;  // percentiles for RangeMode::Percentile
  ColouringState colouring;

  // Interface
  Theme theme = Theme::Dark;
  double scale = 1.0;          // factor of text and widgets
  double monitor_scale = 1.0;  // the monitor's part of the factor; 1 for scripts, so that they draw the same everywhere
  Panels panels;
  Dialog dialog = Dialog::None;
  OpenFor open_for = OpenFor::Alone;  // role of the file in Dialog::Open
  PlotTab plot = PlotTab::Convergence;
  std::array<PlotView, kPlotTabs.size()> plots;
  PlotOptions plot_options;
  KnownRunNames run_names;  // names that the plots' legends had last
  bool full_screen = false;
  WindowPlace place;

  // Work that would be lost
  bool asks_unsaved = false;              // asks before a person gives up unsaved work; scripts are not asked
  std::optional<Leaving> leaving;         // command that waits for the answer
  std::vector<Recoverable> recoverable;   // sessions of windows that did not end properly, until a person decides on them
  std::optional<Recoverable> recovering;  // the one of these that the session was recovered from
  bool native_dialogs = true;             // uses the desktop's file dialogs if there are any

  // Selection
  Picked picked;
  Picked pick_on_switch;  // pick in another open mesh, which is about to become the active one
  Selection selection;
  Brush brush;
  SteppingState stepping;
  InspectionState inspection;
  std::optional<std::uint64_t> renaming_run;  // RunView::id of the run whose name is being typed in the list
  bool placing_size_point = false;            // the next click in the view places the point of the size function

  // Time
  Timeline timeline;
  std::optional<Sequence> sequence;  // pictures that are being taken
  bool watch_file = false;           // reads the mesh again whenever its file changes

  // Log
  std::deque<Message> log;       // newest last, at most 200
  std::uint64_t messages = 0;    // number of all messages so far
  CommandLog commands;           // commands and messages
  ResultLine result;             // text of the status bar
  std::string error_text;        // text of the error dialog
  std::string dismissed_notice;  // Notice::key of the note that a person dismissed

  Tour tour;

  // Remembered
  std::vector<std::string> recent_files;  // newest first, at most 10

  Requests requests;

  /// Camera of a pane.
  [[nodiscard]] render::Camera2D& camera_of(std::size_t pane) {
    return panes.linked || pane == panes.focus ? camera : panes.panes[pane].camera;
  }
  /// Puts all panes under the camera of the active one; or gives each its own, starting from that.
  void link_cameras(bool linked);
  /// Makes a pane the active one.
  void focus_pane(std::size_t pane);
  /// Brings panes, the reference of differences and the runs' names up to date with the session.
  void follow(const SessionView& session);
  /// Sets the arrangement of viewports, see Panes::set_layout.
  void set_layout(PaneLayout layout);
  /// Shows the matrix of so many runs, and if four viewports have room for them, each run in a viewport.
  void show_comparison(std::size_t runs);

  [[nodiscard]] PlotView& plot_view() { return plots[static_cast<std::size_t>(plot)]; }
};

/// Lowest and highest quality of the shown metric, without inverted elements; for a device-resident frame as far as its histogram tells.
/// None if no element has a quality.
[[nodiscard]] std::optional<std::pair<double, double>> own_range(const Frame& frame);
/// Range of qualities that the colours span now. `own`: see own_range; `seen`: the range of all frames so far, for RangeMode::Expanding;
/// `input`: null: not known, `own` is taken instead.
[[nodiscard]] std::pair<double, double> colour_range(const ViewState& state, std::optional<std::pair<double, double>> own,
                                                     std::optional<std::pair<double, double>> seen = {},
                                                     const InputSpread* input = nullptr);

/// Adapts to a monitor with another scale; the factor that a person chose on top of it stays.
void move_to_monitor(ViewState& state, double monitor_scale);

/// Adds a line to the log; an error also opens the error dialog (unless one is open, then it is appended there).
void add_message(ViewState& state, Message message);

/// Puts a file at the front of the recent ones, by its whole path.
void remember_file(ViewState& state, const std::string& file);

/// Opens the tab or fold that a control belongs to, by its name; does nothing for a control that is always there or not known.
void open_home_of(std::string_view item, Panels& panels);

}  // namespace dmoscope::ui
