#include "core/mesh/generate.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/mesh/generators.h"

namespace dmoscope {
namespace {

struct Generator {
  GeneratorInfo info;
  struct {
    Mesh (*make)(const generators::Request&);
    std::size_t smallest, largest;  // valid range of the size
  } by;
};

constexpr auto kGenerators = std::to_array<Generator>({
    {{"coast", "an irregular coastline with islands and an open sea; triangles graded from fine at the coast to coarse offshore", 4000},
     {generators::coast, 300, 20000}},
    {{"block", "fifteen blocks of triangles that meet in irregular vertices, smoothly distorted", 2500}, {generators::block, 50, 5000000}},
    {{"annulus", "a ring of triangles, sheared and jittered inside", 2500}, {generators::annulus, 50, 5000000}},
    {{"random", "Delaunay triangulation of random points in the unit square", 2000}, {generators::random_points, 3, 2000000}},
    {{"quads", "structured quadrilaterals over an arch, distorted", 2000}, {generators::quads, 9, 5000000}},
    {{"mixed", "layers of quadrilaterals over a wall with a bump, triangles above", 2500}, {generators::mixed, 50, 5000000}},
    {{"tangled", "quadrilaterals and triangles with some vertices thrown out of place, so that elements are inverted", 600},
     {generators::tangled, 25, 5000000}},
    {{"grid", "square lattice with random diagonals, jittered; of any size", 10000}, {generators::grid, 9, 10000000}},
    {{"wrapped", "the coast in degrees of longitude and latitude, across the meridian of 180", 4000}, {generators::wrapped, 300, 20000}},
    {{"globe", "a band around the Earth in degrees of longitude and latitude, quadrilaterals and triangles, jittered", 2500},
     {generators::globe, 36, 5000000}},
    {{"tetrahedra", "a cube of tetrahedra, six a cell, jittered inside", 2000}, {generators::tetrahedra, 27, 5000000}},
    {{"hexahedra", "a cube of hexahedra, jittered inside", 2000}, {generators::hexahedra, 27, 5000000}},
    {{"solids", "a cube of hexahedra, wedges, pyramids and tetrahedra, jittered inside", 2000}, {generators::mixed_volumes, 27, 5000000}},
    {{"tangled-solids", "a cube of all four kinds of volume elements with some vertices thrown out of place, so that elements are inverted",
      1000},
     {generators::tangled_volumes, 125, 5000000}},
    {{"screw", "a twisted rod of hexahedra, jittered inside and along its surface, which its worst elements touch", 2000},
     {generators::screw, 63, 5000000}},
    {{"elbow", "a bent rod of hexahedra that gets thicker, jittered inside and along its surface, which its worst elements touch", 2000},
     {generators::elbow, 63, 5000000}},
    {{"can", "a closed can of triangles in space, jittered on its surface and along its two rims", 2000}, {generators::can, 50, 5000000}},
    {{"nested", "a square of triangles in a square of another material, jittered but for what lies between them", 1000},
     {generators::nested, 25, 5000000}},
    {{"nested-solids", "a cube of tetrahedra in a cube of another material, jittered but for what lies between them", 2000},
     {generators::nested_volumes, 64, 5000000}},
    {{"anisotropic", "a square of triangles stretched along a wave, jittered, with the metric field that wants them so", 3000},
     {generators::anisotropic, 16, 5000000}},
    {{"biased", "a cube of hexahedra whose inner vertices are drawn towards one corner, which those on its surface are not", 1331},
     {generators::biased, 27, 5000000}},
});

constexpr auto kInfos = [] {
  std::array<GeneratorInfo, kGenerators.size()> infos;
  std::ranges::transform(kGenerators, infos.begin(), &Generator::info);
  return infos;
}();

}  // namespace

std::span<const GeneratorInfo> generator_table() { return kInfos; }

Mesh generate_mesh(std::string_view name, std::size_t size, std::uint64_t seed, Progress& progress) {
  const auto* found = std::ranges::find(kGenerators, name, [](const Generator& one) { return one.info.name; });
  if (found == kGenerators.end()) throw UsageError(unknown_row("sample", name, kInfos));
  const std::size_t wanted = size == 0 ? found->info.default_size : size;
  if (wanted < found->by.smallest || wanted > found->by.largest)
    throw UsageError(fmt::format("{}: the size must be {} to {} vertices, not {}", name, found->by.smallest, found->by.largest, wanted));
  progress.begin(fmt::format("generating {}", name));
  Mesh mesh = found->by.make({wanted, seed, progress});
  progress.check();
  progress.set(1.0);
  mesh.name = name;
  mesh.title = fmt::format("dmoscope {} with {} vertices, seed {}", name, mesh.positions.size(), seed);
  return mesh;
}

}  // namespace dmoscope
