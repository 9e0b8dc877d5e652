// One source of marks for plane and space: a planar mesh seen from above, and the same mesh as a surface in space seen from there.
#include <gtest/gtest.h>

#include "core/mesh/element_edges.h"
#include "core/mesh/faces.h"
#include "render/context.h"
#include "render/planar_scene.h"
#include "render/volume_scene.h"
#include "tests/support/meshes.h"
#include "tests/support/picture_difference.h"
#include "ui/overlays/moves.h"
#include "ui/overlays/overlay.h"

namespace dmoscope::ui {
namespace {

constexpr Vec2<double> kPicture{400, 300};

/// A lattice over the unit square with some vertices moved; all in view, 250 pixels per unit.
struct Twins {
  std::shared_ptr<const InputMesh> input = dmoscope::testing::input(dmoscope::testing::lattice(12, 0.2, 4));
  std::vector<Vec3> from = input->mesh.positions, to = moved(from);
  render::Camera2D above{{0.5, 0.5}, 1.0 / 250.0};
  render::OrbitCamera orbit = from_top();
  MarkView flat{render::SceneView(above, kPicture), 1.0, {Plane{}}};
  MarkView space{render::SceneView(orbit, orbit.projection(kPicture, box()))};

  static std::vector<Vec3> moved(std::vector<Vec3> positions) {
    for (std::size_t v = 0; v < positions.size(); v += 3) positions[v] = positions[v] + Vec3{0.004 * static_cast<double>(v % 7), 0.011, 0};
    return positions;
  }
  [[nodiscard]] render::OrbitCamera from_top() const {
    render::OrbitCamera camera;
    camera.centre = {0.5, 0.5, 0.0};
    camera.height = kPicture.y / 250.0;
    return camera;
  }
  [[nodiscard]] render::Bounds3 box() const {
    render::Bounds3 all;
    for (const Vec3& position : from) all.include(position);
    return all;
  }
  [[nodiscard]] std::vector<Index> vertices() const {
    std::vector<Index> all(from.size());
    for (Index v = 0; v < all.size(); ++v) all[v] = v;
    return all;
  }
  [[nodiscard]] std::vector<EdgeEnds> edges() const {
    render::Unhidden all;
    for (Index e = 0; e < input->mesh.elements.size(); ++e)
      for_edges(input->mesh.elements, e, [&](Index a, Index b) { all.edges.push_back({std::min(a, b), std::max(a, b)}); });
    all.tidy();
    return all.edges;
  }
};

/// Compares the places of lines and dots of both, in pixels.
void expect_alike(const render::Marks& a, const render::SceneView& by_a, const render::Marks& b, const render::SceneView& by_b) {
  const auto near = [&](Vec3 p, Vec3 q) {
    const auto at = by_a.place(p), there = by_b.place(q);
    return at && there && std::hypot(at->x - there->x, at->y - there->y) < 1e-6;
  };
  ASSERT_EQ(a.lines.size(), b.lines.size());
  for (std::size_t k = 0; k < a.lines.size(); ++k) {
    EXPECT_TRUE(near(a.lines[k].from, b.lines[k].from) && near(a.lines[k].to, b.lines[k].to)) << k;
    EXPECT_EQ(a.lines[k].width, b.lines[k].width);
    EXPECT_EQ(a.lines[k].colour, b.lines[k].colour);
  }
  ASSERT_EQ(a.dots.size(), b.dots.size());
  for (std::size_t k = 0; k < a.dots.size(); ++k) {
    EXPECT_TRUE(near(a.dots[k].point, b.dots[k].point)) << k;
    EXPECT_NEAR(a.dots[k].diameter, b.dots[k].diameter, 1e-4);
    EXPECT_EQ(a.dots[k].shape, b.dots[k].shape);
  }
}

TEST(OverlaysInPlaneAndSpace, MoveMarksAreTheSame) {
  const Twins mesh;
  const Inks inks{{1, 2, 3, 255}, {4, 5, 6, 200}};
  const auto marks_of = [&](const MarkView& view) {
    render::Marks marks;
    const Displacements moved(view.points, mesh.from, mesh.to);
    const double factor = arrow_factor(view, moved, 0.0);
    EXPECT_NEAR(view.view.pixels({}, factor * moved.longest() * Vec3{1, 0, 0}), 40.0, 1e-9);
    add_arrows(marks, view, moved, factor, inks);
    add_ghost(marks, view, mesh.from, mesh.to, mesh.edges(), inks);
    add_dots(marks, view, *mesh.input, mesh.to, mesh.vertices(), inks.ink, 8.0);
    add_ring(marks, view, mesh.to[20], 20.0F, inks.ink);
    return marks;
  };
  const render::Marks flat = marks_of(mesh.flat), space = marks_of(mesh.space);
  EXPECT_GT(flat.lines.size(), 100U);
  EXPECT_EQ(flat.dots.size(), mesh.from.size() + 1);
  expect_alike(flat, mesh.flat.view, space, mesh.space.view);
}

TEST(OverlaysInPlaneAndSpace, FeaturesAndInvertedElementsAreTheSame) {
  const Twins mesh;
  StandingRule rule;
  rule.boundary = BoundaryRule::Slide;
  const Domain domain(*mesh.input, rule);
  ASSERT_FALSE(domain.feature_edges().empty());
  Frame frame;
  frame.input = mesh.input;
  frame.positions = mesh.from;
  const auto small = mesh.input->mesh.elements.corners(60);  // an element of two pixels or less
  for (std::size_t k = 0; k < small.size(); ++k)
    frame.positions[small[k]] = mesh.from[small[0]] + Vec3{0.004 * static_cast<double>(k), 0, 0};
  std::vector<Index> all(mesh.input->mesh.elements.size());
  for (Index e = 0; e < all.size(); ++e) all[e] = e;
  const auto marks_of = [&](const MarkView& view) {
    render::Marks marks;
    add_features(marks, view, domain, mesh.from, {{1, 2, 3, 255}, {4, 5, 6, 200}});
    add_inverted(marks, view, frame, all);
    add_diamond(marks, view.points.at(mesh.from[5]), 12.0F, {});
    return marks;
  };
  const render::Marks flat = marks_of(mesh.flat);
  EXPECT_TRUE(std::ranges::any_of(flat.dots, [](const auto& dot) { return dot.diameter == 8.0F; })) << "something is inverted and small";
  expect_alike(flat, mesh.flat.view, marks_of(mesh.space), mesh.space.view);
}

/// Scenes draw equal marks equally, too: outlines, dots, the ring, lines.
TEST(OverlaysInPlaneAndSpace, ScenesDrawTheSameMarks) {
  std::unique_ptr<render::Context> context;
  try {
    context = render::create_headless_context();
  } catch (const Error& error) {
    GTEST_SKIP() << error.what();
  }
  const Twins mesh;
  const std::vector<float> quality(mesh.input->mesh.elements.size(), 0.5F);
  render::PlanarScene flat;
  flat.set_mesh(mesh.input->mesh, Plane{});
  flat.update(mesh.from, quality, {});
  render::VolumeScene space;
  const FaceNeighbours faces(mesh.input->mesh);
  space.set_mesh(mesh.input->mesh.elements, faces);
  space.update({mesh.from, quality, {}, 1});
  render::Marks marks{.elements = {3, 40}, .vertices = {17, 60}, .worst = 100, .triad = false};
  marks.lines.push_back({{0.1, 0.2, 0}, {0.8, 0.7, 0}, 2.0F, {200, 30, 10, 255}});
  marks.dots.push_back({{0.3, 0.9, 0}, 12.0F, {20, 130, 10, 255}, render::DotShape::Diamond});
  const auto picture = [&](render::Scene& scene, const render::Camera& camera) {
    render::Framebuffer target(static_cast<int>(kPicture.x), static_cast<int>(kPicture.y));
    target.clear({10, 20, 30, 255});
    scene.draw_marks(target, camera, render::Style::dark(), marks);
    return target.read_pixels();
  };
  const render::Image one = picture(flat, mesh.above), other = picture(space, mesh.orbit);
  EXPECT_TRUE(render::compare(one, other).alike(0.0005)) << render::compare(one, other).off_share;
  for_edges(mesh.input->mesh.elements, 3, [&](Index p, Index q) {  // each edge is drawn
    const Vec2<double> at = *mesh.flat.view.place(0.5 * (mesh.from[p] + mesh.from[q]));
    for (const render::Image* image : {&one, &other})
      EXPECT_GT(image->at(static_cast<int>(0.5 * kPicture.x + at.x), static_cast<int>(0.5 * kPicture.y - at.y)).r, 150) << p << " to " << q;
  });
  marks = {};
  marks.triad = false;
  EXPECT_FALSE(render::compare(one, picture(flat, mesh.above)).alike(0.0005)) << "there is something to compare";
}

}  // namespace
}  // namespace dmoscope::ui
