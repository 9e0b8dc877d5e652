#include "core/io/vtk/vtk_values.h"

#include <fmt/format.h>

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

}  // namespace dmoscope
