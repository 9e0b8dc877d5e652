#include "core/io/vtk/vtk_cells.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/io/cell_table.h"
#include "core/io/format.h"

namespace dmoscope {

namespace {

const VtkType kInt32{VtkType::Kind::Scalar, ScalarType::Int32};

Index checked_corner(const VtkValues& values, std::int64_t corner, std::size_t points, std::size_t place) {
  if (corner < 0 || static_cast<std::uint64_t>(corner) >= points) {
    values.in.fail_at(
        place, fmt::format("a cell names point {}, but there are {} points (0 to {})", corner, points, points == 0 ? 0 : points - 1));
  }
  return static_cast<Index>(corner);
}

/// Reads cells up to version 4.2: every cell as its number of corners and the corners.
VtkCells read_counted(VtkValues& values, const std::string& keyword, std::size_t cells, std::size_t size, std::size_t header,
                      std::size_t points) {
  VtkCells found;
  found.offsets.reserve(cells + 1);
  found.places.reserve(cells);
  found.corners.reserve(size >= cells ? size - cells : 0);
  std::size_t remaining = 0;  // corners that the current cell still lacks
  values.wholes(kInt32, size, keyword, [&](std::int64_t value, std::size_t place) {
    if (remaining > 0) {
      found.corners.push_back(checked_corner(values, value, points, place));
      if (--remaining == 0) found.offsets.push_back(static_cast<Index>(found.corners.size()));
      return;
    }
    if (found.size() == cells) {
      values.in.fail_at(header, fmt::format("{} declares {} numbers, but its {} cells take fewer", keyword, size, cells));
    }
    if (value < 0) values.in.fail_at(place, fmt::format("a cell of {} corners", value));
    found.places.push_back(place);
    remaining = static_cast<std::size_t>(value);
    if (remaining == 0) found.offsets.push_back(static_cast<Index>(found.corners.size()));
  });
  if (found.size() != cells || remaining != 0) {
    values.in.fail_at(
        header, fmt::format("{} declares {} numbers, which are used up after {} of its {} cells", keyword, size, found.size(), cells));
  }
  return found;
}

/// Reads cells from version 5 on: offsets into one array of corners. `entries`: number of offsets, one more than there are cells.
VtkCells read_offsets(VtkValues& values, const std::string& keyword, std::size_t entries, std::size_t size, std::size_t header,
                      std::size_t points) {
  VtkCells found;
  values.in.word("OFFSETS");
  const VtkType offset_type = values.type();
  found.offsets.clear();
  found.places.reserve(entries);
  values.wholes(offset_type, entries, "OFFSETS", [&](std::int64_t value, std::size_t place) {
    const std::int64_t least = found.offsets.empty() ? 0 : found.offsets.back();
    if (value < least || static_cast<std::uint64_t>(value) > size || (found.offsets.empty() && value != 0)) {
      values.in.fail_at(place, fmt::format("offset {} of a cell: offsets start with 0, do not fall and end with {}", value, size));
    }
    if (!found.offsets.empty()) found.places.push_back(place);
    found.offsets.push_back(static_cast<Index>(value));
  });
  if (found.offsets.empty()) found.offsets.push_back(0);
  if (found.offsets.back() != size) {
    values.in.fail_at(header, fmt::format("{} declares {} corners, but the last offset is {}", keyword, size, found.offsets.back()));
  }
  if (!equal_ignoring_case(values.in.word("CONNECTIVITY"), "CONNECTIVITY")) values.in.fail("CONNECTIVITY should stand here");
  const VtkType corner_type = values.type();
  found.corners.reserve(size);
  values.wholes(corner_type, size, "CONNECTIVITY",
                [&](std::int64_t value, std::size_t place) { found.corners.push_back(checked_corner(values, value, points, place)); });
  return found;
}

/// Names of VTK's type numbers from `first` on.
struct TypeNames {
  std::int64_t first;
  std::span<const std::string_view> names;
};

constexpr std::array<std::string_view, 17> kSecondOrder{"quadratic edge",
                                                        "quadratic triangle",
                                                        "quadratic quadrilateral",
                                                        "quadratic tetrahedron",
                                                        "quadratic hexahedron",
                                                        "quadratic wedge",
                                                        "quadratic pyramid",
                                                        "biquadratic quadrilateral",
                                                        "triquadratic hexahedron",
                                                        "quadratic linear quadrilateral",
                                                        "quadratic linear wedge",
                                                        "biquadratic quadratic wedge",
                                                        "biquadratic quadratic hexahedron",
                                                        "biquadratic triangle",
                                                        "cubic line",
                                                        "quadratic polygon",
                                                        "triquadratic pyramid"};
constexpr std::array<std::string_view, 6> kParametric{"parametric curve",         "parametric surface",     "parametric triangle",
                                                      "parametric quadrilateral", "parametric tetrahedron", "parametric hexahedron"};
constexpr std::array<std::string_view, 8> kHigherOrderCells{
    "higher-order edge",        "higher-order triangle", "higher-order quadrilateral", "higher-order polygon",
    "higher-order tetrahedron", "higher-order wedge",    "higher-order pyramid",       "higher-order hexahedron"};
constexpr std::array<std::string_view, 14> kLagrange{
    "Lagrange curve",     "Lagrange triangle", "Lagrange quadrilateral", "Lagrange tetrahedron", "Lagrange hexahedron",
    "Lagrange wedge",     "Lagrange pyramid",  "Bezier curve",           "Bezier triangle",      "Bezier quadrilateral",
    "Bezier tetrahedron", "Bezier hexahedron", "Bezier wedge",           "Bezier pyramid"};
constexpr std::array kHigherTypes{TypeNames{21, kSecondOrder}, TypeNames{51, kParametric}, TypeNames{60, kHigherOrderCells},
                                  TypeNames{68, kLagrange}};

/// Reason why a cell of this type cannot be read.
std::string unsupported(std::int64_t type) {
  for (const TypeNames& some : kHigherTypes) {
    if (type < some.first || type - some.first >= static_cast<std::int64_t>(some.names.size())) continue;
    return fmt::format("cells of type {} ({}) are of higher order, which cannot be smoothed here: save the mesh with linear cells", type,
                       some.names[static_cast<std::size_t>(type - some.first)]);
  }
  std::string_view name = "unknown";
  if (type == 6) name = "triangle strip";
  if (type == 15) name = "pentagonal prism";
  if (type == 16) name = "hexagonal prism";
  if (type == 41) name = "convex point set";
  if (type == 42) name = "polyhedron";
  return fmt::format("cells of type {} ({}) are not supported", type, name);
}

}  // namespace

VtkCells read_vtk_cells(VtkValues& values, const std::string& keyword, std::size_t points) {
  const std::size_t header = values.in.token();
  const std::size_t cells = values.in.count(fmt::format("the number of cells of {}", keyword), 0.0);
  const std::size_t size = values.in.count(fmt::format("the size of {}", keyword), values.binary ? 4.0 : 2.0);
  if (size >= kNoIndex || cells >= kNoIndex) values.in.fail("more cells or corners than this program can hold");
  if (equal_ignoring_case(values.in.peek_word(), "OFFSETS")) {
    values.in.need(cells, values.binary ? 4.0 : 2.0, fmt::format("the number of offsets of {}", keyword));
    return read_offsets(values, keyword, cells, size, header, points);
  }
  if (cells > size) values.in.fail_at(header, fmt::format("{} declares {} numbers, which cannot hold {} cells", keyword, size, cells));
  return read_counted(values, keyword, cells, size, header, points);
}

VtkElement element_of_vtk_cell(std::int64_t type, std::span<Index> corners) {
  // Element kinds of the cell types 0 to 14; -1: no element, -2: handled separately.
  constexpr static std::array<int, 15> kinds{-1, kVertexCell, kVertexCell, kLineCell, kLineCell, 0, -2, -2, 1, 1, 2, 3, 3, 4, 5};
  const int known = type >= 0 && type < static_cast<std::int64_t>(kinds.size()) ? kinds[static_cast<std::size_t>(type)] : -2;
  if (known == -1) return {};  // an empty cell
  if (known == kVertexCell || known == kLineCell) return {static_cast<std::uint8_t>(known), {}, false};
  if (type == 7) {
    if (corners.size() == 3) return {static_cast<std::uint8_t>(ElementKind::Triangle), {}, false};
    if (corners.size() == 4) return {static_cast<std::uint8_t>(ElementKind::Quadrilateral), {}, false};
    return {kNoKind, fmt::format("a polygon of {} corners: only those of 3 and 4 can be smoothed", corners.size()), false};
  }
  if (known == -2) return {kNoKind, unsupported(type), true};
  const auto kind = static_cast<ElementKind>(known);
  if (corners.size() != info(kind).corners) {
    return {kNoKind,
            fmt::format("a cell of type {} ({}) has {} corners, not {}", type, info(kind).name, info(kind).corners, corners.size()), false};
  }
  if (type == 8 || type == 11) std::swap(corners[2], corners[3]);
  if (type == 11) std::swap(corners[6], corners[7]);
  exchange_vtk_order(kind, corners.data());
  return {static_cast<std::uint8_t>(kind), {}, false};
}

namespace {

/// Groups made of cells of fewer dimensions than the elements.
class LowCells {
 public:
  void add(std::uint8_t kind, std::span<const Index> corners) {
    if (kind == kVertexCell) {
      ++counts_[0];
      vertices_.members.insert(vertices_.members.end(), corners.begin(), corners.end());
    } else if (kind == kLineCell) {
      ++counts_[1];
      for (std::size_t i = 0; i + 1 < corners.size(); ++i) lines_.members.insert(lines_.members.end(), {corners[i], corners[i + 1]});
    } else if (kind != kNoKind) {
      ++counts_[2];
      faces_.faces.add(static_cast<ElementKind>(kind), corners);
    }
  }
  void add(std::uint8_t kind, const VtkCells* cells) {
    for (std::size_t c = 0; cells != nullptr && c < cells->size(); ++c) add(kind, cells->of(c));
  }

  void finish(Mesh& mesh, SourceFile& source) {
    const std::array<std::string_view, 3> what{"vertices", "lines", "faces of the volume mesh"};
    const std::array<Group*, 3> groups{&vertices_, &lines_, &faces_};
    for (std::size_t i = 0; i < groups.size(); ++i) {
      if (counts_[i] > 0) source.add_note(fmt::format("Cells that are no elements here: {} {}.", counts_[i], what[i]));
      if (!groups[i]->vertices().empty()) mesh.groups.push_back(std::move(*groups[i]));
    }
  }

 private:
  Group vertices_{.name = "vertex cells", .role = std::string(kVtkCells), .code = 0, .dimension = 0};
  Group lines_{.name = "line cells", .role = std::string(kVtkCells), .code = 0, .dimension = 1};
  Group faces_{.name = "face cells", .role = std::string(kVtkCells), .code = 0, .dimension = 2};
  std::array<std::size_t, 3> counts_{};
};

}  // namespace

std::vector<std::size_t> add_vtk_elements(Mesh& mesh, SourceFile& source, const VtkCells& cells, std::span<const std::uint8_t> kinds,
                                          const VtkCells* vertices, const VtkCells* lines) {
  const auto is_element = [](std::uint8_t kind) { return kind < kElementKindCount; };
  const bool volume = std::any_of(kinds.begin(), kinds.end(), [&](std::uint8_t kind) {
    return is_element(kind) && info(static_cast<ElementKind>(kind)).dimension == 3;
  });
  LowCells low;
  low.add(kVertexCell, vertices);
  low.add(kLineCell, lines);
  std::vector<std::size_t> rows;
  mesh.elements.reserve(kinds.size(), cells.corners.size());
  rows.reserve(kinds.size());
  for (std::size_t c = 0; c < kinds.size(); ++c) {
    const auto kind = static_cast<ElementKind>(kinds[c]);
    if (!is_element(kinds[c]) || (volume && info(kind).dimension == 2)) {
      low.add(kinds[c], cells.of(c));
      continue;
    }
    add_element(mesh, kind, cells.of(c), source);
    rows.push_back(c);
  }
  low.finish(mesh, source);
  return rows;
}

void keep_rows(Field& field, std::span<const std::size_t> rows, SourceFile& source) {
  source.add_only_in_file("data of cells that are no elements");
  field.values = rows_of_values(field, rows);
}

int vtk_cell_type(ElementKind kind) noexcept {
  constexpr static std::array<int, kElementKindCount> types{5, 9, 10, 12, 13, 14};
  return types[static_cast<std::size_t>(kind)];
}

std::string VtkGridSize::fault(std::size_t most) const {
  std::size_t count = 1;
  for (const std::size_t n : points) {
    if (n == 0) return "a grid without points";
    if (n > most / count)
      return fmt::format("a grid of {} x {} x {} points: more than its file can be about", points[0], points[1], points[2]);
    count *= n;
  }
  if (std::ranges::count(points, std::size_t{1}) > 1) {
    return fmt::format("a grid of {} x {} x {} points has no cells of two or three dimensions", points[0], points[1], points[2]);
  }
  return {};
}

std::size_t VtkGridSize::cell_count() const noexcept {
  std::size_t count = 1;
  for (const std::size_t n : points) count *= std::max<std::size_t>(n - 1, 1);
  return count;
}

void add_structured_cells(Mesh& mesh, const SourceFile& source, const VtkGridSize& size) {
  const std::array<std::size_t, 3> step{1, size.points[0], size.points[0] * size.points[1]};  // strides of points along x, y, z
  std::array<std::size_t, 3> axes{};                                                          // axes along which there are cells
  std::size_t used = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (size.points[axis] > 1) axes[used++] = axis;
  }
  const std::array<std::size_t, 4> face{0, step[axes[0]], step[axes[0]] + step[axes[1]], step[axes[1]]};
  const std::size_t up = used == 3 ? step[axes[2]] : 0;
  const auto cells = [&](std::size_t axis) { return std::max<std::size_t>(size.points[axis] - 1, 1); };
  mesh.elements.reserve(size.cell_count(), size.cell_count() * (used == 3 ? 8 : 4));
  for (std::size_t k = 0; k < cells(2); ++k) {
    for (std::size_t j = 0; j < cells(1); ++j) {
      for (std::size_t i = 0; i < cells(0); ++i) {
        const std::size_t first = i * step[0] + j * step[1] + k * step[2];
        std::array<Index, 8> corners{};
        for (std::size_t c = 0; c < 4; ++c) {
          corners[c] = static_cast<Index>(first + face[c]);
          corners[c + 4] = static_cast<Index>(first + face[c] + up);
        }
        const auto kind = used == 3 ? ElementKind::Hexahedron : ElementKind::Quadrilateral;
        add_element(mesh, kind, std::span<const Index>(corners.data(), info(kind).corners), source);
      }
    }
  }
}

}  // namespace dmoscope
