#include "core/mesh/generate.h"

#include <array>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/mesh/generators.h"

namespace dmoscope {
namespace {

struct Generator {
  Mesh (*make)(const generators::Request&);
  std::size_t smallest, largest;  // valid range of the size
};

constexpr std::size_t kGenerators = 21;
constexpr std::array<GeneratorInfo, kGenerators> kInfos{{
    {"coast", "an irregular coastline with islands and an open sea; triangles graded from fine at the coast to coarse offshore", 4000},
    {"block", "fifteen blocks of triangles that meet in irregular vertices, smoothly distorted", 2500},
    {"annulus", "a ring of triangles, sheared and jittered inside", 2500},
    {"random", "Delaunay triangulation of random points in the unit square", 2000},
    {"quads", "structured quadrilaterals over an arch, distorted", 2000},
    {"mixed", "layers of quadrilaterals over a wall with a bump, triangles above", 2500},
    {"tangled", "quadrilaterals and triangles with some vertices thrown out of place, so that elements are inverted", 600},
    {"grid", "square lattice with random diagonals, jittered; of any size", 10000},
    {"wrapped", "the coast in degrees of longitude and latitude, across the meridian of 180", 4000},
    {"globe", "a band around the Earth in degrees of longitude and latitude, quadrilaterals and triangles, jittered", 2500},
    {"tetrahedra", "a cube of tetrahedra, six a cell, jittered inside", 2000},
    {"hexahedra", "a cube of hexahedra, jittered inside", 2000},
    {"solids", "a cube of hexahedra, wedges, pyramids and tetrahedra, jittered inside", 2000},
    {"tangled-solids", "a cube of all four kinds of volume elements with some vertices thrown out of place, so that elements are inverted",
     1000},
    {"screw", "a twisted rod of hexahedra, jittered inside and along its surface, which its worst elements touch", 2000},
    {"elbow", "a bent rod of hexahedra that gets thicker, jittered inside and along its surface, which its worst elements touch", 2000},
    {"can", "a closed can of triangles in space, jittered on its surface and along its two rims", 2000},
    {"nested", "a square of triangles in a square of another material, jittered but for what lies between them", 1000},
    {"nested-solids", "a cube of tetrahedra in a cube of another material, jittered but for what lies between them", 2000},
    {"anisotropic", "a square of triangles stretched along a wave, jittered, with the metric field that wants them so", 3000},
    {"biased", "a cube of hexahedra whose inner vertices are drawn towards one corner, which those on its surface are not", 1331},
}};
constexpr std::array<Generator, kGenerators> kMakers{{
    {generators::coast, 300, 20000},
    {generators::block, 50, 5000000},
    {generators::annulus, 50, 5000000},
    {generators::random_points, 3, 2000000},
    {generators::quads, 9, 5000000},
    {generators::mixed, 50, 5000000},
    {generators::tangled, 25, 5000000},
    {generators::grid, 9, 10000000},
    {generators::wrapped, 300, 20000},
    {generators::globe, 36, 5000000},
    {generators::tetrahedra, 27, 5000000},
    {generators::hexahedra, 27, 5000000},
    {generators::mixed_volumes, 27, 5000000},
    {generators::tangled_volumes, 125, 5000000},
    {generators::screw, 63, 5000000},
    {generators::elbow, 63, 5000000},
    {generators::can, 50, 5000000},
    {generators::nested, 25, 5000000},
    {generators::nested_volumes, 64, 5000000},
    {generators::anisotropic, 16, 5000000},
    {generators::biased, 27, 5000000},
}};

}  // namespace

std::span<const GeneratorInfo> generator_table() { return kInfos; }

Mesh generate_mesh(std::string_view name, std::size_t size, std::uint64_t seed, Progress& progress) {
  for (std::size_t i = 0; i < kGenerators; ++i) {
    if (kInfos[i].name != name) continue;
    const std::size_t wanted = size == 0 ? kInfos[i].default_size : size;
    if (wanted < kMakers[i].smallest || wanted > kMakers[i].largest) {
      throw UsageError(
          fmt::format("{}: the size must be {} to {} vertices, not {}", name, kMakers[i].smallest, kMakers[i].largest, wanted));
    }
    progress.begin(fmt::format("generating {}", name));
    Mesh mesh = kMakers[i].make({wanted, seed, progress});
    progress.check();
    progress.set(1.0);
    mesh.name = name;
    mesh.title = fmt::format("dmoscope {} with {} vertices, seed {}", name, mesh.positions.size(), seed);
    return mesh;
  }
  throw UsageError(unknown_row("sample", name, kInfos));
}

}  // namespace dmoscope
