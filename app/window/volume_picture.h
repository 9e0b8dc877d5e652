#pragma once
// A picture of a volume mesh, of its outside or of what is inside, without a window.

#include <optional>
#include <span>
#include <string>
#include <utility>

#include "app/window/picture.h"
#include "core/inside/inside_view.h"
#include "core/mesh/faces.h"

namespace dmoscope::app {

/// What is seen of a volume mesh, and from where.
struct InsideLook {
  std::string clip;          // see parse_clip; empty: no plane
  InsideView view{};         // its plane: the mode alone
  std::string from = "iso";  // see view_preset_table
  bool perspective = false;
  /// Whether anything of it is not the default.
  [[nodiscard]] bool asked_for() const { return !clip.empty() || view != InsideView{} || from != "iso" || perspective; }
};

/// A mesh and how good its cells are.
struct JudgedVolume {
  const Mesh& mesh;
  const FaceNeighbours& faces;
  std::span<const Vec3> positions;
  std::span<const float> quality;  // NaN: not defined
  std::span<const std::uint8_t> inverted;
};

/// Throws UsageError for words that mean nothing, before anything is read.
void require_sense(const InsideLook& inside);

/// As a PNG file's bytes. Throws Error.
[[nodiscard]] std::string volume_picture_png(const JudgedVolume& volume, const PictureLook& look, const InsideLook& inside);

}  // namespace dmoscope::app
