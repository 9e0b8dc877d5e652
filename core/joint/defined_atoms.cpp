#include "core/joint/defined_atoms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "core/formula/dual_program.h"
#include "core/joint/dual_atom.h"
#include "core/joint/mean_ratio_atom.h"
#include "core/joint/surface_atom.h"
#include "core/quality/quality.h"

namespace dmoscope {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Ratio of a guard's f at the begin to the greatest of the metric's: it holds an atom only once its mean ratio is a thousandth of what it
/// was.
constexpr double kGuard = 1e-3;

/// First corner whose vertex and neighbours are all that the piece depends on.
std::optional<std::uint8_t> frame_for(ElementKind kind, std::uint8_t corners) {
  const auto frames = corner_frames(kind);
  const std::size_t ends = static_cast<std::size_t>(info(kind).dimension) + 1;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    unsigned has = 0;
    for (std::size_t k = 0; k < ends; ++k) has |= 1U << frames[i][k];
    if ((corners & ~has) == 0) return static_cast<std::uint8_t>(i);
  }
  return std::nullopt;
}

/// Returns whether the formula is 0 or less in all inverted elements of the kind that were looked at.
bool sees_inversion(const DefinedMetric& metric, ElementKind kind) {
  const auto found = std::ranges::find(metric.facts.kinds, kind, &FormulaFacts::OfKind::kind);
  return found != metric.facts.kinds.end() && found->greatest_inverted <= 0.0;
}

/// Spaces in which elements may be measured.
std::span<const FormulaSpace> spaces_of(const DefinedMetric& metric) {
  static constexpr std::array kAll{FormulaSpace::Plain, FormulaSpace::Target, FormulaSpace::Stretched};
  return metric.target.is_ideal() ? std::span(kAll).first(1) : std::span(kAll);
}

}  // namespace

template <int D>
DefinedAtoms<D>::DefinedAtoms(const InputMesh& input, Metric metric)
    : input_(&input),
      dimension_(input.is_surface() ? 2 : D),
      frame_(input.view<Curved>().frame),
      judge_(input.quality_context().judge(metric)) {
  const QualityContext context = input.quality_context();
  const ElementTable& elements = input.mesh.elements;
  double least = kInfinity;
  for (Index e = 0; e < elements.size(); ++e)
    if (info(elements.kind(e)).dimension == dimension_ && smallest_jacobian(context, input.mesh.positions, e) > 0.0)
      least = std::min(least, element_quality(context, input.mesh.positions, metric, e));
  if (least <= 0.0) shift_ = 1.0 - 2.0 * least;
  for (std::size_t k = 0; k < kElementKindCount; ++k) {
    const auto kind = static_cast<ElementKind>(k);
    if (std::ranges::find(elements.kinds(), kind) == elements.kinds().end() || info(kind).dimension != dimension_) continue;
    for (const FormulaSpace space : spaces_of(judge_->metric())) find_pieces(kind, space);
  }
}

template <int D>
void DefinedAtoms<D>::find_pieces(ElementKind kind, FormulaSpace space) {
  const Formula& formula = *judge_->metric().formula;
  if (!formula.why_not(kind, space).empty()) return;  // no element of the mesh is measured there
  OfKind& found = kinds_[static_cast<std::size_t>(space) * kElementKindCount + static_cast<std::size_t>(kind)];
  found.pieces = formula.pieces(kind, space);
  for (const FormulaPiece& piece : found.pieces) found.frames.push_back(frame_for(kind, piece.corners).value());
  const bool sees = sees_inversion(judge_->metric(), kind) && shift_ == 0.0;
  for (std::uint8_t frame = 0; frame < corner_frames(kind).size(); ++frame)
    if (!sees || std::ranges::find(found.frames, frame) == found.frames.end()) found.guarded.push_back(frame);
}

template <int D>
void DefinedAtoms<D>::append(const ElementTable& elements, Index element, std::vector<Atom<D>>& atoms) const {
  const ElementKind kind = elements.kind(element);
  const auto corners = elements.corners(element);
  const OfKind& all = of(kind, judge_->targets().of(element).space);
  const bool on_surface = dimension_ < D;
  const auto add = [&](std::uint8_t frame, std::uint16_t piece) {
    Atom<D> atom{{}, element, on_surface ? surface_shape(kind) : static_cast<AtomShape>(kind), frame, piece};
    for (std::size_t k = 0; k <= static_cast<std::size_t>(dimension_); ++k) atom.vertices[k] = corners[corner_frames(kind)[frame][k]];
    if (on_surface) atom.vertices.back() = corners[opposite_corner(corners.size(), frame)];
    atoms.push_back(atom);
  };
  for (std::size_t i = 0; i < all.pieces.size(); ++i)
    if (all.pieces[i].corners != 0) add(all.frames[i], static_cast<std::uint16_t>(i));
  for (const std::uint8_t frame : all.guarded) add(frame, kGuardPiece);
}

template <int D>
template <class R, class Variable>
R DefinedAtoms<D>::quality(const Atom<D>& atom, const AtomEdges<D>& edges, const Variable& variable) const {
  const ElementKind kind = kind_of(atom.shape);
  const ElementTarget target = judge_->targets().of(atom.element);
  const auto& frame = corner_frames(kind)[atom.frame];
  std::array<std::uint8_t, 8> end{};  // by corner: its place in the frame
  for (std::uint8_t k = 1; k <= dimension_; ++k) end[frame[k]] = k;
  [[maybe_unused]] std::array<Vec2<R>, 2> flat{};  // vectors on a curved surface
  if constexpr (D == 3)
    if (is_on_surface(atom.shape)) flat = surface_coordinates<R>(atom.shape, edge_vectors<R>(edges, variable), frame_.of(atom.element));
  thread_local std::vector<R> room;
  const R value = run_program<R>(
      of(kind, target.space).pieces[atom.piece].program,
      [&](const FormulaInput& input) -> R {
        if (input.what != FormulaInput::What::Corner) return R(judge_->given(input, atom.element, target, 1.0));
        const std::size_t k = end[input.index];
        if (k == 0) return R(0.0);
        if (is_on_surface(atom.shape)) return input.row == 0 ? flat[k - 1].x : input.row == 1 ? flat[k - 1].y : R(0.0);
        return variable(edges[k - 1][input.row], (k - 1) * D + input.row);
      },
      room);
  return steeper(value, target.steepness) + R(shift_);
}

template <int D>
double DefinedAtoms<D>::guard(const Atom<D>& atom, const AtomEdges<D>& edges) const {
  if constexpr (D == 3)
    if (is_on_surface(atom.shape)) return inverse_on_surface<Metric::MeanRatio>(atom.shape, edges, frame_.of(atom.element));
  return inverse_mean_ratio<D>(atom.shape, edges, 1.0);
}

template <int D>
double DefinedAtoms<D>::jacobian(const Atom<D>& atom, const AtomEdges<D>& edges) const {
  if constexpr (D == 3)
    if (is_on_surface(atom.shape)) return surface_jacobian(atom.shape, edges, frame_.of(atom.element));
  return atom_jacobian<D>(atom.shape, edges);
}

template <int D>
double DefinedAtoms<D>::value(const Atom<D>& atom, const AtomEdges<D>& edges, double reference) const {
  if (atom.piece == kGuardPiece) return kGuard * reference * guard(atom, edges);
  const double q = quality<double>(atom, edges, [unit = 1.0 / reference](double x, std::size_t) { return x * unit; });
  return q > 0.0 && jacobian(atom, edges) > 0.0 ? 1.0 / q : kInfinity;
}

template <int D>
void DefinedAtoms<D>::derive(const Atom<D>& atom, const AtomEdges<D>& edges, double reference, Curvature curvature,
                             AtomDerivatives<D>& result) const {
  if (atom.piece == kGuardPiece) {
    if (is_on_surface(atom.shape)) {
      if constexpr (D == 3) derive_inverse_on_surface<Metric::MeanRatio>(atom.shape, edges, frame_.of(atom.element), curvature, result);
    } else {
      derive_inverse_mean_ratio<D>(atom.shape, edges, 1.0, curvature, result);
    }
    scale_derivatives<D>(kGuard * reference, result);
    return;
  }
  using R = SecondDual<AtomDerivatives<D>::kCount>;
  const R q = quality<R>(atom, edges, [unit = 1.0 / reference](double x, std::size_t i) {
    R variable = R::variable(x * unit, i);
    variable.first[i] = unit;
    return variable;
  });
  derive_inverse<D>(q, curvature, result);
}

template class DefinedAtoms<2>;
template class DefinedAtoms<3>;

std::string defined_joint_obstacle(Metric metric, KindSet kinds) {
  const DefinedMetric& of = defined(metric);
  if (of.formula->uses_place()) return fmt::format("{} depends on where elements lie, and they know edges alone", of.name);
  for (std::size_t k = 0; k < kElementKindCount; ++k) {
    const auto kind = static_cast<ElementKind>(k);
    if (!contains(kinds, kind)) continue;
    bool any = false;
    for (const FormulaSpace space : spaces_of(of)) {
      if (!of.formula->why_not(kind, space).empty()) continue;
      any = true;
      for (const FormulaPiece& piece : of.formula->pieces(kind, space))
        if (!frame_for(kind, piece.corners))
          return fmt::format("{} of a {} is not the least of what its corners are worth one by one, each with its edges", of.name,
                             info(kind).name);
    }
    if (!any) return fmt::format("{} is not defined for {}", of.name, info(kind).plural);
  }
  return {};
}

}  // namespace dmoscope
