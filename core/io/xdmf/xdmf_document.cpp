#include <algorithm>
#include <new>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/xdmf/xdmf.h"

namespace dmoscope {
TextSyntax xdmf_text_syntax() { return {.comment = '<', .comma_is_blank = false, .backslash_joins_lines = false, .free_form = true}; }

XdmfDocument::XdmfDocument(const SourceFile& source, const IoContext& context)
    : source_(source), context_(context), progress_(context.progress), xml_(source.bytes()) {
  // Parses without changes to the text, since its places in the file are needed.
  const pugi::xml_parse_result result =
      document_.load_buffer_inplace(xml_.data(), xml_.size(), pugi::parse_minimal | pugi::parse_escapes, pugi::encoding_utf8);
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  if (!result) {
    fail_at(static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0)),
            fmt::format("not well-formed XML: {}", result.description()));
  }
  if (!document_.child("Xdmf")) fail_at(0, "an XDMF file holds an element Xdmf, this one does not");
}

pugi::xml_node XdmfDocument::grid() const {
  pugi::xml_node parent = document_.child("Xdmf").child("Domain");
  if (!parent) fail(document_.child("Xdmf"), "no Domain");
  for (;;) {
    const pugi::xml_node grid = parent.child("Grid");
    if (!grid) fail(parent, "no Grid");
    if (grid.next_sibling("Grid")) {
      const auto count = std::distance(parent.children("Grid").begin(), parent.children("Grid").end());
      fail(parent, fmt::format("{} grids (time steps, or pieces of a mesh): one is read; save it as a file of its own", count));
    }
    const std::string_view type = grid.attribute("GridType").value();
    if (type.empty() || equal_ignoring_case(type, "Uniform")) return grid;
    if (!equal_ignoring_case(type, "Collection") && !equal_ignoring_case(type, "Tree")) {
      fail(grid, fmt::format("GridType {} is not read: Uniform is", quote_token(type)));
    }
    parent = grid;
  }
}

pugi::xml_node XdmfDocument::item(pugi::xml_node of) const {
  const pugi::xml_node found = of.child("DataItem");
  if (!found) fail(of, "no DataItem");
  if (found.next_sibling("DataItem")) fail(of, "several DataItems, where one is read");
  return found;
}

std::string_view XdmfDocument::attribute(pugi::xml_node node, const char* name, const char* other_name) {
  const std::string_view found = node.attribute(name).value();
  return found.empty() ? std::string_view(node.attribute(other_name).value()) : found;
}

std::size_t XdmfDocument::expected(pugi::xml_node item, std::size_t most) const {
  std::size_t product = 1;
  Progress unwatched;
  Tokenizer sizes(item.attribute("Dimensions").value(), source_.path().string(), {}, unwatched);
  while (!sizes.at_end()) {
    std::int64_t size = -1;
    std::size_t at = 0;
    if (!sizes.take_integer(size, at) || size < 0 || (size > 0 && product > most / static_cast<std::size_t>(size))) {
      fail(item, fmt::format("Dimensions {} are no sizes of what it holds", quote_token(item.attribute("Dimensions").value())));
    }
    product *= static_cast<std::size_t>(size);
  }
  return product;
}

std::optional<XdmfDocument::Elsewhere> XdmfDocument::elsewhere(pugi::xml_node item) const {
  const std::string_view type = item.attribute("ItemType").value();
  if (!type.empty() && !equal_ignoring_case(type, "Uniform"))
    fail(item, fmt::format("ItemType {} is not read: Uniform is", quote_token(type)));
  if (item.attribute("Reference")) fail(item, "references to other elements are not read");
  const std::string_view format = item.attribute("Format").value();
  if (format.empty() || equal_ignoring_case(format, "XML")) return std::nullopt;
  if (!equal_ignoring_case(format, "HDF")) {
    fail(item, fmt::format("its numbers are in another file ({}), which is not read: save the mesh with its numbers in the XML, or as VTU",
                           quote_token(format)));
  }
  const pugi::xml_node text = item.first_child();
  const std::string_view words = trimmed(text.value());
  const std::size_t colon = words.rfind(':');
  if (text.type() != pugi::node_pcdata || colon == std::string_view::npos || colon == 0 || colon + 1 == words.size()) {
    fail(item, fmt::format("{} is no place in an HDF5 file, such as mesh.h5:/points", quote_token(words)));
  }
  const auto start = static_cast<std::size_t>(std::max<std::ptrdiff_t>(text.offset_debug(), 0));
  const std::size_t begin = std::min(source_.bytes().find_first_not_of(" \t\r\n", start), source_.bytes().size());
  const std::size_t tag = std::min(source_.bytes().find('<', begin), source_.bytes().size());
  const std::size_t end = std::max(begin, std::min(source_.bytes().rfind(':', tag), tag));
  std::string array(words.substr(colon + 1));
  if (array.front() != '/') array.insert(0, 1, '/');  // FEniCS writes no leading slash
  return Elsewhere{std::string(words.substr(0, colon)), std::move(array), begin, end};
}

std::vector<XdmfDocument::Elsewhere> XdmfDocument::all_elsewhere() const {
  std::vector<Elsewhere> found;
  for (const pugi::xpath_node& node : document_.select_nodes("//DataItem[@Format='HDF']")) {
    if (auto one = elsewhere(node.node())) found.push_back(std::move(*one));
  }
  return found;
}

ArrayFile& XdmfDocument::arrays(const std::string& file) const {
  std::unique_ptr<ArrayFile>& open = arrays_[file];
  if (!open) {
    const std::filesystem::path path = source_.path().parent_path() / std::filesystem::path(file);
    std::shared_ptr<SourceFile>& bytes = files_[file];
    if (!bytes) bytes = std::make_shared<SourceFile>(path, read_whole_file(path, progress_));
    open = open_hdf5(*bytes, context_);
  }
  return *open;
}

template <class Value, class Read>
std::vector<Value> XdmfDocument::values(pugi::xml_node item, std::vector<std::uint64_t>* places, Read read) const {
  std::size_t begin = 0, end = 0;
  for (const pugi::xml_node child : item) {
    if (child.type() != pugi::node_pcdata && child.type() != pugi::node_cdata) fail(item, "something else stands among its numbers");
    if (end != 0) fail(item, "its numbers are in several parts");
    begin = static_cast<std::size_t>(std::max<std::ptrdiff_t>(child.offset_debug(), 0));
    end = std::min(source_.bytes().find('<', begin), source_.bytes().size());
  }
  Tokenizer tokens(source_.bytes().substr(0, end), source_.path().string(), xdmf_text_syntax(), progress_);
  tokens.seek(begin, line_at(begin));
  std::vector<Value> found;
  while (!tokens.at_end()) {
    if (places != nullptr) places->push_back(tokens.offset());
    found.push_back(read(tokens));
  }
  const std::size_t said = expected(item, source_.bytes().size());
  if (item.attribute("Dimensions") && found.size() != said) {
    fail(item, fmt::format("{} numbers, but its Dimensions say {}", found.size(), said));
  }
  return found;
}

void XdmfDocument::require_expected(pugi::xml_node item, std::size_t found) const {
  constexpr std::size_t kMost = std::size_t{1} << 48U;
  const std::size_t said = expected(item, kMost);
  if (item.attribute("Dimensions") && found != said) fail(item, fmt::format("{} numbers, but its Dimensions say {}", found, said));
}

std::vector<double> XdmfDocument::numbers(pugi::xml_node item, std::vector<std::uint64_t>* places) const {
  const auto place = elsewhere(item);
  if (!place) return values<double>(item, places, any_double);
  std::vector<double> found = arrays(place->file).numbers(place->array);
  require_expected(item, found.size());
  return found;
}

std::vector<std::int64_t> XdmfDocument::wholes(pugi::xml_node item) const {
  const auto place = elsewhere(item);
  if (!place) return values<std::int64_t>(item, nullptr, [](Tokenizer& tokens) { return tokens.read_integer("a whole number"); });
  std::vector<std::int64_t> found = arrays(place->file).wholes(place->array);
  require_expected(item, found.size());
  return found;
}

void XdmfDocument::fail(pugi::xml_node node, const std::string& what) const {
  fail_at(static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0)), fmt::format("{}: {}", node.name(), what));
}

void XdmfDocument::fail_at(std::size_t offset, const std::string& what) const {
  throw InputError(source_.path().string(), line_at(std::min(offset, source_.bytes().size())), what);
}

std::size_t XdmfDocument::line_at(std::size_t offset) const {
  Progress unwatched;
  return Tokenizer(source_.bytes(), {}, {}, unwatched).line_at(offset);
}

}  // namespace dmoscope
