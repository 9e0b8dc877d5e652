#include "core/formula/element_numbers.h"

#include <numbers>
#include <optional>

#include "core/mesh/corner_tables.h"
#include "core/mesh/faces.h"

namespace dmoscope {

namespace {

using Pair = std::pair<Index, Index>;
using Number = ElementNumbers::Number;
using std::numbers::pi;
using std::numbers::sqrt2;
using std::numbers::sqrt3;

constexpr std::array kTriangleEdges{Pair{0, 1}, Pair{1, 2}, Pair{2, 0}};
constexpr std::array kQuadrilateralEdges{Pair{0, 1}, Pair{1, 2}, Pair{2, 3}, Pair{3, 0}};
constexpr std::array kTetrahedronEdges{Pair{0, 1}, Pair{0, 2}, Pair{0, 3}, Pair{1, 2}, Pair{1, 3}, Pair{2, 3}};
constexpr std::array kHexahedronEdges{Pair{0, 1}, Pair{1, 2}, Pair{2, 3}, Pair{3, 0}, Pair{4, 5}, Pair{5, 6},
                                      Pair{6, 7}, Pair{7, 4}, Pair{0, 4}, Pair{1, 5}, Pair{2, 6}, Pair{3, 7}};
constexpr std::array kWedgeEdges{Pair{0, 1}, Pair{1, 2}, Pair{2, 0}, Pair{3, 4}, Pair{4, 5},
                                 Pair{5, 3}, Pair{0, 3}, Pair{1, 4}, Pair{2, 5}};
constexpr std::array kPyramidEdges{Pair{0, 1}, Pair{1, 2}, Pair{2, 3}, Pair{3, 0}, Pair{0, 4}, Pair{1, 4}, Pair{2, 4}, Pair{3, 4}};

/// Joins one more number by an operation to those before it, if there are any.
void join(ProgramBuilder& builder, std::optional<Number>& all, Operation by, Number one) { all = all ? builder.apply(by, *all, one) : one; }

}  // namespace

double ideal_measure(ElementKind kind) {
  switch (kind) {
    case ElementKind::Triangle:
    case ElementKind::Wedge:
      return sqrt3 / 4.0;
    case ElementKind::Tetrahedron:
      return sqrt2 / 12.0;
    case ElementKind::Pyramid:
      return sqrt2 / 6.0;
    default:
      return 1.0;
  }
}

ElementNumbers::ElementNumbers(ProgramBuilder& builder, ElementKind kind, FormulaSpace space)
    : builder_(builder), kind_(kind), space_(space) {}

std::size_t ElementNumbers::frame_count() const noexcept { return kind_ == ElementKind::Pyramid ? 4 : corner_count(); }

std::array<Index, 4> ElementNumbers::frame(std::size_t at) const {
  const auto i = static_cast<Index>(at), n = corner_count();
  switch (kind_) {
    case ElementKind::Triangle:
    case ElementKind::Quadrilateral:
      return {i, (i + 1) % n, (i + n - 1) % n, kNoIndex};
    case ElementKind::Tetrahedron:
      return {i, i ^ 1U, i ^ 2U, i ^ 3U};
    default:
      break;
  }
  const CornerTable row = corner_row(kind_, at);
  return {row[0], row[1], row[2], row[3]};
}

bool ElementNumbers::depends_on(std::size_t at, Index moving) const {
  for (const Index corner : frame(at))
    if (corner == moving) return true;
  return false;
}

std::span<const Pair> ElementNumbers::edges() const noexcept {
  switch (kind_) {
    case ElementKind::Triangle:
      return kTriangleEdges;
    case ElementKind::Quadrilateral:
      return kQuadrilateralEdges;
    case ElementKind::Tetrahedron:
      return kTetrahedronEdges;
    case ElementKind::Hexahedron:
      return kHexahedronEdges;
    case ElementKind::Wedge:
      return kWedgeEdges;
    case ElementKind::Pyramid:
      break;
  }
  return kPyramidEdges;
}

void ElementNumbers::require_whole() const {
  if (only_corners()) throw NoSuchNumber{"has no shape of its own in a target's space, where its corners alone are known"};
}

// --- Vectors ---

/// Vector of `count` components; of(i): component i.
template <class Of>
ElementNumbers::Vector ElementNumbers::each(int count, const Of& of) {
  Vector c{{}, count};
  for (std::size_t i = 0; static_cast<int>(i) < count; ++i) c.at[i] = of(i);
  return c;
}

ElementNumbers::Vector ElementNumbers::subtract(const Vector& a, const Vector& b) {
  return each(a.count, [&](std::size_t i) { return builder_.subtract(a.at[i], b.at[i]); });
}
ElementNumbers::Vector ElementNumbers::add(const Vector& a, const Vector& b) {
  return each(a.count, [&](std::size_t i) { return builder_.add(a.at[i], b.at[i]); });
}
ElementNumbers::Vector ElementNumbers::scaled(Number factor, const Vector& a) {
  return each(a.count, [&](std::size_t i) { return builder_.multiply(factor, a.at[i]); });
}

Number ElementNumbers::dot(const Vector& a, const Vector& b) {
  Number sum = builder_.add(builder_.multiply(a.at[0], b.at[0]), builder_.multiply(a.at[1], b.at[1]));
  if (a.count == 3) sum = builder_.add(sum, builder_.multiply(a.at[2], b.at[2]));
  return sum;
}

Number ElementNumbers::cross_in_plane(const Vector& a, const Vector& b) {
  return builder_.subtract(builder_.multiply(a.at[0], b.at[1]), builder_.multiply(a.at[1], b.at[0]));
}

ElementNumbers::Vector ElementNumbers::cross_in_space(const Vector& a, const Vector& b) {
  const auto part = [&](std::size_t i, std::size_t j) {
    return builder_.subtract(builder_.multiply(a.at[i], b.at[j]), builder_.multiply(a.at[j], b.at[i]));
  };
  return {{part(1, 2), part(2, 0), part(0, 1)}, 3};
}

ElementNumbers::Vector ElementNumbers::raw_edge(Index from, Index to) {
  Vector edge{{}, dimension()};
  for (std::size_t i = 0; static_cast<int>(i) < edge.count; ++i) {
    const auto coordinate = [&](Index corner) {
      return builder_.input({FormulaInput::What::Corner, static_cast<std::uint8_t>(corner), static_cast<std::uint8_t>(i), 0});
    };
    edge.at[i] = builder_.subtract(coordinate(to), coordinate(from));
  }
  return edge;
}

ElementNumbers::Vector ElementNumbers::stretched(const Vector& a) {
  Vector result{{}, a.count};
  for (std::size_t row = 0; static_cast<int>(row) < a.count; ++row)
    for (std::size_t column = row; static_cast<int>(column) < a.count; ++column) {  // upper triangular matrix
      const Number part = builder_.multiply(
          builder_.input({FormulaInput::What::Stretch, 0, static_cast<std::uint8_t>(row), static_cast<std::uint8_t>(column)}),
          a.at[column]);
      result.at[row] = column == row ? part : builder_.add(result.at[row], part);
    }
  return result;
}

/// Multiplies the edges by the target's matrix of the corner.
std::array<ElementNumbers::Vector, 3> ElementNumbers::targeted(Index corner, const std::array<Vector, 3>& edges) {
  const auto n = static_cast<std::size_t>(dimension());
  std::array<Vector, 3> result{};
  for (std::size_t column = 0; column < n; ++column)
    for (std::size_t row = 0; row < n; ++row) {
      const Vector part = scaled(builder_.input({FormulaInput::What::Target, static_cast<std::uint8_t>(corner),
                                                 static_cast<std::uint8_t>(row), static_cast<std::uint8_t>(column)}),
                                 edges[row]);
      result[column] = row == 0 ? part : add(result[column], part);
    }
  return result;
}

ElementNumbers::Vector ElementNumbers::place(Index corner) {
  require_whole();
  if (space_ == FormulaSpace::Plain) {
    Vector place{{}, dimension()};
    for (std::size_t i = 0; static_cast<int>(i) < place.count; ++i)
      place.at[i] = builder_.input({FormulaInput::What::Corner, static_cast<std::uint8_t>(corner), static_cast<std::uint8_t>(i), 0});
    return place;
  }
  const Vector nowhere{{builder_.constant(0.0), builder_.constant(0.0), builder_.constant(0.0)}, dimension()};
  if (corner == 0) return nowhere;  // places are relative to the first corner
  if (space_ == FormulaSpace::Stretched) return stretched(raw_edge(0, corner));
  std::array<Vector, 3> edges{};
  for (Index i = 1; i < corner_count(); ++i) edges[i - 1] = raw_edge(0, i);
  return targeted(0, edges)[corner - 1];
}

ElementNumbers::Vector ElementNumbers::origin() {
  if (space_ != FormulaSpace::Plain) throw NoSuchNumber{"has no place in a target's space, but differences alone"};
  Vector origin{{}, dimension()};
  for (std::size_t i = 0; static_cast<int>(i) < origin.count; ++i)
    origin.at[i] = builder_.input({FormulaInput::What::Origin, 0, static_cast<std::uint8_t>(i), 0});
  return origin;
}

ElementNumbers::Vector ElementNumbers::edge(Index from, Index to) {
  require_whole();
  if (space_ == FormulaSpace::Plain) return raw_edge(from, to);
  if (space_ == FormulaSpace::Stretched) return stretched(raw_edge(from, to));
  if (from == 0) return place(to);
  if (to == 0) return scaled(builder_.constant(-1.0), place(from));
  return subtract(place(to), place(from));
}

// --- Numbers of one corner ---

Number ElementNumbers::jacobian_of(const std::array<Vector, 3>& edges) {
  return dimension() == 2 ? cross_in_plane(edges[0], edges[1]) : determinant_of(edges[0], edges[1], edges[2]);
}

ElementNumbers::Corner ElementNumbers::corner(std::size_t at) {
  const auto ends = frame(at);
  Corner corner;
  for (std::size_t i = 0; static_cast<int>(i) < dimension(); ++i)
    corner.edges[i] = only_corners() ? raw_edge(ends[0], ends[i + 1]) : edge(ends[0], ends[i + 1]);
  if (only_corners()) corner.edges = targeted(ends[0], corner.edges);
  corner.jacobian = jacobian_of(corner.edges);
  builder_.mark_positive(corner.jacobian);
  return corner;
}

std::array<ElementNumbers::Vector, 3> ElementNumbers::jacobian_matrix(std::size_t at) {
  std::array<Vector, 3> a = corner(is_simplex() ? 0 : at).edges;  // corners of a simplex have equal edges but for rotations
  const auto constant = [this](double value) { return builder_.constant(value); };
  const auto twice = [&](const Vector& v) { return add(v, v); };
  switch (kind_) {
    case ElementKind::Triangle:
    case ElementKind::Wedge:
      a[1] = scaled(constant(1.0 / sqrt3), subtract(twice(a[1]), a[0]));
      break;
    case ElementKind::Pyramid:
      a[2] = scaled(constant(0.5 * sqrt2), subtract(subtract(twice(a[2]), a[0]), a[1]));
      break;
    case ElementKind::Tetrahedron: {
      const Vector v = a[1];
      a[1] = scaled(constant(1.0 / sqrt3), subtract(twice(v), a[0]));
      a[2] = scaled(constant(0.5 * sqrt2 / sqrt3), subtract(subtract(add(twice(a[2]), a[2]), a[0]), v));
      break;
    }
    default:
      break;
  }
  return a;
}

Number ElementNumbers::determinant(std::size_t at) {
  const double factor = kind_ == ElementKind::Triangle || kind_ == ElementKind::Wedge        ? 2.0 / sqrt3
                        : kind_ == ElementKind::Tetrahedron || kind_ == ElementKind::Pyramid ? sqrt2
                                                                                             : 1.0;
  return builder_.multiply(builder_.constant(factor), corner(is_simplex() ? 0 : at).jacobian);
}

Number ElementNumbers::squared_norm(std::size_t at) {
  if (kind_ == ElementKind::Triangle || kind_ == ElementKind::Tetrahedron) {  // by the edges, which costs less
    std::optional<Number> sum;
    for (const auto& [from, to] : edges()) {
      const Vector e = edge(from, to);
      join(builder_, sum, Operation::Add, dot(e, e));
    }
    return builder_.times(kind_ == ElementKind::Triangle ? 2.0 / 3.0 : 0.5, *sum);
  }
  const auto a = jacobian_matrix(at);
  Number sum = builder_.add(dot(a[0], a[0]), dot(a[1], a[1]));
  return dimension() == 3 ? builder_.add(sum, dot(a[2], a[2])) : sum;
}

Number ElementNumbers::adjugate_norm(std::size_t at) {
  if (dimension() == 2) return builder_.root(squared_norm(at));
  const auto a = jacobian_matrix(at);
  const auto square = [&](const Vector& v) { return dot(v, v); };
  return builder_.root(builder_.add(builder_.add(square(cross_in_space(a[0], a[1])), square(cross_in_space(a[1], a[2]))),
                                    square(cross_in_space(a[2], a[0]))));
}

Number ElementNumbers::singular_value(std::size_t at, int which) {
  ProgramBuilder& b = builder_;
  const Number det = b.absolute(determinant(at)), square = squared_norm(at);
  if (dimension() == 2) {  // the squares have the sum |T|^2, and the product of the values is |det T|
    const Number greatest = b.times(0.5, b.add(b.root(b.add(square, b.times(2.0, det))), b.root(b.subtract(square, b.times(2.0, det)))));
    return which == 0 ? greatest : b.divide(det, greatest);
  }
  // Eigenvalues of T^T T by the angle of its characteristic polynomial.
  const auto t = jacobian_matrix(at);
  std::array<std::array<Number, 3>, 3> c{};
  const Number third = b.times(1.0 / 3.0, square);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) c[i][j] = i == j ? b.subtract(dot(t[i], t[i]), third) : dot(t[i], t[j]);
  const auto product = [&](std::size_t i, std::size_t j) { return b.multiply(c[i][j], c[i][j]); };
  const Number diagonal = b.add(b.add(product(0, 0), product(1, 1)), product(2, 2));
  const Number off = b.add(b.add(product(0, 1), product(0, 2)), product(1, 2));
  const Number p = b.root(b.times(1.0 / 6.0, b.add(diagonal, b.times(2.0, off))));
  const auto minor = [&](std::size_t i, std::size_t j) {  // minor of the first row
    return b.subtract(b.multiply(c[1][i], c[2][j]), b.multiply(c[1][j], c[2][i]));
  };
  const Number determinant_c =
      b.add(b.subtract(b.multiply(c[0][0], minor(1, 2)), b.multiply(c[0][1], minor(0, 2))), b.multiply(c[0][2], minor(0, 1)));
  const Number ratio = b.times(0.5, b.divide(determinant_c, b.multiply(p, b.multiply(p, p))));
  const Number cosine = b.maximum(b.constant(-1.0), b.minimum(b.constant(1.0), ratio));
  const Number angle = b.times(1.0 / 3.0, b.arc_tangent(b.root(b.subtract(b.constant(1.0), b.multiply(cosine, cosine))), cosine));
  const auto eigenvalue = [&](double turn) {
    return b.add(third, b.times(2.0, b.multiply(p, b.apply(Operation::Cosine, b.add(angle, b.constant(turn))))));
  };
  const Number greatest = b.root(eigenvalue(0.0));
  if (which == 0) return greatest;
  const Number middle = b.root(eigenvalue(-2.0 * pi / 3.0));
  return which == 1 ? middle : b.divide(det, b.multiply(greatest, middle));
}

Number ElementNumbers::relative_size(std::size_t at) {
  const Number det = determinant(at);
  if (space_ != FormulaSpace::Plain) return det;
  return builder_.divide(builder_.times(ideal_measure(kind_), det), mean_measure());
}

Number ElementNumbers::corner_angle(std::size_t at) {
  if (dimension() != 2) throw NoSuchNumber{"has no angle at a corner: it has dihedral angles at its edges"};
  const Corner c = corner(at);
  const Number angle = builder_.arc_tangent(builder_.absolute(c.jacobian), dot(c.edges[0], c.edges[1]));
  if (kind_ == ElementKind::Triangle) return angle;
  return builder_.select(builder_.less(c.jacobian, builder_.constant(0.0)), builder_.subtract(builder_.constant(2.0 * pi), angle), angle);
}

// --- Numbers of the whole element ---

Number ElementNumbers::measure() {
  require_whole();
  if (kind_ == ElementKind::Triangle) return builder_.times(0.5, corner(0).jacobian);
  if (kind_ == ElementKind::Quadrilateral) return builder_.times(0.5, builder_.add(corner(1).jacobian, corner(3).jacobian));
  return volume();
}

/// Volume of an element whose faces may be saddles: each face counts as the mean of its two halvings, seen from the first corner.
Number ElementNumbers::volume() {
  if (kind_ == ElementKind::Tetrahedron) return builder_.times(1.0 / 6.0, corner(0).jacobian);
  std::optional<Number> sum;
  const auto take = [&](Index a, Index b, Index c, double factor) {
    if (a == 0 || b == 0 || c == 0) return;
    join(builder_, sum, Operation::Add, builder_.times(factor, determinant_of(edge(0, a), edge(0, b), edge(0, c))));
  };
  for (const LocalFace& face : faces_of(kind_)) {
    const auto& c = face.corners;
    if (face.count == 3) {
      take(c[0], c[1], c[2], 1.0 / 6.0);
      continue;
    }
    for (std::size_t k = 0; k < 4; ++k) take(c[k], c[(k + 1) % 4], c[(k + 2) % 4], 1.0 / 12.0);
  }
  builder_.mark_positive(*sum);
  return *sum;
}

Number ElementNumbers::surface() {
  if (kind_ != ElementKind::Tetrahedron) throw NoSuchNumber{"has no surface that is known here: that is of tetrahedra"};
  const auto twice = [&](Index a, Index b, Index c) { return length(cross_in_space(edge(a, b), edge(a, c))); };
  return builder_.times(0.5, builder_.add(builder_.add(twice(0, 1, 2), twice(0, 2, 3)), builder_.add(twice(0, 3, 1), twice(1, 2, 3))));
}

Number ElementNumbers::dihedral_angle(std::size_t at) {
  if (kind_ != ElementKind::Tetrahedron) throw NoSuchNumber{"has no dihedral angles that are known here: those are of tetrahedra"};
  const auto [from, to] = edges()[at];
  std::array<Index, 2> others{};
  std::size_t count = 0;
  for (Index i = 0; i < 4; ++i)
    if (i != from && i != to) others[count++] = i;
  const Vector e = edge(from, to), n = cross_in_space(e, edge(from, others[0])), m = cross_in_space(e, edge(from, others[1]));
  return builder_.arc_tangent(builder_.multiply(length(e), builder_.absolute(corner(0).jacobian)), dot(n, m));
}

Number ElementNumbers::least_angle() { return extreme_angle(Operation::Minimum); }

Number ElementNumbers::greatest_angle() { return extreme_angle(Operation::Maximum); }

Number ElementNumbers::extreme_angle(Operation of) {
  if (dimension() == 3) {
    std::optional<Number> extreme;
    for (std::size_t i = 0; i < edges().size(); ++i) join(builder_, extreme, of, dihedral_angle(i));
    return *extreme;
  }
  require_whole();
  if (kind_ == ElementKind::Triangle) {  // the largest u . v has the least angle and the least the greatest: only one angle to compute
    const Operation opposite = of == Operation::Minimum ? Operation::Maximum : Operation::Minimum;
    std::optional<Number> extreme;
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner c = corner(i);
      join(builder_, extreme, opposite, dot(c.edges[0], c.edges[1]));
    }
    return builder_.arc_tangent(builder_.absolute(corner(0).jacobian), *extreme);
  }
  std::optional<Number> extreme;
  for (std::size_t i = 0; i < 4; ++i) join(builder_, extreme, of, corner_angle(i));
  return *extreme;
}

Number ElementNumbers::inradius() {
  ProgramBuilder& b = builder_;
  if (!is_simplex()) throw NoSuchNumber{"has no inradius: that is of triangles and tetrahedra"};
  if (dimension() == 3) return b.divide(b.absolute(b.times(0.5, corner(0).jacobian)), surface());
  const Number perimeter = b.add(b.add(length(edge(0, 1)), length(edge(1, 2))), length(edge(2, 0)));
  return b.divide(b.absolute(corner(0).jacobian), perimeter);
}

Number ElementNumbers::circumradius() {
  ProgramBuilder& b = builder_;
  if (!is_simplex()) throw NoSuchNumber{"has no circumradius: that is of triangles and tetrahedra"};
  const Number size = b.absolute(corner(0).jacobian);
  if (dimension() == 2) {
    const Number product = b.multiply(b.multiply(length(edge(0, 1)), length(edge(1, 2))), length(edge(2, 0)));
    return b.divide(product, b.times(2.0, size));
  }
  const Vector u = edge(0, 1), v = edge(0, 2), w = edge(0, 3);
  const Vector n =
      add(add(scaled(dot(w, w), cross_in_space(u, v)), scaled(dot(v, v), cross_in_space(w, u))), scaled(dot(u, u), cross_in_space(v, w)));
  return b.divide(length(n), b.times(2.0, size));
}

Number ElementNumbers::scaled_jacobian_inside(Index moving) {
  if (kind_ != ElementKind::Hexahedron && kind_ != ElementKind::Wedge)
    throw NoSuchNumber{"has its least scaled Jacobian at a corner: 'scaled_jacobian_inside' is of hexahedra and wedges"};
  struct Coefficient {
    std::optional<Number> determinants{}, lengths{};  // sums over the triples of edges
  };
  std::array<Coefficient, 27> coefficients{};
  const auto take = [&](std::size_t at, const Vector& a, const Vector& b, const Vector& c) {
    join(builder_, coefficients[at].determinants, Operation::Add, determinant_of(a, b, c));
    join(builder_, coefficients[at].lengths, Operation::Add, builder_.multiply(builder_.multiply(length(a), length(b)), length(c)));
  };
  if (kind_ == ElementKind::Hexahedron) {  // (p, q, r) at 9 p + 3 q + r; edges by their two other coordinates, the lower first
    const std::array x{edge(0, 1), edge(3, 2), edge(4, 5), edge(7, 6)}, y{edge(0, 3), edge(1, 2), edge(4, 7), edge(5, 6)},
        z{edge(0, 4), edge(1, 5), edge(3, 7), edge(2, 6)};
    for (std::size_t ends = 0; ends < 64; ++ends) {
      const auto end = [ends](unsigned i) { return ends >> i & 1U; };
      take(9 * (end(0) + end(1)) + 3 * (end(2) + end(3)) + end(4) + end(5), x[end(2) + 2 * end(4)], y[end(0) + 2 * end(5)],
           z[end(1) + 2 * end(3)]);
    }
  } else {  // on the edges between the triangles, where the least is: (edge, q) at 3 edge + q
    const auto side = [this](Index triangle, Index i) { return edge(3 * triangle + i % 3, 3 * triangle + (i + 1) % 3); };
    for (Index i = 0; i < 3; ++i)
      for (Index first = 0; first < 2; ++first)
        for (Index second = 0; second < 2; ++second) take(3 * i + first + second, side(first, i + 2), side(second, i), edge(i, i + 3));
  }
  std::optional<Number> least;
  for (const Coefficient& one : coefficients) {
    if (!one.determinants) continue;
    const Number ratio = builder_.divide(*one.determinants, *one.lengths);
    if (moving == kNoIndex || builder_.depends_on(ratio, moving)) join(builder_, least, Operation::Minimum, ratio);
  }
  return kind_ == ElementKind::Wedge ? builder_.times(2.0 / sqrt3, *least) : *least;
}

Number ElementNumbers::smallest_jacobian(Index moving) {
  ElementNumbers plain(builder_, kind_, FormulaSpace::Plain);
  std::optional<Number> least;
  for (std::size_t i = 0; i < (is_simplex() ? 1 : frame_count()); ++i) {
    if (!is_simplex() && dimension() == 3 && moving != kNoIndex && !depends_on(i, moving)) continue;
    join(builder_, least, Operation::Minimum, plain.corner(i).jacobian);
  }
  return *least;
}

}  // namespace dmoscope
