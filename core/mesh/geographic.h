#pragma once
// Meshes in longitude and latitude: judged on the Earth by way of Mercator's map, which keeps angles.
//
// A degree of longitude is shorter than one of latitude by the latitude's cosine, so that a mesh taken as it stands is judged stretched.
// The map (x, y) = (longitude, atanh(sin latitude)), in degrees, stretches both ways alike at each place: the angles and the shape of an
// element that is small against the Earth are those that it has there. So all that judges and moves works on the map, and what is written
// is mapped back.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope {

struct Mesh;

/// Whether x and y are longitude and latitude in degrees. Auto: where the mesh says so, see looks_geographic().
enum class Geographic { Off, On, Auto };
[[nodiscard]] std::string_view name(Geographic choice);
/// Throws UsageError.
[[nodiscard]] Geographic parse_geographic(std::string_view word);

/// y on the map, of a latitude in degrees; and back.
[[nodiscard]] double mercator(double latitude);
[[nodiscard]] double latitude(double y);
/// How much longer a way is on the map than on the Earth, in degrees of a great circle, at y: 1 on the equator.
[[nodiscard]] double stretch_of_map(double y);

/// Why a mesh cannot be taken for one in degrees: a place beyond a pole, or so near that the map has no room; a volume; a curved surface.
/// Empty: it can.
[[nodiscard]] std::string why_not_geographic(const Mesh& mesh);
enum class Likeness { None, Range, Said };
/// Said: a planar mesh within the range of degrees, of a format for coasts and oceans, whose title or file name says so by a word (degrees,
/// longitude, lon, ll ...). Range: the same without such a word, where some x is below zero or beyond 180, and some |y| beyond 5.
[[nodiscard]] Likeness looks_geographic(const Mesh& mesh);

/// Maps the mesh, whose positions are in degrees.
void map_to_mercator(Mesh& mesh);
/// The coordinates, as the file has them, of a vertex at `position`; the file's own bits where it has not moved.
[[nodiscard]] Vec3 place_in_file(const Mesh& mesh, Index vertex, Vec3 position);
/// A place on the map as the file's coordinates, and the other way round; of a mesh that was not mapped the place itself.
[[nodiscard]] Vec3 in_file(const Mesh& mesh, Vec3 place);
[[nodiscard]] Vec3 on_map(const Mesh& mesh, Vec3 place);
/// All of them.
[[nodiscard]] std::vector<Vec3> places_in_file(const Mesh& mesh, std::span<const Vec3> positions);

}  // namespace dmoscope
