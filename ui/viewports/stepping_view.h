#pragma once
// Keeps what arrows and ghosts compare the mesh with, and makes the marks of stepping and of the selection.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>

#include "ui/state/view_state.h"
#include "ui/toolkit/theme.h"
#include "ui/viewports/stepping_marks.h"
#include "ui/viewports/volume_stepping_marks.h"

namespace dmoscope::ui {

class SteppingView {
 public:
  /// Elements around the view; none where they are more than `most`.
  using ElementsInView = std::function<std::optional<std::vector<Index>>(const MarkView&, std::size_t most)>;

  /// Once a frame: notices when a command has moved something. `busy`: more is to come.
  void update(const SessionView& session, bool busy);

  void add_marks(render::Marks& marks, const ViewState& state, const SessionView& session, const MarkView& view,
                 const ElementsInView& elements_in_view);

  /// The same of a volume mesh, of what nothing hides: selected vertices apart, which are marked anyway.
  void add_space_marks(render::SpaceMarks& marks, const ViewState& state, const SessionView& session, const render::VolumeScene& scene,
                       Vec2<double> viewport);

  /// What is shown, in words for the mesh's title: "next: class 2 of 7, 1,234 vertices"; empty when nothing is.
  [[nodiscard]] std::string note(const ViewState& state, const SessionView& session) const;

 private:
  void make_marks(const ViewState& state, const SessionView& session, const MarkView& view, const ElementsInView& elements_in_view);
  /// Changes whenever the marks do.
  [[nodiscard]] std::string key(const ViewState& state, const Frame& frame, const JointCluster* hold, const std::string& view) const;
  [[nodiscard]] std::optional<std::span<const Vec3>> positions_of(const ViewState& state, Reference reference, const Frame& frame) const;
  void make_space_marks(const ViewState& state, const SessionView& session, const render::VolumeScene& scene, const SpaceMarkView& view);
  /// Where vertices of the run on show slide; null: none does.
  [[nodiscard]] const Domain* domain_of(const SessionView& session) const;
  /// What holds the minimum of the frame on show; null: not known, or not wanted.
  [[nodiscard]] static const JointCluster* hold_of(const ViewState& state, const SessionView& session);
  [[nodiscard]] static std::string hold_note(const ViewState& state, const SessionView& session);
  [[nodiscard]] NextClass class_of(const SessionView& session) const;
  void add_next_class(const ViewState& state, const SessionView& session, const MarkView& view);
  void add_selection(const ViewState& state, const Frame& frame, const MarkView& view);

  std::shared_ptr<const Frame> rest_, previous_;  // where the last command ended, and the one before that moved something
  render::Marks marks_;
  render::SpaceMarks space_marks_;
  std::string marks_key_;  // of either
  Displacements moved_;
  std::tuple<const Vec3*, std::uint64_t, std::uint64_t> moved_key_;
  double factor_ = 1.0;              // of the arrows drawn last
  std::size_t arrows_left_out_ = 0;  // likewise
  bool ghost_too_fine_ = false;
  bool too_many_faces_ = false;   // of a volume
  std::size_t arrows_drawn_ = 0;  // likewise
  double flash_factor_ = 0.0;     // by which the arrows of the last step are too long; 0: there are none
};

}  // namespace dmoscope::ui
