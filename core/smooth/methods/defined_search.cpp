#include "core/smooth/methods/defined_search.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/search/grid_search.h"

namespace dmoscope {

namespace {

template <class Real>
Real coordinate(const Vec2<Real>& p, std::size_t axis) {
  return axis == 0 ? p.x : p.y;
}
template <class Real>
Real coordinate(const Vec3Of<Real>& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}
template <class Real>
Vec2<Real> narrowed(Vec2<double> p) {
  return {static_cast<Real>(p.x), static_cast<Real>(p.y)};
}
template <class Real>
Vec3Of<Real> narrowed(Vec3 p) {
  return {static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)};
}

}  // namespace

template <class Frame>
DefinedSearch<Frame>::DefinedSearch(const DefinedStarJudge<Frame>& judge, const SearchParameters& parameters)
    : judge_(judge),
      parameters_(parameters),
      in_double_(parameters.precision == Precision::Double || judge.judge.needs_double()),
      narrow_(formula_kernel<float>(parameters.simd.value_or(best_simd_level()))),
      wide_(formula_kernel<double>(parameters.simd.value_or(best_simd_level()))) {}

/// Search for one vertex.
template <class Frame>
template <class Real>
struct DefinedSearch<Frame>::Visit {
  using Point = OffsetIn<Frame, Real>;
  static constexpr std::size_t kAxes = std::is_same_v<Frame, Plane> ? 2 : 3;

  const DefinedSearch& search;
  const Found& star;
  Room<Real>& room;
  double unit;                                      // unit of the programs' variables, in units of the star's scale
  Real ceiling = std::numeric_limits<Real>::max();  // no place of the vertex has a greater score

  /// Takes in the star's elements, the worst first.
  void gather(PositionView positions, Index vertex) {
    room.elements.clear();
    room.uniforms.clear();
    std::size_t registers = 0;
    const DefinedStarJudge<Frame>& judge = search.judge_;
    const Vec3 here = positions[vertex];
    const double per_unit = unit / star.scale;
    for (const Incidence& at : judge.mesh.star(vertex)) {
      const ElementTarget target = judge.judge.targets().of(at.element);
      const FormulaProgram& program = judge.judge.program(judge.kinds[at.element], target.space, FormulaUse::Places, at.corner);
      const auto corners = judge.mesh.corners_of(at.element);
      const std::size_t first = room.uniforms.size();
      room.uniforms.resize(first + program.uniforms);
      prepare(
          program,
          [&](const FormulaInput& input) {
            if (input.what == FormulaInput::What::Corner)
              return coordinate(judge.mesh.frame.offset(positions[corners[input.index]], here), input.row) * per_unit;
            if (input.what == FormulaInput::What::Origin) return origin(here, input.row);
            return judge.judge.given(input, at.element, target, star.scale / unit);
          },
          room.uniforms.data() + first);
      if (program.ceiling && room.uniforms[first + *program.ceiling] < ceiling) ceiling = room.uniforms[first + *program.ceiling];
      room.elements.push_back({&program, target, first, Real(0)});
      registers = std::max<std::size_t>(registers, program.registers);
    }
    room.registers.reserve(registers * kFormulaBatch);
    for (auto& element : room.elements) {
      for (std::size_t axis = 0; axis < kAxes; ++axis) room.at[axis].assign(1, Real(0));
      element.here = *evaluate(element, 1);
    }
    std::ranges::stable_sort(room.elements, {}, [](const auto& element) { return element.here; });
  }

  /// Origin of the offsets along an axis; only programs in mesh units need it.
  [[nodiscard]] double origin(Vec3 here, std::size_t axis) const {
    if constexpr (std::is_same_v<Frame, Plane>) return coordinate(search.judge_.mesh.frame.project(here), axis);
    return coordinate(here, axis);
  }

  /// Values of one element at the first `count` places of room.at.
  [[nodiscard]] const Real* evaluate(const typename Room<Real>::Element& element, std::size_t count) {
    const FormulaProgram& program = *element.program;
    Real* registers = room.registers.reserve(0);
    const Real* uniforms = room.uniforms.data() + element.first;
    const Real factor = static_cast<Real>(unit);
    for (const FormulaProgram::Given& one : program.varying) {
      Real* to = registers + one.at * kFormulaBatch;
      const Real* from = room.at[one.input.row].data();
      for (std::size_t i = 0; i < count; ++i) to[i] = from[i] * factor;
    }
    const FormulaRun<Real> run{program.steps.data(), program.steps.size(), uniforms, program.uniforms, registers, count};
    if constexpr (std::is_same_v<Real, float>)
      search.narrow_(run);
    else
      search.wide_(run);
    return FormulaResult<Real>(program, uniforms, registers).values();
  }

  /// Evaluates the candidates that were listed, at most kFormulaBatch; the first of the best becomes `best` where it is better.
  void look(Real& best, Point& offset) {
    std::size_t count = room.at[0].size();
    room.least.assign(count, std::numeric_limits<Real>::max());
    Real* least = room.least.data();
    std::array<Real*, kAxes> at;
    for (std::size_t axis = 0; axis < kAxes; ++axis) at[axis] = room.at[axis].data();
    for (const auto& element : room.elements) {
      const Real* values = evaluate(element, count);
      std::size_t left = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const Real worth = values[i] < least[i] ? values[i] : least[i];
        least[left] = worth;
        for (Real* coordinates : at) coordinates[left] = coordinates[i];
        left += worth > best ? 1U : 0U;
      }
      count = left;
      if (count == 0) break;
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (!(room.least[i] > best)) continue;
      best = room.least[i];
      if constexpr (kAxes == 2)
        offset = {room.at[0][i], room.at[1][i]};
      else
        offset = {room.at[0][i], room.at[1][i], room.at[2][i]};
    }
    clear();
  }
  void clear() {
    for (auto& axis : room.at) axis.clear();
  }

  Point run(int levels) {
    Real best = std::numeric_limits<Real>::max();
    for (const auto& element : room.elements) best = std::min(best, element.here);
    Point offset{};
    if (ceiling <= best) return offset;  // its worst corner does not touch the vertex
    const auto box = narrowed<Real>(star.box);
    double omega = search.parameters_.omega;
    clear();
    for (int level = 0; level < levels; ++level) {
      const CandidateGrid<Real, Point> grid{offset, times(box, static_cast<Real>(omega)), search.parameters_.grid_points};
      for (int i = 0; i < grid.points; ++i)
        grid.for_slice(i, [&](int /*index*/, const Point& p) {
          for (std::size_t axis = 0; axis < kAxes; ++axis) room.at[axis].push_back(coordinate(p, axis));
          if (room.at[0].size() == kFormulaBatch) look(best, offset);
        });
      if (!room.at[0].empty()) look(best, offset);
      omega *= 2.0 / (search.parameters_.grid_points - 1);
    }
    return offset;
  }
};

template <class Frame>
template <class Real>
typename DefinedSearch<Frame>::Offset DefinedSearch<Frame>::search(PositionView positions, Index vertex, const Found& star, int levels,
                                                                   Room<Real>& room) const {
  Visit<Real> visit{*this, star, room, judge_.judge.unit_matters() ? star.scale : 1.0};
  visit.gather(positions, vertex);
  const auto found = visit.run(levels);
  if constexpr (std::is_same_v<Frame, Plane>)
    return {static_cast<double>(found.x), static_cast<double>(found.y)};
  else
    return {static_cast<double>(found.x), static_cast<double>(found.y), static_cast<double>(found.z)};
}

template <class Frame>
typename DefinedSearch<Frame>::Found DefinedSearch<Frame>::find(PositionView positions, Index vertex, int levels, Scratch& scratch) const {
  const MeshStar<Frame> star(judge_.mesh, positions, vertex);
  Found found{{}, star.scale(), star.box()};
  found.offset =
      in_double_ ? search(positions, vertex, found, levels, scratch.wide) : search(positions, vertex, found, levels, scratch.narrow);
  return found;
}

template class DefinedSearch<Plane>;
template class DefinedSearch<Space>;

}  // namespace dmoscope
