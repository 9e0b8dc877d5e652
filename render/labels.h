#pragma once
// Ids written into a picture. No OpenGL.

#include <span>

#include "render/image.h"
#include "render/scene.h"
#include "render/style.h"

namespace dmoscope::render {

/// Width of a digit of a label in a picture and height of its line, in pixels, at a scale; for LabelWish.
[[nodiscard]] Vec2<double> label_digit(float scale);

/// Width of an id in pixels.
[[nodiscard]] double label_width(Index id, const LabelWish& wish);

/// Writes the labels of a view of size `viewport` into the left upper part of `image`. Does nothing without a font.
void draw_labels(Image& image, std::span<const Label> labels, Vec2<double> viewport, const Style& style, float scale);

}  // namespace dmoscope::render
