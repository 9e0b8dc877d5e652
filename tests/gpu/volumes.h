#pragma once
// Volumes whose stars have every form that a device's lanes treat differently.

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/mesh/generate.h"
#include "core/mesh/random.h"
#include "tests/support/inside.h"

namespace dmoscope::gpu::testing {

struct VolumeSample {
  std::string name;
  std::shared_ptr<const InputMesh> input;
};

[[nodiscard]] inline std::shared_ptr<const InputMesh> volume_input_of(Mesh mesh) {
  Progress progress;
  return prepare_input(std::move(mesh), {}, Need::Smoothing, progress);
}

/// Moves some of the free vertices far out of place.
[[nodiscard]] inline Mesh tangled(Mesh mesh, double throw_by) {
  const auto input = volume_input_of(mesh);
  dmoscope::Random random(6);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (input->topology.boundary()[v] == 0 && random.below(3) == 0)
      mesh.positions[v] = mesh.positions[v] + throw_by * Vec3{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
  return mesh;
}

/// A vertex beside the middle of a ball of 2 `ring` tetrahedra, which meet in two poles: with 49 more than the fast search takes.
[[nodiscard]] inline Mesh ball(Index ring, Vec3 centre) {
  Mesh mesh;
  mesh.name = "ball";
  mesh.positions = {centre, {0, 0, 1}, {0, 0, -1}};
  for (Index i = 0; i < ring; ++i) {
    const double angle = 2 * M_PI * i / ring;
    mesh.positions.push_back({std::cos(angle), std::sin(angle), 0.0});
  }
  for (Index i = 0; i < ring; ++i) {
    const Index a = 3 + i, b = 3 + (i + 1) % ring;
    for (const auto& corners : {std::vector<Index>{0, a, b, 1}, std::vector<Index>{0, b, a, 2}})
      mesh.elements.add(ElementKind::Tetrahedron, corners);
  }
  return mesh;
}

/// Samples of about `size` vertices each.
[[nodiscard]] inline std::vector<VolumeSample> volume_samples(std::size_t size) {
  std::vector<VolumeSample> all;
  Progress progress;
  for (const char* kind : {"tetrahedra", "hexahedra", "solids"}) {
    const auto add = [&](const char* what, Mesh mesh) { all.push_back({std::string(kind) + what, volume_input_of(std::move(mesh))}); };
    const Mesh mesh = generate_mesh(kind, size, 5, progress);
    add("", mesh);
    add(", tangled", tangled(mesh, 1.0));
    Mesh far = mesh;
    for (Vec3& p : far.positions) p = p + Vec3{1e6, -1e6, 1e6};
    add(", far", far);
    Mesh single = tangled(mesh, 0.5);
    for (Vec3& p : single.positions) p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    single.single_precision = true;
    add(", single precision", single);
  }
  for (const test::Fill fill : {test::Fill::Hexahedra, test::Fill::Mixed})
    all.push_back({"near to being inverted inside", volume_input_of(test::twisted_block(3, fill, 2))});
  all.push_back({"as many as the fast search takes", volume_input_of(ball(48, {0.3, 0.1, -0.2}))});
  all.push_back({"more than the fast search takes", volume_input_of(ball(49, {0.3, 0.1, -0.2}))});
  return all;
}

}  // namespace dmoscope::gpu::testing
