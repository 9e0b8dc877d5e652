#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/base/memory.h"
#include "core/io/format.h"
#include "core/io/vtk/vtk.h"
#include "core/io/vtk/vtk_cells.h"

namespace dmoscope {
namespace {

constexpr std::string_view kSignature = "# vtk DataFile Version";

/// Reader, see FormatHandler::read. Cells of fewer dimensions than the elements (vertices, lines, the faces of a volume mesh) are skipped
/// with a note, and their rows of cell data with them; writing the same file again keeps both.
class VtkReader {
 public:
  VtkReader(SourceFile& source, const IoContext& context)
      : source_(source), values_(source, context.progress), attributes_(values_, source) {}

  Mesh read() {
    header();
    while (!in().at_end()) section(std::string(in().word("a keyword")));
    finish();
    return std::move(mesh_);
  }

 private:
  enum class Dataset { None, UnstructuredGrid, PolyData, StructuredGrid, RectilinearGrid, StructuredPoints };
  struct DatasetName {
    std::string_view word;
    Dataset dataset;
  };
  static constexpr std::array kDatasets{DatasetName{"UNSTRUCTURED_GRID", Dataset::UnstructuredGrid},
                                        DatasetName{"POLYDATA", Dataset::PolyData}, DatasetName{"STRUCTURED_GRID", Dataset::StructuredGrid},
                                        DatasetName{"RECTILINEAR_GRID", Dataset::RectilinearGrid},
                                        DatasetName{"STRUCTURED_POINTS", Dataset::StructuredPoints}};

  MixedInput& in() { return values_.in; }

  void header() {
    const std::string_view first = in().rest_of_line();
    if (!equal_ignoring_case(first.substr(0, kSignature.size()), kSignature)) {
      in().fail_at(0, fmt::format("a VTK legacy file begins with \"{} 3.0\", this one with {}", kSignature, quote_token(first)));
    }
    std::string_view version = first.substr(kSignature.size());
    version.remove_prefix(std::min(version.find_first_not_of(" \t"), version.size()));
    int major = 0;
    const auto [end, error] = std::from_chars(version.data(), version.data() + version.size(), major);
    if (error != std::errc() || major < 1 || major > 5) {
      in().fail_at(0, fmt::format("VTK version {} is not known (1.0 to 5.1 are)", quote_token(version)));
    }
    mesh_.title = in().rest_of_line();
    const std::string_view encoding = in().word("ASCII or BINARY");
    values_.binary = equal_ignoring_case(encoding, "BINARY");
    if (!values_.binary && !equal_ignoring_case(encoding, "ASCII")) {
      in().fail("expected ASCII or BINARY, got " + quote_token(encoding));
    }
  }

  void section(const std::string& keyword) {
    const auto is = [&](std::string_view word) { return equal_ignoring_case(keyword, word); };
    if (is("DATASET")) {
      dataset();
    } else if (is("METADATA")) {
      values_.skip_metadata();
    } else if (is("POINT_DATA")) {
      data_begun_ = true;
      make_points();
      attributes_.begin(Field::On::Vertices, mesh_.positions.size(), "POINT_DATA");
    } else if (is("CELL_DATA")) {
      data_begun_ = true;
      make_points();
      attributes_.begin(Field::On::Elements, cell_count(), "CELL_DATA");
    } else if (!attributes_.read(keyword) && !geometry(keyword)) {
      in().fail("unknown keyword " + quote_token(keyword));
    }
  }

  void dataset() {
    if (dataset_ != Dataset::None) in().fail("a second DATASET: a file has one");
    const std::string_view kind = in().word("the kind of dataset");
    const auto* const found = std::ranges::find_if(kDatasets, [&](const DatasetName& d) { return equal_ignoring_case(kind, d.word); });
    if (found == kDatasets.end()) {
      in().fail(
          fmt::format("dataset {} is not supported: UNSTRUCTURED_GRID, POLYDATA, STRUCTURED_GRID, RECTILINEAR_GRID and "
                      "STRUCTURED_POINTS are",
                      quote_token(kind)));
    }
    dataset_ = found->dataset;
  }

  bool geometry(const std::string& keyword) {
    const auto is = [&](std::string_view word) { return equal_ignoring_case(keyword, word); };
    const bool grid = dataset_ == Dataset::UnstructuredGrid;
    const bool poly = dataset_ == Dataset::PolyData;
    if (structured() && dataset_ != Dataset::StructuredGrid) return implicit_geometry(keyword);
    const bool known = is("POINTS") || (grid && (is("CELLS") || is("CELL_TYPES"))) || (structured() && is("DIMENSIONS")) ||
                       (poly && (is("POLYGONS") || is("VERTICES") || is("LINES") || is("TRIANGLE_STRIPS")));
    if (!known) return false;
    if (dataset_ == Dataset::None) in().fail(keyword + " before DATASET");
    if (data_begun_) in().fail(keyword + " after the data of points or cells");
    if (is("POINTS")) {
      points();
    } else if (is("DIMENSIONS")) {
      dimensions();
    } else if (!points_read_) {
      in().fail(keyword + " before POINTS");
    } else if (is("CELLS") || is("POLYGONS")) {
      read_cells(cells_, keyword);
    } else if (is("CELL_TYPES")) {
      cell_types();
    } else if (is("TRIANGLE_STRIPS")) {
      const std::size_t place = in().token();
      if (read_vtk_cells(values_, keyword, mesh_.positions.size()).size() > 0) {
        in().fail_at(place, "triangle strips are not supported: write the surface as triangles");
      }
    } else {
      read_cells(is("VERTICES") ? vertices_ : lines_, keyword);
    }
    return true;
  }

  [[nodiscard]] bool structured() const noexcept { return dataset_ >= Dataset::StructuredGrid; }

  void dimensions() {
    if (size_) in().fail("a second DIMENSIONS");
    VtkGridSize size;
    for (std::size_t& n : size.points) n = in().count("a number of points", 0.0);
    // Limits the number of points: a grid whose points are not listed may have more of them than its file has bytes, but not by orders of
    // magnitude.
    constexpr std::size_t kAlways = 1'000'000;
    const std::string fault = size.fault(std::min<std::size_t>(kNoIndex / 8, kAlways + source_.bytes().size()));
    if (!fault.empty()) in().fail(fault);
    size_ = size;
  }

  /// Reads the coordinates along each axis (RECTILINEAR_GRID), or the first point and the spacing (STRUCTURED_POINTS).
  bool implicit_geometry(const std::string& keyword) {
    const auto is = [&](std::string_view word) { return equal_ignoring_case(keyword, word); };
    const bool uniform = dataset_ == Dataset::StructuredPoints;
    if (is("DIMENSIONS")) {
      dimensions();
    } else if (uniform && is("ORIGIN")) {
      for (double& x : origin_) x = in().coordinate();
    } else if (uniform && (is("SPACING") || is("ASPECT_RATIO"))) {
      for (double& x : spacing_) x = in().coordinate();
    } else if (!uniform && (is("X_COORDINATES") || is("Y_COORDINATES") || is("Z_COORDINATES"))) {
      axis_coordinates(static_cast<std::size_t>((keyword[0] | 0x20) - 'x'));
    } else {
      return false;
    }
    return true;
  }

  void axis_coordinates(std::size_t axis) {
    if (!size_) in().fail("coordinates before DIMENSIONS");
    const std::size_t n = in().count("a number of coordinates", values_.binary ? 1.0 : 2.0);
    if (n != size_->points[axis]) in().fail(fmt::format("{} coordinates, but DIMENSIONS says {}", n, size_->points[axis]));
    const VtkType type = values_.type();
    if (type.kind != VtkType::Kind::Scalar) in().fail("coordinates must be of a number type");
    coordinates_[axis].clear();
    values_.numbers(type, n, "a coordinate", [&](double value, std::size_t place) {
      if (!std::isfinite(value)) in().fail_at(place, "a coordinate is not a finite number");
      coordinates_[axis].push_back(value);
    });
  }

  /// Generates the points that the file does not list, once, after all of the geometry is read.
  void make_points() {
    if (!structured() || dataset_ == Dataset::StructuredGrid || points_read_) return;
    if (!size_) in().fail("the file has no DIMENSIONS");
    const auto at = [&](std::size_t axis, std::size_t i) {
      if (dataset_ == Dataset::StructuredPoints) return origin_[axis] + spacing_[axis] * static_cast<double>(i);
      if (coordinates_[axis].empty()) in().fail(fmt::format("the file has no {}_COORDINATES", "XYZ"[axis]));
      return coordinates_[axis][i];
    };
    reserve_large(mesh_.positions, size_->point_count());
    for (std::size_t k = 0; k < size_->points[2]; ++k) {
      for (std::size_t j = 0; j < size_->points[1]; ++j) {
        for (std::size_t i = 0; i < size_->points[0]; ++i) {
          const Vec3 p{at(0, i), at(1, j), at(2, k)};
          if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) in().fail("a point of the grid is not finite");
          mesh_.positions.push_back(p);
        }
      }
    }
    points_read_ = true;
    source_.set_not_patchable("the points of a regular grid are not listed in it");
  }

  void read_cells(std::optional<VtkCells>& cells, const std::string& keyword) {
    if (cells) in().fail("a second " + keyword);
    cells = read_vtk_cells(values_, keyword, mesh_.positions.size());
  }

  void points() {
    if (points_read_) in().fail("a second POINTS");
    points_read_ = true;
    const std::size_t n = in().count("the number of points", values_.binary ? 3.0 : 6.0);
    const VtkType type = values_.type();
    if (type.kind != VtkType::Kind::Scalar) in().fail("points must be of a number type");
    reserve_large(mesh_.positions, n);
    if (!values_.binary) source_.reserve_places(n);
    std::array<double, 3> xyz{};
    std::size_t axis = 0;
    std::size_t first = 0;
    in().need(n, 3.0 * values_.least_bytes(type), "the number of points");
    const auto coordinate = [&](double value, std::size_t place) {
      if (!std::isfinite(value))
        in().fail_at(place, fmt::format("a coordinate of point {} is not a finite number", mesh_.positions.size()));
      if (axis == 0) {
        if (mesh_.positions.empty()) first = place;
        if (!values_.binary) source_.add_place(place);
      }
      xyz[axis++] = value;
      if (axis < 3) return;
      axis = 0;
      mesh_.positions.push_back({xyz[0], xyz[1], xyz[2]});
    };
    values_.numbers(type, n * 3, "a coordinate", coordinate);
    set_layout(type.scalar, first, n);
  }

  void set_layout(ScalarType type, std::size_t first, std::size_t n) {
    const auto scalar = type == ScalarType::Float32 ? CoordinateScalar::Float32 : CoordinateScalar::Float64;
    source_.set_layout(values_.binary ? CoordinateLayout::packed(scalar, true)
                                      : CoordinateLayout{.syntax = {.free_form = true}, .scalar = {scalar, scalar, scalar}});
    if (values_.binary) source_.set_uniform_places(first, 3 * size_of(type), n);
    if (is_whole(type)) source_.set_not_patchable("its points are whole numbers");
  }

  void cell_types() {
    if (!cells_) in().fail("CELL_TYPES before CELLS");
    if (!kinds_.empty()) in().fail("a second CELL_TYPES");
    const std::size_t n = in().count("the number of cell types", values_.binary ? 4.0 : 2.0);
    if (n != cells_->size()) in().fail(fmt::format("CELL_TYPES {}, but there are {} cells", n, cells_->size()));
    types_read_ = true;
    kinds_.reserve(n);
    const VtkType type{VtkType::Kind::Scalar, ScalarType::Int32};
    values_.wholes(type, n, "a cell type", [&](std::int64_t value, std::size_t place) { add_kind(value, place); });
  }

  /// Adds the next cell with VTK's type `type`; pixels and voxels get the corner order of quadrilaterals and hexahedra.
  void add_kind(std::int64_t type, std::size_t type_place) {
    VtkCells& cells = *cells_;
    const std::size_t c = kinds_.size();
    const std::span<Index> corners = std::span(cells.corners).subspan(cells.offsets[c], cells.offsets[c + 1] - cells.offsets[c]);
    const VtkElement element = element_of_vtk_cell(type, corners);
    if (!element.fault.empty()) in().fail_at(element.fault_of_type ? type_place : cells.places[c], element.fault);
    kinds_.push_back(element.kind);
  }

  [[nodiscard]] std::size_t cell_count() const {
    if (structured()) return size_ ? size_->cell_count() : 0;
    return (cells_ ? cells_->size() : 0) + (vertices_ ? vertices_->size() : 0) + (lines_ ? lines_->size() : 0);
  }

  void finish() {
    if (dataset_ == Dataset::None) in().fail_at(source_.bytes().size(), "the file has no DATASET");
    make_points();
    if (!points_read_) in().fail_at(source_.bytes().size(), "the file has no POINTS");
    if (structured()) return finish_structured();
    if (dataset_ == Dataset::PolyData) {
      if (!cells_) in().fail_at(source_.bytes().size(), "the file has no POLYGONS");
      for (std::size_t c = 0; c < cells_->size(); ++c) add_kind(7, cells_->places[c]);
    } else if (!cells_ || !types_read_) {
      in().fail_at(source_.bytes().size(), cells_ ? "the file has no CELL_TYPES" : "the file has no CELLS");
    }
    add_elements();
    for (Field& field : attributes_.fields()) {
      if (field.on == Field::On::Elements && rows_.size() != cell_count()) keep_rows(field, rows_, source_);
      mesh_.fields.push_back(std::move(field));
    }
  }

  void finish_structured() {
    if (!size_) in().fail_at(source_.bytes().size(), "the file has no DIMENSIONS");
    if (mesh_.positions.size() != size_->point_count()) {
      in().fail_at(source_.bytes().size(), fmt::format("{} points, but DIMENSIONS says {}", mesh_.positions.size(), size_->point_count()));
    }
    add_structured_cells(mesh_, source_, *size_);
    for (Field& field : attributes_.fields()) mesh_.fields.push_back(std::move(field));
  }

  void add_elements() {
    // Number of rows of vertices and lines, which come first in cell data of POLYDATA.
    const std::size_t before = (vertices_ ? vertices_->size() : 0) + (lines_ ? lines_->size() : 0);
    rows_ = add_vtk_elements(mesh_, source_, *cells_, kinds_, vertices_ ? &*vertices_ : nullptr, lines_ ? &*lines_ : nullptr);
    for (std::size_t& row : rows_) row += before;
  }

  SourceFile& source_;
  VtkValues values_;
  VtkAttributes attributes_;
  Mesh mesh_;
  Dataset dataset_ = Dataset::None;
  bool points_read_ = false;
  bool types_read_ = false;
  bool data_begun_ = false;
  std::optional<VtkCells> cells_;     // CELLS or POLYGONS
  std::optional<VtkCells> vertices_;  // vertices of POLYDATA
  std::optional<VtkCells> lines_;     // lines of POLYDATA
  // --- Structured grids ---
  std::optional<VtkGridSize> size_;
  std::array<double, 3> origin_{0.0, 0.0, 0.0}, spacing_{1.0, 1.0, 1.0};
  std::array<std::vector<double>, 3> coordinates_;  // coordinates along each axis
  std::vector<std::uint8_t> kinds_;                 // VtkElement::kind of each of cells_
  std::vector<std::size_t> rows_;                   // row of cell data of each element
};

bool recognises_vtk(std::string_view bytes) { return equal_ignoring_case(bytes.substr(0, kSignature.size()), kSignature); }

}  // namespace

constinit const FormatHandler kVtkFormat{
    .info = {"vtk", "VTK legacy", ".vtk",
             "2D and 3D elements, point and cell data; ASCII and binary; POLYDATA, UNSTRUCTURED_GRID, and structured grids"},
    .recognises = recognises_vtk,
    .read = read_with<VtkReader>,
    .write = write_vtk};

}  // namespace dmoscope
