// Element types and boundary conditions of CGNS.

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/io/cgns/cgns.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {
namespace {

constexpr auto kCgnsTypes = std::to_array<std::string_view>(
    {"null",     "user defined", "NODE",     "BAR_2",    "BAR_3",   "TRI_3",   "TRI_6",    "QUAD_4",     "QUAD_8",
     "QUAD_9",   "TETRA_4",      "TETRA_10", "PYRA_5",   "PYRA_14", "PENTA_6", "PENTA_15", "PENTA_18",   "HEXA_8",
     "HEXA_20",  "HEXA_27",      "MIXED",    "PYRA_13",  "NGON_n",  "NFACE_n", "BAR_4",    "TRI_9",      "TRI_10",
     "QUAD_12",  "QUAD_16",      "TETRA_16", "TETRA_20", "PYRA_21", "PYRA_29", "PYRA_30",  "PENTA_24",   "PENTA_38",
     "PENTA_40", "HEXA_32",      "HEXA_56",  "HEXA_64",  "BAR_5",   "TRI_12",  "TRI_15",   "QUAD_P4_16", "QUAD_25"});

/// Reads the numbers of a range or a list, of whatever kind.
bool take_numbers(const CgnsTree& tree, const CgnsNode& node, CgnsCondition& into) {
  for (const CgnsNode& child : tree.children(node.path)) {
    const bool range = child.label == "IndexRange_t" && (child.name == "PointRange" || child.name == "ElementRange");
    const bool list = child.label == "IndexArray_t" && (child.name == "PointList" || child.name == "ElementList");
    if (!range && !list) continue;
    into.numbers = tree.wholes(child);
    into.of_range = range;
    if (child.name.starts_with("Element") && into.location.empty()) into.location = "FaceCenter";
    return true;
  }
  return false;
}

}  // namespace

std::optional<CellShape> cgns_shape(std::int64_t type) noexcept {
  constexpr std::array<std::int64_t, kCellShapeCount> kShapeTypes{2, 3, 5, 7, 10, 17, 14, 12};  // types in the order of CellShape
  const auto* const at = std::ranges::find(kShapeTypes, type);
  return at == kShapeTypes.end() ? std::nullopt : std::optional(static_cast<CellShape>(at - kShapeTypes.begin()));
}

std::string cgns_type_name(std::int64_t type) {
  if (type >= 0 && static_cast<std::size_t>(type) < kCgnsTypes.size()) return std::string(kCgnsTypes[static_cast<std::size_t>(type)]);
  return fmt::format("of type {}", type);
}

std::vector<CgnsCondition> read_cgns_conditions(const CgnsTree& tree, const CgnsZone& zone) {
  std::vector<CgnsCondition> found;
  for (const CgnsNode& all : tree.children(zone.node, "ZoneBC_t")) {
    for (const CgnsNode& node : tree.children(all, "BC_t")) {
      CgnsCondition one{.name = node.name, .family = {}, .numbers = {}, .location = {}};
      if (const auto location = tree.child(node, "GridLocation_t")) one.location = tree.text(*location);
      if (const auto family = tree.child(node, "FamilyName_t")) one.family = tree.text(*family);
      if (!take_numbers(tree, node, one)) continue;
      one.of_vertices = one.location.empty() || one.location == "Vertex";
      found.push_back(std::move(one));
    }
  }
  return found;
}

}  // namespace dmoscope
