#include "ui/toolkit/fonts.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include <imgui_freetype.h>

namespace dmoscope::ui {
namespace {

constexpr float kFontSize = 15.0F;

/// Ranges of the letters that the program itself writes: Latin, Greek, punctuation, super- and subscripts, fractions, arrows, mathematical
/// operators, shapes and a few symbols.
constexpr ImWchar kGlyphs[] = {0x20,   0xff,   0x370,  0x3ff,  0x1d62, 0x1d6a, 0x2000, 0x206f, 0x2070, 0x209f, 0x2100,
                               0x218f, 0x2190, 0x21ff, 0x2200, 0x22ff, 0x2300, 0x23ff, 0x25a0, 0x25ff, 0x2600, 0x26ff,
                               0x2713, 0x2718, 0x2758, 0x275a, 0x2c7c, 0x2c7c, 0xfffd, 0xfffd, 0};

std::filesystem::path font_file(const char* name) {
  std::error_code none;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
  const std::string carried = (program.parent_path().parent_path() / "share/fonts").string();  // fonts of a bundle
  for (const char* folder : {carried.c_str(), "/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu-sans-fonts",
                             "/usr/share/fonts/dejavu", "/usr/share/fonts/TTF", "/usr/local/share/fonts/dejavu"}) {
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored)) return file;
  }
  return {};
}

/// A font for Chinese, Japanese and Korean, if one is installed; only these are too large to be part of every desktop.
std::filesystem::path east_asian_font() {
  for (const char* file : {"/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc", "/usr/share/fonts/noto-cjk/NotoSansCJK-Regular.ttc",
                           "/usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf", "/usr/share/fonts/truetype/wqy/wqy-zenhei.ttc",
                           "/usr/share/fonts/truetype/wqy/wqy-microhei.ttc", "/usr/share/fonts/truetype/arphic/uming.ttc"}) {
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored)) return file;
  }
  return {};
}

bool is_own(char16_t letter) {
  for (const ImWchar* range = kGlyphs; range[0] != 0; range += 2) {
    if (letter >= range[0] && letter <= range[1]) return true;
  }
  return false;
}

/// Ranges of a font, ended by 0.
std::vector<ImWchar> ranges_of(std::span<const char16_t> letters) {
  std::vector<ImWchar> ranges;
  for (const char16_t letter : letters) {
    if (!ranges.empty() && ranges.back() + 1 == letter) {
      ranges.back() = letter;
    } else {
      ranges.insert(ranges.end(), 2, letter);
    }
  }
  ranges.push_back(0);
  return ranges;
}

struct Face {
  const char* file;
  float size;
};

/// One build of the atlas. The ranges must outlive it.
class AtlasBuilder {
 public:
  AtlasBuilder(float size, std::span<const char16_t> letters)
      : faces_{{"DejaVuSans.ttf", size}, {"DejaVuSans-Bold.ttf", size}, {"DejaVuSans-Bold.ttf", std::round(1.6F * size)}},
        letters_(ranges_of(letters)) {
    atlas_.Clear();
    atlas_.FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
    const std::filesystem::path other = letters.empty() ? std::filesystem::path() : east_asian_font();
    for (const Face& face : faces_) {
      fonts_.push_back(add_font(face));
      merge(font_file(face.file), face.size);
      merge(other, face.size);
    }
  }
  [[nodiscard]] ImFont* font(std::size_t k) const { return fonts_[k]; }
  [[nodiscard]] float height(std::size_t k) const { return faces_[k].size; }
  [[nodiscard]] std::size_t size() const { return fonts_.size(); }

 private:
  ImFont* add_font(const Face& face) {
    const std::filesystem::path file = font_file(face.file);
    if (!file.empty()) {
      if (ImFont* font = atlas_.AddFontFromFileTTF(file.c_str(), face.size, nullptr, kGlyphs)) return font;
    }
    ImFontConfig config;
    config.SizePixels = face.size;
    return atlas_.AddFontDefault(&config);
  }
  void merge(const std::filesystem::path& file, float size) {
    if (file.empty() || letters_.size() < 2) return;
    ImFontConfig config;
    config.MergeMode = true;
    (void)atlas_.AddFontFromFileTTF(file.c_str(), size, &config, letters_.data());
  }

  ImFontAtlas& atlas_ = *ImGui::GetIO().Fonts;
  Face faces_[3];
  std::vector<ImWchar> letters_;
  std::vector<ImFont*> fonts_;
};

/// A letter that is drawn as its name, in the same font.
struct Named {
  char16_t letter;
  std::string name;
  std::size_t font;
  int rect = 0;
};

void reserve(ImFontAtlas& atlas, ImFont* font, float advance, float height, Named& named) {
  named.rect = atlas.AddCustomRectFontGlyph(font, named.letter, static_cast<int>(std::ceil(advance)), static_cast<int>(std::ceil(height)),
                                            std::ceil(advance));
}

float width_of(const ImFont& font, const std::string& name) {
  float width = 0;
  for (const char c : name) width += font.GetCharAdvance(static_cast<ImWchar>(c));
  return width + 2;
}

/// Copies the letters of a name within the atlas to the place of the name.
void write_name(ImFontAtlas& atlas, const ImFont& font, const Named& named) {
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  atlas.GetTexDataAsAlpha8(&pixels, &width, &height);
  const ImFontAtlasCustomRect& to = *atlas.GetCustomRectByIndex(named.rect);
  float pen = 1;
  for (const char c : named.name) {
    const ImFontGlyph* glyph = font.FindGlyph(static_cast<ImWchar>(c));
    const int u = static_cast<int>(std::lround(glyph->U0 * static_cast<float>(width)));
    const int v = static_cast<int>(std::lround(glyph->V0 * static_cast<float>(height)));
    const int w = static_cast<int>(std::lround(glyph->X1 - glyph->X0)), h = static_cast<int>(std::lround(glyph->Y1 - glyph->Y0));
    const int x0 = static_cast<int>(std::lround(pen + glyph->X0)), y0 = static_cast<int>(std::lround(glyph->Y0));
    for (int y = std::max(0, -y0); y < h && y0 + y < to.Height; ++y) {
      for (int x = std::max(0, -x0); x < w && x0 + x < to.Width; ++x) {
        unsigned char& pixel = pixels[(to.Y + y0 + y) * width + to.X + x0 + x];
        pixel = std::max(pixel, pixels[(v + y) * width + u + x]);
      }
    }
    pen += glyph->AdvanceX;
  }
}

}  // namespace

Fonts build_fonts(double scale, const GlyphBook& book) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  const float size = std::round(kFontSize * static_cast<float>(scale));
  std::vector<char16_t> letters;
  std::ranges::copy_if(book.letters(), std::back_inserter(letters), [](char16_t letter) { return !is_own(letter); });
  std::vector<Named> named;
  std::vector<float> widths;
  if (book.size() > 0) {  // a first build finds missing letters, and the widths of their names
    const AtlasBuilder trial(size, letters);
    atlas.Build();
    for (std::size_t k = 0; k < trial.size(); ++k) {
      const ImFont& font = *trial.font(k);
      for (const char16_t letter : letters)
        if (font.FindGlyphNoFallback(letter) == nullptr) named.push_back({letter, letter_name(letter), k});
      for (const auto& [letter, stand_in] : book.stand_ins()) named.push_back({letter, stand_in.name, k});
    }
    for (const Named& one : named) widths.push_back(width_of(*trial.font(one.font), one.name));
  }
  const AtlasBuilder builder(size, letters);
  for (std::size_t k = 0; k < named.size(); ++k)
    reserve(atlas, builder.font(named[k].font), widths[k], builder.height(named[k].font), named[k]);
  atlas.Build();
  for (const Named& one : named) write_name(atlas, *builder.font(one.font), one);
  atlas.ClearInputData();  // frees the fonts' files, some of which are large
  const Fonts fonts{builder.font(0), builder.font(1), builder.font(2)};
  ImGui::GetIO().FontDefault = fonts.body;
  return fonts;
}

}  // namespace dmoscope::ui
