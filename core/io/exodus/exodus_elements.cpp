// Element types of Exodus, and the numbering of their sides.

#include <algorithm>
#include <array>

#include "core/io/exodus/exodus.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {
namespace {

/// Words of element types, in capitals; digits may follow.
struct ExodusWords {
  std::string_view begins;
  CellShape shape;
};
constexpr auto kExodusWords = std::to_array<ExodusWords>({{"SPHERE CIRCLE POINT", CellShape::Point},
                                                          {"TRUSS BEAM BAR ROD EDGE LINE SPRING", CellShape::Line},
                                                          {"TRI", CellShape::Triangle},
                                                          {"QUAD SHELL MEMBRANE", CellShape::Quadrilateral},
                                                          {"TET", CellShape::Tetrahedron},
                                                          {"HEX", CellShape::Hexahedron},
                                                          {"WEDGE PENTA", CellShape::Wedge},
                                                          {"PYR", CellShape::Pyramid}});

struct Side {
  Index count;
  std::array<Index, 4> corners;
};
// Sides from the manual's table, counted from 0.
constexpr std::array kTriangleEdges{Side{2, {0, 1}}, Side{2, {1, 2}}, Side{2, {2, 0}}};
constexpr std::array kQuadrilateralEdges{Side{2, {0, 1}}, Side{2, {1, 2}}, Side{2, {2, 3}}, Side{2, {3, 0}}};
constexpr std::array kTriangleShell{Side{3, {0, 1, 2}}, Side{3, {0, 2, 1}}, Side{2, {0, 1}}, Side{2, {1, 2}}, Side{2, {2, 0}}};
constexpr std::array kQuadrilateralShell{Side{4, {0, 1, 2, 3}}, Side{4, {0, 3, 2, 1}}, Side{2, {0, 1}},
                                         Side{2, {1, 2}},       Side{2, {2, 3}},       Side{2, {3, 0}}};
constexpr std::array kTetrahedron{Side{3, {0, 1, 3}}, Side{3, {1, 2, 3}}, Side{3, {0, 3, 2}}, Side{3, {0, 2, 1}}};
constexpr std::array kHexahedron{Side{4, {0, 1, 5, 4}}, Side{4, {1, 2, 6, 5}}, Side{4, {2, 3, 7, 6}},
                                 Side{4, {0, 4, 7, 3}}, Side{4, {0, 3, 2, 1}}, Side{4, {4, 5, 6, 7}}};
constexpr std::array kWedge{Side{4, {0, 1, 4, 3}}, Side{4, {1, 2, 5, 4}}, Side{4, {0, 3, 5, 2}}, Side{3, {0, 2, 1}}, Side{3, {3, 4, 5}}};
constexpr std::array kPyramid{Side{3, {0, 1, 4}}, Side{3, {1, 2, 4}}, Side{3, {2, 3, 4}}, Side{3, {3, 0, 4}}, Side{4, {0, 3, 2, 1}}};

std::span<const Side> sides_of(CellShape shape, bool faces_too) noexcept {
  switch (shape) {
    case CellShape::Triangle:
      return faces_too ? std::span<const Side>(kTriangleShell) : std::span<const Side>(kTriangleEdges);
    case CellShape::Quadrilateral:
      return faces_too ? std::span<const Side>(kQuadrilateralShell) : std::span<const Side>(kQuadrilateralEdges);
    case CellShape::Tetrahedron:
      return kTetrahedron;
    case CellShape::Hexahedron:
      return kHexahedron;
    case CellShape::Wedge:
      return kWedge;
    case CellShape::Pyramid:
      return kPyramid;
    default:
      return {};
  }
}

}  // namespace

std::optional<CellShape> exodus_shape(std::string_view word, std::uint64_t nodes) noexcept {
  const std::string text = in_capitals(trimmed(word));
  const auto begins = [&](std::string_view prefix) { return text.starts_with(prefix); };
  const auto found = std::ranges::find_if(kExodusWords, [&](const ExodusWords& some) { return any_word(some.begins, begins); });
  if (found == kExodusWords.end()) return std::nullopt;
  CellShape shape = found->shape;
  if (shape == CellShape::Quadrilateral && nodes == 3 && !text.starts_with("QUAD")) shape = CellShape::Triangle;  // for example SHELL3
  if (shape == CellShape::Quadrilateral && nodes == 2 && text.starts_with("SHELL")) shape = CellShape::Line;  // a shell of a planar mesh
  if (corners_of(shape) != nodes) return std::nullopt;
  return shape;
}

bool is_exodus_shell(std::string_view word) noexcept {
  const std::string text = in_capitals(word);
  return text.find("SHELL") != std::string::npos || text.starts_with("MEMBRANE") || text.starts_with("TRI");
}

std::span<const Index> exodus_side(CellShape shape, bool has_faces, std::int64_t side) noexcept {
  const std::span<const Side> sides = sides_of(shape, has_faces);
  if (side < 1 || static_cast<std::uint64_t>(side) > sides.size()) return {};
  const Side& one = sides[static_cast<std::size_t>(side - 1)];
  return {one.corners.data(), one.count};
}

}  // namespace dmoscope
