#pragma once
// Which numbers that a file carried for its elements name materials (regions, parts, ...) and are no results.

#include <string_view>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// What the numbers of a field say about its elements. Results such as pressure name nothing, and neither do numberings: whole numbers of
/// which each stands for less than two elements on average.
enum class Naming {
  Nothing,
  Materials,  // one whole number per element, under a name that programs use for materials: "mat_id", "gmsh:physical", "MaterialIds"
  Geometry,   // likewise for parts of the geometry that was meshed: "gmsh:geometrical", "CellEntityIds". Such parts may be there for the
              // mesher's sake alone, so they count only where nothing else tells elements apart
};
[[nodiscard]] Naming naming_of(const Field& field);

/// The same by the name alone; cases, blanks and signs in it do not matter.
[[nodiscard]] Naming naming_by_name(std::string_view field);

}  // namespace dmoscope
