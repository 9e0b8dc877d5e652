// Joint moves on curved surfaces: their atoms are the elements as the program judges them, a flat part of a surface gets as far as the
// plane does, and vertices stay on the surface and near the input.

#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>

#include "core/joint/defined_atoms.h"
#include "core/quality/defined_metric.h"
#include "tests/joint/elements.h"
#include "tests/smooth/surface_judge.h"
#include "tests/smooth/surface_zoo.h"
#include "tests/support/sanitized.h"

namespace dmoscope {
namespace {

using namespace testing;

/// Rotates a point of space so that no axis stays where it was.
Vec3 turned(Vec3 p) {
  const double a = 0.7, b = 1.1;
  const Vec3 q{std::cos(a) * p.x - std::sin(a) * p.y, std::sin(a) * p.x + std::cos(a) * p.y, p.z};
  return {q.x, std::cos(b) * q.y - std::sin(b) * q.z, std::sin(b) * q.y + std::cos(b) * q.z};
}

/// Element whose corners are displaced at random in all of space, and another at its first edge that stands up.
Mesh bent_element(ElementKind kind, testing::Random& random) {
  Mesh mesh = random_element(kind, 0.2, random);
  for (Vec3& p : mesh.positions) p.z += random(-0.3, 0.3);
  mesh.positions.push_back({0.4, -0.2, 0.9});
  const Index corners[]{1, 0, mesh.vertex_count() - 1};
  mesh.elements.add(ElementKind::Triangle, corners);
  return mapped(std::move(mesh), turned);
}

/// Expects that the least of the first element's atoms is its quality, and that their derivatives are those of their values.
void expect_atoms_judge(const AtomFunction<3>& function, const std::vector<Atom<3>>& atoms, const QualityContext& context, Metric metric,
                        int& sound) {
  const std::span<const Vec3> positions = context.mesh.positions;
  double most = 0.0;
  for (const Atom<3>& atom : atoms)
    if (atom.piece != kGuardPiece) most = std::max(most, function.value(atom, edges_of<3>(atom, positions), 1.0));
  if (!(smallest_jacobian(context, positions, 0) > 0.0)) {
    EXPECT_TRUE(std::isinf(most));
    return;
  }
  ++sound;
  EXPECT_NEAR(1.0 / most, element_quality(context, positions, metric, 0), 1e-12);
  for (const Atom<3>& atom : atoms) {
    const AtomEdges<3> edges = edges_of<3>(atom, positions);
    if (const double f = function.value(atom, edges, 1.0); f < 8.0 && f > 0.02) expect_derivatives<3>(function, atom, edges, 1.0);
  }
}

TEST(SurfaceAtoms, JudgeElementsAsTheProgramDoes) {
  testing::Random random(11);
  int sound = 0;
  for (const ElementKind kind : {ElementKind::Triangle, ElementKind::Quadrilateral})
    for (const MetricInfo& row : metric_table()) {
      if (!joint_supports(row.metric, kind_set(kind))) continue;
      SCOPED_TRACE(std::string(row.name) + " of " + std::string(info(kind).plural));
      for (int i = 0; i < 12; ++i) {
        const auto mesh = testing::input(bent_element(kind, random));
        ASSERT_TRUE(mesh->is_surface());
        std::vector<Atom<3>> atoms;
        append_atoms<3>(mesh->mesh.elements, row.metric, 0, atoms);
        // Tries the mesh as it is; with most elements in a plane; and with given normals.
        Geometry geometry = mesh->geometry;
        geometry.mostly_flat = i % 3 == 1;
        std::vector<Vec3> normals;
        if (i % 3 == 2) normals.assign(2, unit(turned({0.2, 0.1, 1.0})));
        Curved frame{geometry.plane.normal, geometry.mostly_flat, normals.empty() ? nullptr : normals.data()};
        expect_atoms_judge(AtomFunction<3>(row.metric, frame), atoms, {mesh->mesh, geometry, normals}, row.metric, sound);
      }
    }
  EXPECT_GT(sound, 80);
}

TEST(SurfaceAtoms, JudgeByFormulasAndTargetsLikewise) {
  testing::Random random(12);
  int sound = 0;
  for (const ElementKind kind : {ElementKind::Triangle, ElementKind::Quadrilateral})
    for (const char* name : {"formula:2*det/norm^2", "formula:exp(-1/det)", "formula:det/norm^2*(1.5 + 0.3*x(u)/length(u))",
                             "formula:min(l12, l23)/max(l12, l23)", "mean-ratio@input:2"}) {
      const Metric metric = parse_metric(name);
      if (!joint_supports(metric, kind_set(kind))) continue;
      for (int i = 0; i < 8; ++i) {
        const auto mesh = testing::input(bent_element(kind, random));
        const auto of = std::make_shared<const DefinedAtoms<3>>(*mesh, metric);
        if (of->shift() != 0.0) continue;
        std::vector<Atom<3>> atoms;
        of->append(mesh->mesh.elements, 0, atoms);
        SCOPED_TRACE(std::string(name) + " of " + std::string(info(kind).plural));
        expect_atoms_judge(AtomFunction<3>(of), atoms, mesh->quality_context(), metric, sound);
      }
    }
  EXPECT_GT(sound, 30);
}

/// Minimum that joint moves reach.
double reached(const std::shared_ptr<const InputMesh>& mesh, RunParameters parameters, unsigned threads = 1) {
  parameters.method = "joint";
  dmoscope::Run run = testing::make_run(mesh, parameters, threads);
  Progress progress;
  run.until_converged({}, progress);
  EXPECT_EQ(run.statistics().inverted, 0U);
  return run.statistics().movable_minimum;
}

/// Compares a flat part of a surface, turned somewhere, with the same mesh in the plane: there joint moves have edges of two coordinates,
/// and other atoms.
TEST(SurfaceJoint, GetsAsFarAsInThePlane) {
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals}) {
    const Mesh flat = lattice(7, 0.35, 21, cells);
    Mesh bent = flat;
    bent.positions.push_back({0.5 / 7, -0.01, 0.1});
    testing::add(bent, {1, 0, bent.vertex_count() - 1});
    const auto plane = testing::input(flat), surface = testing::input(mapped(bent, turned));
    ASSERT_TRUE(surface->is_surface());
    for (const char* name : {"mean-ratio", "scaled-jacobian", "min-angle", "formula:2*det/norm^2"}) {
      const RunParameters parameters{.metric = parse_metric(name)};
      if (!why_not_joint(*plane, parameters.metric).empty()) continue;
      const double in_the_plane = reached(plane, parameters), on_the_surface = reached(surface, parameters);
      EXPECT_NEAR(on_the_surface, in_the_plane, 5e-4 * in_the_plane) << name;
      EXPECT_GT(in_the_plane, 1.01 * compute_statistics(plane->quality_context(), plane->mesh.positions, parameters.metric,
                                                        testing::make_run(plane, parameters).immovable(), nullptr)
                                         .movable_minimum);
    }
  }
}

TEST(SurfaceJoint, StaysOnTheSurfaceAndNearTheInput) {
  EXPECT_GT(expect_kept_by("joint", surfaces(), kSanitized ? 11 : 6, kSanitized ? 1 : 2), kSanitized ? 20U : 200U);
}

/// Uses a can whose rims and ends are its feature edges: checks all that is promised, densely, and the same bits by any number of threads.
TEST(SurfaceJoint, RaisesACansMinimumWithinTheBound) {
  const Mesh can = wound(24, 6, false, false, 5, Cells::Triangles, on_cylinder);
  const auto mesh = testing::input(can);
  RunParameters parameters = sliding_by(2e-3);
  dmoscope::Run alone = testing::make_run(mesh, parameters);
  Progress progress;
  alone.until_converged({}, progress);
  parameters.then_joint.emplace();
  dmoscope::Run run = testing::make_run(mesh, parameters, 1), again = testing::make_run(mesh, parameters, 4);
  run.until_converged({}, progress);
  again.until_converged({}, progress);
  EXPECT_TRUE(same_bits(run.positions(), again.positions()));
  EXPECT_GT(run.statistics().minimum, alone.statistics().minimum);
  EXPECT_EQ(run.statistics().inverted, 0U);
  SurfaceJudge({"can", can}, *mesh, parameters.max_deviation).expect_kept(run);
  const auto facets = triangles_of(surface_faces(can), mesh->mesh.positions);
  double most = 0.0;
  for (const auto& [a, b, c] : triangles_of(surface_faces(can), run.positions()))
    for (int i = 0; i <= 12; ++i)
      for (int j = 0; i + j <= 12; ++j) {
        const auto p = run.positions();
        const Vec3 at =
            (1.0 / 12) * (static_cast<double>(i) * p[a] + static_cast<double>(j) * p[b] + static_cast<double>(12 - i - j) * p[c]);
        most = std::max(most, distance_to(at, mesh->mesh.positions, facets));
      }
  EXPECT_LE(most, parameters.max_deviation * mesh->geometry.size * (1.0 + 1e-9));
}

}  // namespace
}  // namespace dmoscope
