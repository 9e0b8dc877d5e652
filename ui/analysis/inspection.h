#pragma once
// A look into the visit of one vertex: what the search tried there, and what there was to find. Plain values; no ImGui, no OpenGL.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/inspect/quality_field.h"
#include "core/inspect/surface_trace.h"
#include "core/inspect/visit_trace.h"
#include "core/view/view.h"
#include "render/camera.h"
#include "render/orbit_camera.h"
#include "ui/analysis/contours.h"
#include "ui/analysis/grid_slice.h"
#include "ui/analysis/scene_points.h"
#include "ui/state/inspection_state.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// The quality around the vertex, and its lines of equal quality. Contours are in samples of the field.
struct FieldPicture {
  QualityField field;
  struct Line {
    double value = 0.0;
    std::vector<ContourPiece> pieces;
  };
  std::vector<Line> lines;             // at round values
  std::vector<ContourPiece> outline;   // of the region in which no element is inverted
  double lowest = 0.0, highest = 0.0;  // of the qualities in that region
};

struct Inspection {
  /// What it was worked out from.
  struct Key {
    std::uint64_t input_serial = 0, frame_serial = 0;
    std::size_t run = 0;
    Index vertex = kNoIndex;
    Metric metric = Metric::MeanRatio;
    SearchParameters search;
    std::string method;
    friend bool operator==(const Key&, const Key&) = default;
  };
  Key key;
  std::string trouble;  // why there is no trace
  /// Whose trace it is: empty for the run's own; else the run's method, which tries no grid, and the trace is what dmo would do.
  std::string other_method;
  std::optional<VisitTrace> trace;         // of a planar mesh, and of a vertex that slides on a surface
  std::optional<SurfaceGrid> grid;         // of the latter: where its candidates lie
  std::optional<VolumeTrace> solid;        // of a volume, in its place
  Vec3 origin;                             // where the vertex stood, a point of the scene. All below is relative to it
  std::vector<std::array<Vec3, 2>> edges;  // of the star, each once
  render::Bounds3 box;                     // of the star
  std::optional<LocalOptimum> optimum;     // of a planar mesh
  std::optional<FieldPicture> field;
  StarSlice field_slice;         // where the field is
  std::vector<Index> corners;    // of the star, without the vertex, ascending
  std::vector<Vec3> corners_at;  // where they stood

  /// What came of the visit, of whatever mesh; null: there is no trace.
  [[nodiscard]] const VisitSummary* visit() const { return trace ? &*trace : solid ? static_cast<const VisitSummary*>(&*solid) : nullptr; }
  [[nodiscard]] std::size_t level_count() const { return trace ? trace->levels.size() : solid ? solid->levels.size() : 0; }
  /// `number`: from 1 to level_count().
  [[nodiscard]] const LevelValues& level(int number) const {
    const auto slot = static_cast<std::size_t>(number - 1);
    return trace ? static_cast<const LevelValues&>(trace->levels[slot]) : solid->levels[slot];
  }
};

/// What the map of a level (from 1) shows: all of it, or of a volume the slice that is chosen.
[[nodiscard]] GridSlice shown_slice(const InspectionState& state, const Inspection& inspection, int level);
/// The plane of a volume in which the quality is shown: that of the shown level's slice; without a level it is through where the vertex
/// stood, after its move through where it went.
[[nodiscard]] StarSlice field_plane(const InspectionState& state, const Inspection& inspection);

/// Why the search of this run on this frame cannot be looked into; empty when it can.
[[nodiscard]] std::string no_inspection(const SessionView& session);

/// Works out everything but the field. Never throws: trouble says what is the matter.
[[nodiscard]] Inspection inspect(const SessionView& session, Index vertex);

/// Brings `inspection` up to date with what the state wants to see of the session. A vertex that is picked while the inspection is open is
/// looked into from then on. After its move was applied the search that found it stays, until something else moves. `busy`: commands are
/// pending. Cheap when nothing changed.
void refresh(Inspection& inspection, ViewState& state, const SessionView& session, bool busy);

/// The vertex that a step of the active run would visit. Throws UsageError when there is none.
[[nodiscard]] Index next_vertex(const SessionView& session);
/// Of an element the free corner whose star is worst; among equals the one whose visit gains most, then the first. kNoIndex when all
/// corners are fixed. Of a device-resident frame: the first free corner.
[[nodiscard]] Index worst_free_corner(const SessionView& session, Index element);
/// The worst element of the shown metric that has a free corner. kNoIndex when there is none. Throws UsageError on a device-resident frame.
[[nodiscard]] Index worst_movable_element(const SessionView& session);

/// How a quality is read: true for a candidate at which no element of the star is inverted.
[[nodiscard]] bool is_valid(double quality);
/// Least and greatest quality of a level's valid candidates, or of the others; nothing when there is none.
[[nodiscard]] std::optional<std::pair<double, double>> valid_range(const LevelValues& level);
[[nodiscard]] std::optional<std::pair<double, double>> invalid_range(const LevelValues& level);
/// Where a quality lies in a range: 0 to 1; 1 in an empty one.
[[nodiscard]] double part_of(const std::optional<std::pair<double, double>>& range, double quality);
/// Between neighbours of a level's grid along the axis on which they are closer; mesh units. Of a grid that is a line, along that.
[[nodiscard]] double least_spacing(const TracedLevel& level);

}  // namespace dmoscope::ui
