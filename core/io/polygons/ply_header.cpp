#include "core/io/polygons/ply_header.h"

#include <algorithm>

#include <fmt/format.h>

namespace dmoscope {
namespace {

void end_of_line(MixedInput& in) {
  const std::string_view more = in.word_on_line();
  if (!more.empty()) in.fail(fmt::format("the header line goes on with {}, which has no meaning", quote_token(more)));
  in.rest_of_line();
}

std::string_view on_line(MixedInput& in, std::string_view what) {
  const std::string_view found = in.word_on_line();
  if (found.empty()) in.fail(fmt::format("the header line ends where {} is expected", what));
  return found;
}

PlyEncoding read_encoding(MixedInput& in) {
  const std::string_view word = on_line(in, "an encoding");
  PlyEncoding encoding = PlyEncoding::Ascii;
  if (word == "binary_little_endian") {
    encoding = PlyEncoding::LittleEndian;
  } else if (word == "binary_big_endian") {
    encoding = PlyEncoding::BigEndian;
  } else if (word != "ascii") {
    in.fail(fmt::format("unknown encoding {} (ascii, binary_little_endian, binary_big_endian)", quote_token(word)));
  }
  const std::string_view version = on_line(in, "the version");
  if (version != "1.0") in.fail(fmt::format("PLY version {} is not known (1.0 is)", quote_token(version)));
  return encoding;
}

ScalarType type_of(const MixedInput& in, std::string_view word) {
  ScalarType type = ScalarType::Float32;
  if (!scalar_of_word(word, type)) in.fail("unknown type " + quote_token(word));
  return type;
}

PlyProperty read_property(MixedInput& in) {
  PlyProperty property;
  property.type_word = on_line(in, "a type");
  if (property.type_word == "list") {
    property.list = true;
    property.count_type = type_of(in, on_line(in, "the type of the list's count"));
    if (!is_whole(property.count_type)) in.fail("a list must be counted with whole numbers");
    property.type_word = on_line(in, "the type of the list's entries");
  }
  property.type = type_of(in, property.type_word);
  property.name = on_line(in, "the name of the property");
  return property;
}

}  // namespace

std::size_t PlyElement::least_size(PlyEncoding encoding) const noexcept {
  std::size_t size = 0;
  for (const PlyProperty& property : properties) {
    if (encoding == PlyEncoding::Ascii) {
      size += 2;  // a digit and a separator
    } else {
      size += size_of(property.list ? property.count_type : property.type);
    }
  }
  return size;
}

bool PlyElement::has_list() const noexcept {
  return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& property) { return property.list; });
}

std::size_t PlyElement::find(std::string_view property) const noexcept {
  const auto found = std::find_if(properties.begin(), properties.end(), [&](const PlyProperty& p) { return p.name == property; });
  return static_cast<std::size_t>(found - properties.begin());
}

PlyHeader read_ply_header(MixedInput& in) {
  PlyHeader header;
  if (in.rest_of_line() != "ply") in.fail_at(0, "a PLY file begins with the line \"ply\"");
  bool encoded = false;
  for (;;) {
    const std::string keyword(in.word("end_header"));
    if (keyword == "end_header") {
      end_of_line(in);
      break;
    }
    if (keyword == "comment" || keyword == "obj_info") {
      const std::string_view text = in.rest_of_line();
      if (keyword == "comment" && header.title.empty()) header.title = text;
      continue;
    }
    if (keyword == "format") {
      if (encoded) in.fail("a second format line");
      header.encoding = read_encoding(in);
      encoded = true;
    } else if (keyword == "element") {
      PlyElement element;
      element.place = in.token();
      element.name = on_line(in, "the name of the element");
      if (std::any_of(header.elements.begin(), header.elements.end(), [&](const PlyElement& e) { return e.name == element.name; })) {
        in.fail(fmt::format("a second element {}", quote_token(element.name)));
      }
      if (in.line_over()) in.fail("the header line ends where the number of elements is expected");
      element.count = in.count(fmt::format("the number of {} elements", quote_token(element.name)), 0.0);
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty()) in.fail("a property before the first element");
      PlyProperty property = read_property(in);
      PlyElement& element = header.elements.back();
      if (element.find(property.name) != element.properties.size()) {
        in.fail(fmt::format("a second property {} of element {}", quote_token(property.name), quote_token(element.name)));
      }
      element.properties.push_back(std::move(property));
    } else {
      in.fail("unknown header line " + quote_token(keyword));
    }
    end_of_line(in);
  }
  if (!encoded) in.fail("the header has no format line");
  return header;
}

}  // namespace dmoscope
