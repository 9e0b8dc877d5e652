#pragma once
// A part of a mesh as a mesh of its own: what is to be solved there is the same whether one process has the mesh or several have shares.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/input/input_mesh.h"

namespace dmoscope {

/// Vertices and elements are in the order of the whole mesh.
struct MeshRegion {
  std::shared_ptr<const InputMesh> input;  // what quality and joint moves ask for: no fields, groups, neighbours
  std::vector<std::uint64_t> vertices;     // their numbers in the whole mesh
  std::vector<std::uint8_t> fixed, rim;    // by vertex; rim: fixed here alone, since elements around it are missing
  /// Has the element a corner on the rim?
  [[nodiscard]] bool touches_rim(Index element) const;
};

/// What a process has of a region; numbers are those of the whole mesh.
struct RegionParts {
  struct Vertex {
    std::uint64_t number;
    Vec3 position;
    std::uint8_t fixed, rim;
  };
  struct Element {
    std::uint64_t number;
    ElementKind kind;
    std::array<std::uint64_t, 8> corners;
  };
  std::vector<Vertex> vertices;
  std::vector<Element> elements;
};

/// The elements around all vertices within so many rings, below 255, of the seeds: elements that a process has; each process with one of
/// its corners must name it. All processes of a share together; the same for all. None: without seeds, or with more than `most` vertices.
[[nodiscard]] std::optional<MeshRegion> region_around(const InputMesh& input, std::span<const Vec3> positions,
                                                      std::span<const std::uint8_t> fixed, std::span<const Index> seeds, int rings,
                                                      std::size_t most);

/// The vertex of this process with a number in the whole mesh; kNoIndex: others have it.
[[nodiscard]] Index find_vertex(const InputMesh& input, std::uint64_t number);

}  // namespace dmoscope
