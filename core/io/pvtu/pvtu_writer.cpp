#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "core/base/box.h"
#include "core/base/error.h"
#include "core/base/xml_text.h"
#include "core/io/format.h"
#include "core/io/pvtu/pvtu.h"
#include "core/io/vtu/vtu.h"
#include "core/io/writing/text_writer.h"
#include "core/mesh/hilbert_curve.h"

namespace dmoscope {
namespace {

constexpr std::size_t kElementsOfPiece = 1'000'000;

/// The piece of each element: a stretch of a Hilbert curve along which its lowest vertex lies.
std::vector<std::size_t> pieces_of_elements(const Mesh& mesh, std::span<const Vec3> positions, std::size_t pieces) {
  const PointBox box = box_of(positions);
  const HilbertCurve curve(box.low, box.high);
  std::vector<std::pair<std::uint64_t, Index>> order;
  for (Index e = 0; e < mesh.elements.size(); ++e) order.emplace_back(curve.key(positions[std::ranges::min(mesh.elements.corners(e))]), e);
  std::ranges::sort(order);
  std::vector<std::size_t> piece(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) piece[order[i].second] = i * pieces / order.size();
  return piece;
}

/// A field with some rows of another.
Field rows_of(const Field& field, std::span<const Index> rows) {
  Field some{field.name, field.on, field.components, field.type, field.role, {}};
  const auto n = static_cast<std::size_t>(field.components);
  for (const Index row : rows)
    for (std::size_t k = 0; k < n; ++k) some.values.push_back(field.values[row * n + k]);
  return some;
}

Field ids_of(std::string name, Field::On on, std::span<const Index> rows) {
  Field ids{std::move(name), on, 1, "Int64", "GLOBAL_IDS", {}};
  ids.values.assign(rows.begin(), rows.end());
  return ids;
}

class PvtuWriter {
 public:
  PvtuWriter(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context)
      : file_(file), mesh_(mesh), positions_(positions), context_(context) {
    const std::size_t count = mesh.elements.size();
    pieces_ = context.pieces != 0 ? context.pieces : (count + kElementsOfPiece - 1) / kElementsOfPiece;
    pieces_ = std::max<std::size_t>(1, std::min(pieces_, count));
  }

  Notes write() {
    choose_fields();
    const FormerMesh former(file_.path());
    for (std::size_t p = 0; p < pieces_; ++p) former.require_own(file_.path().parent_path() / pvtu_piece_name(file_.path(), p));
    const std::vector<std::size_t> piece = pieces_of_elements(mesh_, positions_, pieces_);
    std::vector<std::vector<Index>> elements(pieces_);
    for (Index e = 0; e < piece.size(); ++e) elements[piece[e]].push_back(e);
    write_head();
    std::vector<std::unique_ptr<AtomicFile>> files;
    for (std::size_t p = 0; p < pieces_; ++p) {
      const Progress::Part part(context_.progress, p, pieces_);
      const std::string name = pvtu_piece_name(file_.path(), p);
      files.push_back(std::make_unique<AtomicFile>(file_.path().parent_path() / name));
      write_piece(*files.back(), elements[p], p == 0 ? unused_vertices() : std::vector<Index>());
      files.back()->finish();
      file_.write(fmt::format("    <Piece Source=\"{}\"/>\n", xml_escaped(name)));
    }
    file_.write("  </PUnstructuredGrid>\n</VTKFile>\n");
    for (const auto& one : files) one->commit();
    Notes notes;
    note_dropped(mesh_, kept_, {}, "PVTU", notes);
    return notes;
  }

 private:
  /// Chooses the fields' types for all pieces: each piece alone would choose the narrowest for its values.
  void choose_fields() {
    for (std::size_t i = 0; i < mesh_.fields.size(); ++i) {
      const Field& field = mesh_.fields[i];
      if (is_id_field(field)) continue;  // ids of a mesh of which this was a part: the pieces get ids of their own
      const std::size_t rows = field.on == Field::On::Vertices ? positions_.size() : mesh_.elements.size();
      if (field.components < 1 || field.values.size() != rows * static_cast<std::size_t>(field.components)) continue;
      kept_.push_back(i);
      types_.emplace_back(vtu_type_word(field));
    }
  }

  void write_head() {
    file_.write("<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\">\n  <PUnstructuredGrid GhostLevel=\"0\">\n");
    for (const auto& [on, element, ids] :
         {std::tuple(Field::On::Vertices, "PPointData", "GlobalNodeIds"), std::tuple(Field::On::Elements, "PCellData", "GlobalCellIds")}) {
      file_.write(fmt::format("    <{}>\n", element));
      for (std::size_t k = 0; k < kept_.size(); ++k) {
        const Field& field = mesh_.fields[kept_[k]];
        if (field.on == on)
          file_.write(fmt::format("      <PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n", types_[k],
                                  xml_escaped(field.name), field.components));
      }
      file_.write(fmt::format("      <PDataArray type=\"Int64\" Name=\"{}\" NumberOfComponents=\"1\"/>\n    </{}>\n", ids, element));
    }
    file_.write("    <PPoints>\n      <PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n    </PPoints>\n");
  }

  /// Vertices of no element, which some piece must have.
  [[nodiscard]] std::vector<Index> unused_vertices() const {
    std::vector<std::uint8_t> used(positions_.size(), 0);
    for (const Index v : mesh_.elements.all_corners()) used[v] = 1;
    std::vector<Index> unused;
    for (Index v = 0; v < used.size(); ++v)
      if (used[v] == 0) unused.push_back(v);
    return unused;
  }

  /// Writes a piece. `vertices`: those besides its elements' corners.
  void write_piece(AtomicFile& file, std::span<const Index> elements, std::vector<Index> vertices) {
    for (const Index e : elements) {
      const auto corners = mesh_.elements.corners(e);
      vertices.insert(vertices.end(), corners.begin(), corners.end());
    }
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    Mesh piece;
    std::vector<Vec3> places;
    for (const Index v : vertices) places.push_back(positions_[v]);
    for (const Index e : elements) {
      FileCorners corners = file_corners(mesh_, e);
      for (std::size_t i = 0; i < corners.size(); ++i)
        corners.at[i] = static_cast<Index>(std::ranges::lower_bound(vertices, corners[i]) - vertices.begin());
      piece.elements.add(mesh_.elements.kind(e), corners);
    }
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      const Field& field = mesh_.fields[kept_[k]];
      Field some = rows_of(field, field.on == Field::On::Vertices ? std::span<const Index>(vertices) : elements);
      some.type = types_[k];
      piece.fields.push_back(std::move(some));
    }
    piece.fields.push_back(ids_of("GlobalNodeIds", Field::On::Vertices, vertices));
    piece.fields.push_back(ids_of("GlobalCellIds", Field::On::Elements, elements));
    write_vtu(file, piece, places, context_);
  }

  AtomicFile& file_;
  const Mesh& mesh_;
  std::span<const Vec3> positions_;
  const IoContext& context_;
  std::size_t pieces_ = 1;
  std::vector<std::size_t> kept_;   // fields to be written
  std::vector<std::string> types_;  // types of these fields
};

}  // namespace

Notes write_pvtu(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  return PvtuWriter(file, mesh, positions, context).write();
}

}  // namespace dmoscope
