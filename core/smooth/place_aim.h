#pragma once
// Second aims that are no metrics: by them each vertex has a place that it wants to be near.

#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "core/input/input_mesh.h"
#include "core/smooth/composite_visit.h"

namespace dmoscope {

/// Such an aim on a mesh. Planar meshes alone have them.
class PlaceAim {
 public:
  virtual ~PlaceAim() = default;
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// Place that the vertex wants while the others stand as they do, and the length by which distances from it count.
  [[nodiscard]] virtual DensityTarget<Plane> target(const PlanarView& mesh, PositionView positions, Index vertex) const = 0;
  /// Sizes as plain data, by which a device finds the place; none: it cannot.
  [[nodiscard]] virtual std::optional<SizeFormula> formula() const { return std::nullopt; }
};

/// Row of the table of these aims, over which notation, reports and the window loop.
struct PlaceAimInfo {
  std::string_view name, title, doc;
  bool sized;  // whether a size function belongs to it
  std::shared_ptr<const PlaceAim> (*make)(const std::shared_ptr<const InputMesh>& input, const SizeFunction& size);
};
[[nodiscard]] std::span<const PlaceAimInfo> place_aims();
/// Row by name; null where there is none.
[[nodiscard]] const PlaceAimInfo* find_place_aim(std::string_view name);

}  // namespace dmoscope
