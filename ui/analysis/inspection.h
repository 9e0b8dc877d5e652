#pragma once
// Trace of the visit of one vertex: places that the search tried, and the best there is. Plain values; no ImGui, no OpenGL.

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
#include "ui/analysis/scene_points.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// All candidates of a grid in the plane, or those of one slice of a grid in space. The map's columns and rows count along the other two
/// axes in their order, from the left and from below.
struct GridSlice {
  int points = 0;           // points of the grid per axis
  std::optional<int> axis;  // axis at right angles to the slice (0 x, 1 y, 2 z); none: the grid is flat
  int number = 0;           // number of the slice along it, from 0

  /// Index of the candidate at a place of the map.
  [[nodiscard]] int index(int column, int row) const {
    const int n = points;
    if (!axis) return column * n + row;
    if (*axis == 0) return (number * n + column) * n + row;
    if (*axis == 1) return (column * n + number) * n + row;
    return (column * n + row) * n + number;
  }
  /// Column and row of a candidate; none if it belongs to another slice.
  [[nodiscard]] std::optional<std::array<int, 2>> place(int candidate) const {
    const int n = points;
    if (!axis) return std::array{candidate / n, candidate % n};
    const std::array<int, 3> at{candidate / (n * n), candidate / n % n, candidate % n};
    if (at[static_cast<std::size_t>(*axis)] != number) return std::nullopt;
    return std::array{*axis == 0 ? at[1] : at[0], *axis == 2 ? at[1] : at[2]};
  }
  /// Place of any candidate along the axis of the slice.
  [[nodiscard]] int along(int candidate) const {
    const int n = points;
    if (!axis) return 0;
    return *axis == 0 ? candidate / (n * n) : *axis == 1 ? candidate / n % n : candidate % n;
  }
};

/// The quality around the vertex, and its lines of equal quality. Contours are in samples of the field.
struct FieldPicture {
  QualityField field;
  struct Line {
    double value = 0.0;
    std::vector<ContourPiece> pieces;
  };
  std::vector<Line> lines;             // lines at round values
  std::vector<ContourPiece> outline;   // border of the region in which no element is inverted
  double lowest = 0.0, highest = 0.0;  // least and greatest quality in that region
};

struct Inspection {
  /// Inputs that it was worked out from.
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
  std::string trouble;  // reason why there is no trace
  /// Method of the run if it tries no grid: the trace then shows what dmo would do. Empty for the run's own trace.
  std::string other_method;
  std::optional<VisitTrace> trace;         // for a planar mesh, and for a vertex that slides on a surface
  std::optional<SurfaceGrid> grid;         // places of the candidates of a vertex that slides on a surface
  std::optional<VolumeTrace> solid;        // trace for a volume, in place of `trace`
  Vec3 origin;                             // place of the vertex before its visit, a point of the scene. Everything below is relative to it
  std::vector<std::array<Vec3, 2>> edges;  // edges of the star, each once
  render::Bounds3 box;                     // box of the star
  std::optional<LocalOptimum> optimum;     // best place of the vertex; for a planar mesh
  std::optional<FieldPicture> field;
  StarSlice field_slice;         // plane of the field
  std::vector<Index> corners;    // corners of the star without the vertex, ascending
  std::vector<Vec3> corners_at;  // their places before the visit

  /// Whether a candidate is refused for its place: the surface there would deviate or lean too much, whatever its quality.
  [[nodiscard]] bool refuses(int number, int candidate) const {
    return grid && grid->levels[static_cast<std::size_t>(number - 1)].fates[static_cast<std::size_t>(candidate)] != CandidateFate::Counts;
  }
  /// Summary of the visit, for any mesh; null: there is no trace.
  [[nodiscard]] const VisitSummary* visit() const { return trace ? &*trace : solid ? static_cast<const VisitSummary*>(&*solid) : nullptr; }
  [[nodiscard]] std::size_t level_count() const { return trace ? trace->levels.size() : solid ? solid->levels.size() : 0; }
  /// Values of a level; `number`: from 1 to level_count().
  [[nodiscard]] const LevelValues& level(int number) const {
    const auto slot = static_cast<std::size_t>(number - 1);
    return trace ? static_cast<const LevelValues&>(trace->levels[slot]) : solid->levels[slot];
  }
};

/// Candidates that the map of a level (from 1) shows: all, or for a volume those of the chosen slice.
[[nodiscard]] GridSlice shown_slice(const InspectionState& state, const Inspection& inspection, int level);

/// Reason why the search of this run on this frame cannot be inspected; empty if it can.
[[nodiscard]] std::string no_inspection(const SessionView& session);

/// Inspection of a visit, except for the field. Never throws: `trouble` tells what is wrong.
[[nodiscard]] Inspection inspect(const SessionView& session, Index vertex);

/// Brings `inspection` up to date with what the state wants to see of the session. A vertex that is picked while the inspection is open
/// becomes the inspected one. After its move was applied the search that found it stays, until something else moves. `busy`: commands are
/// pending. Cheap when nothing changed.
void refresh(Inspection& inspection, ViewState& state, const SessionView& session, bool busy);

/// The vertex that a step of the active run would visit. Throws UsageError when there is none.
[[nodiscard]] Index next_vertex(const SessionView& session);
/// Free corner of an element whose star is worst; among equals the one whose visit gains most, then the first. kNoIndex when all corners
/// are fixed. Of a device-resident frame: the first free corner.
[[nodiscard]] Index worst_free_corner(const SessionView& session, Index element);
/// The worst element of the shown metric that has a free corner. kNoIndex when there is none. Throws UsageError on a device-resident frame.
[[nodiscard]] Index worst_movable_element(const SessionView& session);

/// Whether a quality means that no element of the star is inverted at that candidate.
[[nodiscard]] bool is_valid(double quality);
/// Least and greatest quality of a level's valid candidates, or of the others; none if there is none.
[[nodiscard]] std::optional<std::pair<double, double>> valid_range(const LevelValues& level);
[[nodiscard]] std::optional<std::pair<double, double>> invalid_range(const LevelValues& level);
/// Place of a quality in a range, from 0 to 1; 1 in an empty range.
[[nodiscard]] double part_of(const std::optional<std::pair<double, double>>& range, double quality);
/// Distance between neighbours of a level's grid along the axis on which they are closest, in mesh units; in a grid that is a line, along
/// that.
[[nodiscard]] double least_spacing(const TracedLevel& level);

}  // namespace dmoscope::ui
