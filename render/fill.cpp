#include "render/fill.h"

#include <algorithm>
#include <cmath>

#include "core/run/summary.h"

namespace dmoscope::render {
namespace {

constexpr int kColours = 4096, kMostCategories = 256;

Handle<DeleteTexture> make_table(int colours) {
  GLuint id = 0;
  DMOSCOPE_GL(glCreateTextures(GL_TEXTURE_2D, 1, &id));
  Handle<DeleteTexture> table(id);
  DMOSCOPE_GL(glTextureStorage2D(id, 1, GL_RGBA8, colours, 1));
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return table;
}

void fill_table(const Handle<DeleteTexture>& table, std::span<const Rgb> colours) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(4 * colours.size());
  for (const Rgb colour : colours) bytes.insert(bytes.end(), {colour.r, colour.g, colour.b, std::uint8_t{255}});
  GLint alignment = 4;
  glGetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  const auto width = static_cast<GLsizei>(colours.size());
  DMOSCOPE_GL(glTextureSubImage2D(table.id(), 0, 0, 0, width, 1, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data()));
  glPixelStorei(GL_UNPACK_ALIGNMENT, alignment);
}

}  // namespace

void set_colour(const Program& program, const char* name, Rgb colour, float alpha) {
  program.set(name, static_cast<float>(colour.r) / 255.0F, static_cast<float>(colour.g) / 255.0F, static_cast<float>(colour.b) / 255.0F,
              alpha);
}

Handle<DeleteVertexArray> make_array() {
  GLuint id = 0;
  DMOSCOPE_GL(glCreateVertexArrays(1, &id));
  return Handle<DeleteVertexArray>(id);
}

Fill::Fill() : colours_(make_table(kColours)), palette_(make_table(kMostCategories)) {}

void Fill::reset() {
  values_ = Buffer();
  members_ = Buffer();
  by_.reset();
  categories_ = 0;
  edges_by_category_ = false;
  selection_ = {};
}

void Fill::set_colours(const ColourScale& colours) {
  ColourScale unit = colours;
  unit.low = 0.0;
  unit.high = 1.0;
  if (uploaded_ == unit) return;
  std::vector<Rgb> table(kColours);
  for (std::size_t i = 0; i < kColours; ++i) table[i] = unit.colour(static_cast<double>(i) / (kColours - 1));
  fill_table(colours_, table);
  uploaded_ = unit;
}

void Fill::set_shading(const Shading* shading) {
  by_.reset();
  categories_ = 0;
  edges_by_category_ = false;
  if (shading == nullptr) return;
  by_ = shading->by;
  categories_ = static_cast<int>(std::min<std::size_t>(shading->palette.size(), kMostCategories));
  edges_by_category_ = shading->edges && categories_ > 0 && by_ == Shading::By::Vertices;
  if (categories_ > 0) fill_table(palette_, std::span(shading->palette).first(static_cast<std::size_t>(categories_)));
  std::vector<float> values = shading->values;
  for (float& value : values) value = shade_of(value, false);
  values_.write(std::span<const float>(values));
}

void Fill::set_selection(const Selection& selection) {
  if (selection.members != selection_.members || selection.tinted != selection_.tinted) {
    std::vector<std::uint32_t> bits;
    const auto add = [&bits](const auto& flags, std::size_t bit) {
      if (!flags) return;
      bits.resize(std::max(bits.size(), flags->size() / 16 + 1), 0);
      for (std::size_t e = 0; e < flags->size(); ++e)
        bits[e / 16] |= static_cast<std::uint32_t>((*flags)[e] != 0 ? 1 : 0) << (2 * (e % 16) + bit);
    };
    add(selection.members, 0);
    add(selection.tinted, 1);
    if (!bits.empty()) members_.write(std::span<const std::uint32_t>(bits));
  }
  selection_ = selection;
}

void Fill::bind(const Program& program, const Style& style, const Buffer& shades, const Buffer& order) const {
  DMOSCOPE_GL(glBindTextureUnit(0, colours_.id()));
  DMOSCOPE_GL(glBindTextureUnit(1, palette_.id()));
  shades.bind_storage(1);
  order.bind_storage(2);
  (by_ ? values_ : shades).bind_storage(5);
  (selection_.members || selection_.tinted ? members_ : shades).bind_storage(6);
  program.set("u_colours", 0);
  program.set("u_palette", 1);
  program.set("u_by", !by_ ? 0 : *by_ == Shading::By::Elements ? 1 : 2);
  program.set("u_categories", categories_);
  // The end of the range must differ from its begin for the shaders' division.
  const auto low = static_cast<float>(style.colours.low);
  auto high = static_cast<float>(style.colours.high);
  if (!(high > low)) high = std::nextafter(low, 3e38F);
  program.set("u_range", Vec2<float>{low, high});
  set_colour(program, "u_inverted_colour", kInvertedColour);
  set_colour(program, "u_undefined_colour", kUndefinedColour);
  set_colour(program, "u_neutral_colour", style.neutral_colour);
  constexpr float kFadedWire = 0.3F;
  set_colour(program, "u_faded_colour", style.faded_colour, kFadedWire);
  const auto range = selection_.quality.value_or(std::pair{0.0F, 0.0F});
  program.set("u_filter", range.first, range.second, selection_.quality ? 1.0F : 0.0F,
              in_quality_range(range, kInvertedShade) ? 1.0F : 0.0F);
  program.set("u_has_members", selection_.members ? 1 : 0);
  set_colour(program, "u_tint", {style.tint.r, style.tint.g, style.tint.b},
             selection_.tinted ? static_cast<float>(style.tint.a) / 255.0F : 0.0F);
  program.set("u_others", static_cast<int>(selection_.others));
}

int Fill::bind_edges(const Buffer& instead) const {
  (edges_by_category_ ? values_ : instead).bind_storage(5);
  DMOSCOPE_GL(glBindTextureUnit(1, palette_.id()));
  return edges_by_category_ ? categories_ : 0;
}

}  // namespace dmoscope::render
