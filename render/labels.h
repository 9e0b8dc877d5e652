#pragma once
// Ids written into a picture. No OpenGL.

#include <span>

#include "render/image.h"
#include "render/scene.h"
#include "render/style.h"

namespace dmoscope::render {

/// How wide a digit of a label in a picture is, and how high its line, at a scale; for LabelWish.
[[nodiscard]] Vec2<double> label_digit(float scale);

/// How wide an id is in pixels.
[[nodiscard]] double label_width(Index id, const LabelWish& wish);

/// Writes the labels of a view of the size `viewport` into the left upper part of `image`. Without a font it does nothing.
void draw_labels(Image& image, std::span<const Label> labels, Vec2<double> viewport, const Style& style, float scale);

}  // namespace dmoscope::render
