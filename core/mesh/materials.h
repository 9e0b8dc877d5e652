#pragma once
// Fields of a file whose numbers name materials (regions, parts, ...) of its elements and are no results.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// Meaning of a field's numbers for its elements. Results such as pressure name nothing, and neither do numberings: whole numbers that each
/// stand for less than two elements on average.
enum class Naming {
  Nothing,
  Materials,  // named by the user; or one whole number per element, under a name that programs use for materials: "mat_id",
              // "gmsh:physical", "MaterialIds"
  Geometry,   // one whole number per element, under a name that programs use for parts of the geometry that was meshed: "gmsh:geometrical",
              // "CellEntityIds". Such parts may be there for the mesher's sake alone, so they count only if nothing else tells elements
              // apart
};
[[nodiscard]] Naming naming_of(const Field& field);

/// Meaning of a field by its name alone; case, blanks and punctuation in it do not matter.
[[nodiscard]] Naming naming_by_name(std::string_view field);

/// Makes the cell data of these names, and no others by the user's word, name materials. Throws UsageError, with the names that there are,
/// for a name that no cell data have, and for data with several numbers a cell or with missing ones.
void name_materials(Mesh& mesh, std::span<const std::string> names);
/// The names that name_materials() was given, each once.
[[nodiscard]] std::vector<std::string> said_materials(const Mesh& mesh);

/// Number of different values of a field that names nothing but may mean materials: a few whole numbers, under no name of a computer's
/// parts. Else 0.
[[nodiscard]] std::size_t possible_materials(const Field& field);

}  // namespace dmoscope
