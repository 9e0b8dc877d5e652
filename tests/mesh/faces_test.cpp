// Faces of volume elements: they are closed, face outwards, and enclose the element's volume.
#include "core/mesh/faces.h"

#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dmoscope {
namespace {

using testing::ElementsAre;

/// A positive element of unit edges or so.
Mesh single(ElementKind kind) {
  Mesh mesh;
  switch (kind) {
    case ElementKind::Tetrahedron:
      mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      break;
    case ElementKind::Hexahedron:
      mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
      break;
    case ElementKind::Wedge:
      mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
      break;
    default:
      mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
      break;
  }
  std::vector<Index> corners(mesh.positions.size());
  std::iota(corners.begin(), corners.end(), 0U);
  mesh.elements.add(kind, corners);
  return mesh;
}

/// Volume by the divergence theorem, from the faces' triangles.
double enclosed_volume(const Mesh& mesh, Index element) {
  double six = 0.0;
  for (Index f = 0; f < faces_of(mesh.elements.kind(element)).size(); ++f) {
    const auto v = vertices_of(mesh.elements, {element, f});
    const Index n = v[3] == kNoIndex ? 3 : 4;
    for (Index i = 1; i + 1 < n; ++i) six += dot(mesh.positions[v[0]], cross(mesh.positions[v[i]], mesh.positions[v[i + 1]]));
  }
  return six / 6.0;
}

TEST(Faces, EncloseTheVolumeOfAPositiveElement) {
  EXPECT_NEAR(enclosed_volume(single(ElementKind::Tetrahedron), 0), 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(enclosed_volume(single(ElementKind::Hexahedron), 0), 1.0, 1e-15);
  EXPECT_NEAR(enclosed_volume(single(ElementKind::Wedge), 0), 0.5, 1e-15);
  EXPECT_NEAR(enclosed_volume(single(ElementKind::Pyramid), 0), 1.0 / 3.0, 1e-15);
}

TEST(Faces, AFlippedElementIsInsideOutAndFlippedTwiceTheSame) {
  for (const auto kind : {ElementKind::Tetrahedron, ElementKind::Hexahedron, ElementKind::Wedge, ElementKind::Pyramid}) {
    Mesh mesh = single(kind);
    const double before = enclosed_volume(mesh, 0);
    const std::vector<Index> corners(mesh.elements.corners(0).begin(), mesh.elements.corners(0).end());
    mesh.elements.flip(0);
    EXPECT_NEAR(enclosed_volume(mesh, 0), -before, 1e-15) << info(kind).name;
    EXPECT_EQ(mesh.elements.corners(0).front(), corners.front());
    mesh.elements.flip(0);
    EXPECT_THAT(mesh.elements.corners(0), testing::ElementsAreArray(corners));
  }
}

/// A hexahedron with a pyramid on its top and a wedge at its side.
Mesh house() {
  Mesh mesh = single(ElementKind::Hexahedron);
  mesh.positions.push_back({0.5, 0.5, 2});
  mesh.positions.push_back({2, 0, 0});
  mesh.positions.push_back({2, 1, 0});
  mesh.elements.add(ElementKind::Pyramid, std::vector<Index>{4, 5, 6, 7, 8});
  mesh.elements.add(ElementKind::Wedge, std::vector<Index>{1, 5, 9, 2, 6, 10});
  return mesh;
}

TEST(FaceNeighbours, FindWhoIsAcrossAndTheBoundary) {
  const Mesh mesh = house();
  const FaceNeighbours faces(mesh);
  EXPECT_THAT(faces.of(0), ElementsAre(kNoIndex, 1, kNoIndex, 2, kNoIndex, kNoIndex));
  EXPECT_EQ(faces.of(1)[0], 0U);
  EXPECT_EQ(faces.face_across(mesh.elements, {0, 1}), 0U);
  EXPECT_EQ(faces.face_across(mesh.elements, {1, 0}), 1U);
  EXPECT_EQ(faces.face_count(), 6U + 5 + 5 - 2);
  EXPECT_EQ(faces.boundary().size(), 12U);
  EXPECT_TRUE(faces.non_manifold().empty());
  EXPECT_FALSE(same_direction(mesh.elements, {0, 1}, {1, 0}));
  const Index side = faces.face_across(mesh.elements, {0, 3});
  EXPECT_FALSE(same_direction(mesh.elements, {0, 3}, {2, side}));
}

TEST(FaceNeighbours, TellWhoIsTurnedInsideOut) {
  Mesh mesh = house();
  mesh.elements.flip(1);
  const FaceNeighbours faces(mesh);
  const Index face = faces.face_across(mesh.elements, {0, 1});
  ASSERT_NE(face, kNoIndex);
  EXPECT_TRUE(same_direction(mesh.elements, {0, 1}, {1, face}));
}

TEST(FaceNeighbours, AFaceOfThreeElementsBelongsToNoPair) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 1, 1}};
  for (const Index tip : {3U, 4U, 5U}) mesh.elements.add(ElementKind::Tetrahedron, std::vector<Index>{0, 1, 2, tip});
  const FaceNeighbours faces(mesh);
  EXPECT_EQ(faces.non_manifold().size(), 3U);
  EXPECT_EQ(faces.boundary().size(), 9U);
  for (Index e = 0; e < 3; ++e) EXPECT_EQ(faces.of(e)[0], kNoIndex);
}

TEST(FaceNeighbours, APlanarElementIsItsOwnFace) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.elements.add(ElementKind::Triangle, std::vector<Index>{0, 1, 2});
  const FaceNeighbours faces(mesh);
  ASSERT_EQ(faces.of(0).size(), 1U);
  EXPECT_EQ(faces.of(0)[0], kNoIndex);
  EXPECT_EQ(faces.face_count(), 1U);
  EXPECT_EQ(faces.boundary().size(), 1U);
}

}  // namespace
}  // namespace dmoscope
