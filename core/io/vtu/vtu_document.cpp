#include "core/io/vtu/vtu_document.h"

#include <algorithm>
#include <charconv>
#include <cstring>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {
namespace {

constexpr std::string_view kAppended = "<AppendedData";

/// The unparsed value of an attribute in the text of a tag; empty if there is none.
std::string_view value_in_tag(std::string_view tag, std::string_view attribute) {
  std::size_t at = 0;
  while (at < tag.size()) {
    const std::size_t name = tag.find_first_not_of(" \t\r\n", at);
    if (name == std::string_view::npos) return {};
    const std::size_t equals = tag.find('=', name);
    if (equals == std::string_view::npos) return {};
    std::string_view word = tag.substr(name, equals - name);
    word = trimmed(word.substr(word.find_last_of(" \t\r\n", word.find_last_not_of(" \t\r\n")) + 1));
    const std::size_t open = tag.find_first_of("\"'", equals);
    if (open == std::string_view::npos) return {};
    const std::size_t close = tag.find(tag[open], open + 1);
    if (close == std::string_view::npos) return {};
    if (word == attribute) return tag.substr(open + 1, close - open - 1);
    at = close + 1;
  }
  return {};
}

/// The end of the tag that begins at `begin`: its '>', not one in quotes.
std::size_t tag_end(std::string_view bytes, std::size_t begin) {
  char quote = '\0';
  for (std::size_t i = begin; i < bytes.size(); ++i) {
    const char c = bytes[i];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return i;
    }
  }
  return std::string_view::npos;
}

std::optional<std::uint64_t> unsigned_number(std::string_view text) {
  text = trimmed(text);
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

VtuDocument::VtuDocument(const SourceFile& source, std::size_t file_size, Progress& progress)
    : source_(source), progress_(progress), file_size_(file_size) {
  cut_appended();
  parse();
}

/// Cuts off raw appended data, which are no XML: only the text before them is parsed.
void VtuDocument::cut_appended() {
  appended_begin_ = bytes().size();
  appended_end_ = file_size_;
  const std::size_t tag = bytes().find(kAppended);
  const std::size_t end = tag == std::string_view::npos ? tag : tag_end(bytes(), tag);
  if (end == std::string_view::npos || bytes()[end - 1] == '/') {
    xml_ = bytes();
    return;
  }
  const std::string_view encoding = value_in_tag(bytes().substr(tag + kAppended.size(), end - tag - kAppended.size()), "encoding");
  if (encoding != "raw" && encoding != "base64") {
    fail_at(tag, fmt::format("AppendedData encoded as {}: raw and base64 are known", quote_token(encoding)));
  }
  appended_base64_ = encoding == "base64";
  const std::size_t underscore = bytes().find_first_not_of(" \t\r\n", end + 1);
  if (underscore == std::string_view::npos || bytes()[underscore] != '_')
    fail_at(end, "an underscore should stand before the appended data");
  has_appended_ = true;
  appended_begin_ = underscore + 1;
  const std::string_view close = "</AppendedData";
  const std::size_t found = appended_base64_ ? bytes().find(close, appended_begin_) : bytes().rfind(close);
  if (found != std::string_view::npos && found >= appended_begin_) appended_end_ = found;
  xml_ = bytes().substr(0, end + 1);
  xml_ += "</AppendedData></VTKFile>";
}

void VtuDocument::parse() {
  // Parses without changes to the text, since its places in the file are needed.
  const pugi::xml_parse_result result =
      document_.load_buffer_inplace(xml_.data(), xml_.size(), pugi::parse_minimal | pugi::parse_escapes, pugi::encoding_utf8);
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  if (!result) {
    fail_at(std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0)), bytes().size()),
            fmt::format("not well-formed XML: {}", result.description()));
  }
  const pugi::xml_node file = document_.child("VTKFile");
  if (!file) fail_at(0, "a VTU file holds an element VTKFile, this one does not");
  attributes(file);
}

void VtuDocument::attributes(pugi::xml_node file) {
  const std::string_view type = file.attribute("type").value();
  if (type == "PUnstructuredGrid") {
    fail(file, "this is a PVTU file, which names the pieces of a mesh: call it .pvtu");
  }
  if (type == "PPolyData")
    fail(file, "this is a PVTP file, which names the pieces of a surface: open these, or save it from ParaView as one");
  poly_ = type == "PolyData";
  structured_ = type == "StructuredGrid" || type == "RectilinearGrid" || type == "ImageData";
  if (type != "UnstructuredGrid" && !structured_ && !poly_) {
    fail(file,
         fmt::format("a dataset of type {} is not read: UnstructuredGrid, PolyData, StructuredGrid, RectilinearGrid and ImageData are",
                     quote_token(type)));
  }
  const std::string_view order = file.attribute("byte_order").value();
  if (!order.empty() && order != "LittleEndian" && order != "BigEndian")
    fail(file, fmt::format("byte_order {} is not known", quote_token(order)));
  big_endian_ = order == "BigEndian";
  const std::string_view header = file.attribute("header_type").value();
  if (!header.empty() && header != "UInt32" && header != "UInt64")
    fail(file, fmt::format("header_type {} is not known", quote_token(header)));
  header_ = header == "UInt64" ? ScalarType::UInt64 : ScalarType::UInt32;
  compressor_ = file.attribute("compressor").value();
  grid_ = file.child(file.attribute("type").value());
  if (!grid_) fail(file, fmt::format("{} is missing", type));
}

std::size_t VtuDocument::count(pugi::xml_node node, const char* attribute, std::size_t most) const {
  const std::string_view text = node.attribute(attribute).value();
  const std::optional<std::uint64_t> value = unsigned_number(text);
  if (!value) fail(node, fmt::format("{}={} is no count", attribute, quote_token(text)));
  if (*value > most) fail(node, fmt::format("{} is {}: {} at most are possible", attribute, *value, most));
  return static_cast<std::size_t>(*value);
}

std::optional<VtuArray> VtuDocument::array(pugi::xml_node node) const {
  VtuArray array;
  array.node = node;
  array.name = node.attribute("Name").value();
  const std::string_view type = node.attribute("type").value();
  if (type == "String" || type == "Bit") return std::nullopt;
  if (!scalar_of_word(type, array.type)) fail(node, fmt::format("type {} is not known", quote_token(type)));
  if (node.attribute("NumberOfComponents")) {
    constexpr std::size_t kMost = 1024;
    array.components = std::max<std::size_t>(count(node, "NumberOfComponents", kMost), 1);
  }
  const std::string_view format = node.attribute("format").value();
  if (format == "appended") {
    const std::optional<std::uint64_t> offset = unsigned_number(node.attribute("offset").value());
    if (!offset) fail(node, "appended data without an offset");
    if (!has_appended_) fail(node, "appended data, but the file has no AppendedData");
    if (*offset > appended_end_ - appended_begin_) fail(node, fmt::format("offset {} lies beyond the appended data", *offset));
    array.appended = true;
    array.base64 = appended_base64_;
    array.begin = appended_begin_ + static_cast<std::size_t>(*offset);
    array.limit = appended_end_;
    return array;
  }
  if (!format.empty() && format != "ascii" && format != "binary") fail(node, fmt::format("format {} is not known", quote_token(format)));
  array.ascii = format != "binary";
  array.base64 = !array.ascii;
  find_inline_text(array);
  return array;
}

void VtuDocument::find_inline_text(VtuArray& array) const {
  array.begin = array.limit = place_of(array.node);
  bool found = false;
  for (const pugi::xml_node child : array.node) {
    if (child.type() != pugi::node_pcdata) continue;  // skips VTK's information keys
    if (found) fail(array.node, "its numbers are in several parts");
    found = true;
    array.begin = static_cast<std::size_t>(std::max<std::ptrdiff_t>(child.offset_debug(), 0));
    array.limit = std::min(bytes().find('<', array.begin), xml().size());
  }
}

std::vector<VtuDocument::Appended> VtuDocument::appended() const {
  std::vector<Appended> found;
  const auto gather = [&](pugi::xml_node node) {
    if (std::string_view(node.attribute("format").value()) != "appended") return;
    const std::optional<std::uint64_t> offset = unsigned_number(node.attribute("offset").value());
    if (offset) found.push_back({node, static_cast<std::size_t>(*offset), appended_begin_ + static_cast<std::size_t>(*offset)});
  };
  for (pugi::xml_node node = document_.first_child(); node;) {  // visits all elements, without recursion
    gather(node);
    if (node.first_child()) {
      node = node.first_child();
      continue;
    }
    while (node && !node.next_sibling()) node = node.parent();
    node = node.next_sibling();
  }
  return found;
}

std::pair<std::size_t, std::size_t> VtuDocument::attribute_place(pugi::xml_node node, std::string_view attribute) const {
  const std::size_t begin = place_of(node) + std::strlen(node.name());
  const std::size_t end = tag_end(bytes(), begin);
  const std::string_view value = value_in_tag(bytes().substr(begin, end - begin), attribute);
  if (value.data() == nullptr) fail(node, fmt::format("{} is missing", attribute));
  return {static_cast<std::size_t>(value.data() - bytes().data()), value.size()};
}

std::size_t VtuDocument::place_of(pugi::xml_node node) const {
  return std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0)), bytes().size());
}

void VtuDocument::fail(pugi::xml_node node, const std::string& what) const {
  const std::string_view name = node.attribute("Name").value();
  const std::string element = name.empty() ? std::string(node.name()) : fmt::format("{} {}", node.name(), quote_token(name));
  fail_at(place_of(node), fmt::format("{}: {}", element, what));
}

std::size_t VtuDocument::line_at(std::size_t offset) const {
  const std::size_t low = std::min(offset, counted_at_);
  const std::string_view between = bytes().substr(low, std::max(offset, counted_at_) - low);
  const auto lines = static_cast<std::size_t>(std::count(between.begin(), between.end(), '\n'));
  counted_line_ = offset < counted_at_ ? counted_line_ - lines : counted_line_ + lines;
  counted_at_ = offset;
  return counted_line_;
}

void VtuDocument::fail_at(std::size_t offset, const std::string& what) const {
  throw InputError(file(), line_at(std::min(offset, bytes().size())), what);
}

}  // namespace dmoscope
