#include "core/io/writing/patch_writer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/same_bits.h"
#include "core/io/reading/binary.h"
#include "core/io/reading/source_file.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/writing/field_number.h"

namespace dmoscope {
namespace {

using Coordinates = std::array<double, 3>;

Coordinates coordinates(Vec3 p) { return {p.x, p.y, p.z}; }

/// Copies a part of the source and replaces in it, place after place.
class Patcher {
 public:
  /// `begin`: where the part begins in the source. `file` is what errors call the target.
  Patcher(const std::string& file, const SourceFile& source, std::size_t begin, TextBuffer& out)
      : file_(file),
        source_(source),
        layout_(source.layout()),
        out_(out),
        tokens_(source.bytes(), source.path().string(), source.layout().syntax, unwatched_),
        copied_(begin) {
    std::sort(order_.begin(), order_.begin() + layout_.components,
              [this](std::size_t a, std::size_t b) { return layout_.at[a] < layout_.at[b]; });
  }

  void place(std::size_t i, const Coordinates& before, const Coordinates& after) {
    const std::size_t vertex = source_.vertex_at(i);
    if (layout_.components == 2 && after[2] != 0.0) {
      throw OutputError(file_, fmt::format("vertex {} has z = {}, but the file holds only x and y", vertex, after[2]));
    }
    bool any = false;
    for (int k = 0; k < layout_.components; ++k) {
      const auto c = static_cast<std::size_t>(k);
      any = any || !same_bits(before[c], after[c]);
    }
    if (!any) return;
    if (layout_.binary) {
      binary_place(i, before, after);
    } else {
      text_place(i, before, after);
    }
  }

  void copy_until(std::size_t offset) {
    if (copied_ >= offset) return;
    out_ << source_.bytes().substr(copied_, offset - copied_);
    copied_ = offset;
  }
  /// Bytes of the source that were copied or replaced.
  [[nodiscard]] std::size_t copied() const noexcept { return copied_; }
  [[nodiscard]] std::size_t rounded() const noexcept { return rounded_; }

 private:
  void text_place(std::size_t i, const Coordinates& before, const Coordinates& after) {
    tokens_.seek(source_.place(i));
    std::uint32_t next = 0;  // number of the token that comes next
    for (int k = 0; k < layout_.components; ++k) {
      const std::size_t c = order_[static_cast<std::size_t>(k)];
      std::string_view token;
      for (; next <= layout_.at[c]; ++next) token = tokens_.token();
      if (same_bits(before[c], after[c])) continue;
      copy_until(tokens_.offset_of(token));
      put_text(after[c]);
      copied_ += token.size();
    }
  }

  void binary_place(std::size_t i, const Coordinates& before, const Coordinates& after) {
    for (int k = 0; k < layout_.components; ++k) {
      const std::size_t c = order_[static_cast<std::size_t>(k)];
      if (same_bits(before[c], after[c])) continue;
      copy_until(source_.place(i) + layout_.at[c]);
      if (layout_.scalar[c] == CoordinateScalar::Float64) {
        put(after[c]);
      } else {
        put(to_float(after[c], source_.vertex_at(i)));
      }
    }
  }

  void put_text(double value) {
    if (layout_.width == 0) {
      out_ << value;
      return;
    }
    const FieldNumber number = number_in_field(value, layout_.width, ExponentStyle::Letter);
    if (number.value != value) ++rounded_;
    out_ << number.text;
  }

  float to_float(double value, std::size_t vertex) {
    const auto rounded = static_cast<float>(value);
    if (!std::isfinite(rounded)) {
      throw OutputError(file_, fmt::format("coordinate {} of vertex {} is too large for a 32-bit float", value, vertex));
    }
    if (static_cast<double>(rounded) != value) ++rounded_;
    return rounded;
  }

  template <class Number>
  void put(Number value) {
    const auto bytes = store_number(value, layout_.big_endian);
    out_ << std::string_view(bytes.data(), bytes.size());
    copied_ += bytes.size();
  }

  const std::string& file_;
  const SourceFile& source_;
  const CoordinateLayout& layout_;
  TextBuffer& out_;
  Progress unwatched_;  // the writer watches
  Tokenizer tokens_;
  std::array<std::size_t, 3> order_{0, 1, 2};  // components as they come in the file
  std::size_t copied_;
  std::size_t rounded_ = 0;
};

}  // namespace

std::size_t patch_part(TextBuffer& out, const std::string& file, const SourceFile& source, std::span<const Vec3> before,
                       std::span<const Vec3> after) {
  Patcher patcher(file, source, 0, out);
  for (std::size_t i = 0; i < source.place_count(); ++i) patcher.place(i, coordinates(before[i]), coordinates(after[i]));
  patcher.copy_until(source.bytes().size());
  return patcher.rounded();
}

std::vector<std::string> write_patched(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  constexpr std::size_t kGrain = 16384;
  const SourceFile& source = *mesh.source;
  const std::size_t count = source.place_count();
  const std::string name = file.path().string();
  std::atomic<std::size_t> rounded = 0;
  std::size_t copied = count == 0 ? 0 : source.place(0);
  TextWriter out(file, context);
  out.bytes(source.bytes().substr(0, copied));
  out.in_parts(count, kGrain, [&](TextBuffer& part, std::size_t first, std::size_t last) {
    Patcher patcher(name, source, source.place(first), part);
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t vertex = source.vertex_at(i);
      patcher.place(i, coordinates(mesh.positions[vertex]), coordinates(positions[vertex]));
    }
    patcher.copy_until(source.place(last < count ? last : last - 1));
    rounded += patcher.rounded();
    context.progress.set(static_cast<double>(last) / static_cast<double>(count));
    if (last == count) copied = patcher.copied();
  });
  out.bytes(source.bytes().substr(copied));
  if (rounded == 0) return {};
  if (!source.layout().binary) {
    return {fmt::format("{} moved coordinates were rounded to the {} characters that the format has for a number.", rounded.load(),
                        source.layout().width)};
  }
  return {fmt::format("{} moved coordinates were rounded to 32-bit floats, which is what the file holds.", rounded.load())};
}

}  // namespace dmoscope
