#pragma once
// The interface's fonts, with every letter to be shown.

#include <imgui.h>

#include "ui/state/glyph_book.h"

namespace dmoscope::ui {

/// Fonts of one scale: body, headings and large titles. Owned by ImGui's atlas.
struct Fonts {
  ImFont* body = nullptr;
  ImFont* bold = nullptr;
  ImFont* large = nullptr;
};

/// Builds the atlas anew: DejaVu Sans 15 px times `scale` through FreeType, or ImGui's own font where DejaVu is not installed. In addition
/// to the program's own letters it has those of `book`: from DejaVu, else from a font for Chinese, Japanese and Korean if one is installed,
/// else as their names ("<U+4E2D>"). The event loop uploads the texture afterwards.
[[nodiscard]] Fonts build_fonts(double scale, const GlyphBook& book);

}  // namespace dmoscope::ui
