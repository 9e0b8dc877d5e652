#include "render/text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <utility>

#include <ft2build.h>
#include FT_FREETYPE_H

namespace dmoscope::render {
namespace {

constexpr const char* kFontFile = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

/// Next code point of UTF-8 text; bytes that are no UTF-8 stand for themselves.
char32_t next_code_point(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80 ? 1 : first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : first >= 0xc0 ? 2 : 1;
  char32_t code = first;
  if (length > 1 && text.size() >= length) {
    code = first & (0xffU >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) code = (code << 6U) | (byte(i) & 0x3fU);
    text.remove_prefix(length);
  } else {
    text.remove_prefix(1);
  }
  return code;
}

}  // namespace

struct Font::Impl {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (face != nullptr) FT_Done_Face(face);
    if (library != nullptr) FT_Done_FreeType(library);
  }
  void set_size(float pixels) const { FT_Set_Char_Size(face, 0, static_cast<FT_F26Dot6>(std::lround(pixels * 64.0F)), 72, 72); }
};

Font::Font(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Font::~Font() = default;

std::unique_ptr<Font> Font::load() {
  auto impl = std::make_unique<Impl>();
  if (FT_Init_FreeType(&impl->library) != 0) return nullptr;
  if (FT_New_Face(impl->library, kFontFile, 0, &impl->face) != 0) return nullptr;
  return std::unique_ptr<Font>(new Font(std::move(impl)));
}

int Font::width(std::string_view text, float pixels) const {
  impl_->set_size(pixels);
  FT_Pos pen = 0;
  while (!text.empty()) {
    if (FT_Load_Char(impl_->face, next_code_point(text), FT_LOAD_TARGET_LIGHT) == 0) pen += impl_->face->glyph->advance.x;
  }
  return static_cast<int>((pen + 63) / 64);
}

void Font::draw(Image& image, int x, int baseline, std::string_view text, float pixels, Rgba colour) const {
  impl_->set_size(pixels);
  FT_Pos pen = FT_Pos{x} * 64;
  while (!text.empty()) {
    if (FT_Load_Char(impl_->face, next_code_point(text), FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT) != 0) continue;
    const FT_GlyphSlot glyph = impl_->face->glyph;
    const FT_Bitmap& bitmap = glyph->bitmap;
    Image cover(static_cast<int>(bitmap.width), static_cast<int>(bitmap.rows));
    for (int j = 0; j < cover.height; ++j) {
      for (int i = 0; i < cover.width; ++i) {
        const unsigned value = bitmap.buffer[j * bitmap.pitch + i];
        cover.set(i, j, {colour.r, colour.g, colour.b, static_cast<std::uint8_t>(value * colour.a / 255U)});
      }
    }
    blend_over(image, cover, static_cast<int>((pen + 32) / 64) + glyph->bitmap_left, baseline - glyph->bitmap_top);
    pen += glyph->advance.x;
  }
}

}  // namespace dmoscope::render
