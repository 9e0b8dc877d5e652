#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <sstream>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "core/base/error.h"
#include "core/base/same_bits.h"
#include "core/io/format.h"
#include "core/io/mesh_io.h"
#include "core/io/pvtu/pvtu.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {

namespace {

/// Parses the document and returns the element PUnstructuredGrid.
pugi::xml_node parse(pugi::xml_document& document, std::string_view bytes, const std::filesystem::path& path) {
  const auto line_of = [&](std::ptrdiff_t offset) {
    const auto before = bytes.substr(0, static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
    return static_cast<std::size_t>(1 + std::ranges::count(before, '\n'));
  };
  const pugi::xml_parse_result result = document.load_buffer(bytes.data(), bytes.size(), pugi::parse_default | pugi::parse_declaration);
  if (!result) throw InputError(path.string(), line_of(result.offset), fmt::format("not well-formed XML: {}", result.description()));
  const pugi::xml_node file = document.child("VTKFile");
  if (std::string_view(file.attribute("type").value()) != "PUnstructuredGrid")
    throw InputError(path.string(), line_of(file.offset_debug()),
                     "a PVTU file holds a VTKFile of type PUnstructuredGrid, this one does not");
  const pugi::xml_node grid = file.child("PUnstructuredGrid");
  if (!grid.child("Piece")) throw InputError(path.string(), line_of(file.offset_debug()), "it names no pieces");
  for (const pugi::xml_node piece : grid.children("Piece"))
    if (!piece.attribute("Source") || *piece.attribute("Source").value() == '\0')
      throw InputError(path.string(), line_of(piece.offset_debug()), "a Piece without a Source, the file that holds it");
  return grid;
}

constexpr std::array<std::string_view, 5> kVertexIds{"GlobalNodeIds", "GlobalNodeId", "GlobalPointIds", "GlobalPointId", "GlobalVertexIds"};
constexpr std::array<std::string_view, 4> kElementIds{"GlobalCellIds", "GlobalCellId", "GlobalElementIds", "GlobalElementId"};

void require_ids(const Field* field, const Mesh& piece) {
  constexpr double kExact = 9007199254740992.0;  // 2^53
  if (field == nullptr) return;
  for (const double id : field->values)
    if (!(id >= 0.0 && id < kExact && id == std::floor(id)))
      throw InputError(piece.source ? piece.source->path().string() : piece.name, 0,
                       fmt::format("{} has {}: ids are whole numbers from 0 on", field->name, id));
}

}  // namespace

std::vector<std::filesystem::path> pvtu_pieces(std::string_view bytes, const std::filesystem::path& path) {
  pugi::xml_document document;
  std::vector<std::filesystem::path> pieces;
  for (const pugi::xml_node piece : parse(document, bytes, path).children("Piece"))
    pieces.push_back(path.parent_path() / piece.attribute("Source").value());
  for (const std::filesystem::path& piece : pieces)  // refuses a piece that names pieces again
    if (!equal_ignoring_case(piece.extension().string(), ".vtu"))
      throw InputError(path.string(), 0, fmt::format("its piece {} is no .vtu", quote_token(piece.filename().string())));
  return pieces;
}

std::string pvtu_with_pieces(std::string_view bytes, const std::filesystem::path& path, const std::vector<std::string>& names) {
  pugi::xml_document document;
  auto name = names.begin();
  for (pugi::xml_node piece : parse(document, bytes, path).children("Piece"))
    if (name != names.end()) piece.attribute("Source").set_value((name++)->c_str());
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

std::string pvtu_piece_name(const std::filesystem::path& path, std::size_t piece) {
  return fmt::format("{}_{}.vtu", path.stem().string(), piece);
}

bool is_pvtu_piece_name(const std::filesystem::path& path, const std::filesystem::path& file) {
  const std::string stem = path.stem().string() + '_', name = file.stem().string();
  return file.extension() == ".vtu" && name.size() > stem.size() && name.starts_with(stem) &&
         name.find_first_not_of("0123456789", stem.size()) == std::string::npos;
}

bool is_id_field(const Field& field) {
  if (field.components != 1) return false;
  const auto names =
      field.on == Field::On::Vertices ? std::span<const std::string_view>(kVertexIds) : std::span<const std::string_view>(kElementIds);
  return field.role == "GLOBAL_IDS" ||
         std::ranges::any_of(names, [&](std::string_view name) { return equal_ignoring_case(field.name, name); });
}

PieceIds piece_ids(const Mesh& piece) {
  PieceIds ids;
  for (const Field& field : piece.fields) {
    const bool of_vertices = field.on == Field::On::Vertices;
    const Field*& which = of_vertices ? ids.vertices : ids.elements;
    if (is_id_field(field) && which == nullptr) which = &field;
    if (!of_vertices && field.components == 1 && field.name == "vtkGhostType") ids.ghosts = &field;
  }
  require_ids(ids.vertices, piece);
  require_ids(ids.elements, piece);
  return ids;
}

namespace {

struct BitsHash {
  std::size_t operator()(const std::array<std::uint64_t, 3>& bits) const noexcept {
    std::uint64_t mixed = 0;
    for (const std::uint64_t b : bits) mixed = (mixed ^ b ^ (mixed >> 29U)) * 0x9e3779b97f4a7c15U;
    return static_cast<std::size_t>(mixed ^ (mixed >> 32U));
  }
};
std::array<std::uint64_t, 3> bits_of(Vec3 p) {
  return {std::bit_cast<std::uint64_t>(p.x), std::bit_cast<std::uint64_t>(p.y), std::bit_cast<std::uint64_t>(p.z)};
}

class Joiner {
 public:
  Joiner(const std::vector<Mesh>& pieces, const std::string& file, std::vector<std::string>& notes)
      : pieces_(pieces), file_(file), notes_(notes), number_(pieces.size()) {
    for (const Mesh& piece : pieces) ids_.push_back(piece_ids(piece));
  }

  Mesh join() {
    if (all_have(&PieceIds::vertices))
      number_by_id();
    else
      number_by_place();
    order_elements();
    for (const auto& [p, e] : order_) {
      const auto corners = pieces_[p].elements.corners(e);
      std::array<Index, 8> own{};
      for (std::size_t i = 0; i < corners.size(); ++i) own[i] = number_[p][corners[i]];
      mesh_.elements.add(pieces_[p].elements.kind(e), std::span(own).first(corners.size()));
    }
    fields();
    for (const Mesh& piece : pieces_)
      if (!piece.groups.empty()) {
        notes_.push_back("Cells of its pieces that are no elements were passed over.");
        break;
      }
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] bool all_have(const Field* PieceIds::*which) const {
    return std::ranges::all_of(ids_, [which](const PieceIds& ids) { return ids.*which != nullptr; });
  }

  void number_by_id() {
    std::vector<double> all;
    for (const PieceIds& ids : ids_) all.insert(all.end(), ids.vertices->values.begin(), ids.vertices->values.end());
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    mesh_.positions.resize(all.size());
    std::vector<std::uint8_t> met(all.size(), 0);
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      for (Index v = 0; v < pieces_[p].vertex_count(); ++v) {
        const double id = ids_[p].vertices->values[v];
        const auto at = static_cast<Index>(std::ranges::lower_bound(all, id) - all.begin());
        number_[p].push_back(at);
        if (met[at] != 0 && !same_bits(mesh_.positions[at], pieces_[p].positions[v]))
          throw InputError(file_, 0, fmt::format("pieces disagree on where vertex {} stands ({})", id, pieces_[p].name));
        met[at] = 1;
        mesh_.positions[at] = pieces_[p].positions[v];
      }
    }
  }

  void number_by_place() {
    std::unordered_map<std::array<std::uint64_t, 3>, Index, BitsHash> known;
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      for (const Vec3& position : pieces_[p].positions) {
        const auto [at, added] = known.try_emplace(bits_of(position), static_cast<Index>(mesh_.positions.size()));
        if (added) mesh_.positions.push_back(position);
        number_[p].push_back(at->second);
      }
    }
  }

  void order_elements() {
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      for (Index e = 0; e < pieces_[p].elements.size(); ++e)
        if (!ids_[p].is_ghost(e)) order_.emplace_back(p, e);
    if (!all_have(&PieceIds::elements)) return;
    const auto id = [this](const auto& one) { return ids_[one.first].elements->values[one.second]; };
    std::ranges::stable_sort(order_, {}, id);
    order_.erase(std::unique(order_.begin(), order_.end(), [&](const auto& a, const auto& b) { return id(a) == id(b); }), order_.end());
  }

  /// The field of another piece that corresponds to `like`; null: it has none.
  static const Field* find(const Mesh& piece, const Field& like) {
    const auto found = std::ranges::find_if(piece.fields, [&](const Field& field) {
      return field.on == like.on && field.name == like.name && field.components == like.components;
    });
    return found == piece.fields.end() ? nullptr : &*found;
  }

  void fields() {
    for (const Field& first : pieces_.front().fields) {
      if (&first == ids_.front().ghosts) continue;
      std::vector<const Field*> all;
      for (const Mesh& piece : pieces_) all.push_back(find(piece, first));
      if (std::ranges::find(all, nullptr) != all.end()) {
        notes_.push_back(fmt::format("Field \"{}\" was left out: not all pieces have it.", first.name));
        continue;
      }
      Field joined{first.name, first.on, first.components, first.type, first.role, {}};
      fill(joined, all);
      const bool is_id = &first == ids_.front().vertices || &first == ids_.front().elements;
      if (!is_id || !counts_up(joined.values)) mesh_.fields.push_back(std::move(joined));
    }
  }
  static bool counts_up(const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] != static_cast<double>(i)) return false;
    return true;
  }
  void fill(Field& joined, const std::vector<const Field*>& all) const {
    const auto n = static_cast<std::size_t>(joined.components);
    if (joined.on == Field::On::Elements) {
      for (const auto& [p, e] : order_) {
        const auto row = all[p]->values.begin() + static_cast<std::ptrdiff_t>(e * n);
        joined.values.insert(joined.values.end(), row, row + static_cast<std::ptrdiff_t>(n));
      }
      return;
    }
    joined.values.resize(n * mesh_.positions.size());
    for (std::size_t p = pieces_.size(); p-- > 0;)  // in reverse, so that the first piece's are kept
      for (std::size_t v = 0; v < number_[p].size(); ++v)
        std::copy_n(all[p]->values.begin() + static_cast<std::ptrdiff_t>(v * n), n,
                    joined.values.begin() + static_cast<std::ptrdiff_t>(number_[p][v] * n));
  }

  const std::vector<Mesh>& pieces_;
  const std::string& file_;
  std::vector<std::string>& notes_;
  std::vector<PieceIds> ids_;
  std::vector<std::vector<Index>> number_;            // numbers of each piece's vertices in the mesh
  std::vector<std::pair<std::size_t, Index>> order_;  // piece and number there of each element
  Mesh mesh_;
};

bool recognises_pvtu(std::string_view bytes) {
  constexpr std::size_t kLook = 4096;
  const std::string_view begin = bytes.substr(0, kLook);
  return begin.find("<VTKFile") != std::string_view::npos && begin.find("PUnstructuredGrid") != std::string_view::npos;
}

}  // namespace

Mesh join_pieces(const std::vector<Mesh>& pieces, const std::string& file, std::vector<std::string>& notes) {
  return Joiner(pieces, file, notes).join();
}

namespace {

Mesh read_pvtu(SourceFile& source, const IoContext& context) {
  std::vector<Mesh> pieces;
  const std::vector<std::filesystem::path> paths = pvtu_pieces(source.bytes(), source.path());
  bool floats = false;
  for (std::size_t p = 0; p < paths.size(); ++p) {
    const Progress::Part part(context.progress, p, paths.size());
    pieces.push_back(read_mesh(paths[p], context));
    floats = floats || pieces.back().single_precision;
    pieces.back().source.reset();
  }
  source.set_not_patchable("its pieces are written anew");
  CoordinateLayout layout;
  if (floats) layout.scalar.fill(CoordinateScalar::Float32);
  source.set_layout(layout);
  std::vector<std::string> notes;
  Mesh mesh = join_pieces(pieces, source.path().string(), notes);
  for (std::string& note : notes) source.add_note(std::move(note));
  return mesh;
}

}  // namespace

constinit const FormatHandler kPvtuFormat{
    .info = {"pvtu", "PVTU", ".pvtu", "a mesh in pieces, each a VTU file: 2D and 3D elements, point and cell data"},
    .recognises = recognises_pvtu,
    .read = read_pvtu,
    .write = write_pvtu,
    .further = [](const SourceFile& source, const IoContext&) { return pvtu_pieces(source.bytes(), source.path()); },
    .writes_beside = is_pvtu_piece_name};

}  // namespace dmoscope
