#pragma once
// Text drawn into pictures without OpenGL (FreeType, DejaVu Sans).

#include <memory>
#include <string_view>

#include "render/image.h"

namespace dmoscope::render {

/// The system's DejaVu Sans at any size.
class Font {
 public:
  /// The font; null when the font file is not there (package fonts-dejavu-core) or FreeType refuses it.
  [[nodiscard]] static std::unique_ptr<Font> load();
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;
  /// Width in pixels of one line of UTF-8 text.
  [[nodiscard]] int width(std::string_view text, float pixels) const;
  /// Draws one line; (x, baseline) is where it starts.
  void draw(Image& image, int x, int baseline, std::string_view text, float pixels, Rgba colour) const;

 private:
  struct Impl;
  explicit Font(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dmoscope::render
