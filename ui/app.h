#pragma once
// The window's content: the engine, the view state and the scene, drawn one ImGui frame at a time. The owner of the platform (GLFW, or
// none) drives it.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/engine/engine.h"
#include "render/screenshot.h"
#include "ui/analysis/step_report.h"
#include "ui/commands/view_commands.h"
#include "ui/panels/panels.h"
#include "ui/state/mesh_change.h"
#include "ui/state/run_progress.h"
#include "ui/state/view_state.h"
#include "ui/toolkit/file_watch.h"
#include "ui/viewports/viewports.h"

namespace dmoscope::ui {

class App {
 public:
  struct Options {
    unsigned threads = 0;             // threads of the smoothing; 0: one per hardware thread
    Acceleration acceleration{};      // devices that runs may use besides the CPU
    Backend backend = Backend::Auto;  // backend that the first run asks for
    std::string renderer;             // name of the OpenGL renderer
    std::string no_interop;           // reason why the accelerator cannot write what is drawn; empty if it can
    bool software_renderer = false;
    bool sample_pictures = true;  // pictures of samples on the start page
    bool native_dialogs = false;  // allows the desktop's file dialogs
    bool wait_for_scene = false;  // big meshes are made ready for drawing before a frame goes on (headless)
  };

  /// Needs a current OpenGL context and a current ImGui context, also when destroyed.
  explicit App(Options options);
  ~App();
  App(const App&) = delete;
  App& operator=(const App&) = delete;

  [[nodiscard]] ViewState& state() noexcept { return state_; }
  [[nodiscard]] const ViewState& state() const noexcept { return state_; }
  [[nodiscard]] Engine& engine() noexcept { return engine_; }
  [[nodiscard]] const Items& items() const noexcept { return items_; }
  [[nodiscard]] const Activity& activity() const noexcept { return activity_; }
  /// Frame that was drawn last; null: nothing is open.
  [[nodiscard]] std::shared_ptr<const Frame> frame() const { return session_->frame; }
  [[nodiscard]] const CommandTable& commands() const noexcept { return commands_; }
  /// Range of the colours of quality, and the colours shown instead of it (null: quality), in the active viewport as drawn last.
  [[nodiscard]] std::pair<double, double> colour_range() const noexcept { return derived_.range; }
  /// Range of the values other than quality that elements are coloured by, all viewports together.
  [[nodiscard]] std::optional<std::pair<double, double>> values_range() const { return derived_.colouring.values_range; }
  [[nodiscard]] std::shared_ptr<const ElementColours> colours() const noexcept { return derived_.colouring.colours; }
  /// The viewports as drawn last.
  [[nodiscard]] std::span<const PaneFacts> panes() const noexcept { return viewports_.facts(); }
  /// The inspection as drawn last.
  [[nodiscard]] const Inspection& inspection() const noexcept { return inspection_; }

  /// Runs or queues one command line. Throws UsageError for an impossible one (errors of the session become messages).
  void execute(std::string_view line);
  /// Runs or queues one command line; errors become messages.
  void submit(std::string_view line);
  /// Opens the tab or fold of the control that a line of a script clicks, and scrolls to it; true: a frame is to be drawn before the line.
  bool bring_to_sight(std::string_view line);
  /// Runs a line of a person, or opens the question instead if it would give up unsaved work.
  void submit_by_person(std::string_view line);
  /// Stores the present view with the automatically saved session.
  void update_autosaved_view();
  /// Called with every message of the session, besides the log.
  /// `wake` ends the event loop's waiting; called from any thread when there is something new.
  void set_wake(const std::function<void()>& wake);
  void set_listener(std::function<void(const Message&)> listener) { listener_ = std::move(listener); }

  /// Whether keys are for commands: no field, dialog or menu has the keyboard.
  [[nodiscard]] bool takes_commands() const;
  /// Runs the action of a key if it is possible now. `repeated`: the key is being held.
  void press(const KeyChord& chord, bool repeated = false);
  /// Letter that ImGui gets for a typed one.
  [[nodiscard]] char16_t shown_letter(char32_t letter) { return widgets_.glyphs.shown_letter(letter); }
  /// Whether the control that has the keyboard takes text.
  [[nodiscard]] bool focus_takes_text() const { return items_.focus_takes_text(); }
  /// Moves the keyboard to the next control (1) or to the one before (-1), with the next frame.
  void move_focus(int direction) noexcept { focus_moves_ = direction; }

  /// Builds fonts and style anew when theme or scale changed; to be called before ImGui::NewFrame. True: upload the font texture again.
  bool prepare();
  /// Draws the window, the mesh into a texture of its own; to be called between ImGui::NewFrame and ImGui::Render. `now`: seconds on any
  /// steady clock.
  void draw(double now);
  /// Seconds after which a frame should be drawn though nothing happens; infinity when there is no such need.
  [[nodiscard]] double redraw_in() const noexcept { return redraw_in_; }
  /// Whether nothing is under way: false while the scene is prepared in the background or drawn in full, a fit waits for it, or the window
  /// does something by itself that ends.
  [[nodiscard]] bool settled() const noexcept {
    const bool drawn = viewports_.settled() && !state_.requests.fit;
    return drawn && !state_.sequence && state_.timeline.play.kind != Playback::Kind::History;
  }

  /// A picture of the mesh in its present view, with its colour bar.
  [[nodiscard]] render::Image mesh_picture(const ScreenshotOptions& options);
  /// Title of the window: "east.14 – dmoscope".
  [[nodiscard]] std::string title() const;

 private:
  void take_news(double now);
  void show_comparison(bool ended);
  [[nodiscard]] std::vector<std::string> look() const;
  [[nodiscard]] std::shared_ptr<const SessionView> shown_view();
  void post_by_itself(const std::string& line);
  void advance_playback(double now);
  void take_restored_view();
  void advance_sequence();
  void end_sequence(const std::string& outcome, Message::Kind kind);
  void watch_file();
  void keep_safe(bool busy, double now);
  void cancel();
  void update_backend();
  void update_drawing();
  void notice_new_input();
  void show_beside();
  [[nodiscard]] SaveRows* rows_of(Dialog dialog);
  void take_chosen_file();
  void serve_chooser();
  void note_letters(const Mesh& mesh);
  void update_derived();
  double play_on(bool busy, double now);
  [[nodiscard]] std::vector<Rect> pane_places(PanelContext& context, const Rect& rect);
  void update_viewports(PanelContext& context, const Layout& layout);
  [[nodiscard]] bool waits_its_turn(const Action& action) const;
  void draw_panels(PanelContext& context);
  void uncover_pick(const Layout& layout);
  [[nodiscard]] bool moving(double now) const;

  Options options_;
  ViewState state_;
  Engine engine_;
  CommandHost host_;
  CommandTable commands_;
  std::shared_ptr<const SessionView> session_;
  Activity activity_;
  Derived derived_;
  Inspection inspection_;
  WidgetState widgets_;
  Items items_;
  Fonts fonts_;
  std::function<void(const Message&)> listener_;
  std::function<void()> wake_;
  struct Flipped {
    std::shared_ptr<const SessionView> now;
    std::shared_ptr<const Frame> mark;
    std::shared_ptr<const SessionView> view;
  };
  Flipped flipped_;  // latest result of shown_view()

  Viewports viewports_;
  StepWatch steps_;
  FileChooser chooser_;
  bool chooser_failed_ = false;  // set after a failure: it is not tried again

  Pace pace_;
  double styled_scale_ = 0.0;
  std::size_t built_letters_ = 0;
  std::optional<Theme> styled_theme_;
  double busy_since_ = -1.0, last_draw_ = -1.0, frame_interval_ = 0.0;
  double redraw_in_ = 0.0;
  int focus_moves_ = 0;
  Picked seen_pick_;               // pick in the last frame
  std::size_t runs_before_ = 0;    // number of runs in the last frame
  bool comparison_shown_ = false;  // whether the comparison was shown for the command at work
  double view_kept_at_ = 0.0;
  std::uint64_t seen_restored_ = 0;
  MeshWatch meshes_;
  std::unique_ptr<FileWatch> watch_;  // declared last, because it wakes others
};

}  // namespace dmoscope::ui
