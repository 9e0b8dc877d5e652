#pragma once
// Size function anywhere in a mesh, and how well the elements follow it.

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/input/input_mesh.h"
#include "core/mesh/nodal_field.h"
#include "core/mesh/position_view.h"
#include "core/smooth/composite_objective.h"
#include "core/smooth/place_aim.h"

namespace dmoscope {

class SizeField final : public PlaceAim {
 public:
  /// Throws UsageError for a field that the mesh has not (it lists those there are), or that is no size anywhere.
  SizeField(std::shared_ptr<const InputMesh> input, SizeFunction function);

  /// Size h > 0, up to a factor, for `vertex` at `place`.
  [[nodiscard]] double at(Index vertex, Vec3 place) const;
  [[nodiscard]] std::string_view name() const override { return kDensity; }
  /// None for a nodal field.
  [[nodiscard]] std::optional<SizeFormula> formula() const override;
  /// Mean of the edge neighbours, weighted by the inverse of the size at their present positions.
  [[nodiscard]] DensityTarget<Plane> target(const PlanarView& mesh, PositionView positions, Index vertex) const override;
  [[nodiscard]] const SizeFunction& function() const noexcept { return function_; }
  /// Note for a person ("depth is not positive at 12 vertices: ..."), usually empty.
  [[nodiscard]] const std::string& note() const noexcept { return note_; }

 private:
  void read_field();

  std::shared_ptr<const InputMesh> input_;
  SizeFunction function_;
  std::unique_ptr<NodalField> field_;
  double least_distance_ = 0.0;
  std::string note_;
};

/// Names of the nodal fields that can be a size function: those with one number per vertex.
[[nodiscard]] std::vector<std::string> scalar_fields(const Mesh& mesh);

/// Mean length of the edges at a vertex; 0 for a vertex of no element.
[[nodiscard]] double local_edge_length(const PlanarView& mesh, PositionView positions, Index vertex);

/// Correlation of local edge lengths with the target sizes over some vertices: Pearson's, of the two and of their logarithms, which tells
/// more where sizes span decades. NaN where either does not vary.
struct SizeCorrelation {
  double sizes = std::numeric_limits<double>::quiet_NaN(), logarithms = std::numeric_limits<double>::quiet_NaN();
};
[[nodiscard]] SizeCorrelation size_correlation(const SizeField& size, const InputMesh& input, PositionView positions,
                                               std::span<const Index> vertices);

}  // namespace dmoscope
