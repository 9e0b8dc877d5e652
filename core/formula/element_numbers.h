#pragma once
// What formulas know of an element: its corners, edges, angles, Jacobians, ..., as numbers of a program. All are of the space of the target
// where there is one.

#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "core/formula/program_builder.h"

namespace dmoscope {

/// What is measured. Plain: the element as it stands. Target: its edges at each corner against those of a target (A W^-1, Knupp), whose
/// corner Jacobian is the ideal one. Stretched: the element in a space that a metric tensor makes of its own.
enum class FormulaSpace : std::uint8_t { Plain, Target, Stretched };
inline constexpr std::size_t kFormulaSpaces = 3;

/// An element has no such number.
struct NoSuchNumber {
  const char* why;  // "has no area"
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
  /// The corners where as many edges meet as there are dimensions: all but a pyramid's tip.
  [[nodiscard]] std::size_t frame_count() const noexcept;
  /// Does the Jacobian of such a corner change with the element's corner `moving`?
  [[nodiscard]] bool depends_on(std::size_t frame, Index moving) const;
  [[nodiscard]] std::span<const std::pair<Index, Index>> edges() const noexcept;

  // Vectors. A corner's place is relative to what all corners are given relative to.
  [[nodiscard]] Vector place(Index corner);
  [[nodiscard]] Vector origin();  // of the places: in the mesh's coordinates, of a planar one those of its plane
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

  // Corner by corner.
  [[nodiscard]] Corner corner(std::size_t frame);
  /// The columns of the corner's Jacobian against the ideal or the target: A W^-1.
  [[nodiscard]] std::array<Vector, 3> jacobian_matrix(std::size_t frame);
  [[nodiscard]] Number determinant(std::size_t frame);
  [[nodiscard]] Number squared_norm(std::size_t frame);
  /// Singular value 0 (greatest) to dimension() - 1.
  [[nodiscard]] Number singular_value(std::size_t frame, int which);
  /// The norm of the adjugate.
  [[nodiscard]] Number adjugate_norm(std::size_t frame);
  /// The determinant against that of an ideal element of the mesh's mean measure, or of the target.
  [[nodiscard]] Number relative_size(std::size_t frame);
  [[nodiscard]] Number corner_angle(std::size_t frame);

  // Of the whole element; throw NoSuchNumber.
  [[nodiscard]] Number measure();
  [[nodiscard]] Number surface();
  [[nodiscard]] Number dihedral_angle(std::size_t edge);
  [[nodiscard]] Number least_angle();
  [[nodiscard]] Number greatest_angle();
  [[nodiscard]] Number inradius();
  [[nodiscard]] Number circumradius();
  [[nodiscard]] Number mean_measure() { return builder_.input({FormulaInput::What::MeanMeasure, 0, 0, 0}); }
  /// Of a hexahedron or wedge: above 0 it is valid everywhere, and this no more than the scaled Jacobian anywhere in it; of a wedge, across
  /// which the determinant is linear, on the edges between its triangles. The determinant is a sum of coefficients times Bernstein
  /// polynomials, each coefficient a mean of determinants of triples of edges, one along each coordinate. The same means of the products of
  /// these edges' lengths make a sum that is no less than the product of the lengths of the Jacobian's columns, for each is a mean of
  /// edges. No polynomial is negative, so that determinant over sum is at least the least coefficient over its own mean of products, which
  /// is the number; at corners these are the scaled Jacobian. Of those that change with `moving` (kNoIndex: all).
  [[nodiscard]] Number scaled_jacobian_inside(Index moving);
  /// The least Jacobian of the corners as they stand, of those that change with `moving` (kNoIndex: all).
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
  /// The least angle (Minimum) or the greatest (Maximum).
  [[nodiscard]] Number extreme_angle(Operation of);
  [[nodiscard]] Number determinant_of(const Vector& a, const Vector& b, const Vector& c) { return dot(cross_in_space(a, b), c); }

  ProgramBuilder& builder_;
  ElementKind kind_;
  FormulaSpace space_;
};

/// The measure of an ideal element whose edges have the length 1.
[[nodiscard]] double ideal_measure(ElementKind kind);

}  // namespace dmoscope
