#include "mpi/mesh/mesh_block.h"

#include <algorithm>

#include "core/mesh/materials.h"

namespace dmoscope {

bool FieldFilter::wants(const std::string& name, Field::On on) const {
  if (std::ranges::find(names, name) != names.end()) return true;
  return on == Field::On::Elements && naming_by_name(name) != Naming::Nothing;
}

}  // namespace dmoscope
