#pragma once
// Positions of a mesh's vertices, in whatever memory and order they are stored.

#include <span>
#include <vector>

#include "core/base/host_device.h"
#include "core/base/vec.h"

namespace dmoscope {

class PositionView {
 public:
  DMOSCOPE_ANYWHERE PositionView(std::span<const Vec3> positions) : at_(positions.data()) {}  // NOLINT(google-explicit-constructor): a view
  PositionView(const std::vector<Vec3>& positions) : at_(positions.data()) {}                 // NOLINT(google-explicit-constructor)
  PositionView(std::span<Vec3> positions) : at_(positions.data()) {}                          // NOLINT(google-explicit-constructor)
  /// Views positions in the order of ranks: that of vertex v is ranked[rank_of_vertex[v]].
  DMOSCOPE_ANYWHERE PositionView(std::span<const Vec3> ranked, std::span<const Index> rank_of_vertex)
      : at_(ranked.data()), rank_(rank_of_vertex.data()) {}
  DMOSCOPE_ANYWHERE PositionView(const Vec3* ranked, const Index* rank_of_vertex) : at_(ranked), rank_(rank_of_vertex) {}
  [[nodiscard]] DMOSCOPE_ANYWHERE const Vec3& operator[](Index vertex) const { return at_[rank_ == nullptr ? vertex : rank_[vertex]]; }

 private:
  const Vec3* at_;
  const Index* rank_ = nullptr;
};

}  // namespace dmoscope
