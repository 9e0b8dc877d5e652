#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "core/io/reading/binary.h"
#include "core/io/vtk/vtk.h"

namespace dmoscope {

VtkType VtkValues::type() {
  const std::string word(in.peek_word());
  const VtkType found = any_type();
  if (found.kind == VtkType::Kind::Unknown) in.fail("unknown data type " + quote_token(word));
  return found;
}

VtkType VtkValues::any_type() {
  const std::string_view word = in.word("a data type");
  VtkType found;
  if (equal_ignoring_case(word, "bit")) {
    found.kind = VtkType::Kind::Bit;
    found.scalar = ScalarType::UInt8;
  } else if (equal_ignoring_case(word, "string") || equal_ignoring_case(word, "variant")) {
    found.kind = VtkType::Kind::String;
  } else if (!scalar_of_word(word, found.scalar)) {
    found.kind = VtkType::Kind::Unknown;
  }
  return found;
}

double VtkValues::least_bytes(const VtkType& type) const noexcept {
  if (!binary) return 2.0;
  if (type.kind == VtkType::Kind::Bit) return 0.125;
  return type.kind == VtkType::Kind::String || type.kind == VtkType::Kind::Unknown ? 1.0 : static_cast<double>(size_of(type.scalar));
}

std::size_t VtkValues::count(std::string_view what, const VtkType& type) { return in.count(what, least_bytes(type)); }

std::string_view VtkValues::block(std::size_t n, std::size_t bytes_each, std::string_view what) {
  if (!in.rest_of_line().empty()) in.fail(fmt::format("something stands between the header of {} and its data", what));
  return in.block(n * bytes_each, what);
}

void VtkValues::skip_unknown(std::size_t n, std::string_view what) {
  if (binary) in.fail(fmt::format("{} is of a type that is not known, so that in a binary file nobody can tell where it ends", what));
  in.need(n, 2.0, what);
  for (std::size_t i = 0; i < n; ++i) in.word(what);
}

void VtkValues::skip_strings(std::size_t n) {
  if (!in.rest_of_line().empty()) in.fail("something stands between the header of the strings and the strings");
  for (std::size_t i = 0; i < n; ++i) {
    if (!binary) {
      if (in.left() == 0) in.fail("the file ends within an array of strings");
      in.rest_of_line();
      continue;
    }
    // The two upper bits of the first byte give the number of bytes of the length: 8, 4, 2 or 1.
    const auto first = static_cast<unsigned char>(in.block(1, "the length of a string")[0]);
    const std::size_t more = (std::size_t{8} >> (first >> 6)) - 1;
    std::uint64_t length = first & 0x3fU;
    for (const char c : in.block(more, "the length of a string")) length = (length << 8) | static_cast<unsigned char>(c);
    if (length > in.left()) in.fail("a string is longer than the rest of the file");
    in.block(static_cast<std::size_t>(length), "a string");
  }
}

void VtkValues::skip_metadata() {
  in.rest_of_line();
  while (in.left() > 0 && !in.rest_of_line().empty()) {
  }
}

namespace {

const VtkType kUnsignedChar{VtkType::Kind::Scalar, ScalarType::UInt8};
const VtkType kFloat{VtkType::Kind::Scalar, ScalarType::Float32};

struct FixedAttribute {
  std::string_view keyword;
  int components;
};
constexpr std::array kFixed{FixedAttribute{"VECTORS", 3},   FixedAttribute{"NORMALS", 3},    FixedAttribute{"TENSORS", 9},
                            FixedAttribute{"TENSORS6", 6},  FixedAttribute{"GLOBAL_IDS", 1}, FixedAttribute{"PEDIGREE_IDS", 1},
                            FixedAttribute{"EDGE_FLAGS", 1}};

}  // namespace

void VtkAttributes::begin(Field::On on, std::size_t count, std::string_view keyword) {
  const std::size_t declared = values_.in.count(fmt::format("the size of {}", keyword), 0.0);
  if (declared != count) {
    values_.in.fail(fmt::format("{} {}, but there are {} {}", keyword, declared, count, on == Field::On::Vertices ? "points" : "cells"));
  }
  begun_ = true;
  on_ = on;
  count_ = count;
}

bool VtkAttributes::read(std::string_view keyword) {
  if (equal_ignoring_case(keyword, "FIELD")) {
    field_arrays();
    return true;
  }
  if (!begun_) return false;
  if (equal_ignoring_case(keyword, "SCALARS")) {
    scalars();
  } else if (equal_ignoring_case(keyword, "COLOR_SCALARS")) {
    color_scalars();
  } else if (equal_ignoring_case(keyword, "LOOKUP_TABLE")) {
    lookup_table();
  } else if (equal_ignoring_case(keyword, "TEXTURE_COORDINATES")) {
    texture_coordinates();
  } else {
    for (const FixedAttribute& attribute : kFixed) {
      if (!equal_ignoring_case(keyword, attribute.keyword)) continue;
      fixed(attribute.keyword, attribute.components);
      return true;
    }
    return false;
  }
  return true;
}

std::string VtkAttributes::name() { return vtk_decoded(values_.in.word("the name of the data")); }

VtkType VtkAttributes::type(std::string& word) {
  word = std::string(values_.in.peek_word());
  return values_.any_type();
}

/// Reads the type and number of components of scalars; FreeFem joins them: "int1".
VtkType VtkAttributes::type_of_scalars(const std::string& name, std::string& word, std::size_t& components) {
  VtkType kind = type(word);
  if (kind.kind != VtkType::Kind::Unknown || word.size() < 2 || word.back() < '1' || word.back() > '4') return kind;
  const std::string_view known = std::string_view(word).substr(0, word.size() - 1);
  if (!scalar_of_word(known, kind.scalar)) return kind;
  kind.kind = VtkType::Kind::Scalar;
  components = static_cast<std::size_t>(word.back() - '0');
  source_.add_note(fmt::format("The data type {} of field \"{}\" was read as {} {}.", quote_token(word), name, known, components));
  word = known;
  return kind;
}

std::size_t VtkAttributes::components(std::size_t most) {
  const std::int64_t n = values_.in.integer("a number of components");
  if (n < 1 || static_cast<std::uint64_t>(n) > most) values_.in.fail(fmt::format("{} components: 1 to {} are possible", n, most));
  return static_cast<std::size_t>(n);
}

void VtkAttributes::append(std::string name, std::string_view role, std::string_view type_word, const VtkType& type, std::size_t components,
                           std::size_t tuples, double scale) {
  if (type.kind == VtkType::Kind::Unknown) {
    values_.skip_unknown(components * tuples, fmt::format("\"{}\"", name));
    source_.add_note(fmt::format("Field \"{}\" was passed over: its data type {} is not known.", name, quote_token(type_word)));
    return source_.add_only_in_file(fmt::format("field \"{}\"", name));
  }
  Field field;
  field.name = std::move(name);
  field.on = on_;
  field.components = static_cast<int>(components);
  field.type = type_word;
  field.role = role;
  const std::size_t n = components * tuples;
  values_.in.need(n, values_.least_bytes(type), "the number of values");
  field.values.reserve(n);
  bool rounded = false;
  const bool plain = type.kind == VtkType::Kind::Scalar && scale == 1.0;
  const auto row = static_cast<std::uint32_t>(components * size_of(type.scalar));
  values_.numbers(type, n, "a value of the data", [&](double value, std::size_t at) {
    field.values.push_back(value * scale);
    if (field.values.size() == 1 && !values_.binary) field.place = {at, static_cast<std::uint32_t>(components)};
    if (field.values.size() == 1 && values_.binary && plain) field.place = {.begin = at, .bytes = row};
    rounded = rounded || std::abs(value) >= kExactWhole;
  });
  if (rounded && is_whole(type.scalar)) {
    source_.add_note(fmt::format("Field \"{}\" has whole numbers beyond 2^53: other formats get them rounded.", field.name));
  }
  fields_.push_back(std::move(field));
}

void VtkAttributes::scalars() {
  std::string word;
  const std::string called = name();
  std::size_t n = 1;
  const VtkType kind = type_of_scalars(called, word, n);
  const std::string_view given = values_.in.word_on_line();
  if (!given.empty()) {
    const auto [end, error] = std::from_chars(given.data(), given.data() + given.size(), n);
    if (error != std::errc() || end != given.data() + given.size() || n < 1 || n > 1024) {
      values_.in.fail("expected a number of components, got " + quote_token(given));
    }
  }
  // Skips the name of the table in the next line, which old files leave out.
  if (equal_ignoring_case(values_.in.peek_word(), "LOOKUP_TABLE")) {
    values_.in.word("LOOKUP_TABLE");
    const std::string table(values_.in.word("the name of the lookup table"));
    if (!equal_ignoring_case(table, "default")) source_.add_only_in_file(fmt::format("name of the lookup table \"{}\"", table));
  }
  append(called, "SCALARS", word, kind, n, count_);
}

void VtkAttributes::color_scalars() {
  const std::string called = name();
  const std::size_t n = components(1024);
  if (values_.binary) {
    append(called, "COLOR_SCALARS", "float", kUnsignedChar, n, count_, 1.0 / 255.0);
  } else {
    append(called, "COLOR_SCALARS", "float", kFloat, n, count_);
  }
}

void VtkAttributes::lookup_table() {
  const std::string called = name();
  const std::size_t size = values_.in.count("the size of the lookup table", values_.binary ? 4.0 : 8.0);
  values_.numbers(values_.binary ? kUnsignedChar : kFloat, size * 4, "a colour of the lookup table", [](double, std::size_t) {});
  source_.add_only_in_file(fmt::format("lookup table \"{}\"", called));
}

void VtkAttributes::texture_coordinates() {
  std::string word;
  const std::string called = name();
  const std::size_t n = components(3);
  const VtkType kind = type(word);
  append(called, "TEXTURE_COORDINATES", word, kind, n, count_);
}

void VtkAttributes::fixed(std::string_view role, int components) {
  std::string word;
  const std::string called = name();
  const VtkType kind = type(word);
  append(called, role, word, kind, static_cast<std::size_t>(components), count_);
}

void VtkAttributes::field_arrays() {
  name();
  const std::size_t arrays = values_.in.count("the number of arrays", 1.0);
  for (std::size_t i = 0; i < arrays; ++i) {
    while (equal_ignoring_case(values_.in.peek_word(), "METADATA")) {
      values_.in.word("METADATA");
      values_.skip_metadata();
    }
    field_array();
  }
}

void VtkAttributes::field_array() {
  const std::string called = name();
  if (equal_ignoring_case(called, "NULL_ARRAY")) return;
  std::string word;
  const std::size_t n = values_.in.count("a number of components", 0.0);
  const std::size_t tuples = values_.in.count("a number of tuples", 0.0);
  const VtkType kind = type(word);
  if (n != 0) values_.in.need(tuples, values_.least_bytes(kind) * static_cast<double>(n), "the number of tuples");
  if (kind.kind == VtkType::Kind::String) {
    values_.skip_strings(n * tuples);
    source_.add_only_in_file(fmt::format("strings \"{}\"", called));
  } else if (kind.kind == VtkType::Kind::Unknown || (begun_ && tuples == count_ && n >= 1 && n <= 1024)) {
    append(called, "FIELD", word, kind, n, tuples);
  } else {
    values_.numbers(kind, n * tuples, "a value of the data", [](double, std::size_t) {});
    source_.add_only_in_file(fmt::format("data \"{}\", which belongs to the whole file,", called));
  }
}

std::string vtk_encoded(std::string_view name) {
  std::string word;
  for (const char c : name) {
    const auto code = static_cast<unsigned char>(c);
    if (code <= ' ' || code >= 0x7f || c == '"' || c == '%') {
      word += fmt::format("%{:02X}", code);
    } else {
      word += c;
    }
  }
  return word.empty() ? "unnamed" : word;
}

std::string vtk_decoded(std::string_view word) {
  std::string name;
  for (std::size_t i = 0; i < word.size(); ++i) {
    unsigned code = 0;
    if (word[i] == '%' && i + 2 < word.size()) {
      const auto [end, error] = std::from_chars(word.data() + i + 1, word.data() + i + 3, code, 16);
      if (error == std::errc() && end == word.data() + i + 3) {
        name += static_cast<char>(code);
        i += 2;
        continue;
      }
    }
    name += word[i];
  }
  return name;
}

}  // namespace dmoscope
