#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/memory.h"
#include "core/io/format.h"
#include "core/io/reading/binary.h"
#include "core/io/reading/io_context.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/vtk/vtk_cells.h"
#include "core/io/vtu/vtu.h"
#include "core/io/vtu/vtu_document.h"

namespace dmoscope {
namespace {

/// Reader, see FormatHandler::read. Several pieces become one mesh, without joining points on their seams. Cells of fewer dimensions than
/// the elements are skipped as in VTK legacy files.
class VtuReader {
 public:
  VtuReader(SourceFile& source, const IoContext& context)
      : source_(source),
        progress_(context.progress),
        document_(source, context.progress),
        budget_(source.size_on_disk(), context.most_memory) {}

  Mesh read() {
    std::size_t pieces = 0;
    for (const pugi::xml_node node : document_.grid()) {
      const std::string_view name = node.name();
      if (name == "Piece") {
        piece(node);
        ++pieces;
      } else if (name == "FieldData") {
        file_data(node);
      } else if (node.type() == pugi::node_element) {
        source_.add_only_in_file(fmt::format("the element {}", name));
      }
    }
    if (pieces == 0) document_.fail(document_.grid(), "no Piece");
    if (pieces > 1) {
      source_.add_note(fmt::format("{} pieces were read as one mesh; points on their seams are not joined.", pieces));
      source_.add_only_in_file(fmt::format("division into {} pieces", pieces));
    }
    if (document_.xml().find("<!--") != std::string_view::npos) source_.add_only_in_file("comments");
    layout();
    if (document_.structured()) {
      for (Field& field : fields_) mesh_.fields.push_back(std::move(field));
      return std::move(mesh_);
    }
    const std::vector<std::size_t> rows = add_vtk_elements(mesh_, source_, cells_, kinds_);
    for (Field& field : fields_) {
      if (field.on == Field::On::Elements && rows.size() != kinds_.size()) keep_rows(field, rows, source_);
      mesh_.fields.push_back(std::move(field));
    }
    return std::move(mesh_);
  }

 private:
  /// Reads an extent such as "0 2 0 1 3 3": the first and the last point along x, y and z.
  std::array<std::int64_t, 6> extent(pugi::xml_node piece) {
    const pugi::xml_attribute given = piece.attribute("Extent") ? piece.attribute("Extent") : document_.grid().attribute("WholeExtent");
    const std::vector<double> numbers = several(piece, given.value(), 6);
    std::array<std::int64_t, 6> found{};
    for (std::size_t i = 0; i < 6; ++i) {
      if (numbers[i] != std::nearbyint(numbers[i]) || std::abs(numbers[i]) > 1e9)
        document_.fail(piece, "an extent that is no whole number");
      found[i] = static_cast<std::int64_t>(numbers[i]);
    }
    return found;
  }

  std::vector<double> several(pugi::xml_node node, const char* text, std::size_t count) {
    Progress unwatched;
    Tokenizer tokens(text, document_.file(), {}, unwatched);
    std::vector<double> numbers;
    while (!tokens.at_end() && numbers.size() < count) {
      const std::string_view word = tokens.token();
      double value = 0.0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) break;
      numbers.push_back(value);
    }
    if (numbers.size() != count) document_.fail(node, fmt::format("{} is no list of {} numbers", quote_token(text), count));
    return numbers;
  }

  /// Reads the only piece of a grid whose cells are not listed.
  void structured_piece(pugi::xml_node node) {
    if (pieces_read_) document_.fail(node, "structured grids of several pieces are not read: save it as one, or as an unstructured grid");
    constexpr std::size_t kAlways = 1'000'000, kTimes = 256;  // packed data may have more points than the file has bytes
    const std::array<std::int64_t, 6> range = extent(node);
    VtkGridSize size;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (range[2 * axis + 1] < range[2 * axis]) document_.fail(node, "a grid without points");
      size.points[axis] = static_cast<std::size_t>(range[2 * axis + 1] - range[2 * axis] + 1);
    }
    const std::string fault = size.fault(std::min<std::size_t>(kNoIndex / 8, kAlways + kTimes * source_.bytes().size()));
    if (!fault.empty()) document_.fail(node, fault);
    if (node.child("Points")) {
      points(node, size.point_count());
    } else {
      implicit_points(node, size, range);
    }
    add_structured_cells(mesh_, source_, size);
    source_.set_not_patchable("structured grids are written as unstructured ones");
    attributes(node.child("PointData"), Field::On::Vertices, size.point_count());
    attributes(node.child("CellData"), Field::On::Elements, size.cell_count());
    pieces_read_ = true;
  }

  /// Reads the coordinates along each axis (RectilinearGrid), or the origin and the spacing (ImageData).
  void implicit_points(pugi::xml_node node, const VtkGridSize& size, const std::array<std::int64_t, 6>& range) {
    std::array<std::vector<double>, 3> along;
    const pugi::xml_node grid = document_.grid();
    if (std::string_view(grid.name()) == "RectilinearGrid") {
      std::size_t axis = 0;
      for (const pugi::xml_node array : node.child("Coordinates").children("DataArray")) {
        if (axis < 3) along[axis] = numbers(geometry(array), size.points[axis]);
        ++axis;
      }
      if (axis != 3) document_.fail(node, "Coordinates need three arrays");
    } else {
      if (grid.attribute("Direction") &&
          several(grid, grid.attribute("Direction").value(), 9) != std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1}) {
        document_.fail(grid, "an image that is turned (Direction) is not read: save it as a structured or unstructured grid");
      }
      const auto origin = several(grid, grid.attribute("Origin").as_string("0 0 0"), 3);
      const auto spacing = several(grid, grid.attribute("Spacing").as_string("1 1 1"), 3);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::int64_t i = range[2 * axis]; i <= range[2 * axis + 1]; ++i) {
          along[axis].push_back(origin[axis] + spacing[axis] * static_cast<double>(i));
        }
      }
    }
    reserve_large(mesh_.positions, size.point_count());
    for (const double z : along[2]) {
      for (const double y : along[1]) {
        for (const double x : along[0]) mesh_.positions.push_back({x, y, z});
      }
    }
    const auto finite = [](double x) { return std::isfinite(x); };
    for (const auto& list : along) {
      if (!std::ranges::all_of(list, finite)) document_.fail(node, "a coordinate is not a finite number");
    }
  }

  void piece(pugi::xml_node node) {
    if (document_.structured()) return structured_piece(node);
    if (document_.is_poly()) return poly_piece(node);
    const std::size_t point_count = document_.count(node, "NumberOfPoints", kNoIndex - 1 - mesh_.positions.size());
    const std::size_t cell_count = document_.count(node, "NumberOfCells", kNoIndex - 1 - kinds_.size());
    if (point_count == 0 && cell_count == 0) return;  // a piece of a process without data
    points(node, point_count);
    cells(node, node.child("Cells"), point_count, cell_count, {});
    attributes(node.child("PointData"), Field::On::Vertices, point_count);
    attributes(node.child("CellData"), Field::On::Elements, cell_count);
    end_piece(node, std::array<std::string_view, 1>{"Cells"});
  }

  /// Reads a piece of PolyData: lists of points, lines and polygons, whose cell data come in this order.
  void poly_piece(pugi::xml_node node) {
    struct List {
      const char *name, *count;
      std::int64_t type;  // VTK's type of all its cells
    };
    constexpr static std::array kLists{List{"Verts", "NumberOfVerts", 2}, List{"Lines", "NumberOfLines", 4},
                                       List{"Polys", "NumberOfPolys", 7}};
    const std::size_t point_count = document_.count(node, "NumberOfPoints", kNoIndex - 1 - mesh_.positions.size());
    const auto count_of = [&](const char* attribute) {
      return node.attribute(attribute) ? document_.count(node, attribute, kNoIndex - 1 - kinds_.size()) : 0;
    };
    if (count_of("NumberOfStrips") > 0)
      document_.fail(node, "triangle strips are not read: make triangles of them (ParaView's filter Triangulate)");
    const std::size_t cells_before = kinds_.size();
    if (point_count > 0) points(node, point_count);
    for (const List& list : kLists)
      if (const std::size_t count = count_of(list.count); count > 0) cells(node, node.child(list.name), point_count, count, list.type);
    const std::size_t cell_count = kinds_.size() - cells_before;
    if (point_count == 0 && cell_count == 0) return;
    attributes(node.child("PointData"), Field::On::Vertices, point_count);
    attributes(node.child("CellData"), Field::On::Elements, cell_count);
    end_piece(node, std::array<std::string_view, 4>{"Verts", "Lines", "Strips", "Polys"});
  }

  /// Ends a piece. `cells`: names of its elements that hold cells.
  void end_piece(pugi::xml_node node, std::span<const std::string_view> cells) {
    for (const pugi::xml_node child : node) {
      const std::string_view name = child.name();
      const bool known = name == "Points" || name == "PointData" || name == "CellData" || std::ranges::find(cells, name) != cells.end();
      if (!known && child.type() == pugi::node_element) source_.add_only_in_file(fmt::format("the element {}", name));
    }
    pieces_read_ = true;
    progress_.check();
    progress_.set(static_cast<double>(node.offset_debug()) / static_cast<double>(document_.xml().size() + 1));
  }

  VtuArray geometry(pugi::xml_node node) {
    const std::optional<VtuArray> array = document_.array(node);
    if (!array) document_.fail(node, "must be of a number type");
    return *array;
  }

  std::vector<double> numbers(const VtuArray& array, std::size_t count) {
    std::size_t end = array.begin;
    std::vector<double> values = vtu_numbers(document_, array, count, end, budget_);
    if (array.appended) others_.push_back({array.begin, end, false});
    return values;
  }
  std::vector<std::int64_t> wholes(const VtuArray& array, std::size_t count) {
    std::size_t end = array.begin;
    std::vector<std::int64_t> values = vtu_wholes(document_, array, count, end, budget_);
    if (array.appended) others_.push_back({array.begin, end, false});
    return values;
  }

  void points(pugi::xml_node piece, std::size_t count) {
    const pugi::xml_node node = piece.child("Points").child("DataArray");
    if (!node) document_.fail(piece, "no Points");
    const VtuArray array = geometry(node);
    if (array.components != 3) document_.fail(node, fmt::format("points have 3 coordinates, not {}", array.components));
    std::vector<std::uint64_t> places;
    std::size_t end = array.begin;
    const std::vector<double> values = vtu_numbers(document_, array, 3 * count, end, budget_, &places);
    if (mesh_.positions.empty()) reserve_large(mesh_.positions, count);
    for (std::size_t v = 0; v < count; ++v) {
      const Vec3 p{values[3 * v], values[3 * v + 1], values[3 * v + 2]};
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        document_.fail(node, fmt::format("a coordinate of point {} is not a finite number", v));
      }
      mesh_.positions.push_back(p);
      if (array.ascii) source_.add_place(static_cast<std::size_t>(places[3 * v]));
    }
    points_.push_back({array, count, end});
  }

  /// Reads cells. `type`: VTK's type of all of them; none: the file lists their types.
  void cells(pugi::xml_node piece, pugi::xml_node cells, std::size_t points, std::size_t count, std::optional<std::int64_t> type) {
    std::optional<VtuArray> connectivity, offsets, types;
    for (const pugi::xml_node node : cells.children("DataArray")) {
      const std::string_view name = node.attribute("Name").value();
      if (name == "connectivity") {
        connectivity = geometry(node);
      } else if (name == "offsets") {
        offsets = geometry(node);
      } else if (name == "types") {
        types = geometry(node);
      } else if (name != "faces" && name != "faceoffsets") {  // belong to polyhedra, which are refused
        source_.add_only_in_file(fmt::format("cell array \"{}\"", name));
      }
    }
    if (!cells || !connectivity || !offsets || !(types || type))
      document_.fail(cells ? cells : piece, type ? "cells need connectivity and offsets" : "Cells need connectivity, offsets and types");
    const std::vector<std::int64_t> ends = wholes(*offsets, count);
    for (std::size_t c = 0; c < count; ++c) {
      if (ends[c] < (c == 0 ? 0 : ends[c - 1]))
        document_.fail(offsets->node, fmt::format("the offset of cell {} is {}: offsets do not fall", c, ends[c]));
    }
    const std::size_t corners = count == 0 ? 0 : static_cast<std::size_t>(ends.back());
    if (corners >= kNoIndex - cells_.corners.size()) document_.fail(offsets->node, "more corners than this program can hold");
    add_cells(ends, wholes(*connectivity, corners), type ? std::vector(count, *type) : wholes(*types, count), points, *connectivity,
              types ? *types : *connectivity);
  }

  void add_cells(const std::vector<std::int64_t>& ends, const std::vector<std::int64_t>& corners, const std::vector<std::int64_t>& types,
                 std::size_t points, const VtuArray& connectivity, const VtuArray& type_array) {
    const std::size_t first_point = mesh_.positions.size() - points;
    const std::size_t first = cells_.corners.size();
    for (const std::int64_t corner : corners) {
      if (corner < 0 || static_cast<std::uint64_t>(corner) >= points) {
        document_.fail(connectivity.node, fmt::format("a cell names point {}, but there are {} points (0 to {})", corner, points,
                                                      points == 0 ? 0 : points - 1));
      }
      cells_.corners.push_back(static_cast<Index>(first_point + static_cast<std::size_t>(corner)));
    }
    for (std::size_t c = 0; c < types.size(); ++c) {
      const std::size_t begin = cells_.offsets.back();
      const std::size_t end = first + static_cast<std::size_t>(ends[c]);
      const VtkElement element = element_of_vtk_cell(types[c], std::span(cells_.corners).subspan(begin, end - begin));
      if (!element.fault.empty()) {
        document_.fail(element.fault_of_type ? type_array.node : connectivity.node, fmt::format("cell {}: {}", c, element.fault));
      }
      kinds_.push_back(element.kind);
      cells_.offsets.push_back(static_cast<Index>(end));
    }
  }

  /// Reads PointData or CellData of a piece: `count` rows, which follow those of the pieces before.
  void attributes(pugi::xml_node data, Field::On on, std::size_t count) {
    std::vector<std::uint8_t> met(fields_.size(), 0);
    for (const pugi::xml_node node : data) {
      progress_.check();
      if (node.type() != pugi::node_element) continue;
      const bool of_numbers = std::string_view(node.name()) == "DataArray";
      const std::optional<VtuArray> array = of_numbers ? document_.array(node) : std::optional<VtuArray>();
      if (!array) {
        source_.add_only_in_file(fmt::format("array \"{}\" of strings or bits", node.attribute("Name").value()));
        continue;
      }
      const std::size_t i = field_of(data, *array, on, met);
      met.resize(fields_.size(), 0);
      met[i] = 1;
      append(i, *array, count);
    }
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      if (fields_[i].on != on || met[i] != 0) continue;
      document_.fail(data ? data : document_.grid(), fmt::format("a piece lacks the array {} of the others", quote_token(fields_[i].name)));
    }
  }

  /// The index of the field that an array belongs to, one that was not met in this piece; a new one in the first piece.
  std::size_t field_of(pugi::xml_node data, const VtuArray& array, Field::On on, const std::vector<std::uint8_t>& met) {
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      if (fields_[i].on != on || fields_[i].name != array.name || met[i] != 0) continue;
      if (static_cast<std::size_t>(fields_[i].components) != array.components) {
        document_.fail(array.node, fmt::format("{} components, but {} in the piece before", array.components, fields_[i].components));
      }
      return i;
    }
    if (pieces_read_) document_.fail(array.node, "the pieces before lack this array");
    Field field;
    field.name = array.name;
    field.on = on;
    field.components = static_cast<int>(array.components);
    field.type = array.node.attribute("type").value();
    for (const VtuRole& active : kVtuRoles) {
      if (!array.name.empty() && array.name == data.attribute(active.attribute).value()) field.role = active.role;
    }
    fields_.push_back(std::move(field));
    return fields_.size() - 1;
  }

  void append(std::size_t number, const VtuArray& array, std::size_t rows) {
    Field& field = fields_[number];
    std::vector<double> values = numbers(array, rows * array.components);
    const bool rounded =
        is_whole(array.type) && std::any_of(values.begin(), values.end(), [](double v) { return std::abs(v) >= kExactWhole; });
    if (field.values.empty()) {
      field.values = std::move(values);
      if (array.ascii) field.place = {array.begin, static_cast<std::uint32_t>(array.components)};
    } else {
      if (!array.ascii) field.place = {};
      if (field.place.words > 0) source_.add_field_piece({number, field.values.size() / array.components, array.begin});
      field.values.insert(field.values.end(), values.begin(), values.end());
    }
    if (rounded) {
      source_.add_note(fmt::format("Field \"{}\" has whole numbers beyond 2^53: other formats get them rounded.", field.name));
    }
  }

  void file_data(pugi::xml_node data) {
    for (const pugi::xml_node node : data) {
      if (node.type() != pugi::node_element) continue;
      source_.add_only_in_file(fmt::format("data \"{}\", which belongs to the whole file,", node.attribute("Name").value()));
    }
  }

  struct PointArray {
    VtuArray array;
    std::size_t count;
    std::size_t end;  // end in the file
  };
  struct Range {
    std::size_t begin, end;
    bool of_points;
  };

  /// Sets how coordinates are replaced: in place if they are text or raw; otherwise patch_vtu() encodes them again.
  void layout() {
    if (points_.empty()) return;
    const VtuArray& first = points_.front().array;
    CoordinateLayout layout;
    layout.binary = !first.ascii;
    layout.syntax = vtu_text_syntax();
    layout.big_endian = document_.big_endian();
    const auto size = static_cast<std::uint32_t>(size_of(first.type));
    if (layout.binary) layout.at = {0, size, 2 * size};
    layout.scalar.fill(first.type == ScalarType::Float32 ? CoordinateScalar::Float32 : CoordinateScalar::Float64);
    source_.set_layout(layout);
    for (const PointArray& some : points_) {
      if (is_whole(some.array.type)) source_.set_not_patchable("its points are whole numbers");
      if (some.array.type != first.type || some.array.ascii != first.ascii || some.array.appended != first.appended) {
        source_.set_not_patchable("its pieces hold their points in different ways");
      }
    }
    if (layout.binary) find_shared_data();
    if (layout.binary && !first.base64 && !document_.compressed()) raw_places(size);
  }

  /// Finds arrays that share data with the points, as some writers allow: moved points would then move the other arrays, too.
  void find_shared_data() {
    std::vector<Range> ranges = others_;
    std::unordered_set<std::size_t> of_points;
    for (const PointArray& some : points_) of_points.insert(some.array.node.hash_value());
    for (const auto& array : document_.appended()) {  // for example arrays of strings, whose ends are not known
      if (!of_points.contains(array.node.hash_value())) ranges.push_back({array.begin, array.begin + 1, false});
    }
    for (const PointArray& some : points_) {
      if (some.array.appended) ranges.push_back({some.array.begin, some.end, true});
    }
    std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) { return a.begin < b.begin; });
    std::size_t end = 0, end_of_points = 0;  // greatest ends of all ranges before
    for (const Range& range : ranges) {
      if (range.end > range.begin && range.begin < (range.of_points ? end : end_of_points)) {
        return source_.set_not_patchable("other data share the bytes of its points");
      }
      end = std::max(end, range.end);
      if (range.of_points) end_of_points = std::max(end_of_points, range.end);
    }
  }

  void raw_places(std::size_t size) {
    const bool ascending = std::is_sorted(points_.begin(), points_.end(),
                                          [](const PointArray& a, const PointArray& b) { return a.array.begin < b.array.begin; });
    if (!ascending) source_.set_not_patchable("its pieces do not come in their order in the appended data");
    if (!source_.not_patchable().empty()) return;
    for (const PointArray& some : points_) {
      const std::size_t begin = some.array.begin + size_of(document_.header());
      for (std::size_t v = 0; v < some.count; ++v) source_.add_place(begin + 3 * size * v);
    }
  }

  SourceFile& source_;
  Progress& progress_;
  VtuDocument document_;
  UnpackBudget budget_;
  Mesh mesh_;
  VtkCells cells_;
  std::vector<std::uint8_t> kinds_;  // VtkElement::kind of each cell
  std::vector<Field> fields_;        // fields with a row for each cell
  std::vector<PointArray> points_;   // arrays of the pieces' points
  std::vector<Range> others_;        // ranges of the appended arrays that are no points
  bool pieces_read_ = false;
};

/// The attributes of an element VTKFile at the begin, behind a declaration and comments; empty if there is none.
std::string_view vtk_file_tag(std::string_view bytes) {
  constexpr std::size_t kLook = 4096;
  const std::string_view begin = bytes.substr(0, kLook);
  const std::size_t first = begin.find_first_not_of(" \t\r\n\xef\xbb\xbf"), tag = begin.find("<VTKFile");
  if (first == std::string_view::npos || begin[first] != '<' || tag == std::string_view::npos) return {};
  return begin.substr(tag, begin.find('>', tag) - tag);
}
bool is_of_poly_data(std::string_view tag) {
  return tag.find("\"PolyData\"") != std::string_view::npos || tag.find("'PolyData'") != std::string_view::npos;
}
bool recognises_vtu(std::string_view bytes) {
  const std::string_view tag = vtk_file_tag(bytes);
  return !tag.empty() && !is_of_poly_data(tag);
}
bool recognises_vtp(std::string_view bytes) { return is_of_poly_data(vtk_file_tag(bytes)); }

}  // namespace

constinit const FormatHandler kVtuFormat{
    .info = {"vtu", "VTU", ".vtu", "2D and 3D elements, point and cell data; VTK's XML, ASCII, base64 and raw, uncompressed and zlib"},
    .recognises = recognises_vtu,
    .read = read_with<VtuReader>,
    .write = write_vtu,
    .patch = patch_vtu,
    .comment = {"<!-- ", " -->\n", "--"}};

constinit const FormatHandler kVtpFormat{
    .info = {"vtp", "VTP", ".vtp", "triangles and quadrilaterals, point and cell data; VTK's XML PolyData, encoded as VTU is"},
    .recognises = recognises_vtp,
    .read = read_with<VtuReader>,
    .write = write_vtp,
    .patch = patch_vtu,
    .comment = {"<!-- ", " -->\n", "--"}};

}  // namespace dmoscope
