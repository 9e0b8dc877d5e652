#pragma once
// A mesh as overlays see it, alike in a plane and in space.

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/reference/kinds.h"
#include "render/marks.h"
#include "render/scene.h"
#include "ui/analysis/scene_points.h"

namespace dmoscope::ui {

/// Greatest number of dots or arrows: more would hide the mesh, and cost too much.
inline constexpr std::size_t kMostMarks = 20'000;

/// The picture that marks are made for.
struct MarkView {
  render::SceneView view;
  double scale = 1.0;                          // scale of the interface
  ScenePoints points{};                        // points of the mesh
  std::optional<render::Unhidden> unhidden{};  // visible part in space; none: nothing hides anything

  [[nodiscard]] double units(double pixels_at_scale_one) const { return pixels_at_scale_one * scale * view.units_per_pixel(); }
  [[nodiscard]] double pixels(Vec3 a, Vec3 b) const { return view.pixels(a, b) / scale; }  // pixels at scale 1
  /// Whether something else covers a vertex, or one of the two ends of an edge.
  [[nodiscard]] bool hides(Index vertex) const;
  [[nodiscard]] bool hides(const EdgeEnds& edge) const;
  /// Whether a vertex, or part of an edge given by its ends, is in the picture and nothing covers it.
  [[nodiscard]] bool sees(Index vertex, std::span<const Vec3> positions) const;
  [[nodiscard]] bool sees(const EdgeEnds& edge, std::span<const Vec3> positions) const;
};

/// Taken places of a picture in which marks must keep apart.
class PlacesTaken {
 public:
  /// `apart`: least distance in pixels at scale 1.
  PlacesTaken(const MarkView& seen, double apart);
  /// Takes a place. False if another mark came first, or the point is behind the eye.
  [[nodiscard]] bool take(Vec3 point);

 private:
  [[nodiscard]] std::size_t place(double at, std::size_t count) const;
  const render::SceneView& view_;
  double size_;
  std::size_t columns_, rows_;
  std::vector<bool> taken_;
};

/// Colours of lines, and of the casings below them.
struct Inks {
  render::Rgba ink, casing;
};

/// Adds casings at once and collects the lines, so that no casing covers a line: the lines themselves are added at the end of this object's
/// life.
class CasedLines {
 public:
  CasedLines(render::Marks& marks, Inks inks) : marks_(marks), inks_(inks) {}
  ~CasedLines() { marks_.lines.insert(marks_.lines.end(), inner_.begin(), inner_.end()); }
  CasedLines(const CasedLines&) = delete;
  CasedLines& operator=(const CasedLines&) = delete;
  void add(Vec3 from, Vec3 to, float width, float casing_width) {
    marks_.lines.push_back({from, to, casing_width, inks_.casing});
    inner_.push_back({from, to, width, inks_.ink});
  }

 private:
  render::Marks& marks_;
  Inks inks_;
  std::vector<render::OverlayLine> inner_;
};

}  // namespace dmoscope::ui
