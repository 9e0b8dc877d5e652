#pragma once
// One viewport, drawn into a picture of its own.

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "render/live_picture.h"
#include "render/planar_scene.h"
#include "render/volume_scene.h"
#include "ui/analysis/colour_worker.h"
#include "ui/analysis/derived.h"
#include "ui/analysis/inspection.h"
#include "ui/overlays/overlays.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

class PaneView {
 public:
  /// `no_interop`: reason why a device cannot write what is drawn; empty if it can.
  explicit PaneView(std::string no_interop = {}) : no_interop_(std::move(no_interop)) { plane().draw_through_host(no_interop_); }
  /// Sets the content: a session with this viewport's frame and run in place of the active ones. Its frame is null when nothing is shown.
  void show(std::shared_ptr<const SessionView> session) { session_ = std::move(session); }
  [[nodiscard]] const std::shared_ptr<const SessionView>& session() const noexcept { return session_; }
  [[nodiscard]] const Frame* frame() const noexcept { return session_ ? session_->frame.get() : nullptr; }

  /// Brings the elements' colours up to date. `reference`: frame that differences are taken from; `like`: a viewport that has worked out
  /// the same already, or null.
  void update_colours(const ViewState& state, std::shared_ptr<const Frame> reference, const PaneView* like);
  [[nodiscard]] const std::shared_ptr<const ElementColours>& colours() const noexcept { return colours_; }
  void update_stepping(bool busy) { overlays_.update(*session_, busy); }

  /// Uploads the mesh to OpenGL; false while that goes on in the background.
  bool bring(render::Loading loading);
  struct Wish {
    render::Camera2D camera;
    bool inspected = false;  // whether marks of the inspected search belong here
    double detail = 1.0;
    bool refine = true;
    bool plain = false;  // see LivePicture
  };
  /// Draws the viewport with the size state.viewport, as far as a moment goes.
  void draw(const Scenery& scenery, const Wish& wish);
  /// All marks, also for a picture of another size.
  [[nodiscard]] render::Marks marks(const Scenery& scenery, const render::Camera& camera, Vec2<double> viewport, bool inspected) {
    return overlays_.marks(scenery, *session_, scene(), camera, viewport, inspected);
  }
  /// Note on marks that are faint because their elements were taken away, and on stepping.
  [[nodiscard]] std::string note(const ViewState& state) const;
  /// Sets the threads for finding the visible part of a volume; null: the caller's alone.
  void set_pool(ThreadPool* pool) noexcept { pool_ = pool; }

  /// Scene of the shown mesh.
  [[nodiscard]] render::Scene& scene() noexcept {
    return std::visit([](auto& scene) -> render::Scene& { return scene; }, scene_);
  }
  [[nodiscard]] const render::Scene& scene() const noexcept {
    return std::visit([](const auto& scene) -> const render::Scene& { return scene; }, scene_);
  }
  /// Scene of a planar mesh, or of one in space; null if the mesh is of the other kind.
  [[nodiscard]] render::PlanarScene* planar() noexcept { return std::get_if<render::PlanarScene>(&scene_); }
  [[nodiscard]] const render::PlanarScene* planar() const noexcept { return std::get_if<render::PlanarScene>(&scene_); }
  [[nodiscard]] render::VolumeScene* volume() noexcept { return std::get_if<render::VolumeScene>(&scene_); }
  [[nodiscard]] const render::VolumeScene* volume() const noexcept { return std::get_if<render::VolumeScene>(&scene_); }
  /// Camera of the mesh; `camera`: for a planar one.
  [[nodiscard]] render::Camera seen_from(const ViewState& state, const render::Camera2D& camera) const;
  [[nodiscard]] bool in_space() const noexcept { return frame() != nullptr && frame()->input->in_space(); }
  /// Number of faces or elements to draw.
  [[nodiscard]] std::size_t drawn_count() const noexcept { return scene().drawn_count(); }
  /// Element and vertex at a pixel of its picture.
  [[nodiscard]] render::Pick pick(const ViewState& state, const render::Camera2D& camera, Vec2<double> pixel, double radius) const;
  [[nodiscard]] unsigned texture() const noexcept { return picture_.texture(); }
  [[nodiscard]] std::uint64_t picture_serial() const noexcept { return picture_.serial(); }
  [[nodiscard]] bool whole() const noexcept { return picture_.whole(); }
  [[nodiscard]] bool complete() const noexcept { return picture_.complete(); }
  [[nodiscard]] bool current() const noexcept { return current_; }
  [[nodiscard]] bool settled() const noexcept { return current_ && complete() && worker_.settled(); }
  [[nodiscard]] bool colours_settled() const noexcept { return worker_.settled(); }
  /// Ids on the mesh, and whether some were left out for lack of room.
  [[nodiscard]] const std::vector<render::Label>& labels() const noexcept { return labels_; }
  [[nodiscard]] bool labels_lack_room() const noexcept { return labels_lack_room_; }

 private:
  [[nodiscard]] render::PlanarScene& plane() noexcept { return std::get<render::PlanarScene>(scene_); }
  void update_planar(render::PlanarScene& scene, const Scenery& scenery);
  void update_volume(render::VolumeScene& scene, const Scenery& scenery, const Wish& wish);
  /// Selection of the elements of its frame that count.
  [[nodiscard]] render::Selection selection(const Scenery& scenery);
  [[nodiscard]] std::shared_ptr<const std::vector<std::uint8_t>> moved_just_now(const SteppingState& stepping);
  void find_labels(const Scenery& scenery, const render::Camera& camera);

  std::shared_ptr<const SessionView> session_;
  std::string no_interop_;
  std::variant<render::PlanarScene, render::VolumeScene> scene_;  // scene of the kind of mesh that was shown last
  render::LivePicture picture_;
  ThreadPool* pool_ = nullptr;
  Overlays overlays_;
  ColourWorker worker_;
  std::shared_ptr<const ElementColours> colours_;
  ColourFacts members_;  // colours of its frame if that is not the active one
  std::vector<render::Label> labels_;
  bool labels_lack_room_ = false;
  bool current_ = true;
  std::uint64_t fixed_serial_ = 0;
  std::shared_ptr<const std::vector<std::uint8_t>> tinted_;
  std::uint64_t tinted_serial_ = 0;  // serial of the frame of these elements
};

/// Present look of the mesh.
[[nodiscard]] render::Style picture_style(const ViewState& state, const Derived& derived);

}  // namespace dmoscope::ui
