#include "mpi/smooth/shared_mesh.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/mesh/plane.h"
#include "core/mesh/seam.h"
#include "mpi/mesh/partition.h"

namespace dmoscope {
namespace {

/// Finds the whole mesh's geometry, as classify() does for one process.
Geometry classify_shares(const World& world, const Mesh& mesh, const std::string& file) {
  PointBox own;
  for (const Index v : mesh.elements.all_corners()) own.add(mesh.positions[v]);
  const auto [low, high] = world.around_all(own);
  const auto kinds = mesh.elements.kinds();
  const auto is_volume = [](ElementKind kind) { return info(kind).dimension == 3; };
  const bool volume = world.any(std::ranges::any_of(kinds, is_volume));
  const bool planar = world.any(!std::ranges::all_of(kinds, is_volume));
  const auto plane = coordinate_plane_of(low, high);
  const bool wide = !volume && plane && might_wrap(*plane, low, high) && [&] {
    for (Index e = 0; e < mesh.elements.size(); ++e)
      if (is_wide(mesh, e)) return true;
    return false;
  }();
  const bool wraps = world.any(wide);
  Geometry geometry;
  geometry.shape = volume ? Shape::Volume : Shape::Planar;
  geometry.size = diagonal(low, high);
  if (plane) geometry.plane = *plane;
  world.together([&] {
    if (volume && planar) throw InputError(file, 0, "the mesh mixes volume elements with planar ones");
    if (!volume && !plane)
      throw InputError(
          file, 0,
          "the mesh is a curved surface, or lies in a plane that is tilted: several ranks smooth planar meshes whose x, y or z is "
          "the same everywhere, and volumes");
    if (wraps)
      throw InputError(file, 0,
                       "the mesh has elements wider than 180 degrees, as one in longitude and latitude that goes round has: one process "
                       "alone smooths such a mesh");
  });
  return geometry;
}

SharedFindings::Some count_home(const World& world, const Share& share, std::span<const Index> elements) {
  SharedFindings::Some some{0, std::numeric_limits<WholeIndex>::max()};
  for (const Index e : elements) {
    if (share.home[e] == 0) continue;
    ++some.count;
    some.first = std::min(some.first, share.elements[e]);
  }
  return {world.sum(some.count), world.least(some.first)};
}

SharedFindings find(const World& world, const RankShare& share, const InputMesh& input) {
  SharedFindings findings;
  findings.volume = input.is_volume();
  findings.inverted = count_home(world, share.share(), input.report.inverted_elements);
  findings.degenerate = count_home(world, share.share(), input.report.degenerate_elements);
  std::uint64_t flipped = 0, held = 0;
  for (std::size_t e = 0; e < input.mesh.flipped.size(); ++e) flipped += input.mesh.flipped[e] != 0 && share.share().home[e] != 0 ? 1U : 0U;
  for (Index v = 0; v < input.mesh.vertex_count(); ++v) held += share.owns(v) && input.interfaces.holds(v) ? 1U : 0U;
  findings.flipped = world.sum(flipped);
  findings.held = world.sum(held);
  return findings;
}

/// Takes elements with repeated corners as the simpler kinds that they are, as one process does. Returns how many all ranks have.
CollapsedKinds take_simpler_kinds(const World& world, MeshBlock& block) {
  CollapsedKinds here;
  if (any_collapsed<WholeIndex>(block.kinds, block.corners)) {
    std::vector<ElementKind> kinds;
    std::vector<WholeIndex> corners;
    here = for_simpler_elements<WholeIndex>(block.kinds, block.corners, [&](ElementKind kind, std::span<const WholeIndex> own) {
      kinds.push_back(kind);
      corners.insert(corners.end(), own.begin(), own.end());
    });
    block.kinds = std::move(kinds);
    block.corners = std::move(corners);
  }
  CollapsedKinds everywhere;
  if (!world.any(here.any())) return everywhere;
  for (std::size_t from = 0; from < kElementKindCount; ++from) {
    for (std::size_t to = 0; to < kElementKindCount; ++to) {
      const auto a = static_cast<ElementKind>(from), b = static_cast<ElementKind>(to);
      everywhere.add(a, b, world.sum(here.count(a, b)));
    }
  }
  return everywhere;
}

void add(std::vector<std::string>& sentences, const SharedFindings::Some& some, const char* one, const char* many) {
  if (some.count == 1) sentences.push_back(fmt::format("1 {} ({})", one, some.first));
  if (some.count > 1) sentences.push_back(fmt::format("{} {} (first: {})", some.count, many, some.first));
}

}  // namespace

std::vector<std::string> SharedFindings::sentences() const {
  std::vector<std::string> all = collapsed.sentences();
  add(all, inverted, "element is inverted", "elements are inverted");
  if (volume)
    add(all, degenerate, "element has no volume", "elements have no volume");
  else
    add(all, degenerate, "element has no area", "elements have no area");
  const char* const wound = volume ? "wound inside out" : "wound clockwise";
  if (flipped == 1) all.push_back(fmt::format("1 element is {}; it is turned over here and written back as it was", wound));
  if (flipped > 1)
    all.push_back(fmt::format("{} elements are {}; they are turned over here and written back as they were", flipped, wound));
  return all;
}

SharedMesh load_shared(const World& world, SharedMeshFile& file, const std::filesystem::path& path, const PartitionChoice& partition,
                       const SharedVertexWords& named, Need need) {
  return share_block(world, file.read(named.fields()), path, partition, named, need);
}

SharedMesh share_block(const World& world, MeshBlock block, const std::filesystem::path& path, const PartitionChoice& choice,
                       const SharedVertexWords& named, Need need) {
  world.together([&] {
    if (block.vertices.size() == 0) throw InputError(path.string(), 0, "the file holds no vertices");
    if (block.elements.size() == 0) throw InputError(path.string(), 0, "the file holds no elements");
  });
  SharedMesh shared;
  shared.vertices = block.vertices;  // with the ranges of the file
  const CollapsedKinds collapsed = take_simpler_kinds(world, block);
  spread_evenly(world, block);
  const BlockMarks marks = named.find(world, block);
  const std::vector<std::size_t> materials = material_fields(world, block);
  const std::vector<int> part = partition(world, block, choice);
  Share share = make_share(world, block, part, materials, marks);
  Mesh mesh = std::move(share.mesh);
  mesh.name = path.filename().string();
  for (Index v = 0; v < share.named.size(); ++v)
    if (share.named[v] != 0 && share.owner[v] == world.rank()) shared.named.push_back(v);
  const Geometry geometry = classify_shares(world, mesh, path.string());
  world.together([&] { require_computable(geometry, path.string(), need); });
  shared.share = std::make_shared<const RankShare>(world, std::move(share));
  Progress unwatched;
  shared.input = prepare_share(std::move(mesh), geometry, shared.share, path, unwatched);
  shared.findings = find(world, *shared.share, *shared.input);
  shared.findings.collapsed = collapsed;
  return shared;
}

std::vector<Vec3> positions_of_block(const SharedMesh& mesh, std::span<const Vec3> positions) {
  struct Placed {
    WholeIndex vertex;
    Vec3 position;
  };
  const World& world = mesh.share->world();
  const Share& share = mesh.share->share();
  const auto each = [&](const auto& give) {
    for (Index v = 0; v < share.vertices.size(); ++v)
      if (mesh.share->owns(v)) give(mesh.vertices.holder(share.vertices[v]), Placed{share.vertices[v], positions[v]});
  };
  std::vector<Vec3> block(mesh.vertices.count(world.rank()));
  for (const Placed& one : world.exchange(deal<Placed>(world, each)).values)
    block[one.vertex - mesh.vertices.begin(world.rank())] = one.position;
  return block;
}

}  // namespace dmoscope
