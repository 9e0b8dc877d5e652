#pragma once
// Which numbers that a file carried for its elements name materials (regions, parts, ...) and are no results.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// What the numbers of a field say about its elements. Results such as pressure name nothing, and neither do numberings: whole numbers of
/// which each stands for less than two elements on average.
enum class Naming {
  Nothing,
  Materials,  // said by a person; or one whole number per element, under a name that programs use for materials: "mat_id", "gmsh:physical",
              // "MaterialIds"
  Geometry,   // likewise for parts of the geometry that was meshed: "gmsh:geometrical", "CellEntityIds". Such parts may be there for the
              // mesher's sake alone, so they count only where nothing else tells elements apart
};
[[nodiscard]] Naming naming_of(const Field& field);

/// The same by the name alone; cases, blanks and signs in it do not matter.
[[nodiscard]] Naming naming_by_name(std::string_view field);

/// Lets the cell data of these names, and no other by a person's word, name materials. Throws UsageError for a name that no cell data have,
/// with those that there are, and for data of several numbers a cell or without some.
void name_materials(Mesh& mesh, std::span<const std::string> names);
/// The names that name_materials() was given, each once.
[[nodiscard]] std::vector<std::string> said_materials(const Mesh& mesh);

/// Of data that name nothing how many different values they have, where they are such that a person may have meant materials: a few whole
/// numbers, under no name of a computer's parts. Else 0.
[[nodiscard]] std::size_t possible_materials(const Field& field);

}  // namespace dmoscope
