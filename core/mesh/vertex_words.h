#pragma once
// Words by which the user names vertices of a mesh: by number, by group, by the file's data, by place, or by boundary loop.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// Syntax of these words, in one line for --help.
inline constexpr std::string_view kVertexWords =
    "ids from 0 and ranges (3,7-9 or vertices:3,7-9), a group (its name or group:NAME), those with some number in the file's data "
    "(mat_id=3,5, of elements or points), those in a box (box:X0,Y0,X1,Y1 or box:X0,Y0,Z0,X1,Y1,Z1), or those of a boundary loop or a "
    "connected part of a mesh of triangles and quadrilaterals (loop:2, part:1; info lists them)";

struct NumberRange {
  std::uint64_t first = 0, last = 0;
};
/// Ranges of a list of numbers like 3,7-9. `word`: begins messages. Throws UsageError.
[[nodiscard]] std::vector<NumberRange> parse_number_list(std::string_view list, std::string_view word);

/// A closed box in the plane of x and y, or in space.
struct NamedBox {
  std::vector<double> limits{};  // low corner, then high corner: 4 or 6 numbers; empty: nothing lies in it
  [[nodiscard]] bool has(Vec3 p) const;
};
/// Reads X0,Y0,X1,Y1 or X0,Y0,Z0,X1,Y1,Z1. `word`: begins messages. Throws UsageError.
[[nodiscard]] NamedBox parse_box(std::string_view text, std::string_view word);
/// Parts of a text between commas.
[[nodiscard]] std::vector<std::string_view> split_at_commas(std::string_view text);

/// The vertices that one word names:
///   vertices:3,7-9              by number from 0, and ranges
///   group:NAME                  those of a group, by its name, or else by its number in the file; all corners of elements. If groups of
///                               points, lines, faces and elements share a name: points:NAME, lines:NAME, faces:NAME, elements:NAME
///   data:FIELD=3,5              those whose number in a field is one of these, and the corners of such elements. If points and cells have
///                               fields of one name: point-data:FIELD=3, cell-data:FIELD=3
///   box:X0,Y0,X1,Y1             those with x and y (and z, with six numbers) in these closed ranges
///   loop:2, part:1              those of a boundary loop, or of a connected part, of a planar or surface mesh: see outline.h
/// and, without what stands before the colon, any of the first three that it can mean. Ascending, each once.
/// Throws UsageError, which begins with the word: for one that means nothing in this mesh, with a list of what the mesh has, and for one
/// that can mean more than one thing, with the choices.
[[nodiscard]] std::vector<Index> vertices_named(const Mesh& mesh, std::string_view word);

/// The groups that one word names: group:NAME, points:NAME, lines:NAME, faces:NAME, elements:NAME, or a name alone; by its name, or else by
/// its number in the file. Throws UsageError, which begins with the word: for one that names none, and for one that can mean several kinds.
[[nodiscard]] std::vector<const Group*> groups_named(const Mesh& mesh, std::string_view word);

/// The vertices that any of several words names. Ascending, each once. Throws UsageError.
[[nodiscard]] std::vector<Index> vertices_named(const Mesh& mesh, std::span<const std::string> words);

}  // namespace dmoscope
