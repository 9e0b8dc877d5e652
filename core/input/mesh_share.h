#pragma once
// One process's share of a mesh that several processes smooth together, without their means of communication.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/colouring.h"
#include "core/mesh/faces.h"
#include "core/mesh/plane.h"
#include "core/mesh/topology.h"
#include "core/quality/quality.h"

namespace dmoscope {

class Smoother;
class ThreadPool;
struct RegionParts;
struct SmoothingTask;

/// A share: the vertices that a process owns, all elements around them, and the other corners of these elements, which other processes own.
/// Each vertex of the mesh has one owner. Vertices and elements are in the order of the whole mesh. All processes call the same functions
/// in the same order, for each call asks all of them.
class MeshShare {
 public:
  MeshShare() = default;
  MeshShare(const MeshShare&) = delete;
  MeshShare& operator=(const MeshShare&) = delete;
  virtual ~MeshShare() = default;

  /// Number of elements of the whole mesh.
  [[nodiscard]] virtual std::uint64_t element_count() const noexcept = 0;
  [[nodiscard]] virtual bool owns(Index vertex) const noexcept = 0;
  /// Whether this process counts an element, which others may have, too.
  [[nodiscard]] virtual bool counts(Index element) const noexcept = 0;
  /// Numbers in the whole mesh of the share's vertices and elements, ascending.
  [[nodiscard]] virtual std::span<const std::uint64_t> vertex_numbers() const noexcept = 0;
  [[nodiscard]] virtual std::span<const std::uint64_t> element_numbers() const noexcept = 0;
  /// Replaces values of vertices that others own by those of their owners.
  virtual void agree(std::span<std::uint8_t> values) const = 0;
  virtual void agree(std::span<double> values) const = 0;
  /// Whether the condition holds on any process.
  [[nodiscard]] virtual bool any(bool here) const = 0;
  [[nodiscard]] virtual double greatest(double here) const = 0;
  [[nodiscard]] virtual std::uint64_t sum(std::uint64_t here) const = 0;
  /// Texts of all processes, in the same order on each.
  [[nodiscard]] virtual std::vector<std::string> all_of(const std::string& here) const = 0;
  /// Joins the parts of all processes, on each of them.
  virtual void join(RegionParts& parts) const = 0;
  /// Turns elements over as normalise_orientation() does; returns the number turned here. `faces`: null for a planar mesh.
  virtual Index orient(Mesh& mesh, const Geometry& geometry, const Topology& topology, const FaceNeighbours* faces) const = 0;
  /// The owned vertices that are free, in the classes that colour_vertices() finds for the whole mesh. A class may be split into several
  /// here, and be empty. `fixed`: by vertex, equal on all processes.
  [[nodiscard]] virtual Colouring colour(const Mesh& mesh, const Geometry& geometry, const Topology& topology,
                                         std::span<const std::uint8_t> fixed, ThreadPool* pool) const = 0;
  /// A smoother that sends the new positions to the other processes after each class of colour(). `here`: the smoother of this process.
  [[nodiscard]] virtual std::unique_ptr<Smoother> among_others(std::unique_ptr<Smoother> here, const SmoothingTask& task) const = 0;
  /// Statistics of the whole mesh, with the bits of compute_statistics(). `immovable`: elements of the share.
  [[nodiscard]] virtual Statistics statistics(const QualityContext& context, std::span<const Vec3> positions, Metric metric,
                                              std::span<const Index> immovable, ThreadPool* pool) const = 0;
};

/// Counts the inverted elements of the whole mesh, by its numbers; all processes together.
[[nodiscard]] InvertedCount count_inverted(const QualityContext& context, PositionView positions, const MeshShare& share);

}  // namespace dmoscope
