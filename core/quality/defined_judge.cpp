#include "core/quality/defined_judge.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/numeric/small_matrix.h"
#include "core/quality/formula_values.h"

namespace dmoscope {

namespace {

double coordinate(Vec3 p, std::size_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// By element: its own number, or the mean of its corners'.
std::vector<double> numbers_of(const std::string& name, const Mesh& mesh) {
  std::vector<std::string_view> names;
  for (const Field& field : mesh.fields) {
    if (field.components != 1) continue;
    names.push_back(field.name);
    if (field.name != name) continue;
    if (field.on == Field::On::Elements) return field.values;
    std::vector<double> means(mesh.elements.size());
    for (Index e = 0; e < mesh.elements.size(); ++e) {
      const auto corners = mesh.elements.corners(e);
      for (const Index v : corners) means[e] += field.values[v];
      means[e] /= static_cast<double>(corners.size());
    }
    return means;
  }
  if (names.empty()) throw UsageError(fmt::format("the formula reads the field '{}', and the mesh has no fields of single numbers", name));
  throw UsageError(unknown_value("field of the formula", name, names));
}

/// From there on a search in floats finds worse places than one in double, along no axis.
constexpr double kFarStretched = 3e3;

/// The matrix of an element's first corner (or of the whole element, where it has one).
SmallMatrix first_matrix(const ElementTarget& target, std::size_t dimension) {
  SmallMatrix matrix{static_cast<int>(dimension), {}};
  for (std::size_t row = 0; row < dimension; ++row)
    for (std::size_t column = 0; column < dimension; ++column) matrix.at[row][column] = target.matrices[row * dimension + column];
  return matrix;
}

}  // namespace

DefinedJudge::DefinedJudge(const DefinedMetric& metric, const Mesh& mesh, const ElementFrames& frames)
    : metric_(metric),
      targets_(metric.target, mesh, frames,
               [&metric](ElementKind kind, double ratio) { return value_of_stretched(*metric.formula, kind, ratio); }),
      element_count_(mesh.elements.size()),
      dimension_(frames.geometry.shape == Shape::Volume ? 3 : 2) {
  bool seen[kElementKindCount][kFormulaSpaces] = {};
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const ElementKind kind = mesh.elements.kind(e);
    const ElementTarget target = targets_.of(e);
    const FormulaSpace space = target.space;
    stretches_far_ = stretches_far_ || (target.matrices != nullptr && !(condition(first_matrix(target, dimension_)) < kFarStretched));
    bool& known = seen[static_cast<std::size_t>(kind)][static_cast<std::size_t>(space)];
    if (known) continue;
    known = true;
    if (const std::string why = metric.formula->why_not(kind, space); !why.empty())
      throw UsageError(fmt::format("{} is not defined for {}{}: {}", metric.name, info(kind).plural,
                                   space == FormulaSpace::Plain ? "" : " that have a target", why));
    if (space == FormulaSpace::Plain) unit_matters_ = unit_matters_ || !metric.formula->scale_free(kind) || metric.formula->uses_fields();
  }
  unit_matters_ = unit_matters_ || metric.formula->uses_place();
  if (metric.formula->uses_place() && frames.geometry.shape == Shape::Surface)
    throw UsageError(fmt::format("{} depends on where elements lie, which is not possible on curved surfaces", metric.name));
  if (metric.formula->uses_place() && mesh.degrees)
    throw UsageError(fmt::format("{} depends on where elements lie, which is not possible on the Earth (--geographic off)", metric.name));
  if (metric.formula->uses_place() && frames.geometry.plane.period > 0.0)
    throw UsageError(
        fmt::format("{} depends on where elements lie, which is not possible in meshes that go round in longitude", metric.name));
  for (const std::string& name : metric.formula->fields()) {
    const std::vector<double> numbers = numbers_of(name, mesh);
    fields_.insert(fields_.end(), numbers.begin(), numbers.end());
  }
}

double DefinedJudge::quality(Index element, ElementKind kind, const Corners& corners, Vec3 origin, Index moving) const {
  const Placed placed{element, corners, origin};
  double value = 0.0;
  qualities(program_for(element, kind, moving), {&placed, 1}, &value);
  return value;
}

void DefinedJudge::qualities(const FormulaProgram& program, std::span<const Placed> elements, double* out) const {
  FormulaValues values(program);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Placed& one = elements[i];
    const ElementTarget target = targets_.of(one.element);
    values.set(i, [&](const FormulaInput& input) {
      if (input.what == FormulaInput::What::Corner) return coordinate(one.corners[input.index], input.row);
      if (input.what == FormulaInput::What::Origin) return coordinate(one.origin, input.row);
      return given(input, one.element, target, 1.0);
    });
  }
  values.run();
  for (std::size_t i = 0; i < elements.size(); ++i) out[i] = settled(values.quality(i), targets_.of(elements[i].element));
}

const DefinedJudges::Made& DefinedJudges::made(Metric metric, const Mesh& mesh, const ElementFrames& frames) const {
  const std::lock_guard lock(mutex_);
  Made& made = judges_[metric];
  if (made.judge || made.why_not) return made;
  try {
    made.judge = std::make_shared<const DefinedJudge>(defined(metric), mesh, frames);
  } catch (const UsageError&) {
    made.why_not = std::current_exception();
  } catch (const InputError&) {  // of a metric field
    made.why_not = std::current_exception();
  }
  return made;
}

std::shared_ptr<const DefinedJudge> DefinedJudges::of(Metric metric, const Mesh& mesh, const ElementFrames& frames) const {
  const Made& found = made(metric, mesh, frames);
  if (!found.judge) std::rethrow_exception(found.why_not);
  return found.judge;
}

std::shared_ptr<const DefinedJudge> DefinedJudges::find(Metric metric, const Mesh& mesh, const ElementFrames& frames) const {
  return made(metric, mesh, frames).judge;
}

}  // namespace dmoscope
