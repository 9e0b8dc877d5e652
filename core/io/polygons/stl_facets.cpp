#include "core/io/polygons/stl_facets.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/io/reading/binary.h"
#include "core/io/reading/mixed_input.h"

namespace dmoscope {
namespace {

bool begins_with_solid(std::string_view bytes) noexcept { return equal_ignoring_case(bytes.substr(0, 5), "solid"); }

void expect(MixedInput& in, std::string_view keyword) {
  const std::string_view found = in.word(keyword);
  if (!equal_ignoring_case(found, keyword)) in.fail(fmt::format("expected \"{}\", got {}", keyword, quote_token(found)));
}

void read_number(MixedInput& in, StlFacet& facet, std::size_t i) {
  // Accepts any normal (degenerate facets have NaN in many files), since it follows from the corners.
  facet.numbers[i] = i < 3 ? in.number("a component of the normal") : in.coordinate();
  facet.places[i] = in.token();
  facet.sizes[i] = in.offset() - in.token();
}

/// Reads a facet behind the word "facet".
void read_facet(MixedInput& in, StlFacet& facet) {
  expect(in, "normal");
  for (std::size_t i = 0; i < 3; ++i) read_number(in, facet, i);
  expect(in, "outer");
  expect(in, "loop");
  for (std::size_t corner = 0; corner < 3; ++corner) {
    expect(in, "vertex");
    for (std::size_t k = 0; k < 3; ++k) read_number(in, facet, 3 + 3 * corner + k);
  }
  if (equal_ignoring_case(in.peek_word(), "vertex")) {
    in.word("endloop");
    in.fail("a facet of more than three corners");
  }
  expect(in, "endloop");
  expect(in, "endfacet");
}

void ascii_facets(MixedInput& in, const std::function<void(std::string_view)>& solid, const std::function<void(const StlFacet&)>& each) {
  StlFacet facet;
  while (!in.at_end()) {
    expect(in, "solid");
    solid(in.rest_of_line());
    for (;;) {
      const std::string_view keyword = in.word("\"facet\" or \"endsolid\"");
      if (equal_ignoring_case(keyword, "endsolid")) {
        in.rest_of_line();
        break;
      }
      if (!equal_ignoring_case(keyword, "facet")) in.fail("expected \"facet\" or \"endsolid\", got " + quote_token(keyword));
      read_facet(in, facet);
      each(facet);
    }
  }
}

void binary_facets(MixedInput& in, const std::function<void(std::string_view)>& solid, const std::function<void(const StlFacet&)>& each) {
  const std::string_view header = in.block(kStlHeaderBytes, "the header (a text file begins with \"solid\")");
  const auto n = load_number<std::uint32_t>(header.data() + 80, false);
  if (in.left() != std::size_t{n} * kStlFacetBytes) {
    in.fail_at(
        80, fmt::format("{}: {} facets take {} bytes, {} are left", in.left() < std::size_t{n} * kStlFacetBytes ? "truncated" : "too long",
                        n, std::size_t{n} * kStlFacetBytes, in.left()));
  }
  std::string_view name = header.substr(0, std::min<std::size_t>(80, header.find('\0')));
  while (!name.empty() && name.back() == ' ') name.remove_suffix(1);
  solid(name);
  StlFacet facet;
  for (std::uint32_t f = 0; f < n; ++f) {
    const std::string_view data = in.block(kStlFacetBytes, "a facet");
    for (std::size_t i = 0; i < 12; ++i) {
      facet.numbers[i] = static_cast<double>(load_number<float>(data.data() + 4 * i, false));
      facet.places[i] = in.token() + 4 * i;
      facet.sizes[i] = 4;
      if (i >= 3 && !std::isfinite(facet.numbers[i])) {
        in.fail_at(facet.places[i], fmt::format("a coordinate of facet {} is not a finite number", f));
      }
    }
    facet.attribute = load_number<std::uint16_t>(data.data() + 48, false);
    each(facet);
  }
}

bool size_fits(std::string_view bytes) noexcept {
  if (bytes.size() < kStlHeaderBytes) return false;
  return bytes.size() == kStlHeaderBytes + std::size_t{load_number<std::uint32_t>(bytes.data() + 80, false)} * kStlFacetBytes;
}

}  // namespace

bool is_binary_stl(std::string_view bytes) noexcept {
  // Detects a truncated binary file that begins with "solid" by its zero bytes.
  return size_fits(bytes) || !begins_with_solid(bytes.substr(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()))) ||
         bytes.substr(0, 512).find('\0') != std::string_view::npos;
}

bool recognises_stl(std::string_view bytes) {
  if (size_fits(bytes)) return bytes.size() > kStlHeaderBytes;
  if (!begins_with_solid(bytes)) return false;
  const std::string_view begin = bytes.substr(0, 1024);
  return begin.find("facet") != std::string_view::npos || begin.find("FACET") != std::string_view::npos;
}

void for_each_stl_facet(const SourceFile& source, Progress& progress, const std::function<void(std::string_view)>& solid,
                        const std::function<void(const StlFacet&)>& facet) {
  MixedInput in(source, progress);
  if (is_binary_stl(source.bytes())) {
    binary_facets(in, solid, facet);
  } else {
    ascii_facets(in, solid, facet);
  }
}

}  // namespace dmoscope
