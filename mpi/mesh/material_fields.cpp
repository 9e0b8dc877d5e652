#include "mpi/mesh/material_fields.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/mesh/materials.h"

namespace dmoscope {
namespace {

constexpr double kLargestWhole = 9e15;

/// Counts the different values of the field on all ranks; 0 if one of them is not a whole number.
std::uint64_t count_different(const World& world, const BlockField& field) {
  std::vector<double> values = field.values;
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  const bool whole = std::ranges::all_of(values, [](double v) { return v == std::floor(v) && std::abs(v) <= kLargestWhole; });
  if (world.any(!whole)) return 0;
  // Equal values meet on one rank.
  std::vector<std::vector<double>> to(static_cast<std::size_t>(world.size()));
  for (const double value : values) {
    const std::uint64_t mixed = std::bit_cast<std::uint64_t>(value + 0.0) * 0x9e3779b97f4a7c15U;  // + 0.0 turns -0 into 0
    to[(mixed >> 32U) % to.size()].push_back(value + 0.0);
  }
  std::vector<double> here = world.exchange(to).values;
  std::ranges::sort(here);
  return world.sum(static_cast<std::uint64_t>(std::unique(here.begin(), here.end()) - here.begin()));
}

}  // namespace

std::vector<std::size_t> material_fields(const World& world, const MeshBlock& block) {
  std::vector<std::size_t> found;
  for (const Naming naming : {Naming::Materials, Naming::Geometry}) {
    if (!found.empty()) return found;
    for (std::size_t f = 0; f < block.fields.size(); ++f) {
      const BlockField& field = block.fields[f];
      if (field.on != Field::On::Elements || naming_by_name(field.name) != naming) continue;
      const std::uint64_t different = count_different(world, field);
      const bool numbering = 2 * different > block.elements.size() && different > 2;  // see naming_of()
      if (different >= 2 && !numbering) found.push_back(f);
    }
  }
  return found;
}

}  // namespace dmoscope
