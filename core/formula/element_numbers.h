#pragma once
// Numbers of an element that formulas use: corners, edges, angles, Jacobians, ..., as numbers of a program. With a target, all are measured
// in its space.

#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "core/formula/program_builder.h"

namespace dmoscope {

/// Space in which formulas measure an element. Plain: the element as it stands. Target: its edges at each corner relative to those of a
/// target (A W^-1, Knupp), whose corner Jacobian is the ideal one. Stretched: the element in a space given by a metric tensor.
enum class FormulaSpace : std::uint8_t { Plain, Target, Stretched };
inline constexpr std::size_t kFormulaSpaces = 3;

/// Reports that an element has no such number.
struct NoSuchNumber {
  const char* why;  // reason, such as "has no area"
};

class ElementNumbers {
 public:
  using Number = ProgramBuilder::Number;
  struct Vector {
    std::array<Number, 3> at{};
    int count = 0;  // 2 or 3
  };
  /// The edges that leave a corner, right-handed, and their determinant: the corner's Jacobian.
  struct Corner {
    std::array<Vector, 3> edges{};
    Number jacobian = 0;
  };

  ElementNumbers(ProgramBuilder& builder, ElementKind kind, FormulaSpace space);

  [[nodiscard]] int dimension() const noexcept { return info(kind_).dimension; }
  [[nodiscard]] Index corner_count() const noexcept { return info(kind_).corners; }
  /// Number of corners where as many edges meet as there are dimensions: all but a pyramid's apex.
  [[nodiscard]] std::size_t frame_count() const noexcept;
  /// Whether the Jacobian of such a corner changes with the element's corner `moving`.
  [[nodiscard]] bool depends_on(std::size_t frame, Index moving) const;
  [[nodiscard]] std::span<const std::pair<Index, Index>> edges() const noexcept;

  // --- Vectors. Places of corners are relative to the common origin. ---
  [[nodiscard]] Vector place(Index corner);
  [[nodiscard]] Vector origin();  // origin of the places, in the mesh's coordinates or, in a planar mesh, those of its plane
  [[nodiscard]] Vector edge(Index from, Index to);
  template <class Of>
  [[nodiscard]] Vector each(int count, const Of& of);
  [[nodiscard]] Vector subtract(const Vector& a, const Vector& b);
  [[nodiscard]] Vector add(const Vector& a, const Vector& b);
  [[nodiscard]] Vector scaled(Number factor, const Vector& a);
  [[nodiscard]] Number dot(const Vector& a, const Vector& b);
  [[nodiscard]] Number cross_in_plane(const Vector& a, const Vector& b);
  [[nodiscard]] Vector cross_in_space(const Vector& a, const Vector& b);
  [[nodiscard]] Number length(const Vector& a) { return builder_.root(dot(a, a)); }

  // --- Numbers of one corner ---
  [[nodiscard]] Corner corner(std::size_t frame);
  /// The columns of the corner's Jacobian relative to the ideal element or the target: A W^-1.
  [[nodiscard]] std::array<Vector, 3> jacobian_matrix(std::size_t frame);
  [[nodiscard]] Number determinant(std::size_t frame);
  [[nodiscard]] Number squared_norm(std::size_t frame);
  /// Singular value of the corner's Jacobian, from 0 (the greatest) to dimension() - 1.
  [[nodiscard]] Number singular_value(std::size_t frame, int which);
  /// The norm of the adjugate of the corner's Jacobian.
  [[nodiscard]] Number adjugate_norm(std::size_t frame);
  /// The corner's determinant over that of an ideal element of the mesh's mean measure, or over that of the target.
  [[nodiscard]] Number relative_size(std::size_t frame);
  [[nodiscard]] Number corner_angle(std::size_t frame);

  // --- Numbers of the whole element; all throw NoSuchNumber. ---
  [[nodiscard]] Number measure();
  [[nodiscard]] Number surface();
  [[nodiscard]] Number dihedral_angle(std::size_t edge);
  [[nodiscard]] Number least_angle();
  [[nodiscard]] Number greatest_angle();
  [[nodiscard]] Number inradius();
  [[nodiscard]] Number circumradius();
  [[nodiscard]] Number mean_measure() { return builder_.input({FormulaInput::What::MeanMeasure, 0, 0, 0}); }
  /// Lower bound of the scaled Jacobian in a hexahedron or wedge; if it is above 0, the element is valid everywhere. For a wedge, across
  /// which the determinant is linear, it is taken on the edges between its triangles. The determinant is a sum of coefficients times
  /// Bernstein polynomials, each coefficient a mean of determinants of triples of edges, one along each coordinate. The same means of the
  /// products of these edges' lengths make a sum that is no less than the product of the lengths of the Jacobian's columns, for each is a
  /// mean of edges. No polynomial is negative, so that determinant over sum is at least the least coefficient over its own mean of
  /// products, which is the number; at corners these are the scaled Jacobian. Only coefficients that change with `moving` count (kNoIndex:
  /// all).
  [[nodiscard]] Number scaled_jacobian_inside(Index moving);
  /// The least corner Jacobian of the element as it stands, among corners that change with `moving` (kNoIndex: all).
  [[nodiscard]] Number smallest_jacobian(Index moving);

 private:
  [[nodiscard]] bool is_simplex() const noexcept { return static_cast<int>(corner_count()) == dimension() + 1; }
  [[nodiscard]] bool only_corners() const noexcept { return space_ == FormulaSpace::Target && !is_simplex(); }
  void require_whole() const;
  [[nodiscard]] std::array<Index, 4> frame(std::size_t at) const;  // the corner, and the ends of its edges
  [[nodiscard]] Vector raw_edge(Index from, Index to);
  [[nodiscard]] Vector stretched(const Vector& a);
  [[nodiscard]] std::array<Vector, 3> targeted(Index corner, const std::array<Vector, 3>& edges);
  [[nodiscard]] Number jacobian_of(const std::array<Vector, 3>& edges);
  [[nodiscard]] Number volume();
  /// The least (Minimum) or greatest (Maximum) angle.
  [[nodiscard]] Number extreme_angle(Operation of);
  [[nodiscard]] Number determinant_of(const Vector& a, const Vector& b, const Vector& c) { return dot(cross_in_space(a, b), c); }

  ProgramBuilder& builder_;
  ElementKind kind_;
  FormulaSpace space_;
};

/// The measure of an ideal element whose edges have length 1.
[[nodiscard]] double ideal_measure(ElementKind kind);

}  // namespace dmoscope
