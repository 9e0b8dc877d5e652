#pragma once
// Formulas and targets for tests of devices, and meshes for them.

#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/quality/defined_metric.h"
#include "core/smooth/methods/star_kernels.h"
#include "tests/gpu/same_bits.h"
#include "tests/gpu/volumes.h"
#include "tests/smooth/zoo.h"

namespace dmoscope::gpu::testing {

/// Metrics that together have every operation of programs, every number that these are given, and targets of every form.
inline constexpr std::string_view kDefinedMetrics[] = {
    "formula:if(measure > 0, lmin/lmax, measure/lmax^2)",
    "formula:lmin/lmax",  // does not depend on inversion
    "formula:smin/smax",
    "formula:3*cbrt(det)*abs(cbrt(det))/norm^2 - 0.2*lsum/cbrt(mean_measure)",  // changes with the unit of length
    "formula:exp(-3*(smax/smin - 1))*sign(det)*(1 - 0.1*sin(7*lmin/lmax)^2)",
    "formula:if(det > 0, cos(log(smax/smin)), -1) * pow(0.5 + lmin/(2*lmax), 1.3)",
    "formula:amin/amax * if(measure <= 0 || lmax == 0, -1, 1)",
    "formula:q = min_corner(det/norm^3 + length(p1 - p2)/lmax); q",
    "formula:if(det > 0, smin/smax, det/norm^2) * (1 - 0.3*min(1, max(0, x(p1)/(1 + abs(x(p1))))))",  // depends on the place
    "formula:s = lmax/field(\"h\"); min(s, 1/s)*smin/smax",
    "formula:t = exp(60*smax/smin); if(det > 0, 1 - 0.5*(t - 1)/(t + 1), -1)",  // not a number if floats overflow
    "shape-size",
    "relative-size",
    "aspect@input:1",
    "scaled-jacobian-inside",
    "scaled-jacobian@input:2:20%",
    "formula:if(det > 0, smin/smax, det/norm^2)@input",
    "shape-size@aspect:3:30",
    "scaled-jacobian@aspect:2:1:2:3",
    "shape-size@field:m",
    // Metrics with searches of their own:
    "mean-ratio@input",
    "mean-ratio@input:1:20%",
    "mean-ratio@aspect:3:30",
    "mean-ratio@aspect:2:1:2:3",
    "mean-ratio@field:m",
};

/// Adds a field "h" of sizes and one "m" of metric tensors.
[[nodiscard]] inline Mesh with_fields(Mesh mesh) {
  const bool volume = classify(mesh).shape == Shape::Volume;
  Field size, tensor;
  size.name = "h";
  size.components = 1;
  tensor.name = "m";
  tensor.components = volume ? 6 : 3;
  for (const Vec3& p : mesh.positions) {
    const double wave = std::sin(3.0 * p.x) + std::cos(2.0 * p.y - p.z);
    size.values.push_back(0.2 + 0.05 * wave);
    const std::vector<double> m =
        volume ? std::vector<double>{30.0 + 5.0 * wave, 2.0, 20.0, 1.0, -1.0, 40.0} : std::vector<double>{30.0 + 5.0 * wave, 4.0, 12.0};
    tensor.values.insert(tensor.values.end(), m.begin(), m.end());
  }
  mesh.fields.push_back(std::move(size));
  mesh.fields.push_back(std::move(tensor));
  return mesh;
}

/// Whether a device can search the mesh by the metric.
[[nodiscard]] inline bool is_for(std::string_view metric, const InputMesh& mesh) {
  try {
    require_defined(parse_metric(metric), mesh);
  } catch (const UsageError&) {
    return false;
  }
  return true;
}

[[nodiscard]] inline std::vector<dmoscope::testing::Specimen> defined_specimens() {
  using dmoscope::testing::Cells;
  using dmoscope::testing::lattice;
  using dmoscope::testing::mapped;
  std::vector<dmoscope::testing::Specimen> all;
  const auto add = [&all](std::string name, Mesh mesh) { all.push_back({std::move(name), with_fields(std::move(mesh))}); };
  add("triangles", lattice(8, 0.35, 221));
  add("quadrilaterals", lattice(8, 0.35, 222, Cells::Quadrilaterals));
  add("mixed", lattice(8, 0.35, 223, Cells::Mixed));
  add("tangled", lattice(8, 0.9, 224, Cells::Mixed));
  add("stretched, tilted", mapped(lattice(8, 0.3, 225, Cells::Mixed), [](Vec3 p) {
        return Vec3{0.6e3 * p.x + 7, 1e-2 * p.y - 3, 0.8e3 * p.x + 2};
      }));
  Mesh single = mapped(lattice(8, 0.8, 226), [](Vec3 p) { return Vec3{static_cast<float>(p.x), static_cast<float>(p.y), 0}; });
  single.single_precision = true;
  add("tangled, single precision", std::move(single));
  add("stars", dmoscope::testing::mixed_stars());
  Progress progress;
  for (const char* kind : {"tetrahedra", "hexahedra", "solids"}) {
    const Mesh mesh = generate_mesh(kind, 64, 5, progress);
    add(kind, mesh);
    add(std::string(kind) + ", tangled", tangled(mesh, 1.0));
  }
  return all;
}

}  // namespace dmoscope::gpu::testing
