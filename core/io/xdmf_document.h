#pragma once
// The XML of an XDMF file, and the numbers of its DataItems.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "core/base/progress.h"
#include "core/io/source_file.h"

namespace dmoscope {

class XdmfDocument {
 public:
  /// Parses; `source` must outlive this. Throws InputError with the line.
  XdmfDocument(const SourceFile& source, Progress& progress);

  /// The one grid that the file holds. Throws InputError where it has none, or several.
  [[nodiscard]] pugi::xml_node grid() const;
  /// The one DataItem of an element. Throws InputError.
  [[nodiscard]] pugi::xml_node item(pugi::xml_node of) const;
  /// The numbers of a DataItem; `places`: their offsets in the file. Throws InputError: no inline XML, no numbers, not as many as it says.
  [[nodiscard]] std::vector<double> numbers(pugi::xml_node item, std::vector<std::uint64_t>* places = nullptr) const;
  [[nodiscard]] std::vector<std::int64_t> wholes(pugi::xml_node item) const;
  /// The first of these attributes that the element has; empty if none.
  [[nodiscard]] static std::string_view attribute(pugi::xml_node node, const char* name, const char* other_name);

  /// Throws InputError at the line of an element, naming it.
  [[noreturn]] void fail(pugi::xml_node node, const std::string& what) const;

 private:
  template <class Value, class Read>
  std::vector<Value> values(pugi::xml_node item, std::vector<std::uint64_t>* places, Read read) const;
  [[noreturn]] void fail_at(std::size_t offset, const std::string& what) const;
  [[nodiscard]] std::size_t line_at(std::size_t offset) const;

  const SourceFile& source_;
  Progress& progress_;
  std::string xml_;  // parsed in place
  pugi::xml_document document_;
};

/// What separates the numbers of a DataItem: the next tag ends them.
[[nodiscard]] TextSyntax xdmf_text_syntax();

}  // namespace dmoscope
