#pragma once
// A part of a mesh as a mesh of its own, so that a problem there has the same solution whether one process has the mesh or several have
// shares.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/input/input_mesh.h"

namespace dmoscope {

/// A region of a mesh. Vertices and elements are in the order of the whole mesh.
struct MeshRegion {
  std::shared_ptr<const InputMesh> input;  // mesh with the data that quality and joint moves need: no fields, groups, neighbours
  std::vector<std::uint64_t> vertices;     // numbers of the vertices in the whole mesh
  std::vector<std::uint8_t> fixed, rim;    // flags by vertex; rim: fixed in the region only, since elements around it are missing
  /// Whether the element has a corner on the rim.
  [[nodiscard]] bool touches_rim(Index element) const;
};

/// One process's part of a region; numbers are those of the whole mesh.
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

/// Gathers the elements around all vertices within so many rings, below 255, of the seeds. The seeds are elements of the process; each
/// process that owns one of a seed's corners must name it. All processes of a share call this together, with equal results. None: without
/// seeds, or with more than `most` vertices.
[[nodiscard]] std::optional<MeshRegion> region_around(const InputMesh& input, std::span<const Vec3> positions,
                                                      std::span<const std::uint8_t> fixed, std::span<const Index> seeds, int rings,
                                                      std::size_t most);

/// The vertex of this process with a number in the whole mesh; kNoIndex: it is on other processes.
[[nodiscard]] Index find_vertex(const InputMesh& input, std::uint64_t number);

}  // namespace dmoscope
