#pragma once
// One process's share of a mesh that several processes smooth together. How they talk to each other is not known here.

#include <cstdint>
#include <memory>
#include <span>

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

/// A share is the vertices that a process owns, all elements around them, and the other corners of these elements, which other processes
/// own. Each vertex of the mesh has one owner. Vertices and elements are in the order of the whole mesh. All processes call the same
/// functions in the same order, for each call is a question to all of them.
class MeshShare {
 public:
  MeshShare() = default;
  MeshShare(const MeshShare&) = delete;
  MeshShare& operator=(const MeshShare&) = delete;
  virtual ~MeshShare() = default;

  /// Of the whole mesh.
  [[nodiscard]] virtual std::uint64_t element_count() const noexcept = 0;
  [[nodiscard]] virtual bool owns(Index vertex) const noexcept = 0;
  /// Is it this process that counts an element, which others may have, too?
  [[nodiscard]] virtual bool counts(Index element) const noexcept = 0;
  /// By vertex and element of the share: their numbers in the whole mesh, ascending.
  [[nodiscard]] virtual std::span<const std::uint64_t> vertex_numbers() const noexcept = 0;
  [[nodiscard]] virtual std::span<const std::uint64_t> element_numbers() const noexcept = 0;
  /// Values by vertex: those of others' vertices become what their owners have here.
  virtual void agree(std::span<std::uint8_t> values) const = 0;
  virtual void agree(std::span<double> values) const = 0;
  /// Is it true of any process?
  [[nodiscard]] virtual bool any(bool here) const = 0;
  [[nodiscard]] virtual double greatest(double here) const = 0;
  [[nodiscard]] virtual std::uint64_t sum(std::uint64_t here) const = 0;
  /// Those of all processes, on each.
  virtual void join(RegionParts& parts) const = 0;
  /// Turns elements over as normalise_orientation() does; how many were turned here. `faces`: null of a planar mesh.
  virtual Index orient(Mesh& mesh, const Geometry& geometry, const Topology& topology, const FaceNeighbours* faces) const = 0;
  /// The owned vertices that are free, in the classes that colour_vertices() finds for the whole mesh. A class may be several here, and
  /// empty. `fixed`: by vertex, agreed on.
  [[nodiscard]] virtual Colouring colour(const Mesh& mesh, const Geometry& geometry, const Topology& topology,
                                         std::span<const std::uint8_t> fixed, ThreadPool* pool) const = 0;
  /// A smoother that tells the others where vertices went, after each class of colour(). `here`: of the task.
  [[nodiscard]] virtual std::unique_ptr<Smoother> among_others(std::unique_ptr<Smoother> here, const SmoothingTask& task) const = 0;
  /// Of the whole mesh, the same bits as compute_statistics() finds. `immovable`: of the share.
  [[nodiscard]] virtual Statistics statistics(const QualityContext& context, std::span<const Vec3> positions, Metric metric,
                                              std::span<const Index> immovable, ThreadPool* pool) const = 0;
};

}  // namespace dmoscope
