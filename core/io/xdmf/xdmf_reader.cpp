#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/io/reading/tokenizer.h"
#include "core/io/xdmf/xdmf.h"

namespace dmoscope {
namespace {

constexpr std::string_view kLinear = "only elements without nodes beyond their corners are read";

/// Reader, see FormatHandler. One uniform grid, unstructured, of first order. Throws InputError, Cancelled.
class XdmfReader {
 public:
  XdmfReader(SourceFile& source, const IoContext& context) : source_(source), document_(source, context) {}

  Mesh read() {
    const pugi::xml_node grid = document_.grid();
    if (grid.attribute("Name")) mesh_.title = grid.attribute("Name").value();
    points(one(grid, "Geometry"));
    topology(one(grid, "Topology"));
    const std::vector<OriginLabels> unlabelled(1, OriginLabels{{}, false});
    rows_ = split_cells(cells_, unlabelled, mesh_, source_);
    if (const std::size_t others = cells_.size() - mesh_.elements.size(); others > 0) {
      source_.add_only_in_file(fmt::format("{} cells of fewer dimensions", others));
    }
    for (const pugi::xml_node node : grid) {
      const std::string_view name = node.name();
      if (name == "Attribute") {
        attribute(node);
      } else if (name == "Set") {
        set(node);
      } else if (name != "Geometry" && name != "Topology" && node.type() == pugi::node_element) {
        source_.add_only_in_file("further elements of its XML");
      }
    }
    keep_files(grid.child("Geometry"));
    if (source_.bytes().find("<!--") != std::string_view::npos) source_.add_only_in_file("comments");
    return std::move(mesh_);
  }

 private:
  pugi::xml_node one(pugi::xml_node grid, const char* name) const {
    const pugi::xml_node found = grid.child(name);
    if (!found) document_.fail(grid, fmt::format("no {}", name));
    if (found.next_sibling(name)) document_.fail(grid, fmt::format("a second {}", name));
    return found;
  }

  void points(pugi::xml_node geometry) {
    const std::string_view type = XdmfDocument::attribute(geometry, "GeometryType", "Type");
    const bool plane = equal_ignoring_case(type, "XY");
    if (!plane && !type.empty() && !equal_ignoring_case(type, "XYZ")) {
      document_.fail(geometry, fmt::format("GeometryType {} is not read: XYZ and XY are", quote_token(type)));
    }
    const std::size_t each = plane ? 2 : 3;
    const pugi::xml_node item = document_.item(geometry);
    if (document_.elsewhere(item)) return points_elsewhere(item, plane);
    std::vector<std::uint64_t> places;
    const std::vector<double> values = document_.numbers(item, &places);
    if (values.size() % each != 0) document_.fail(item, fmt::format("{} numbers are no points of {} coordinates", values.size(), each));
    const std::size_t count = values.size() / each;
    if (count >= kNoIndex) document_.fail(item, "too many points");
    source_.set_layout({.components = static_cast<int>(each), .syntax = xdmf_text_syntax()});
    source_.reserve_places(count);
    mesh_.positions.reserve(count);
    for (std::size_t v = 0; v < count; ++v) {
      const Vec3 p{values[each * v], values[each * v + 1], plane ? 0.0 : values[each * v + 2]};
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        document_.fail(item, fmt::format("a coordinate of point {} is not a finite number", v));
      }
      mesh_.positions.push_back(p);
      source_.add_place(places[v * each]);
    }
  }

  void points_elsewhere(pugi::xml_node item, bool plane) {
    const CoordinateArrays coordinates = read_xdmf_points(document_, item, plane, mesh_.positions);
    coordinates.describe(source_);
  }

  /// Keeps the HDF5 file for patching: a file is written again with the one beside it that has all its numbers.
  void keep_files(pugi::xml_node points) {
    if (document_.files().empty()) return;
    const auto all = document_.all_elsewhere();
    const bool one = std::ranges::all_of(all, [&](const auto& place) { return place.file == all.front().file; });
    if (!one || !document_.elsewhere(document_.item(points))) {
      source_.set_not_patchable("its numbers are in several files");
    } else {
      source_.set_companion(document_.files().begin()->second);
    }
  }

  void topology(pugi::xml_node node) {
    const std::string_view type = XdmfDocument::attribute(node, "TopologyType", "Type");
    if (node.attribute("Order")) document_.fail(node, "an Order of its own is not read");
    if (const auto base = node.attribute("BaseOffset")) base_ = base.as_llong(0);
    const pugi::xml_node item = document_.item(node);
    numbers_ = document_.wholes(item);
    if (equal_ignoring_case(type, "Mixed")) {
      mixed(item);
    } else {
      same_shape(node, item, shape(node, type));
    }
    if (cells_.dimension() < 2) document_.fail(node, "no elements of two or three dimensions");
    const std::string_view said = XdmfDocument::attribute(node, "NumberOfElements", "Dimensions");
    if (!said.empty() && trimmed(said) != std::to_string(cells_.size())) {
      document_.fail(node, fmt::format("{} elements, but it says {}", cells_.size(), quote_token(said)));
    }
  }

  CellShape shape(pugi::xml_node node, std::string_view type) const {
    const auto* const found =
        std::find_if(kXdmfNames.begin(), kXdmfNames.end(), [&](auto name) { return equal_ignoring_case(name, type); });
    if (found != kXdmfNames.end() && found - kXdmfNames.begin() > 1) return static_cast<CellShape>(found - kXdmfNames.begin());
    if (equal_ignoring_case(type, "Polygon")) {
      const long long nodes = node.attribute("NodesPerElement").as_llong(0);
      if (nodes == 3) return CellShape::Triangle;
      if (nodes == 4) return CellShape::Quadrilateral;
    }
    if (type.find('_') != std::string_view::npos) {
      document_.fail(node, fmt::format("elements of type {} are of higher order: {}", quote_token(type), kLinear));
    }
    document_.fail(node, fmt::format("a topology of type {} is not read: save the mesh as unstructured, of triangles to hexahedra",
                                     quote_token(type)));
  }

  void same_shape(pugi::xml_node node, pugi::xml_node item, CellShape shape) {
    const std::size_t corners = corners_of(shape);
    if (numbers_.size() % corners != 0)
      document_.fail(node, fmt::format("{} numbers are no elements of {} corners", numbers_.size(), corners));
    cells_.reserve_more(numbers_.size() / corners, numbers_.size());
    for (std::size_t at = 0; at < numbers_.size(); at += corners) add(item, shape, at);
  }

  /// Reads a mixed topology: a type before the corners of each cell; points, lines and polygons also have their count.
  void mixed(pugi::xml_node item) {
    for (std::size_t at = 0; at < numbers_.size();) {
      const std::int64_t type = numbers_[at++];
      const auto* const found = std::find(kXdmfTypes.begin(), kXdmfTypes.end(), type);
      std::optional<CellShape> shape;
      if (found != kXdmfTypes.end()) shape = static_cast<CellShape>(found - kXdmfTypes.begin());
      std::size_t corners = shape ? corners_of(*shape) : 0;
      if (type >= 1 && type <= 3) {
        const std::int64_t count = at < numbers_.size() ? numbers_[at++] : -1;
        if (count < 1 || static_cast<std::uint64_t>(count) > numbers_.size() - at)
          document_.fail(item, fmt::format("a cell with {} points", count));
        corners = static_cast<std::size_t>(count);
        if (type == 3 && (count == 3 || count == 4)) shape = count == 3 ? CellShape::Triangle : CellShape::Quadrilateral;
        if (type != 3 && corners != corners_of(*shape)) {  // a polyline, or a set of points
          source_.add_only_in_file("lines and points of several nodes");
          at += corners;
          passed_over_ = true;
          continue;
        }
      }
      if (!shape) {
        const bool higher = type >= 34 && type <= 50;
        document_.fail(item, fmt::format("a cell of type {}{}: {}", type, higher ? " is of higher order" : " is not read", kLinear));
      }
      if (corners > numbers_.size() - at) document_.fail(item, "the last cell is cut off");
      add(item, *shape, at);
      at += corners;
    }
    if (passed_over_) source_.add_note("Lines and points of several nodes are not shown.");
  }

  void add(pugi::xml_node item, CellShape shape, std::size_t at) {
    std::array<Index, 8> corners{};
    for (Index k = 0; k < corners_of(shape); ++k) {
      const std::int64_t number = numbers_[at + k];
      const std::uint64_t vertex = static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(base_);
      if (vertex >= mesh_.positions.size()) {
        document_.fail(item, fmt::format("point {} out of range (the file has {} points)", number, mesh_.positions.size()));
      }
      corners[k] = static_cast<Index>(vertex);
    }
    cells_.add(shape, corners.data(), 0);
  }

  void attribute(pugi::xml_node node) {
    const std::string_view centre = node.attribute("Center").value();
    const bool of_points = centre.empty() || equal_ignoring_case(centre, "Node");
    const std::string name = node.attribute("Name").value();
    const pugi::xml_node item = node.child("DataItem");
    const std::string_view type = XdmfDocument::attribute(item, "NumberType", "DataType");
    // Skips several items: a field of finite elements, as FEniCS writes them.
    if (item.next_sibling("DataItem")) return source_.add_only_in_file("further attributes");
    const bool text = equal_ignoring_case(type, "String") || equal_ignoring_case(type, "Char");
    if ((!of_points && !equal_ignoring_case(centre, "Cell")) || text || (passed_over_ && !of_points)) {
      return source_.add_only_in_file("further attributes");
    }
    std::vector<std::uint64_t> places;
    Field field{.name = name,
                .on = of_points ? Field::On::Vertices : Field::On::Elements,
                .type = "float",
                .values = document_.numbers(document_.item(node), &places)};
    const bool precise = std::string_view(item.attribute("Precision").value()) == "8";
    if (equal_ignoring_case(type, "Int")) {
      field.type = precise ? "long" : "int";
    } else if (precise) {
      field.type = "double";
    }
    const std::size_t things = of_points ? mesh_.positions.size() : cells_.size();
    constexpr std::size_t kMost = 1024;
    if (field.values.empty() || field.values.size() % things != 0 || field.values.size() / things > kMost) {
      document_.fail(node, fmt::format("{} numbers for {} {}", field.values.size(), things, of_points ? "points" : "cells"));
    }
    field.components = static_cast<int>(field.values.size() / things);
    if (const auto place = document_.elsewhere(document_.item(node))) {
      field.place.array = place->array;
    } else if (!places.empty()) {
      field.place = {places.front(), static_cast<std::uint32_t>(field.components)};
    }
    if (!of_points && !rows_.empty()) field.values = rows_of_values(field, rows_);
    mesh_.fields.push_back(std::move(field));
  }

  /// Reads a set: numbers of points or cells.
  void set(pugi::xml_node node) {
    const std::string_view type = XdmfDocument::attribute(node, "SetType", "Center");
    const bool of_points = equal_ignoring_case(type, "Node");
    if ((!of_points && !equal_ignoring_case(type, "Cell")) || (passed_over_ && !of_points)) return source_.add_only_in_file("further sets");
    const std::size_t things = of_points ? mesh_.positions.size() : cells_.size();
    const std::vector<Index> elements = elements_of_cells(cells_, mesh_, rows_);
    Group group{.name = node.attribute("Name").value(), .role = "set", .code = 0, .dimension = of_points ? 0 : 2};
    for (const std::int64_t number : document_.wholes(document_.item(node))) {
      if (number < 0 || static_cast<std::uint64_t>(number) >= things) {
        document_.fail(node, fmt::format("{} out of range (the file has {} {})", number, things, of_points ? "points" : "cells"));
      }
      const auto member = of_points ? static_cast<Index>(number) : elements[static_cast<std::size_t>(number)];
      if (member != kNoIndex) group.members.push_back(member);
    }
    if (!group.members.empty()) mesh_.groups.push_back(std::move(group));
  }

  SourceFile& source_;
  XdmfDocument document_;
  Mesh mesh_;
  CellTable cells_;
  std::vector<std::int64_t> numbers_;  // numbers of the topology
  std::int64_t base_ = 0;
  std::vector<Index> rows_;   // cell of each element, empty if every cell is one
  bool passed_over_ = false;  // whether cells were skipped: data and sets of cells then do not apply to the elements
};

bool recognises_xdmf(std::string_view bytes) {
  constexpr std::size_t kLook = 4096;
  const std::string_view head = bytes.substr(0, kLook);
  return trimmed(head).starts_with('<') && head.find("<Xdmf") != std::string_view::npos;
}

std::vector<std::filesystem::path> files_elsewhere(const SourceFile& source, const IoContext& context) {
  std::vector<std::filesystem::path> files;
  if (source.bytes().find("HDF") == std::string_view::npos) return files;
  for (const auto& place : XdmfDocument(source, context).all_elsewhere()) {
    std::filesystem::path file = source.path().parent_path() / std::filesystem::path(place.file);
    if (std::ranges::find(files, file) == files.end()) files.push_back(std::move(file));
  }
  return files;
}

}  // namespace

constinit const FormatHandler kXdmfFormat{.info = {"xdmf", "XDMF", ".xdmf .xmf",
                                                   "2D and 3D elements, attributes of nodes and cells, sets; numbers in the XML"
#ifdef DMOSCOPE_HDF5
                                                   " or in an HDF5 file"
#endif
                                          },
                                          .recognises = recognises_xdmf,
                                          .read = read_with<XdmfReader>,
                                          .write = write_xdmf,
                                          .patch = patch_xdmf,
                                          .further = files_elsewhere,
                                          .writes_beside = [](const std::filesystem::path& main, const std::filesystem::path& file) {
                                            return file.filename() == numbers_beside(main);
                                          }};

}  // namespace dmoscope
