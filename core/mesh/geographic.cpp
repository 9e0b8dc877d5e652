#include "core/mesh/geographic.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "core/base/box.h"
#include "core/base/error.h"
#include "core/base/same_bits.h"
#include "core/base/unknown_value.h"
#include "core/mesh/mesh.h"

namespace dmoscope {
namespace {

constexpr double kRadian = std::numbers::pi / 180.0;
constexpr double kFarthest = 89.5;  // degrees of latitude: beyond, the map stretches more than a hundred times
constexpr double kWidest = 720.0;   // degrees of longitude, however they are counted
constexpr std::array<std::string_view, 3> kChoices{"off", "on", "auto"};
constexpr std::array<std::string_view, 10> kWords{"degree", "degrees",  "deg",    "lon",    "longitude",
                                                  "lat",    "latitude", "lonlat", "latlon", "ll"};

bool says_so(std::string_view text) {
  std::string word;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    const char c = i < text.size() ? text[i] : ' ';
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      continue;
    }
    if (std::ranges::find(kWords, word) != kWords.end()) return true;
    word.clear();
  }
  return false;
}

}  // namespace

std::string_view name(Geographic choice) { return kChoices[static_cast<std::size_t>(choice)]; }

Geographic parse_geographic(std::string_view word) { return parse_choice<Geographic>("choice of coordinates", word, kChoices); }

double mercator(double latitude) { return std::asinh(std::tan(kRadian * latitude)) / kRadian; }
double latitude(double y) { return std::atan(std::sinh(kRadian * y)) / kRadian; }
double stretch_of_map(double y) { return std::cosh(kRadian * y); }

std::string why_not_geographic(const Mesh& mesh) {
  if (std::ranges::any_of(mesh.elements.kinds(), [](ElementKind kind) { return info(kind).dimension == 3; }))
    return "it has volume elements";
  const PointBox box = box_of(mesh.positions);
  if (box.low.z != box.high.z) return "it has heights: z is not the same everywhere";
  if (box.low.x < -kWidest || box.high.x > kWidest) return fmt::format("x goes from {:g} to {:g}", box.low.x, box.high.x);
  if (box.low.y < -kFarthest || box.high.y > kFarthest)
    return fmt::format("y goes from {:g} to {:g}, and latitudes beyond {:g} degrees have no room on the map", box.low.y, box.high.y,
                       kFarthest);
  return {};
}

Likeness looks_geographic(const Mesh& mesh) {
  constexpr std::array<std::string_view, 5> kOceans{".14", ".grd", ".gr3", ".ll", ".2dm"};
  constexpr double kAway = 5.0;  // degrees from the equator
  std::string_view file = mesh.name;
  if (file.ends_with(".gz")) file.remove_suffix(3);
  if (std::ranges::none_of(kOceans, [&](std::string_view extension) { return file.ends_with(extension); })) return Likeness::None;
  const PointBox box = box_of(mesh.positions);
  const bool fits = box.high.x - box.low.x <= 360.0 && box.low.x >= -360.0 && box.high.x <= 360.0;
  constexpr double kAround = 350.0, kPole = 90.0;  // degrees
  const bool around = fits && box.high.x - box.low.x >= kAround && box.low.y >= -kPole && box.high.y <= kPole;
  if (around && box.low.z == box.high.z && (box.low.y < -kFarthest || box.high.y > kFarthest)) return Likeness::Pole;
  if (!fits || !why_not_geographic(mesh).empty()) return Likeness::None;
  if (says_so(mesh.title) || says_so(mesh.name)) return Likeness::Said;
  const bool elsewhere = box.low.x < 0.0 || box.high.x > 180.0;
  return elsewhere && (box.low.y < -kAway || box.high.y > kAway) ? Likeness::Range : Likeness::None;
}

void map_to_mercator(Mesh& mesh) {
  mesh.degrees = std::make_shared<const std::vector<Vec3>>(mesh.positions);
  mesh.single_precision = false;  // places on the map are in double precision
  for (Vec3& p : mesh.positions) p.y = mercator(p.y);
}

Vec3 in_file(const Mesh& mesh, Vec3 place) { return mesh.degrees ? Vec3{place.x, latitude(place.y), place.z} : place; }
Vec3 on_map(const Mesh& mesh, Vec3 place) { return mesh.degrees ? Vec3{place.x, mercator(place.y), place.z} : place; }

Vec3 place_in_file(const Mesh& mesh, Index vertex, Vec3 position) {
  if (!mesh.degrees) return position;
  const Vec3 before = (*mesh.degrees)[vertex];
  // Keeps the latitude of a vertex that moved along a parallel.
  return {position.x, same_bits(position.y, mesh.positions[vertex].y) ? before.y : latitude(position.y), position.z};
}

std::vector<Vec3> places_in_file(const Mesh& mesh, std::span<const Vec3> positions) {
  std::vector<Vec3> places(positions.size());
  for (std::size_t v = 0; v < places.size(); ++v) places[v] = place_in_file(mesh, static_cast<Index>(v), positions[v]);
  return places;
}

}  // namespace dmoscope
