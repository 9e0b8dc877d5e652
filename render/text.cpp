#include "render/text.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include <ft2build.h>
#include FT_FREETYPE_H

#include <fmt/format.h>

#include "core/base/utf8.h"

namespace dmoscope::render {
namespace {

constexpr const char* kFontFile = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

/// Takes the next letter of UTF-8 text.
std::uint32_t next_letter(std::string_view& text) {
  std::uint32_t letter = 0;
  const std::size_t size = utf8_letter(text, letter);
  if (size == 0) letter = 0xFFFD;
  text.remove_prefix(size == 0 ? 1 : size);
  return letter;
}

/// The text, with "<U+4E2D>" for letters that the font lacks.
std::string in_letters_of(FT_Face face, std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::string_view before = text;
    const std::uint32_t letter = next_letter(text);
    if (FT_Get_Char_Index(face, letter) == 0) {
      out += fmt::format("<U+{:04X}>", letter);
    } else {
      out += before.substr(0, before.size() - text.size());
    }
  }
  return out;
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

int Font::width(std::string_view words, float pixels) const {
  impl_->set_size(pixels);
  const std::string letters = in_letters_of(impl_->face, words);
  std::string_view text = letters;
  FT_Pos pen = 0;
  while (!text.empty()) {
    if (FT_Load_Char(impl_->face, next_letter(text), FT_LOAD_TARGET_LIGHT) == 0) pen += impl_->face->glyph->advance.x;
  }
  return static_cast<int>((pen + 63) / 64);
}

void Font::draw(Image& image, int x, int baseline, std::string_view words, float pixels, Rgba colour) const {
  impl_->set_size(pixels);
  const std::string letters = in_letters_of(impl_->face, words);
  std::string_view text = letters;
  FT_Pos pen = FT_Pos{x} * 64;
  while (!text.empty()) {
    if (FT_Load_Char(impl_->face, next_letter(text), FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT) != 0) continue;
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
