#include "gpu/defined/program_table.h"

#include <algorithm>

#include "gpu/defined/defined_task.h"

namespace dmoscope::gpu {

ProgramTable::ProgramTable(const InputMesh& input, const DefinedJudge& judge) {
  const ElementTable& elements = input.mesh.elements;
  group_of_element_.reserve(elements.size());
  for (Index e = 0; e < elements.size(); ++e) {
    const ElementTarget target = judge.targets().of(e);
    const ElementGroup group{elements.kind(e), target.space, target.steepness};
    const auto found = std::ranges::find(groups_, group);
    group_of_element_.push_back(static_cast<std::uint16_t>(found - groups_.begin()));
    if (found == groups_.end()) groups_.push_back(group);
  }
  programs_.assign(groups_.size() * kProgramsOfGroup, nullptr);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const ElementGroup& group = groups_[g];
    const auto put = [&](std::size_t which, FormulaUse use, Index moving) {
      programs_[g * kProgramsOfGroup + which] = &judge.program(group.kind, group.space, use, moving);
    };
    for (Index corner = 0; corner < info(group.kind).corners; ++corner) {
      put(corner, FormulaUse::Places, corner);
      if (input.is_volume()) put(DefinedTask::kElements + corner, FormulaUse::Elements, corner);
    }
    put(DefinedTask::kWhole, FormulaUse::Elements, kNoIndex);
  }
}

const FormulaProgram& ProgramTable::for_places(const Incidence& at) const {
  return *programs_[group_of_element_[at.element] * kProgramsOfGroup + at.corner];
}

}  // namespace dmoscope::gpu
