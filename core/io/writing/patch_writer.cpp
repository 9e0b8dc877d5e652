#include "core/io/writing/patch_writer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/same_bits.h"
#include "core/io/reading/binary.h"
#include "core/io/reading/source_file.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {
namespace {

using Coordinates = std::array<double, 3>;

Coordinates coordinates(Vec3 p) { return {p.x, p.y, p.z}; }

/// A field that changed, and the storage of its numbers.
struct ChangedField {
  const Field* field;
  const std::vector<double>* after;
  ScalarType type = ScalarType::Float64;

  [[nodiscard]] std::size_t components() const { return static_cast<std::size_t>(field->components); }
  [[nodiscard]] bool differs(std::size_t number) const { return !same_bits(field->values[number], (*after)[number]); }
  [[nodiscard]] std::size_t row_of(std::size_t i) const { return field->place.rows.empty() ? i : field->place.rows[i]; }
  [[nodiscard]] std::size_t row_count() const {
    return field->place.rows.empty() ? field->values.size() / components() : field->place.rows.size();
  }
};

/// Copies a part of the source and replaces numbers in it, place by place.
class Patcher {
 public:
  /// Begins a part. `begin`: its offset in the source. `file`: name of the target in errors. `fields`: those at the places of vertices.
  Patcher(const std::string& file, const SourceFile& source, std::size_t begin, TextBuffer& out, std::span<const ChangedField> fields = {})
      : file_(file),
        source_(source),
        layout_(source.layout()),
        out_(out),
        fields_(fields),
        tokens_(source.bytes(), source.path().string(), source.layout().syntax, unwatched_),
        copied_(begin) {
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(layout_.components); ++axis)
      numbers_.push_back({layout_.at[axis], kNone, axis});
    for (std::size_t f = 0; f < fields.size(); ++f) {
      const std::size_t each = layout_.binary ? size_of(fields[f].type) : 1;
      for (std::size_t k = 0; k < fields[f].components(); ++k) numbers_.push_back({fields[f].field->place.at + k * each, f, k});
    }
    std::ranges::sort(numbers_, {}, &Number::at);
  }

  void place(std::size_t i, const Coordinates& before, const Coordinates& after) {
    const std::size_t vertex = source_.vertex_at(i);
    if (layout_.components == 2 && after[2] != 0.0) {
      throw OutputError(file_, fmt::format("vertex {} has z = {}, but the file holds only x and y", vertex, after[2]));
    }
    const auto changed = [&](const Number& number) {
      if (number.field == kNone) return !same_bits(before[number.component], after[number.component]);
      return fields_[number.field].differs(vertex * fields_[number.field].components() + number.component);
    };
    if (std::ranges::none_of(numbers_, changed)) return;
    std::size_t next = 0;  // text: number of the next token
    if (!layout_.binary) tokens_.seek(source_.place(i));
    for (const Number& number : numbers_) {
      std::string_view token;
      if (!layout_.binary)
        for (; next <= number.at; ++next) token = tokens_.token();
      if (!changed(number)) continue;
      copy_until(layout_.binary ? source_.place(i) + number.at : tokens_.offset_of(token));
      if (number.field != kNone) {
        const ChangedField& field = fields_[number.field];
        put_field(field, (*field.after)[vertex * field.components() + number.component], token.size());
      } else if (layout_.binary) {
        put_binary(after[number.component], number.component, vertex);
      } else {
        put_text(after[number.component]);
        copied_ += token.size();
      }
    }
  }

  /// Replaces a field that is stored separately, from its first row to its last.
  void run(const ChangedField& field) {
    const Field::Place& place = field.field->place;
    const std::size_t n = field.components();
    if (place.bytes == 0) tokens_.seek(place.begin);
    for (std::size_t i = 0; i < field.row_count(); ++i) {
      const std::size_t first = field.row_of(i) * n;
      if (place.bytes == 0)
        for (std::uint32_t k = 0; k < place.at; ++k) (void)tokens_.token();
      for (std::size_t k = 0; k < n; ++k) {
        const std::string_view token = place.bytes == 0 ? tokens_.token() : std::string_view();
        if (!field.differs(first + k)) continue;
        copy_until(place.bytes == 0 ? tokens_.offset_of(token) : place.begin + i * place.bytes + place.at + k * size_of(field.type));
        put_field(field, (*field.after)[first + k], token.size());
      }
      if (place.bytes == 0)
        for (std::size_t k = place.at + n; k < place.words; ++k) (void)tokens_.token();
    }
  }

  void copy_until(std::size_t offset) {
    if (copied_ >= offset) return;
    out_ << source_.bytes().substr(copied_, offset - copied_);
    copied_ = offset;
  }
  /// Number of the source's bytes that were copied or replaced.
  [[nodiscard]] std::size_t copied() const noexcept { return copied_; }
  [[nodiscard]] std::size_t rounded() const noexcept { return rounded_; }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  /// A number at the place of a vertex; `at`: words or bytes from there.
  struct Number {
    std::size_t at, field, component;  // kNone: a coordinate
  };

  void put_field(const ChangedField& field, double value, std::size_t token) {
    if (layout_.binary) {
      std::array<char, 8> bytes{};
      store_scalar(bytes.data(), field.type, layout_.big_endian, value);
      out_ << std::string_view(bytes.data(), size_of(field.type));
      copied_ += size_of(field.type);
    } else {
      put_number(out_, value, field.type);
      copied_ += token;
    }
  }

  void put_binary(double value, std::size_t axis, std::size_t vertex) {
    if (layout_.scalar[axis] == CoordinateScalar::Float64) {
      put(value);
    } else {
      put(to_float(value, vertex));
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

  template <class Scalar>
  void put(Scalar value) {
    const auto bytes = store_number(value, layout_.big_endian);
    out_ << std::string_view(bytes.data(), bytes.size());
    copied_ += bytes.size();
  }

  const std::string& file_;
  const SourceFile& source_;
  const CoordinateLayout& layout_;
  TextBuffer& out_;
  std::span<const ChangedField> fields_;
  std::vector<Number> numbers_;  // numbers in the order of the file
  Progress unwatched_;           // unused: the writer reports progress
  Tokenizer tokens_;
  std::size_t copied_;
  std::size_t rounded_ = 0;
};

/// The fields that changed: those at the places of vertices, and those stored separately, in the order of the file.
struct ChangedFields {
  std::vector<ChangedField> with_positions, runs;
};

ChangedFields changed_fields(const Mesh& mesh, std::span<const FieldValues> changed, std::vector<std::string>& notes) {
  ChangedFields fields;
  for (const FieldValues& one : changed) {
    const Field& field = mesh.fields[one.field];
    ChangedField found{&field, &one.values};
    const bool typed = scalar_of_word(field.type, found.type);
    const bool binary = mesh.source->layout().binary;
    const bool known = field.place.with_positions || (binary ? field.place.bytes : field.place.words) > 0;
    if (!known || (binary && !typed)) {
      notes.push_back(fmt::format("Field \"{}\" was carried: where it stands in the file is not known.", field.name));
    } else {
      (field.place.with_positions ? fields.with_positions : fields.runs).push_back(found);
    }
  }
  std::ranges::sort(fields.runs, {}, [](const ChangedField& one) { return one.field->place.begin; });
  return fields;
}

}  // namespace

void put_number(TextBuffer& out, double value, ScalarType type) {
  if (type != ScalarType::Float32 || !std::isfinite(static_cast<float>(value))) {
    out << value;
    return;
  }
  constexpr std::size_t kLongestNumber = 64;
  std::array<char, kLongestNumber> text;
  const char* const end = std::to_chars(text.data(), text.data() + text.size(), static_cast<float>(value)).ptr;
  out << std::string_view(text.data(), static_cast<std::size_t>(end - text.data()));
}

std::size_t patch_part(TextBuffer& out, const std::string& file, const SourceFile& source, std::span<const Vec3> before,
                       std::span<const Vec3> after) {
  Patcher patcher(file, source, 0, out);
  for (std::size_t i = 0; i < source.place_count(); ++i) patcher.place(i, coordinates(before[i]), coordinates(after[i]));
  patcher.copy_until(source.bytes().size());
  return patcher.rounded();
}

namespace {

/// Writes the source byte by byte, with the places of vertices and the separate fields replaced.
class PatchedFile {
 public:
  PatchedFile(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context)
      : name_(file.path().string()),
        source_(*mesh.source),
        mesh_(mesh),
        positions_(moved.positions),
        context_(context),
        out_(file, context) {
    fields_ = changed_fields(mesh, moved.fields, notes_);
  }

  std::vector<std::string> write() {
    auto run = fields_.runs.begin();
    const std::size_t first = source_.place_count() == 0 ? source_.bytes().size() : source_.place(0);
    for (; run != fields_.runs.end() && run->field->place.begin < first; ++run) write_run(*run);
    if (source_.place_count() > 0) write_places();
    for (; run != fields_.runs.end(); ++run) write_run(*run);
    out_.bytes(source_.bytes().substr(copied_));
    tell_rounded();
    return std::move(notes_);
  }

 private:
  void write_places() {
    constexpr std::size_t kGrain = 16384;
    const std::size_t count = source_.place_count();
    out_.bytes(source_.bytes().substr(copied_, source_.place(0) - copied_));
    out_.in_parts(count, kGrain, [&](TextBuffer& part, std::size_t first, std::size_t last) {
      Patcher patcher(name_, source_, source_.place(first), part, fields_.with_positions);
      for (std::size_t i = first; i < last; ++i) {
        const std::size_t vertex = source_.vertex_at(i);
        patcher.place(i, coordinates(mesh_.positions[vertex]), coordinates(positions_[vertex]));
      }
      patcher.copy_until(source_.place(last < count ? last : last - 1));
      rounded_ += patcher.rounded();
      context_.progress.set(static_cast<double>(last) / static_cast<double>(count));
      if (last == count) copied_ = patcher.copied();
    });
  }

  void write_run(const ChangedField& field) {
    TextBuffer part;
    Patcher patcher(name_, source_, copied_, part);
    patcher.run(field);
    out_.bytes(part.text());
    copied_ = patcher.copied();
    context_.progress.check();
  }

  void tell_rounded() {
    if (rounded_ == 0) return;
    notes_.push_back(source_.layout().binary
                         ? fmt::format("{} moved coordinates were rounded to 32-bit floats, which is what the file holds.", rounded_.load())
                         : fmt::format("{} moved coordinates were rounded to the {} characters that the format has for a number.",
                                       rounded_.load(), source_.layout().width));
  }

  const std::string name_;
  const SourceFile& source_;
  const Mesh& mesh_;
  std::span<const Vec3> positions_;
  const IoContext& context_;
  TextWriter out_;
  std::vector<std::string> notes_;
  ChangedFields fields_;
  std::atomic<std::size_t> rounded_ = 0;
  std::size_t copied_ = 0;
};

}  // namespace

std::vector<std::string> write_patched(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context) {
  return PatchedFile(file, mesh, moved, context).write();
}

}  // namespace dmoscope
