// Colours of volume elements against known sizes; and their samples on the start page.
#include <array>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "core/base/progress.h"
#include "core/input/input_mesh.h"
#include "core/mesh/generate.h"
#include "core/view/view.h"
#include "tests/support/volume_grids.h"
#include "ui/analysis/element_colours.h"
#include "ui/toolkit/thumbnails.h"

namespace dmoscope::ui {
namespace {

std::shared_ptr<Frame> frame_of(Mesh mesh) {
  Progress progress;
  auto frame = std::make_shared<Frame>();
  frame->input = prepare_input(std::move(mesh), {}, Need::Smoothing, progress);
  frame->positions = frame->input->mesh.positions;
  frame->quality.assign(frame->input->mesh.elements.size(), 0.5F);
  frame->inverted.assign(frame->quality.size(), 0);
  return frame;
}

ElementColours volume_colours_of(ColourBy by, const std::shared_ptr<Frame>& frame) {
  return colour_elements({by, frame, nullptr, render::ColourMap::Viridis, false});
}

/// Two boxes side by side, a cube of side 1 and one twice as long.
Mesh a_cube_and_a_bar() {
  Mesh mesh;
  for (const double x : {0.0, 1.0, 3.0})
    for (const double z : {0.0, 1.0})
      for (const double y : {0.0, 1.0}) mesh.positions.push_back({x, y, z});
  for (const Index first : {Index{0}, Index{4}})
    mesh.elements.add(ElementKind::Hexahedron,
                      std::array<Index, 8>{first, first + 4, first + 5, first + 1, first + 2, first + 6, first + 7, first + 3});
  return mesh;
}

TEST(VolumeColours, SizeIsVolumeOverItsMean) {
  const ElementColours colours = volume_colours_of(ColourBy::Size, frame_of(a_cube_and_a_bar()));
  ASSERT_EQ(colours.shading->values.size(), 2U);
  EXPECT_NEAR(colours.shading->values[0], std::log10(1.0 / 1.5), 1e-6);
  EXPECT_NEAR(colours.shading->values[1], std::log10(2.0 / 1.5), 1e-6);
  EXPECT_EQ(colours.title, "volume / mean volume");
}

TEST(VolumeColours, EdgeLengthIsTheMeanOfAnElementsTwelveEdges) {
  const ElementColours colours = volume_colours_of(ColourBy::EdgeLength, frame_of(a_cube_and_a_bar()));
  ASSERT_EQ(colours.shading->values.size(), 2U);
  EXPECT_NEAR(colours.shading->values[0], 0.0, 1e-6);
  EXPECT_NEAR(colours.shading->values[1], std::log10((8.0 + 4.0 * 2.0) / 12.0), 1e-6);
  EXPECT_EQ(colours.shading->by, render::Shading::By::Elements);
}

TEST(VolumeColours, WhatIsOfVerticesOrOfThePlaneIsNotDrawn) {
  const auto frame = frame_of(test::volume_grid(2, test::Fill::Tetrahedra));
  for (const ColourBy by : {ColourBy::Valence, ColourBy::Class, ColourBy::Group, ColourBy::SizeOverTarget})
    EXPECT_TRUE(why_not_drawn(by, *frame->input).has_value()) << info(by).name;
  for (const ColourBy by : {ColourBy::Quality, ColourBy::Kind, ColourBy::Size, ColourBy::EdgeLength, ColourBy::Difference,
                            ColourBy::Deviation, ColourBy::Tilt, ColourBy::Freedom})
    EXPECT_FALSE(why_not_drawn(by, *frame->input).has_value()) << info(by).name;
}

TEST(Thumbnails, EverySampleHasAPictureWithinItsFrame) {
  for (const Thumbnail& sample : make_thumbnails(render::ColourMap::Viridis)) {
    EXPECT_GT(sample.polygons.size(), 20U) << sample.name;
    for (const Thumbnail::Polygon& polygon : sample.polygons) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(polygon.count); ++k) {
        for (const float x : polygon.corners[k]) {
          EXPECT_GE(x, -1e-3F) << sample.name;
          EXPECT_LE(x, 1.001F) << sample.name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace dmoscope::ui
