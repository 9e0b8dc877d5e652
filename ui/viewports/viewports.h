#pragma once
// All viewports: finds the content of each from the state and the session, and draws it.

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/view/view.h"
#include "render/screenshot.h"
#include "ui/viewports/pane_view.h"

namespace dmoscope::ui {

/// A viewport as panels draw it; alive until the next Viewports::draw.
struct PaneFacts {
  std::size_t number = 0;                         // index of the viewport, from 0
  Rect rect;                                      // place of its picture
  Rect clip;                                      // visible part of that: all of it except in a split view
  Rect uncovered;                                 // part of `clip` over which no column lies
  std::shared_ptr<const SessionView> session;     // session with its frame and its run in place of the active ones; the frame may be null
  std::string name;                               // "A", "B", "input"; empty for a run
  std::string why_not;                            // reason why it shows no mesh
  bool of_run = true;                             // whether it is meant to show a run
  bool removed = false;                           // the run was removed from the session after it was marked
  std::shared_ptr<const ElementColours> colours;  // null: quality
  std::span<const render::Label> labels;
  render::Camera2D camera;                // camera of a planar mesh
  std::optional<render::SceneView> view;  // none: it shows no mesh
  unsigned texture = 0;
  std::uint64_t picture_serial = 0;       // grows whenever its elements look otherwise
  bool focus = false;                     // whether it is the active one
  bool inspected = false;                 // the inspected search is shown here
  bool reduced = false;                   // drawn with fewer elements just now
  bool current = false;                   // whether its mesh is drawn; false while the mesh is made ready for that
  bool lacks_room = false;                // there is no room for labels
  std::optional<std::size_t> cells_seen;  // number of visible elements of a volume mesh
  render::Bounds3 box;                    // box of a volume mesh
  std::string stepping_note;
  [[nodiscard]] const Frame* frame() const { return session->frame.get(); }
  [[nodiscard]] bool in_space() const { return frame() != nullptr && frame()->input->in_space(); }
  [[nodiscard]] const RunView* run() const { return session->runs.empty() ? nullptr : &session->runs[session->active]; }
};

/// One piece of a viewport's title; pieces of the highest rank are left out first if room is lacking.
struct TitlePiece {
  enum class Role { Name, Plain, Dim, Bad, Warning };
  std::string text;
  Role role = Role::Plain;
  int rank = 0;
};
/// Pieces of a viewport's title: "dmo", "mean ratio", "iteration 12", "min 0.31", "3 inverted" ... `shown`: the metric that colours tell.
[[nodiscard]] std::vector<TitlePiece> title_of(const PaneFacts& pane, Metric shown);

/// Whether two planar meshes lie at about the same place, so that one camera suits both.
[[nodiscard]] bool cover_alike(const InputMesh& a, const InputMesh& b);

class Viewports {
 public:
  struct Options {
    std::string no_interop;  // reason why a device cannot write what is drawn; empty if it can
    bool software_renderer = false;
    bool wait_for_scene = false;  // big meshes are made ready before a frame goes on
  };
  /// Needs a current OpenGL context, also when destroyed.
  explicit Viewports(Options options);

  /// Sets the content of each viewport. `session`: the shown one, perhaps with a mark in place of the active run's frame.
  void follow(const ViewState& state, const std::shared_ptr<const SessionView>& session);
  /// Requests to the session for this content, besides the active run.
  [[nodiscard]] std::vector<Watch> wanted(const ViewState& state) const;
  /// Width over height of the input's box.
  [[nodiscard]] double aspect() const noexcept { return aspect_; }
  /// All different frames on show.
  [[nodiscard]] const std::vector<std::shared_ptr<const Frame>>& frames() const noexcept { return frames_; }
  void update_colours(ViewState& state, Derived& derived);
  void update_stepping(bool busy);

  struct Turn {
    double em = 15.0;     // height of the interface's font
    bool moving = false;  // the view has just moved
    bool live = false;    // a run is at work
    int note_lines = 0;   // lines below the active viewport's title
    Rect uncovered;       // part of all viewports over which no column lies
  };
  /// Draws all that changed, as far as a moment goes, each within one of `rects`. A requested fit is done once its mesh is there; true: it
  /// was done.
  bool draw(ViewState& state, const Derived& derived, const Inspection& inspection, std::span<const Rect> rects, const Turn& turn);
  /// Notes that the cameras were set by something other than a fit.
  void forget_fit() {
    fitted_.reset();
    fitted_others_ = {};
    fitted_orbit_.reset();
  }
  [[nodiscard]] std::span<const PaneFacts> facts() const noexcept { return facts_; }
  /// Element and vertex at a pixel, see PlanarScene::pick.
  [[nodiscard]] render::Pick pick(const ViewState& state, std::size_t pane, Vec2<double> pixel) const;
  /// Point of a volume mesh that is seen at a pixel; none if there is nothing.
  [[nodiscard]] std::optional<Vec3> point_at(const ViewState& state, std::size_t pane, Vec2<double> pixel) const;
  [[nodiscard]] std::vector<Index> vertices_near(const ViewState& state, std::size_t pane, Vec2<double> pixel, double radius) const;

  [[nodiscard]] PaneView& active() noexcept { return *views_[focus_]; }
  /// Whether meshes are being uploaded to OpenGL, coarse pictures wait to become full ones, or neither.
  [[nodiscard]] bool loading() const noexcept { return loading_; }
  [[nodiscard]] bool refining() const noexcept { return refining_; }
  [[nodiscard]] bool settled() const noexcept;
  [[nodiscard]] bool colours_settled() const noexcept;

  /// A picture of the meshes in their present view, with titles if there are several, and one colour bar. Throws Error.
  [[nodiscard]] render::Image picture(const ViewState& state, const Derived& derived, const Inspection& inspection, render::Shot shot);

 private:
  /// The session with another frame and run, made anew only when one of these changes.
  struct Content {
    std::shared_ptr<const SessionView> session, view;
    std::shared_ptr<const Frame> frame;
    std::size_t active = 0;
    std::string name, why_not;
  };
  /// A mark with its run at the time: the run's place in the session may belong to another run by now, or to none.
  struct Marked {
    std::shared_ptr<const Frame> frame;  // null: not set
    RunView run;
  };
  void remember(Marked& marked, const Mark& mark);
  /// Sets the content of a pane. `own`: run taken for the one at this place (or behind the last); null: the session's own.
  void show(std::size_t pane, std::shared_ptr<const Frame> frame, std::size_t run, std::string name, std::string why_not,
            const RunView* own = nullptr);
  void show_content(const ViewState& state, std::size_t pane);
  void show_mark(std::size_t pane, const Marked& mark, const char* letter);
  bool fit(ViewState& state, const Rect& rect, const Turn& turn);
  [[nodiscard]] static std::pair<double, double> covered(const Rect& rect, const Turn& turn);
  [[nodiscard]] render::Bounds2 box_of_pane(std::size_t pane) const;
  [[nodiscard]] bool keeps_fit(const render::OrbitCamera& now, bool resized) const;
  [[nodiscard]] bool inspected(const ViewState& state, std::size_t pane) const;
  void measure();
  [[nodiscard]] std::shared_ptr<const Frame> reference(const ViewState& state) const;
  [[nodiscard]] PaneFacts facts_of_pane(ViewState& state, std::size_t pane, const Rect& rect, const Rect& uncovered) const;
  [[nodiscard]] render::Image joint_picture(const Scenery& scenery, const render::Shot& shot, const render::Legend& legend);
  [[nodiscard]] render::Image picture_of(std::size_t pane, const Scenery& scenery, const render::Shot& shot);

  Options options_;
  /// Threads that find the visible part of volumes, made for the first one. They are not the session's, because a dragged clip plane must
  /// not wait for these. Declared before the viewports, which use them.
  std::unique_ptr<ThreadPool> pool_;
  std::shared_ptr<const SessionView> session_;
  std::array<std::unique_ptr<PaneView>, Panes::kMost> views_;  // one for each viewport on show
  std::array<Content, Panes::kMost> shown_;
  std::array<Marked, 2> marked_;  // marks A and B
  std::vector<std::shared_ptr<const Frame>> frames_;
  std::vector<PaneFacts> facts_;
  std::optional<render::Camera2D> fitted_;  // camera of the last fit, until it is moved
  std::array<std::optional<render::Camera2D>, Panes::kMost>
      fitted_others_;  // last fits of viewports that show another mesh by a camera of their own
  std::optional<render::OrbitCamera> fitted_orbit_;
  int fitted_below_ = 0;                     // lines below the title at the last fit
  std::pair<double, double> fitted_beside_;  // widths that columns covered at its sides then
  // State at the last follow(): a command may have changed it since.
  PaneLayout layout_ = PaneLayout::One;
  std::size_t count_ = 1, focus_ = 0;
  bool loading_ = false, refining_ = false;
  double aspect_ = 1.0;
  std::shared_ptr<const InputMesh> measured_;  // the input that aspect_ belongs to
};

}  // namespace dmoscope::ui
