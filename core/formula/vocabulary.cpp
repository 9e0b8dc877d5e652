#include "core/formula/vocabulary.h"

#include <array>

namespace dmoscope {

namespace {

constexpr NameScope kElement = NameScope::Element, kCorner = NameScope::Corner, kEdge = NameScope::Edge;
constexpr int kMeasure = -1;  // stands for the power of the measure: 2 in the plane, 3 in space

constexpr std::array kNames{
    FormulaName{"area", kElement, false, 2, "signed area of a triangle or quadrilateral"},
    FormulaName{"volume", kElement, false, 3, "signed volume"},
    FormulaName{"measure", kElement, false, kMeasure, "area or volume, signed"},
    FormulaName{"surface", kElement, false, 2, "area of a tetrahedron's faces"},
    FormulaName{"perimeter", kElement, false, 1, "sum of the edges' lengths"},
    FormulaName{"lmin", kElement, false, 1, "length of the shortest edge"},
    FormulaName{"lmax", kElement, false, 1, "length of the longest edge"},
    FormulaName{"lsum", kElement, false, 1, "sum of the edges' lengths"},
    FormulaName{"l2sum", kElement, false, 2, "sum of the squares of the edges' lengths"},
    FormulaName{"amin", kElement, false, 0, "smallest angle in radians; of a tetrahedron smallest dihedral angle"},
    FormulaName{"amax", kElement, false, 0, "largest one"},
    FormulaName{"inradius", kElement, false, 1, "of the circle or sphere inside a simplex"},
    FormulaName{"circumradius", kElement, false, 1, "of the circle or sphere through a simplex's corners"},
    FormulaName{"scaled_jacobian_inside", kElement, false, 0,
                "of a hexahedron or wedge: a lower bound of the scaled Jacobian everywhere in it"},
    FormulaName{"mean_measure", kElement, false, kMeasure, "mean area or volume of the mesh's elements at input"},
    FormulaName{"u", kCorner, true, 1, "first edge that leaves the corner"},
    FormulaName{"v", kCorner, true, 1, "second edge, counter-clockwise of the first"},
    FormulaName{"w", kCorner, true, 1, "third edge, of volume elements"},
    FormulaName{"J", kCorner, false, kMeasure, "the corner's Jacobian: the edges' determinant"},
    FormulaName{"angle", kCorner, false, 0, "interior angle of a triangle or quadrilateral, in radians"},
    FormulaName{"det", kCorner, false, kMeasure, "determinant of T, the corner's Jacobian matrix against the ideal element or the target"},
    FormulaName{"norm", kCorner, false, 1, "Frobenius norm of T"},
    FormulaName{"adj", kCorner, false, kMeasure - 100, "Frobenius norm of T's adjugate"},
    FormulaName{"smax", kCorner, false, 1, "greatest singular value of T"},
    FormulaName{"smid", kCorner, false, 1, "middle singular value of T, of volume elements"},
    FormulaName{"smin", kCorner, false, 1, "smallest singular value of T"},
    FormulaName{"size", kCorner, false, 0, "det against that of an ideal element of the mesh's mean measure, or against the target's"},
    FormulaName{"e", kEdge, true, 1, "the edge"},
    FormulaName{"l", kEdge, false, 1, "its length"},
    FormulaName{"dihedral", kEdge, false, 0, "a tetrahedron's dihedral angle there, in radians"},
    FormulaName{"pi", kElement, false, 0, "3.14159..."},
};

constexpr std::array kFunctions{
    FormulaFunction{"abs", 1, 1, "x", "absolute value"},
    FormulaFunction{"sign", 1, 1, "x", "-1, 0 or 1"},
    FormulaFunction{"sqrt", 1, 1, "x", "square root; of less than 0 it is 0"},
    FormulaFunction{"cbrt", 1, 1, "x", "cube root, with the sign of x"},
    FormulaFunction{"pow", 2, 2, "x, y", "x^y; of x below 0 only for whole numbers y up to 64, else 0"},
    FormulaFunction{"exp", 1, 1, "x", "e^x"},
    FormulaFunction{"log", 1, 1, "x", "natural logarithm; of 0 and less it is -700"},
    FormulaFunction{"sin", 1, 1, "x", "sine, of radians"},
    FormulaFunction{"cos", 1, 1, "x", "cosine"},
    FormulaFunction{"tan", 1, 1, "x", "tangent"},
    FormulaFunction{"asin", 1, 1, "x", "its angle; beyond 1 as of 1"},
    FormulaFunction{"acos", 1, 1, "x", "likewise"},
    FormulaFunction{"atan", 1, 1, "x", "likewise"},
    FormulaFunction{"atan2", 2, 2, "y, x", "angle of the point (x, y)"},
    FormulaFunction{"min", 1, 64, "x, y, ...", "the least"},
    FormulaFunction{"max", 1, 64, "x, y, ...", "the greatest"},
    FormulaFunction{"clamp", 3, 3, "x, low, high", "x, but no less than low and no more than high"},
    FormulaFunction{"if", 3, 3, "condition, x, y", "x where the condition holds, else y"},
    FormulaFunction{"dot", 2, 2, "a, b", "scalar product of two vectors"},
    FormulaFunction{"cross", 2, 2, "a, b", "their cross product: a number in the plane, a vector in space"},
    FormulaFunction{"length", 1, 1, "a", "length of a vector"},
    FormulaFunction{"x", 1, 1, "a", "a vector's first coordinate"},
    FormulaFunction{"y", 1, 1, "a", "its second one"},
    FormulaFunction{"z", 1, 1, "a", "its third one, in space"},
    FormulaFunction{"min_corner", 1, 1, "...", "least over the corners of what names of corners make"},
    FormulaFunction{"max_corner", 1, 1, "...", "greatest over the corners"},
    FormulaFunction{"mean_corner", 1, 1, "...", "mean over the corners"},
    FormulaFunction{"sum_corner", 1, 1, "...", "sum over the corners"},
    FormulaFunction{"min_edge", 1, 1, "...", "least over the edges of what names of edges make"},
    FormulaFunction{"max_edge", 1, 1, "...", "greatest over the edges"},
    FormulaFunction{"mean_edge", 1, 1, "...", "mean over the edges"},
    FormulaFunction{"sum_edge", 1, 1, "...", "sum over the edges"},
    FormulaFunction{"field", 1, 1, "\"name\"", "a field of the mesh: of the element, or the mean of its corners"},
};

}  // namespace

std::span<const FormulaName> formula_names() { return kNames; }
std::span<const FormulaFunction> formula_functions() { return kFunctions; }

}  // namespace dmoscope
