#include "core/input/input_mesh.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mesh/edges.h"
#include "core/mesh/orientation.h"
#include "tests/mesh/meshes.h"

namespace dmoscope {
namespace {

using test::add;
using test::band;
using test::lattice;
using test::make;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

MeshReport examined(const Mesh& mesh) { return examine(mesh, classify(mesh)); }

std::string refusal(Mesh mesh, Need need) {
  Progress progress;
  try {
    (void)prepare_input(std::move(mesh), "folder/some.vtk", need, progress);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Examine, CleanMeshHasNothingToSay) {
  const MeshReport report = examined(lattice(6, 4, 2));
  EXPECT_THAT(report.sentences(), IsEmpty());
  EXPECT_EQ(report.components, 1U);
  EXPECT_EQ(report.boundary_loops, 1U);
}

TEST(Examine, FindsUnusedDuplicateAndDegenerate) {
  Mesh mesh = lattice(4, 4, 2);
  const Index count = mesh.elements.size();
  mesh.positions.push_back({2, 2, 0});
  mesh.positions.push_back({3, 3, 0});
  const auto corners = mesh.elements.corners(3);
  const std::vector<Index> again(corners.rbegin(), corners.rend());  // another winding is still the same element
  mesh.elements.add(mesh.elements.kind(3), again);
  add(mesh, {0, 1, 2});  // three vertices in a row
  add(mesh, {7, 8, 7});
  const MeshReport report = examined(mesh);
  EXPECT_THAT(report.unused_vertices, ElementsAre(25, 26));
  EXPECT_THAT(report.duplicate_elements, ElementsAre(count));
  EXPECT_THAT(report.degenerate_elements, ElementsAre(count + 1, count + 2));
  EXPECT_GT(report.non_manifold_edges, 0U);
  const std::string all = fmt::format("{}", fmt::join(report.sentences(), "\n"));
  EXPECT_THAT(all, HasSubstr("2 vertices belong to no element (first: 25)"));
  EXPECT_THAT(all, HasSubstr(fmt::format("1 element has the same corners as an earlier one ({})", count)));
  EXPECT_THAT(all, HasSubstr(fmt::format("2 elements have no area (first: {})", count + 1)));
}

TEST(Examine, InvertedElementsAreThoseAroundAThrownVertex) {
  Mesh mesh = lattice(4, 4, 1);
  EXPECT_THAT(examined(mesh).inverted_elements, IsEmpty());
  mesh.positions[12] = {3.2, 3.2, 0};  // beyond the far corner of the upper right cell around it
  const MeshReport report = examined(mesh);
  // By hand: all four cells around it have a corner that turns right, or none; the lower left one keeps turning left.
  EXPECT_THAT(report.inverted_elements, ElementsAre(6, 9, 10));
}

TEST(Examine, BowTieQuadrilateralIsInvertedNotDegenerate) {
  const Mesh mesh = make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2, 3}});
  const MeshReport report = examined(mesh);
  EXPECT_THAT(report.inverted_elements, ElementsAre(0));
  EXPECT_THAT(report.degenerate_elements, IsEmpty());
}

TEST(Examine, ManyElementsOnOneEdge) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}};
  for (Index i = 0; i < 2000; ++i) {
    mesh.positions.push_back({0.5, 1.0 + i, 0});
    add(mesh, {0, 1, 2 + i});
  }
  add(mesh, {1, 1500, 0});
  const MeshReport report = examined(mesh);
  EXPECT_EQ(report.non_manifold_edges, 1U);
  EXPECT_THAT(report.duplicate_elements, ElementsAre(2000));
}

TEST(Examine, HugeOffsetsDoNotMakeElementsDegenerate) {
  Mesh mesh = lattice(5, 5, 2);
  for (Vec3& p : mesh.positions) p = p + Vec3{5e5, 4.5e6, 0};
  EXPECT_THAT(examined(mesh).sentences(), IsEmpty());
}

TEST(PrepareInput, OrientsAndCounts) {
  Mesh mesh = lattice(5, 4, 2);
  for (Index e = 0; e < 7; ++e) mesh.elements.flip(e);
  Progress progress;
  const auto input = prepare_input(std::move(mesh), {}, Need::Smoothing, progress);
  EXPECT_EQ(input->report.flipped_elements, 7U);
  EXPECT_THAT(input->report.inverted_elements, IsEmpty());
  EXPECT_EQ(input->topology.vertex_count(), 30U);
  EXPECT_TRUE(input->path.empty());
}

TEST(PrepareInput, ReferenceMeasureIsTheMeanAreaAround) {
  Mesh mesh = lattice(3, 1, 1);
  mesh.positions[3].x = mesh.positions[7].x = 7;  // areas 1, 1, 5
  Progress progress;
  const auto input = prepare_input(mesh, {}, Need::Smoothing, progress);
  EXPECT_THAT(input->reference_measure, ElementsAre(1.0, 2.0, 4.0));
  // Nothing to measure: 1.
  const auto flat = prepare_input(make({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {{0, 1, 2}}), {}, Need::Smoothing, progress);
  EXPECT_THAT(flat->reference_measure, ElementsAre(1.0));
}

TEST(PrepareInput, RefusesWhatThisVersionCannotDo) {
  EXPECT_EQ(refusal(Mesh{}, Need::QualityOnly), "folder/some.vtk: the mesh has no elements");
  Mesh volume = make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {});
  volume.elements.add(ElementKind::Tetrahedron, std::vector<Index>{0, 1, 2, 3});
  EXPECT_EQ(refusal(volume, Need::Smoothing), "");
  volume.elements.add(ElementKind::Triangle, std::vector<Index>{0, 1, 2});
  EXPECT_EQ(refusal(volume, Need::QualityOnly), "folder/some.vtk: the mesh mixes volume elements with triangles (element 1)");
  EXPECT_EQ(refusal(band(9, false), Need::Smoothing), "") << "a curved surface";
}

TEST(PrepareInput, CanBeCancelled) {
  Progress progress;
  progress.request_cancel();
  EXPECT_THROW((void)prepare_input(lattice(3, 3, 1), {}, Need::Smoothing, progress), Cancelled);
}

}  // namespace
}  // namespace dmoscope
