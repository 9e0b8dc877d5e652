#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "core/base/error.h"
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

}  // namespace dmoscope
