#include "core/joint/atoms.h"

#include <fmt/format.h>

#include "core/joint/atom_pieces.h"
#include "core/joint/defined_atoms.h"
#include "core/joint/dual_atom.h"
#include "core/joint/mean_ratio_atom.h"
#include "core/joint/surface_atom.h"

namespace dmoscope {

namespace {

using pieces::Of;

/// Metric whose formula an atom uses: several are the mean ratio in the plane.
Metric joint_metric(Metric metric, int dimension) {
  const bool same = dimension == 2 && (metric == Metric::Condition || metric == Metric::MeanRatioArea);
  return same ? Metric::MeanRatio : metric;
}

// ---- atoms of an element ----

Of what_counts(Metric metric, ElementKind kind) {
  const bool triangle = kind == ElementKind::Triangle;
  if (!triangle && kind != ElementKind::Tetrahedron) return Of::Corner;
  return formulas::with_metric(joint_metric(metric, triangle ? 2 : 3),
                               [triangle]<Metric M>() { return triangle ? pieces::Piece<M>::kTriangle : pieces::Piece<M>::kTetrahedron; });
}

constexpr AtomShape atom_shape(ElementKind kind) { return static_cast<AtomShape>(kind); }
static_assert(atom_shape(ElementKind::Quadrilateral) == AtomShape::SquareCorner &&
              atom_shape(ElementKind::Wedge) == AtomShape::PrismCorner && atom_shape(ElementKind::Hexahedron) == AtomShape::CubeCorner &&
              atom_shape(ElementKind::Pyramid) == AtomShape::PyramidCorner);

/// Orders of a tetrahedron's corners that keep its orientation, with each corner first, and with each edge first.
constexpr std::array<std::array<std::uint8_t, 4>, 4> kCornersFirst{{{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}}};
constexpr std::array<std::array<std::uint8_t, 4>, 6> kEdgesFirst{
    {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};
constexpr std::array<std::array<std::uint8_t, 4>, 1> kAsItIs{{{0, 1, 2, 3}}};

std::span<const CornerTable> volume_atoms(ElementKind kind, Of of) {
  if (kind != ElementKind::Tetrahedron) return corner_frames(kind);
  if (of == Of::Whole) return kAsItIs;
  if (of == Of::Corner) return kCornersFirst;
  return kEdgesFirst;
}

// ---- quality of an atom ----

/// Quality of an atom with these edges, in any scalar.
template <Metric M, class R>
R quality_of(AtomShape shape, const std::array<Vec2<R>, 2>& e) {
  return planar_quality<M>(shape == AtomShape::Triangle, e[0], e[1]);
}
template <Metric M, class R>
R quality_of(AtomShape shape, const std::array<Vec3Of<R>, 3>& e) {
  if constexpr (formulas::kDefinedForTetrahedra<M>) {
    if (shape == AtomShape::Tetrahedron) return pieces::Piece<M>::tetrahedron(e[0], e[1], e[2]);
  }
  if constexpr (formulas::kDefinedForCorners<M>) {
    if (shape == AtomShape::CubeCorner) return pieces::solid_corner<M, formulas::CubeCorner>(e[0], e[1], e[2]);
    if (shape == AtomShape::PrismCorner) return pieces::solid_corner<M, formulas::PrismCorner>(e[0], e[1], e[2]);
    if (shape == AtomShape::PyramidCorner) return pieces::solid_corner<M, formulas::PyramidCorner>(e[0], e[1], e[2]);
  }
  return R(0.0);
}

template <int D, Metric M>
double inverse_quality(AtomShape shape, const AtomEdges<D>& edges, double /*reference*/) {
  const double q = quality_of<M>(shape, plain_vectors(edges));
  // An angle between inverted edges is not negative in every formula, hence the determinant.
  return q > 0.0 && atom_jacobian<D>(shape, edges) > 0.0 ? 1.0 / q : std::numeric_limits<double>::infinity();
}

template <int D, Metric M>
void derive_inverse_quality(AtomShape shape, const AtomEdges<D>& edges, double /*reference*/, Curvature curvature,
                            AtomDerivatives<D>& result) {
  derive_inverse<D>(quality_of<M>(shape, dual_vectors(edges)), curvature, result);
}

template <int D, class F>
void with_metric_of(Metric metric, F f) {
  if constexpr (D == 2)
    formulas::with_planar_metric(metric, f);
  else
    formulas::with_volume_metric(metric, f);
}

}  // namespace

std::span<const CornerTable> corner_frames(ElementKind kind) {
  static constexpr std::array<CornerTable, 4> kSquare{{{0, 1, 3, 3}, {1, 2, 0, 0}, {2, 3, 1, 1}, {3, 0, 2, 2}}};
  switch (kind) {
    case ElementKind::Quadrilateral:
      return kSquare;
    case ElementKind::Hexahedron:
      return formulas::HexahedronCorners::kTable;
    case ElementKind::Wedge:
      return formulas::WedgeCorners::kTable;
    case ElementKind::Pyramid:
      return formulas::PyramidCorners::kTable;
    default:
      return kAsItIs;
  }
}

std::string joint_obstacle(Metric metric, KindSet kinds) {
  if (!is_built_in(metric)) return defined_joint_obstacle(metric, kinds);
  for (std::size_t k = 0; k < kElementKindCount; ++k) {
    const auto kind = static_cast<ElementKind>(k);
    if ((kinds & kind_set(kind)) == 0) continue;
    if (!info(metric).defined_for(kind)) return fmt::format("{} is not defined for {}", info(metric).name, info(kind).plural);
    if (metric == Metric::MeanRatioArea && kind == ElementKind::Quadrilateral)
      return "mean-ratio-area cannot see a concave corner, and a quadrilateral's is no least of its corners'";
  }
  if (metric == Metric::Rectangularity)
    return "rectangularity is the best of a triangle's corners, not the worst, so it has no smooth pieces";
  return {};
}

template <int D>
void append_atoms(const ElementTable& elements, Metric metric, Index element, std::vector<Atom<D>>& atoms) {
  const ElementKind kind = elements.kind(element);
  const auto corners = elements.corners(element);
  const Of of = what_counts(metric, kind);
  const std::size_t n = corners.size(), count = of == Of::Whole ? 1 : n;
  if constexpr (D == 2) {
    for (std::size_t i = 0; i < count; ++i)
      atoms.push_back({{corners[i], corners[(i + 1) % n], corners[(i + n - 1) % n]}, element, atom_shape(kind)});
  } else if (info(kind).dimension == 2) {
    for (std::size_t i = 0; i < count; ++i)
      atoms.push_back(
          {{corners[i], corners[(i + 1) % n], corners[(i + n - 1) % n], corners[opposite_corner(n, i)]}, element, surface_shape(kind)});
  } else {
    for (const CornerTable& row : volume_atoms(kind, of))
      atoms.push_back({{corners[row[0]], corners[row[1]], corners[row[2]], corners[row[3]]}, element, atom_shape(kind)});
  }
}
template void append_atoms<2>(const ElementTable&, Metric, Index, std::vector<Atom<2>>&);
template void append_atoms<3>(const ElementTable&, Metric, Index, std::vector<Atom<3>>&);

template <int D>
AtomFunction<D>::AtomFunction(Metric metric) {
  if (joint_metric(metric, D) == Metric::MeanRatio) {
    value_.fill(inverse_mean_ratio<D>);
    derive_.fill(derive_inverse_mean_ratio<D>);
    convex_by_vertex_ = true;
  } else {
    with_metric_of<D>(metric, [this]<Metric M>() {
      value_.fill(inverse_quality<D, M>);
      derive_.fill(derive_inverse_quality<D, M>);
    });
  }
}
template <int D>
AtomFunction<D>::AtomFunction([[maybe_unused]] Metric metric, const Curved& frame) {
  surface_.frame = frame;
  if constexpr (D == 3)
    formulas::with_planar_metric(joint_metric(metric, 2), [this]<Metric M>() {
      surface_.value = inverse_on_surface<M>;
      surface_.derive = derive_inverse_on_surface<M>;
    });
}
template <int D>
AtomFunction<D>::AtomFunction(std::shared_ptr<const DefinedAtoms<D>> atoms) : defined_(std::move(atoms)) {}
template <int D>
double AtomFunction<D>::defined_value(const Atom<D>& atom, const AtomEdges<D>& edges, double reference) const {
  return defined_->value(atom, edges, reference);
}
template <int D>
void AtomFunction<D>::derive_defined(const Atom<D>& atom, const AtomEdges<D>& edges, double reference, Curvature curvature,
                                     AtomDerivatives<D>& result) const {
  defined_->derive(atom, edges, reference, curvature, result);
}
template <int D>
double AtomFunction<D>::shift() const noexcept {
  return defined_ ? defined_->shift() : 0.0;
}
template class AtomFunction<2>;
template class AtomFunction<3>;

template <int D>
double atom_jacobian(AtomShape shape, const AtomEdges<D>& edges) {
  return MatrixAgainstIdeal<D>(shape, edges).determinant;
}
template double atom_jacobian<2>(AtomShape, const AtomEdges<2>&);
template double atom_jacobian<3>(AtomShape, const AtomEdges<3>&);

}  // namespace dmoscope
