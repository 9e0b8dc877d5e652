#pragma once
// The viewports there are, from what the state and the session say each shows to their pictures.

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/view/view.h"
#include "render/screenshot.h"
#include "ui/viewports/pane_view.h"

namespace dmoscope::ui {

/// A viewport as panels draw it; alive until the next Viewports::draw.
struct PaneFacts {
  std::size_t number = 0;                         // from 0
  Rect rect;                                      // of its picture
  Rect clip;                                      // what of that is seen: all but in a split view
  std::shared_ptr<const SessionView> session;     // with its frame and its run in place of the active ones; the frame may be null
  std::string name;                               // "A", "B", "input"; empty for a run
  std::string why_not;                            // it shows no mesh
  bool of_run = true;                             // it is meant to show a run
  bool removed = false;                           // which the session has no longer: it was marked before
  std::shared_ptr<const ElementColours> colours;  // null: quality
  std::span<const render::Label> labels;
  render::Camera2D camera;                // of a planar mesh
  std::optional<render::SceneView> view;  // none: it shows no mesh
  unsigned texture = 0;
  bool focus = false;                     // the active one
  bool inspected = false;                 // where the search that is looked into is shown
  bool reduced = false;                   // drawn with fewer elements just now
  bool current = false;                   // its mesh is drawn; else it is still made ready for that
  bool lacks_room = false;                // for labels
  std::optional<std::size_t> cells_seen;  // of a volume mesh, of all its elements
  render::Bounds3 box;                    // of it
  std::string stepping_note;
  [[nodiscard]] const Frame* frame() const { return session->frame.get(); }
  [[nodiscard]] bool in_space() const { return frame() != nullptr && frame()->input->in_space(); }
  [[nodiscard]] const RunView* run() const { return session->runs.empty() ? nullptr : &session->runs[session->active]; }
};

/// One piece of a viewport's title; those of the highest rank are left out first where there is no room.
struct TitlePiece {
  enum class Role { Name, Plain, Dim, Bad, Warning };
  std::string text;
  Role role = Role::Plain;
  int rank = 0;
};
/// "dmo", "mean ratio", "iteration 12", "min 0.31", "3 inverted" ... `shown`: the metric that colours tell.
[[nodiscard]] std::vector<TitlePiece> title_of(const PaneFacts& pane, Metric shown);

/// Whether two planar meshes lie at about the same place, so that one camera suits both.
[[nodiscard]] bool cover_alike(const InputMesh& a, const InputMesh& b);

class Viewports {
 public:
  struct Options {
    std::string no_interop;  // why a device cannot write what is drawn; empty where it can
    bool software_renderer = false;
    bool wait_for_scene = false;  // big meshes are made ready before a frame goes on
  };
  /// Needs a current OpenGL context, also when destroyed.
  explicit Viewports(Options options);

  /// What each shows from now on. `session`: as it is shown, perhaps with a mark in place of the active run's frame.
  void follow(const ViewState& state, const std::shared_ptr<const SessionView>& session);
  /// What that needs of the session besides the active run.
  [[nodiscard]] std::vector<Watch> wanted(const ViewState& state) const;
  /// Width over height of the input's box.
  [[nodiscard]] double aspect() const noexcept { return aspect_; }
  /// The different frames on show.
  [[nodiscard]] const std::vector<std::shared_ptr<const Frame>>& frames() const noexcept { return frames_; }
  void update_colours(ViewState& state, Derived& derived);
  void update_stepping(bool busy);

  struct Turn {
    double em = 15.0;     // height of the interface's font
    bool moving = false;  // the view was moved just now
    bool live = false;    // a run goes on
  };
  /// Draws all that changed, as far as a moment goes, each within one of `rects`. A fit that is asked for is done once its mesh is there;
  /// true: it was.
  bool draw(ViewState& state, const Derived& derived, const Inspection& inspection, std::span<const Rect> rects, const Turn& turn);
  /// Somebody else has set the cameras.
  void forget_fit() {
    fitted_.reset();
    fitted_others_ = {};
    fitted_orbit_.reset();
  }
  [[nodiscard]] std::span<const PaneFacts> facts() const noexcept { return facts_; }
  /// See PlanarScene.
  [[nodiscard]] render::Pick pick(const ViewState& state, std::size_t pane, Vec2<double> pixel) const;
  /// The point of a volume mesh that is seen there; none where nothing is.
  [[nodiscard]] std::optional<Vec3> point_at(const ViewState& state, std::size_t pane, Vec2<double> pixel) const;
  [[nodiscard]] std::vector<Index> vertices_near(const ViewState& state, std::size_t pane, Vec2<double> pixel, double radius) const;

  [[nodiscard]] PaneView& active() noexcept { return *views_[focus_]; }
  /// Meshes are on their way to OpenGL; coarse pictures are to be made full ones; nothing of all that.
  [[nodiscard]] bool loading() const noexcept { return loading_; }
  [[nodiscard]] bool refining() const noexcept { return refining_; }
  [[nodiscard]] bool settled() const noexcept;
  [[nodiscard]] bool colours_settled() const noexcept;

  /// A picture of the meshes as they are seen now, with titles where there are several, and one colour bar. Throws Error.
  [[nodiscard]] render::Image picture(const ViewState& state, const Derived& derived, const Inspection& inspection, render::Shot shot);

 private:
  /// The session with another frame and run, made anew only when one of these changes.
  struct Content {
    std::shared_ptr<const SessionView> session, view;
    std::shared_ptr<const Frame> frame;
    std::size_t active = 0;
    std::string name, why_not;
  };
  /// A mark with its run as it was then: the place in the session that its frame tells may be another's by now, or nobody's.
  struct Marked {
    std::shared_ptr<const Frame> frame;  // null: not set
    RunView run;
  };
  void remember(Marked& marked, const Mark& mark);
  /// `own`: what the run at this place (or behind the last) is taken to be; null: what the session says.
  void show(std::size_t pane, std::shared_ptr<const Frame> frame, std::size_t run, std::string name, std::string why_not,
            const RunView* own = nullptr);
  void show_content(const ViewState& state, std::size_t pane);
  void show_mark(std::size_t pane, const Marked& mark, const char* letter);
  bool fit(ViewState& state, double em);
  [[nodiscard]] render::Bounds2 box_of_pane(std::size_t pane) const;
  [[nodiscard]] bool keeps_fit(const render::OrbitCamera& now, bool resized) const;
  [[nodiscard]] bool inspected(const ViewState& state, std::size_t pane) const;
  void measure();
  [[nodiscard]] std::shared_ptr<const Frame> reference(const ViewState& state) const;
  [[nodiscard]] PaneFacts facts_of_pane(ViewState& state, std::size_t pane, const Rect& rect) const;
  [[nodiscard]] render::Image joint_picture(const Scenery& scenery, const render::Shot& shot, const render::Legend& legend);
  [[nodiscard]] render::Image picture_of(std::size_t pane, const Scenery& scenery, const render::Shot& shot);

  Options options_;
  /// For what is seen of volumes; from the first one on. Of their own: a clip plane that is dragged is not to wait for the session's.
  /// Before the viewports, which use it.
  std::unique_ptr<ThreadPool> pool_;
  std::shared_ptr<const SessionView> session_;
  std::array<std::unique_ptr<PaneView>, Panes::kMost> views_;  // as many as are shown
  std::array<Content, Panes::kMost> shown_;
  std::array<Marked, 2> marked_;  // A and B
  std::vector<std::shared_ptr<const Frame>> frames_;
  std::vector<PaneFacts> facts_;
  std::optional<render::Camera2D> fitted_;  // the camera of the last fit, while nobody has moved it
  std::array<std::optional<render::Camera2D>, Panes::kMost>
      fitted_others_;  // the same of viewports that show another mesh by a camera of their own
  std::optional<render::OrbitCamera> fitted_orbit_;
  // As followed last: a command may have changed the state since.
  PaneLayout layout_ = PaneLayout::One;
  std::size_t count_ = 1, focus_ = 0;
  bool loading_ = false, refining_ = false;
  double aspect_ = 1.0;
  std::shared_ptr<const InputMesh> measured_;  // the input that this is of
};

}  // namespace dmoscope::ui
