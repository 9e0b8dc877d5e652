#pragma once
// Meshes in longitude and latitude, which are judged on the Earth through the Mercator map, which keeps angles.
//
// A degree of longitude is shorter than one of latitude by the cosine of the latitude, so a mesh taken as it stands is judged stretched.
// The map (x, y) = (longitude, atanh(sin latitude)), in degrees, stretches both directions equally at each place, so an element that is
// small against the Earth has the angles and the shape that it has there. All judging and moving works on the map, and results are mapped
// back.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope {

struct Mesh;

/// Whether x and y are longitude and latitude in degrees. Auto: if the mesh says so, see looks_geographic().
enum class Geographic { Off, On, Auto };
[[nodiscard]] std::string_view name(Geographic choice);
/// Parses "off", "on" or "auto". Throws UsageError.
[[nodiscard]] Geographic parse_geographic(std::string_view word);

/// The y on the map of a latitude in degrees; latitude() is its inverse.
[[nodiscard]] double mercator(double latitude);
[[nodiscard]] double latitude(double y);
/// Length on the map over length on the Earth, in degrees of a great circle, at y: 1 on the equator.
[[nodiscard]] double stretch_of_map(double y);

/// Reason why a mesh cannot be taken for one in degrees: a place beyond a pole, or too near to it for the map; a volume; a curved surface.
/// Empty: it can.
[[nodiscard]] std::string why_not_geographic(const Mesh& mesh);
enum class Likeness { None, Range, Said, Pole };
/// Judges whether a mesh is in degrees. Said: a planar mesh within the range of degrees, of a format for coasts and oceans, whose title or
/// file name says so by a word (degrees, longitude, lon, ll ...). Range: such a mesh without such a word, with some x below zero or beyond
/// 180, and some |y| beyond 5. Pole: a mesh of such a format that goes round the globe and nearer to a pole than the map can show.
[[nodiscard]] Likeness looks_geographic(const Mesh& mesh);

/// Maps the positions of a mesh, which are in degrees.
void map_to_mercator(Mesh& mesh);
/// The coordinates in the file of a vertex at `position` on the map; the file's own bits if it has not moved.
[[nodiscard]] Vec3 place_in_file(const Mesh& mesh, Index vertex, Vec3 position);
/// Converts a place on the map to the file's coordinates; on_map() is the inverse. Of a mesh that was not mapped the place itself.
[[nodiscard]] Vec3 in_file(const Mesh& mesh, Vec3 place);
[[nodiscard]] Vec3 on_map(const Mesh& mesh, Vec3 place);
/// The coordinates in the file of all vertices, at `positions` on the map.
[[nodiscard]] std::vector<Vec3> places_in_file(const Mesh& mesh, std::span<const Vec3> positions);

}  // namespace dmoscope
