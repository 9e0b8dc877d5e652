#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/io/mesh_writer.h"
#include "core/io/reading/binary.h"
#include "core/io/vtk/vtk.h"
#include "core/io/vtk/vtk_cells.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {
namespace {

constexpr std::size_t kLongestTitle = 255;  // VTK reads 256 bytes, with the line end

class VtkWriter : MeshWriter {
 public:
  VtkWriter(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context)
      : MeshWriter(file, mesh, positions, context, "VTK legacy") {}

  Notes write() {
    out_ << "# vtk DataFile Version 3.0\n" << title() << "\nASCII\nDATASET UNSTRUCTURED_GRID\n";
    points();
    cells();
    data(Field::On::Vertices, "POINT_DATA ", positions_.size());
    data(Field::On::Elements, "CELL_DATA ", mesh_.elements.size());
    return finish();
  }

 private:
  std::string title() {
    std::string line = mesh_.title.empty() ? "dmoscope" : without_line_ends(mesh_.title);
    if (line.size() > kLongestTitle) {
      notes_.push_back("The title was cut to 255 bytes, which is what VTK legacy allows.");
      line.resize(kLongestTitle);
    }
    return line;
  }

  void points() {
    out_ << "POINTS " << positions_.size() << " double\n";
    out_.for_each(positions_.size(), [this](TextBuffer& part, std::size_t v) {
      part << positions_[v].x << ' ' << positions_[v].y << ' ' << positions_[v].z << '\n';
    });
  }

  void cells() {
    const Index n = mesh_.elements.size();
    out_ << "CELLS " << n << ' ' << n + mesh_.elements.all_corners().size() << '\n';
    out_.for_each(n, [this](TextBuffer& part, std::size_t e) {
      const FileCorners corners = vtk_corners(mesh_, e);
      part << corners.size();
      put_corners(part, corners, 0);
      part << '\n';
    });
    out_ << "CELL_TYPES " << n << '\n';
    for (const ElementKind kind : mesh_.elements.kinds()) out_ << vtk_cell_type(kind) << '\n';
  }

  void data(Field::On on, std::string_view header, std::size_t count) {
    std::vector<std::size_t> arrays;
    bool begun = false;
    for (std::size_t i = 0; i < mesh_.fields.size(); ++i) {
      const Field& field = mesh_.fields[i];
      if (!is_of(field, on)) continue;
      kept_fields_.push_back(i);
      if (!begun) out_ << header << count << '\n';
      begun = true;
      if (!attribute(field)) arrays.push_back(i);
    }
    if (arrays.empty()) return;
    out_ << "FIELD FieldData " << arrays.size() << '\n';
    for (const std::size_t i : arrays) {
      const Field& field = mesh_.fields[i];
      out_ << vtk_encoded(field.name) << ' ' << field.components << ' ' << count << ' ' << type_word(field) << '\n';
      values(field);
    }
  }

  /// Writes a field as the attribute that its role names; false if it has no such role.
  bool attribute(const Field& field) {
    const auto role = [&](std::string_view word, int components) {
      return equal_ignoring_case(field.role, word) && (components == 0 || field.components == components);
    };
    const std::string name = vtk_encoded(field.name);
    if (role("COLOR_SCALARS", 0)) {
      out_ << "COLOR_SCALARS " << name << ' ' << field.components << '\n';
    } else if (role("TEXTURE_COORDINATES", 0) && field.components <= 3) {
      out_ << "TEXTURE_COORDINATES " << name << ' ' << field.components << ' ' << type_word(field) << '\n';
    } else if (role("VECTORS", 3) || role("NORMALS", 3) || role("TENSORS", 9) || role("TENSORS6", 6) || role("GLOBAL_IDS", 1) ||
               role("PEDIGREE_IDS", 1) || role("EDGE_FLAGS", 1)) {
      out_ << field.role << ' ' << name << ' ' << type_word(field) << '\n';
    } else if (field.components <= 4 && !role("FIELD", 0)) {
      out_ << "SCALARS " << name << ' ' << type_word(field) << ' ' << field.components << "\nLOOKUP_TABLE default\n";
    } else {
      return false;
    }
    values(field);
    return true;
  }

  /// VTK's word for the field's type; "double" if the values would not fit or VTK has no such type.
  static std::string_view type_word(const Field& field) {
    if (field.type == "bit" && std::all_of(field.values.begin(), field.values.end(), [](double v) { return v == 0.0 || v == 1.0; })) {
      return "bit";
    }
    ScalarType type = ScalarType::Float64;
    if (!scalar_of_word(field.type, type)) return "double";
    // Keeps more digits than the type has, which an ASCII file may hold; VTK rounds them when reading.
    if (!is_whole(type)) return vtk_word(type);
    const bool fits = std::all_of(field.values.begin(), field.values.end(), [type](double v) { return holds_exactly(type, v); });
    return fits ? vtk_word(type) : "double";
  }

  void values(const Field& field) {
    const std::string_view word = type_word(field);
    const bool whole = word != "double" && word != "float";
    const auto n = static_cast<std::size_t>(field.components);
    for (std::size_t i = 0; i < field.values.size(); ++i) {
      if (whole) {
        out_ << static_cast<std::int64_t>(field.values[i]);
      } else {
        out_ << field.values[i];
      }
      out_ << ((i + 1) % n == 0 ? '\n' : ' ');
    }
  }
};

}  // namespace

Notes write_vtk(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  return VtkWriter(file, mesh, positions, context).write();
}

}  // namespace dmoscope
