#pragma once
// Sample meshes that the program generates itself.

#include <cstdint>
#include <span>
#include <string_view>

#include "core/base/progress.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

struct GeneratorInfo {
  std::string_view name;     // such as "coast"
  std::string_view doc;      // description in one line
  std::size_t default_size;  // approximate number of vertices without --size
};
/// Generators in the order of lists: coast, block, annulus, random, quads, mixed, tangled, grid, wrapped, globe; tetrahedra, hexahedra,
/// solids, tangled-solids, screw, elbow; can; nested, nested-solids; anisotropic; biased.
[[nodiscard]] std::span<const GeneratorInfo> generator_table();

/// Generates a sample. `size`: approximate number of vertices (0: the generator's default; exact for `random`). Equal names, sizes and
/// seeds give equal meshes on every machine. Throws UsageError for an unknown name or a size out of range, Cancelled.
[[nodiscard]] Mesh generate_mesh(std::string_view name, std::size_t size, std::uint64_t seed, Progress& progress);

}  // namespace dmoscope
