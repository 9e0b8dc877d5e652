#include <array>
#include <limits>

#include "fixture.h"
#include "render/gl.h"
#include "render/scene.h"
#include "tests/support/picture_difference.h"

namespace dmoscope::render {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST_F(WithContext, SaysWhatDraws) {
  EXPECT_NE(context->description().find("OpenGL 4."), std::string::npos);
  EXPECT_NE(context->description().find("EGL"), std::string::npos);
}

TEST_F(WithContext, ElementsHaveTheirColours) {
  load(triangle_and_quadrilateral(), {0.25F, 0.8F});
  const Image image = picture(unit_camera(), flat_style());
  const Rgb triangle = sample(ColourMap::Viridis, 0.25), quadrilateral = sample(ColourMap::Viridis, 0.8);
  EXPECT_TRUE(near_colour(image.at(60, 60), triangle));        // plane (-40, 0)
  EXPECT_TRUE(near_colour(image.at(24, 108), triangle));       // (-76, -48): inside, near its left corner
  EXPECT_TRUE(near_colour(image.at(150, 65), quadrilateral));  // (50, -5)
  EXPECT_TRUE(near_colour(image.at(112, 22), quadrilateral));  // (12, 38): its left upper corner
  EXPECT_TRUE(near_colour(image.at(188, 108), quadrilateral));
  const Rgb background = Style::dark().background;
  EXPECT_TRUE(near_colour(image.at(105, 60), background, 0));  // between both elements
  EXPECT_TRUE(near_colour(image.at(24, 20), background, 0));   // above the triangle's left corner: y is up
  EXPECT_TRUE(near_colour(image.at(60, 15), triangle));        // its tip is above
}

TEST_F(WithContext, RangeReversedAndSteps) {
  load(triangle_and_quadrilateral(), {0.25F, 0.8F});
  Style style = flat_style();
  style.colours = {ColourMap::Magma, true, 5, 0.2, 0.7};
  const Image image = picture(unit_camera(), style);
  EXPECT_TRUE(near_colour(image.at(60, 60), sample(ColourMap::Magma, 1.0)));   // first of five steps, reversed
  EXPECT_TRUE(near_colour(image.at(150, 65), sample(ColourMap::Magma, 0.0)));  // above the range
}

TEST_F(WithContext, InvertedIsMagentaWithHatchingAndUndefinedGrey) {
  load(triangle_and_quadrilateral(), {kNan, -0.4F}, {0, 1});
  const Image image = picture(unit_camera(), flat_style());
  int plain = 0, dark = 0, grey = 0;
  for (int y = 25; y < 105; ++y) {
    for (int x = 115; x < 185; ++x) {
      const Rgba c = image.at(x, y);
      EXPECT_LT(c.g, 40);
      plain += near_colour(c, kInvertedColour) ? 1 : 0;
      dark += c.r < 130 ? 1 : 0;
    }
    grey += near_colour(image.at(60, y), kUndefinedColour) ? 1 : 0;
  }
  EXPECT_GT(plain, 2000);
  EXPECT_GT(dark, 500) << "stripes";
  EXPECT_GT(grey, 20);
}

TEST_F(WithContext, InvertedLiesAboveItsNeighbours) {
  Mesh mesh = triangle_and_quadrilateral();
  const Index folded[] = {3, 6, 5};  // over the quadrilateral's upper left half, wound the other way
  Mesh below;
  below.positions = mesh.positions;
  below.elements.add(ElementKind::Triangle, folded);
  below.elements.add(ElementKind::Quadrilateral, mesh.elements.corners(1));
  load(below, {0.5F, 0.9F}, {1, 0});
  const Image image = picture(unit_camera(), flat_style());
  int stripes = 0, between = 0;  // counts in a square of two periods
  for (int y = 27; y < 43; ++y)
    for (int x = 117; x < 133; ++x) {
      stripes += near_colour(image.at(x, y), kInvertedColour) ? 1 : 0;
      between += near_colour(image.at(x, y), sample(ColourMap::Viridis, 0.9)) ? 1 : 0;
    }
  EXPECT_EQ(stripes + between, 16 * 16);
  EXPECT_GT(stripes, 16 * 16 / 5) << "it lies above";
  EXPECT_GT(between, 16 * 16 / 2) << "but hides nothing";
  EXPECT_TRUE(near_colour(image.at(170, 95), sample(ColourMap::Viridis, 0.9)));
  EXPECT_EQ(scene->pick(unit_camera(), kViewport, {125, 35}).element, 0U);
}

TEST_F(WithContext, WireframeFollowsEdgesWithoutDiagonals) {
  load(triangle_and_quadrilateral(), {0.25F, 0.8F});
  Style style = flat_style();
  style.wireframe = true;
  style.wire_width = 4;
  style.wire_colour = {0, 0, 0, 255};
  const Image image = picture(unit_camera(), style);
  EXPECT_TRUE(near_colour(image.at(150, 109), {0, 0, 0}, 8));                    // on the lower edge
  EXPECT_TRUE(near_colour(image.at(150, 65), sample(ColourMap::Viridis, 0.8)));  // middle of the diagonal
  for (int x = 115; x < 185; ++x) {
    EXPECT_TRUE(near_colour(image.at(x, 109 - (x - 110) * 90 / 80), sample(ColourMap::Viridis, 0.8))) << "along the diagonal at " << x;
  }
  // Edges are gone when elements are a few pixels big.
  Camera2D far = unit_camera();
  far.units_per_pixel = 50;
  const Image with = picture(far, style), without = picture(far, flat_style());
  EXPECT_EQ(with.rgba, without.rgba);
}

TEST_F(WithContext, ConcaveQuadrilateralIsFilledInsideOnly) {
  for (const int turn : {0, 1, 2, 3}) {
    Mesh mesh;
    // The element is an arrowhead with its reflex corner at (0, -10).
    mesh.positions = {{-60, -50, 0}, {0, -10, 0}, {60, -50, 0}, {0, 50, 0}};
    Index c[4];
    for (int i = 0; i < 4; ++i) c[i] = static_cast<Index>((i + turn) % 4);
    mesh.elements.add(ElementKind::Quadrilateral, c);
    load(mesh, {0.5F});
    const Image image = picture(unit_camera(), flat_style());
    EXPECT_TRUE(near_colour(image.at(100, 60), sample(ColourMap::Viridis, 0.5))) << turn;
    EXPECT_TRUE(near_colour(image.at(100, 90), Style::dark().background)) << turn;
    EXPECT_EQ(scene->pick(unit_camera(), kViewport, {100, 60}).element, 0U);
    EXPECT_EQ(scene->pick(unit_camera(), kViewport, {100, 90}).element, kNoIndex);
  }
}

TEST_F(WithContext, BoundaryEdgesAndMarksAreDrawn) {
  const Mesh mesh = triangle_and_quadrilateral();
  load(mesh, {0.25F, 0.8F});
  Style style = flat_style();
  style.boundary = true;
  style.boundary_width = 5;
  style.boundary_colour = {255, 0, 0, 255};
  EXPECT_TRUE(near_colour(picture(unit_camera(), style).at(150, 110), {255, 0, 0}));
  style.boundary = false;
  Marks marks;
  marks.dots.push_back({{50, 0, 0}, 10.0F, {1, 2, 3, 255}, DotShape::Round});
  marks.lines.push_back({{-90, 0, 0}, {90, 0, 0}, 3.0F, {0, 255, 0, 255}});
  marks.vertices = {2};
  marks.elements = {1};
  marks.worst = 0;
  const Image image = picture(unit_camera(), style, marks);
  EXPECT_TRUE(near_colour(image.at(150, 60), {1, 2, 3}));
  EXPECT_TRUE(near_colour(image.at(105, 60), {0, 255, 0}));
  EXPECT_TRUE(near_colour(image.at(60, 10), {255, 255, 255}, 4));    // the vertex' dot at (-40, 50)
  EXPECT_TRUE(near_colour(image.at(150, 20), {255, 255, 255}, 40));  // the outline's upper side
  EXPECT_FALSE(compare(image, picture(unit_camera(), style)).alike());
}

TEST_F(WithContext, PicksElementsAndVertices) {
  load(triangle_and_quadrilateral(), {0.25F, 0.8F});
  const Camera2D camera = unit_camera();
  EXPECT_EQ(scene->pick(camera, kViewport, {60, 60}).element, 0U);
  EXPECT_EQ(scene->pick(camera, kViewport, {150, 65}).element, 1U);
  EXPECT_EQ(scene->pick(camera, kViewport, {111, 21}).element, 1U);
  EXPECT_EQ(scene->pick(camera, kViewport, {105, 60}).element, kNoIndex);
  EXPECT_EQ(scene->pick(camera, kViewport, {5, 5}).element, kNoIndex);
  EXPECT_EQ(scene->pick(camera, kViewport, {60, 60}).vertex, kNoIndex);
  const Pick near_corner = scene->pick(camera, kViewport, {193, 22});  // corner 5 at plane (90, 40) is pixel (190, 20)
  EXPECT_EQ(near_corner.vertex, 5U);
  EXPECT_EQ(near_corner.element, kNoIndex);
  EXPECT_NEAR(near_corner.vertex_distance, std::hypot(3, 2), 1e-9);
  EXPECT_EQ(scene->pick(camera, kViewport, {199, 20}).vertex, kNoIndex);
  EXPECT_EQ(scene->pick(camera, kViewport, {199, 20}, 10.0).vertex, 5U);
}

TEST_F(WithContext, PickingAgreesWithDrawingEverywhere) {
  const Mesh mesh = wavy_sheet(19, 11);
  std::vector<float> quality(mesh.elements.size());
  for (std::size_t e = 0; e < quality.size(); ++e) quality[e] = static_cast<float>(e % 10) / 9.0F;
  load(mesh, quality);
  const Camera2D camera = Camera2D::fit(scene->bounds(), kViewport, 4);
  const Image image = picture(camera, flat_style());
  int wrong = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Index element = scene->pick(camera, kViewport, {x + 0.5, y + 0.5}).element;
      const Rgb wanted = element == kNoIndex ? Style::dark().background : sample(ColourMap::Viridis, static_cast<double>(quality[element]));
      wrong += near_colour(image.at(x, y), wanted) ? 0 : 1;
    }
  }
  EXPECT_LE(wrong, 20) << "only pixel middles within float rounding of an edge may differ";
}

TEST_F(WithContext, FarFromTheOriginTheSamePicture) {
  load(triangle_and_quadrilateral(), {0.25F, 0.8F});
  const Image here = picture(unit_camera(), Style::dark());
  const Vec3 shift{500'000.0, 4'649'776.0, 0};
  load(triangle_and_quadrilateral(shift), {0.25F, 0.8F});
  const Image there = picture(unit_camera({shift.x, shift.y}), Style::dark());
  EXPECT_EQ(here.rgba, there.rgba);
  EXPECT_EQ(scene->pick(unit_camera({shift.x, shift.y}), kViewport, {150, 65}).element, 1U);
}

TEST_F(WithContext, OtherPlanesAreSeenFromAbove) {
  Mesh mesh = triangle_and_quadrilateral();
  load(mesh, {0.25F, 0.8F});
  const Image flat = picture(unit_camera(), Style::dark());
  for (Vec3& p : mesh.positions) p = {7.0, p.x, p.y};
  scene->set_mesh(mesh, Plane{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}});
  scene->update(mesh.positions, std::vector<float>{0.25F, 0.8F}, {});
  EXPECT_EQ(picture(unit_camera(), Style::dark()).rgba, flat.rgba);
}

TEST_F(WithContext, UpdatesInPlace) {
  Mesh mesh = triangle_and_quadrilateral();
  load(mesh, {0.25F, 0.8F});
  mesh.positions[2] = {-40, 0, 0};  // the triangle's tip comes down
  scene->update(mesh.positions, std::vector<float>{0.6F, 0.8F}, {});
  const Image image = picture(unit_camera(), flat_style());
  EXPECT_TRUE(near_colour(image.at(60, 15), Style::dark().background));
  EXPECT_TRUE(near_colour(image.at(60, 90), sample(ColourMap::Viridis, 0.6)));
  EXPECT_THROW(scene->update(mesh.positions, std::vector<float>{0.6F}, {}), UsageError);
}

TEST_F(WithContext, ReducedDetailLooksAlikeAndKeepsInvertedElements) {
  const Mesh mesh = wavy_sheet(300, 180);
  std::vector<float> quality(mesh.elements.size());
  for (std::size_t e = 0; e < quality.size(); ++e)
    quality[e] = mesh.positions[mesh.elements.corners(static_cast<Index>(e))[0]].x < 150 ? 0.2F : 0.9F;
  std::vector<std::uint8_t> inverted(quality.size(), 0);
  inverted[quality.size() / 3] = 1;
  load(mesh, quality, inverted);
  const Camera2D camera = Camera2D::fit(scene->bounds(), kViewport, 6);
  const Image full = picture(camera, flat_style()), coarse = picture(camera, flat_style(), {}, 0.1);
  EXPECT_TRUE(compare(full, coarse).alike(0.08)) << compare(full, coarse).off_share;
  int magenta = 0;
  for (int y = 0; y < coarse.height; ++y) {
    for (int x = 0; x < coarse.width; ++x) magenta += near_colour(coarse.at(x, y), kInvertedColour) ? 1 : 0;
  }
  EXPECT_GT(magenta, 0);
  EXPECT_EQ(picture(camera, flat_style(), {}, 0.1).rgba, coarse.rgba);
  // Close up there are few elements: all are drawn, at any detail.
  Camera2D close;
  close.look_at({20, 20}, 10, kViewport);
  EXPECT_EQ(picture(close, Style::dark(), {}, 0.1).rgba, picture(close, Style::dark()).rgba);
}

TEST_F(WithContext, LeavesTheBoundFramebufferAndViewport) {
  load(triangle_and_quadrilateral(), {0.25F, 0.8F});
  Framebuffer other(32, 16);
  other.bind();
  GLint before = 0, after = 0, viewport[4];
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
  (void)picture(unit_camera(), Style::dark());
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &after);
  glGetIntegerv(GL_VIEWPORT, viewport);
  EXPECT_EQ(before, after);
  EXPECT_EQ(viewport[2], 32);
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(WithContext, NothingAndOddMeshes) {
  EXPECT_TRUE(scene->empty());
  EXPECT_TRUE(scene->show(nullptr));
  EXPECT_TRUE(near_colour(picture(unit_camera(), Style::dark()).at(3, 3), Style::dark().background, 0));
  EXPECT_EQ(scene->pick(unit_camera(), kViewport, {1, 1}).element, kNoIndex);
  Mesh volume;
  volume.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Index corners[] = {0, 1, 2, 3};
  volume.elements.add(ElementKind::Tetrahedron, corners);
  EXPECT_THROW(scene->set_mesh(volume, Plane{}), UsageError);
  Mesh lonely;
  lonely.positions = {{5, 5, 0}};
  load(lonely, {});
  EXPECT_TRUE(scene->empty());
  EXPECT_TRUE(scene->bounds().empty());
  (void)picture(unit_camera(), Style::dark());
}

TEST_F(WithContext, ErrorsNameTheCall) {
  try {
    DMOSCOPE_GL(glEnable(0xdead));
    FAIL() << "an invalid enum passed";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("glEnable(0xdead)"), std::string::npos) << error.what();
  }
}

TEST_F(WithContext, SuggestsLessDetailOnlyInSoftwareWhileMoving) {
  EXPECT_EQ(scene->suggested_detail(2'700'000, false, true), 1.0);
  EXPECT_EQ(scene->suggested_detail(2'700'000, true, false), 1.0);
  EXPECT_EQ(scene->suggested_detail(1'000, true, true), 1.0);
  EXPECT_LT(scene->suggested_detail(2'700'000, true, true), 0.1);
  EXPECT_EQ(scene->suggested_detail(0, true, true), 1.0);
}

TEST_F(WithContext, InvertedElementsDoNotBuryTheRest) {
  // A sheet of 8 x 4 quadrilaterals, and over all of it three inverted triangles.
  Mesh mesh;
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i <= 8; ++i) mesh.positions.push_back({i * 20.0 - 80.0, j * 20.0 - 40.0, 0.0});
  for (Index j = 0; j < 4; ++j)
    for (Index i = 0; i < 8; ++i) {
      const Index a = j * 9 + i;
      mesh.elements.add(ElementKind::Quadrilateral, std::array<Index, 4>{a, a + 1, a + 10, a + 9});
    }
  std::vector<float> quality(32, 0.5F);
  std::vector<std::uint8_t> inverted(32, 0);
  for (int k = 0; k < 3; ++k) {
    const auto first = static_cast<Index>(mesh.positions.size());
    for (const Vec3 p : {Vec3{-90, -50, 0}, Vec3{0, 400, 0}, Vec3{90, -50, 0}}) mesh.positions.push_back(p);
    mesh.elements.add(ElementKind::Triangle, std::array<Index, 3>{first, first + 1, first + 2});
    quality.push_back(-0.5F);
    inverted.push_back(1);
  }
  scene->set_mesh(mesh, Plane{});
  scene->update(mesh.positions, quality, inverted);
  const Image image = picture(unit_camera(), flat_style());
  int magenta = 0, of_the_rest = 0, others = 0;
  for (int y = 25; y < 95; ++y)
    for (int x = 40; x < 160; ++x) {
      if (near_colour(image.at(x, y), kInvertedColour, 2)) {
        ++magenta;
      } else if (near_colour(image.at(x, y), sample(ColourMap::Viridis, 0.5), 2)) {
        ++of_the_rest;
      } else {
        ++others;
      }
    }
  const int all = 70 * 120;
  EXPECT_EQ(others, 0);
  EXPECT_GT(magenta, all / 8) << "they are marked";
  EXPECT_LT(magenta, all / 2) << "three of them no more than one";
  EXPECT_GT(of_the_rest, all / 2);
}

}  // namespace
}  // namespace dmoscope::render
