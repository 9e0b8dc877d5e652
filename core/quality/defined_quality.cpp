#include "core/quality/defined_quality.h"

#include <array>

#include "core/formula/evaluator.h"

namespace dmoscope {

double defined_quality(const QualityContext& context, const DefinedJudge& judge, PositionView positions, Index element) {
  const ElementTable& elements = context.mesh.elements;
  return defined_quality_at(judge, {context.geometry, context.normals}, elements.kind(element), elements.corners(element), element,
                            [&](Index v) { return positions[v]; });
}

void defined_qualities(const QualityContext& context, const DefinedJudge& judge, std::span<const Vec3> positions, Index first,
                       std::size_t count, double* out) {
  const ElementTable& elements = context.mesh.elements;
  const ElementFrames frames{context.geometry, context.normals};
  std::array<DefinedJudge::Placed, kFormulaBatch> placed;
  for (std::size_t i = 0; i < count;) {  // stretches that one program judges
    const Index e = first + static_cast<Index>(i);
    const FormulaProgram& program = judge.program_for(e, elements.kind(e), kNoIndex);
    std::size_t n = 0;
    for (; i + n < count && n < kFormulaBatch; ++n) {
      const Index other = e + static_cast<Index>(n);
      if (&judge.program_for(other, elements.kind(other), kNoIndex) != &program) break;
      const auto corners = elements.corners(other);
      placed[n].element = other;
      frames.gather(
          corners, other, info(elements.kind(other)).dimension, [&](Index v) { return positions[v]; }, placed[n].corners);
      placed[n].origin = origin_of_corners(context.geometry, positions[corners[0]]);
    }
    judge.qualities(program, std::span(placed).first(n), out + i);
    i += n;
  }
}

}  // namespace dmoscope
