#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/xml_text.h"
#include "core/io/format.h"
#include "core/io/reading/binary_scalar.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/vtk/vtk_cells.h"
#include "core/io/vtk/vtk_order.h"
#include "core/io/vtu/vtu.h"
#include "core/io/vtu/vtu_data.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {
namespace {

constexpr bool kBigEndian = std::endian::native == std::endian::big;
constexpr std::size_t kBlockBytes = std::size_t{1} << 18;  // bytes in a compressed block

/// Word of VTU for a type of number.
std::string_view vtu_word(ScalarType type) {
  constexpr static std::array<std::string_view, 10> words{"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                                          "UInt32", "Int64", "UInt64", "Float32", "Float64"};
  return words[static_cast<std::size_t>(type)];
}

/// The field's own type if that holds all its values; else double.
ScalarType type_of(const Field& field) {
  ScalarType type = ScalarType::Float64;
  if (field.type == "bit") type = ScalarType::UInt8;
  if (field.type != "bit" && !scalar_of_word(field.type, type)) return ScalarType::Float64;
  const bool fits = std::all_of(field.values.begin(), field.values.end(), [type](double v) { return holds_exactly(type, v); });
  return fits ? type : ScalarType::Float64;
}

class VtuWriter {
 public:
  /// Begins a file. `poly`: as PolyData.
  VtuWriter(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context, bool poly)
      : poly_(poly),
        file_(file),
        mesh_(mesh),
        positions_(positions),
        context_(context),
        encoding_{kBigEndian, ScalarType::UInt64, true, false, kBlockBytes} {}

  Notes write() {
    const std::string_view dataset = poly_ ? "PolyData" : "UnstructuredGrid";
    xml_ = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"1.0\" byte_order=\"{1}\" header_type=\"UInt64\" "
        "compressor=\"vtkZLibDataCompressor\">\n  <{0}>\n    <Piece NumberOfPoints=\"{2}\" {3}=\"{4}\">\n",
        dataset, kBigEndian ? "BigEndian" : "LittleEndian", positions_.size(),
        poly_ ? "NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys" : "NumberOfCells", mesh_.elements.size());
    data(Field::On::Vertices, "PointData", positions_.size());
    data(Field::On::Elements, "CellData", mesh_.elements.size());
    points();
    cells();
    xml_ += fmt::format("    </Piece>\n  </{}>\n  <AppendedData encoding=\"raw\">\n   _", dataset);
    TextWriter out(file_, context_);
    out << xml_;
    for (const std::string& one : appended_) out.bytes(one);
    out << "\n  </AppendedData>\n</VTKFile>\n";
    out.finish();
    Notes notes;
    note_dropped(mesh_, kept_, {}, poly_ ? "VTP" : "VTU", notes);
    return notes;
  }

 private:
  /// Adds an array; `bytes` are in the machine's byte order.
  void array(std::string_view name, ScalarType type, std::size_t components, const std::vector<char>& bytes) {
    context_.progress.check();
    xml_ += fmt::format("        <DataArray type=\"{}\" Name=\"{}\"", vtu_word(type), xml_escaped(name));
    if (components != 1) xml_ += fmt::format(" NumberOfComponents=\"{}\"", components);
    xml_ += fmt::format(" format=\"appended\" offset=\"{}\"/>\n", offset_);
    appended_.push_back(vtu_encoded(file_.path().string(), {bytes.data(), bytes.size()}, encoding_, context_.pool));
    offset_ += appended_.back().size();
  }

  /// The bytes of `count` numbers: of(i) gives the i-th.
  template <class Of>
  static std::vector<char> bytes_of(ScalarType type, std::size_t count, Of of) {
    const std::size_t size = size_of(type);
    std::vector<char> bytes(count * size);
    for (std::size_t i = 0; i < count; ++i) store_scalar(bytes.data() + i * size, type, kBigEndian, of(i));
    return bytes;
  }

  void points() {
    xml_ += "      <Points>\n";
    const auto coordinate = [this](std::size_t i) {
      const Vec3 p = positions_[i / 3];
      return i % 3 == 0 ? p.x : i % 3 == 1 ? p.y : p.z;
    };
    array("Points", ScalarType::Float64, 3, bytes_of(ScalarType::Float64, 3 * positions_.size(), coordinate));
    xml_ += "      </Points>\n";
  }

  void cells() {
    const Index n = mesh_.elements.size();
    std::vector<Index> corners;
    corners.reserve(mesh_.elements.all_corners().size());
    for (Index e = 0; e < n; ++e) {
      const FileCorners own = vtk_corners(mesh_, e);
      corners.insert(corners.end(), own.begin(), own.end());
    }
    const auto offsets = mesh_.elements.offsets();
    const std::string_view list = poly_ ? "Polys" : "Cells";
    xml_ += fmt::format("      <{}>\n", list);
    array("connectivity", ScalarType::Int64, 1,
          bytes_of(ScalarType::Int64, corners.size(), [&](std::size_t i) { return static_cast<double>(corners[i]); }));
    array("offsets", ScalarType::Int64, 1,
          bytes_of(ScalarType::Int64, n, [&](std::size_t e) { return static_cast<double>(offsets[e + 1]); }));
    const auto type = [&](std::size_t e) { return static_cast<double>(vtk_cell_type(mesh_.elements.kind(static_cast<Index>(e)))); };
    if (!poly_) array("types", ScalarType::UInt8, 1, bytes_of(ScalarType::UInt8, n, type));
    xml_ += fmt::format("      </{}>\n", list);
  }

  void data(Field::On on, std::string_view element, std::size_t count) {
    const auto is_of = [&](const Field& field) {
      return field.on == on && field.components >= 1 && field.values.size() == count * static_cast<std::size_t>(field.components);
    };
    xml_ += fmt::format("      <{}", element);
    for (const VtuRole& role : kVtuRoles) {
      const auto active = std::find_if(mesh_.fields.begin(), mesh_.fields.end(),
                                       [&](const Field& field) { return is_of(field) && equal_ignoring_case(field.role, role.role); });
      if (active != mesh_.fields.end()) xml_ += fmt::format(" {}=\"{}\"", role.attribute, xml_escaped(active->name));
    }
    xml_ += ">\n";
    for (std::size_t i = 0; i < mesh_.fields.size(); ++i) {
      const Field& field = mesh_.fields[i];
      if (!is_of(field)) continue;
      kept_.push_back(i);
      const ScalarType type = type_of(field);
      array(field.name, type, static_cast<std::size_t>(field.components),
            bytes_of(type, field.values.size(), [&](std::size_t k) { return field.values[k]; }));
    }
    xml_ += fmt::format("      </{}>\n", element);
  }

  bool poly_;
  AtomicFile& file_;
  const Mesh& mesh_;
  std::span<const Vec3> positions_;
  const IoContext& context_;
  VtuEncoding encoding_;
  std::string xml_;
  std::vector<std::string> appended_;  // arrays as they will be behind the underscore
  std::size_t offset_ = 0;
  std::vector<std::size_t> kept_;
};

}  // namespace

std::string_view vtu_type_word(const Field& field) { return vtu_word(type_of(field)); }

Notes write_vtu(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  return VtuWriter(file, mesh, positions, context, false).write();
}

Notes write_vtp(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  require_surface_elements(file, mesh, "VTP");
  return VtuWriter(file, mesh, positions, context, true).write();
}

}  // namespace dmoscope
