#pragma once
// XDMF files (.xdmf, .xmf) with their numbers in the XML.
// https://www.xdmf.org/index.php/XDMF_Model_and_Format

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "core/base/progress.h"
#include "core/io/array_patch.h"
#include "core/io/arrays/array_file.h"
#include "core/io/cell_table.h"
#include "core/io/format.h"
#include "core/io/reading/io_context.h"
#include "core/io/reading/source_file.h"

namespace dmoscope {

// The XML of an XDMF file, and the numbers of its DataItems.

class XdmfDocument {
 public:
  /// Place of a DataItem's numbers outside of the XML: "mesh.h5:/points".
  struct Elsewhere {
    std::string file, array;
    std::size_t begin, end;  // range of the file's name in the XML
  };

  /// Parses a document; `source` must outlive this. Throws InputError with the line.
  XdmfDocument(const SourceFile& source, const IoContext& context);

  /// The only grid in the file. Throws InputError if there is none, or several.
  [[nodiscard]] pugi::xml_node grid() const;
  /// The only DataItem of an element. Throws InputError.
  [[nodiscard]] pugi::xml_node item(pugi::xml_node of) const;
  /// The numbers of a DataItem; `places`: gets their offsets in the file. Throws InputError: no inline XML, no numbers, another count than
  /// declared.
  [[nodiscard]] std::vector<double> numbers(pugi::xml_node item, std::vector<std::uint64_t>* places = nullptr) const;
  [[nodiscard]] std::vector<std::int64_t> wholes(pugi::xml_node item) const;
  /// Throws InputError unless an item's Dimensions give this number of values, or are missing.
  void require_expected(pugi::xml_node item, std::size_t found) const;
  /// Place of a DataItem's numbers; none if they are in the XML. Throws InputError for a binary file, and for words that are no place.
  [[nodiscard]] std::optional<Elsewhere> elsewhere(pugi::xml_node item) const;
  /// The HDF5 file of that name beside the XML; opened once. Throws InputError.
  [[nodiscard]] ArrayFile& arrays(const std::string& file) const;
  /// Opened files, by their names in the XML.
  [[nodiscard]] const std::map<std::string, std::shared_ptr<SourceFile>>& files() const noexcept { return files_; }
  /// All DataItems of the document whose numbers are in HDF5 files.
  [[nodiscard]] std::vector<Elsewhere> all_elsewhere() const;
  /// The first of these attributes that the element has; empty if none.
  [[nodiscard]] static std::string_view attribute(pugi::xml_node node, const char* name, const char* other_name);

  /// Throws InputError at the line of an element, naming it.
  [[noreturn]] void fail(pugi::xml_node node, const std::string& what) const;

 private:
  template <class Value, class Read>
  std::vector<Value> values(pugi::xml_node item, std::vector<std::uint64_t>* places, Read read) const;
  [[noreturn]] void fail_at(std::size_t offset, const std::string& what) const;
  [[nodiscard]] std::size_t line_at(std::size_t offset) const;

  /// Number of values by an item's Dimensions; `most`: greatest number accepted.
  [[nodiscard]] std::size_t expected(pugi::xml_node item, std::size_t most) const;

  const SourceFile& source_;
  const IoContext& context_;
  Progress& progress_;
  std::string xml_;  // parsed in place
  pugi::xml_document document_;
  mutable std::map<std::string, std::shared_ptr<SourceFile>> files_;  // HDF5 files by name
  mutable std::map<std::string, std::unique_ptr<ArrayFile>> arrays_;  // opened files by name
};

/// Separators of the numbers of a DataItem: the next tag ends them.
[[nodiscard]] TextSyntax xdmf_text_syntax();

/// Number of each CellShape in a mixed topology of XDMF, and its name for a topology. The format does not define the winding of volume
/// elements: it is taken from the file, as most programs do.
inline constexpr std::array<std::int64_t, kCellShapeCount> kXdmfTypes{1, 2, 4, 5, 6, 9, 8, 7};
inline constexpr std::array<std::string_view, kCellShapeCount> kXdmfNames{"Polyvertex",  "Polyline",   "Triangle", "Quadrilateral",
                                                                          "Tetrahedron", "Hexahedron", "Wedge",    "Pyramid"};

/// Writer, see FormatHandler. Throws OutputError, Cancelled.
Notes write_xdmf(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

/// Patcher, see FormatHandler. An HDF5 file with the numbers is written beside the XML: under its own name or, if the XML gets another name
/// than it was read with, under that one with .h5. Throws OutputError, Cancelled.
Notes patch_xdmf(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context);

/// Name of the file with the numbers for an XML of this name that does not hold them.
[[nodiscard]] std::string numbers_beside(const std::filesystem::path& xml);

/// Reads the points of a DataItem whose numbers are in an HDF5 file into `positions`. Throws InputError.
[[nodiscard]] CoordinateArrays read_xdmf_points(const XdmfDocument& document, pugi::xml_node item, bool plane,
                                                std::vector<Vec3>& positions);

}  // namespace dmoscope
