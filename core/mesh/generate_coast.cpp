// Sample coast: an ocean mesh. Outlines first, then points of graded density between them, then Delaunay with the outlines as edges.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "core/base/error.h"
#include "core/mesh/coast_map.h"
#include "core/mesh/delaunay.h"
#include "core/mesh/edges.h"
#include "core/mesh/generators.h"

namespace dmoscope::generators {
namespace {

using Point = Vec2<double>;
constexpr double kPerKilometre = 100'000.0;  // units of the integer grid in a kilometre: centimetres

GridPoint to_grid(Point p) {
  return {static_cast<std::int32_t>(std::lround(p.x * kPerKilometre)), static_cast<std::int32_t>(std::lround(p.y * kPerKilometre))};
}
Point from_grid(GridPoint g) { return {g.x / kPerKilometre, g.y / kPerKilometre}; }
double distance(Point a, Point b) { return std::sqrt(dot(a - b, a - b)); }
std::uint64_t pair_key(Index a, Index b) { return (static_cast<std::uint64_t>(a) << 32U) | b; }

/// Vertices of the sea and the loops that bound it.
struct Outline {
  std::vector<GridPoint> points;
  std::vector<std::vector<Index>> loops;  // loops with the sea to the left; the first is the outer one
};

/// Points along a curve at the wanted edge length, slightly irregular like digitised shores.
std::vector<Point> resample(const std::vector<Point>& curve, const CoastMap& map, Random& random) {
  std::vector<double> edges{0.0};  // length along the curve at each point, in wanted edges
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Point a = curve[i];
    const Point b = curve[(i + 1) % curve.size()];
    edges.push_back(edges.back() + distance(a, b) / map.edge_length({0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}));
  }
  const auto count = static_cast<std::size_t>(std::lround(edges.back()));
  std::vector<Point> points;
  if (count < 5) return points;
  std::size_t i = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double at = (static_cast<double>(k) + random.between(0.0, 0.3)) * edges.back() / static_cast<double>(count);
    while (edges[i + 1] < at) ++i;
    const double t = edges[i + 1] > edges[i] ? (at - edges[i]) / (edges[i + 1] - edges[i]) : 0.0;
    const Point a = curve[i];
    const Point b = curve[(i + 1) % curve.size()];
    const Point p{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    points.push_back(map.on_arc(p) ? CoastMap::to_arc(p) : p);
  }
  return points;
}

Outline make_outline(const CoastMap& map, Random& random) {
  Outline outline;
  for (const auto& curve : map.outlines()) {
    std::vector<Index> loop;
    for (const Point p : resample(curve, map, random)) {
      loop.push_back(static_cast<Index>(outline.points.size()));
      outline.points.push_back(to_grid(p));
    }
    if (!loop.empty()) outline.loops.push_back(std::move(loop));
  }
  return outline;
}

/// Points in square bins, to find those near a place.
class Bins {
 public:
  explicit Bins(double edge) : edge_(edge), columns_(bin(CoastMap::kEast - CoastMap::kWest) + 1) {
    bins_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(bin(CoastMap::kNorth - CoastMap::kSouth) + 1));
  }
  void add(Point p) { bins_[index(bin(p.x - CoastMap::kWest), bin(p.y - CoastMap::kSouth))].push_back(p); }
  [[nodiscard]] bool any_within(Point p, double radius) const {
    const int last_row = static_cast<int>(bins_.size()) / columns_ - 1;
    const int left = std::max(0, bin(p.x - radius - CoastMap::kWest));
    const int right = std::min(columns_ - 1, bin(p.x + radius - CoastMap::kWest));
    const int top = std::min(last_row, bin(p.y + radius - CoastMap::kSouth));
    for (int j = std::max(0, bin(p.y - radius - CoastMap::kSouth)); j <= top; ++j) {
      for (int i = left; i <= right; ++i) {
        for (const Point q : bins_[index(i, j)]) {
          if (dot(p - q, p - q) < radius * radius) return true;
        }
      }
    }
    return false;
  }

 private:
  [[nodiscard]] int bin(double x) const { return static_cast<int>(std::floor(x / edge_)); }
  [[nodiscard]] std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(i);
  }
  double edge_;
  int columns_;
  std::vector<std::vector<Point>> bins_;
};

/// Fills the sea with points that keep the wanted distance (Bridson 2007, with a radius that varies), beginning at the outlines.
std::vector<GridPoint> fill_sea(const CoastMap& map, const Outline& outline, Random& random, Progress& progress) {
  constexpr int kTries = 24;
  constexpr double kSpacing = 0.74;  // spacing in wanted edge lengths, as the nearest neighbour is nearer than most
  Bins bins(1.5 * map.finest());
  std::vector<Point> active;
  for (const GridPoint g : outline.points) {
    active.push_back(from_grid(g));
    bins.add(active.back());
  }
  std::vector<GridPoint> points;
  for (std::size_t next = 0; next < active.size(); ++next) {
    if (next % 1024 == 0) progress.check();
    const Point from = active[next];
    for (int k = 0; k < kTries; ++k) {
      const double turns = random.unit();
      const double reach = kSpacing * map.edge_length(from) * random.between(1.0, 1.6);
      const Point p = from_grid(to_grid({from.x + reach * cos_turns(turns), from.y + reach * sin_turns(turns)}));
      const double edge = map.edge_length(p);
      if (map.outside(p) > -0.55 * edge || bins.any_within(p, kSpacing * edge)) continue;
      bins.add(p);
      active.push_back(p);
      points.push_back(to_grid(p));
    }
  }
  return points;
}

/// Triangulates the sea by Delaunay. Adds midpoints to the loops until they consist of edges; false if that does not end.
bool triangulate(Outline& outline, std::vector<GridPoint>& points, std::vector<std::array<Index, 3>>& triangles, Progress& progress) {
  for (int round = 0; round < 12; ++round) {
    triangles = delaunay(points, progress);
    std::unordered_set<std::uint64_t> sides;
    for (const auto& t : triangles) {
      for (std::size_t i = 0; i < 3; ++i) sides.insert(pair_key(t[i], t[(i + 1) % 3]));
    }
    bool complete = true;
    for (auto& loop : outline.loops) {
      std::vector<Index> refined;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Index a = loop[i];
        const Index b = loop[(i + 1) % loop.size()];
        refined.push_back(a);
        if (sides.contains(pair_key(a, b))) continue;
        complete = false;
        refined.push_back(static_cast<Index>(points.size()));
        points.push_back({(points[a].x + points[b].x) / 2, (points[a].y + points[b].y) / 2});
      }
      loop = std::move(refined);
    }
    if (complete) return true;
  }
  return false;
}

/// Keeps the triangles to the left of the loops and all that are connected with them.
std::vector<std::array<Index, 3>> cut_out(const Outline& outline, const std::vector<std::array<Index, 3>>& triangles) {
  std::unordered_map<std::uint64_t, Index> triangle_of;
  for (Index t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) triangle_of[pair_key(triangles[t][i], triangles[t][(i + 1) % 3])] = t;
  }
  std::unordered_set<std::uint64_t> rim;
  std::vector<Index> todo;
  std::vector<std::uint8_t> kept(triangles.size(), 0);
  for (const auto& loop : outline.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) rim.insert(pair_key(loop[i], loop[(i + 1) % loop.size()]));
  }
  const auto keep = [&](Index t) {
    if (kept[t] != 0) return;
    kept[t] = 1;
    todo.push_back(t);
  };
  for (const std::uint64_t side : rim) keep(triangle_of.at(side));
  while (!todo.empty()) {
    const auto corner = triangles[todo.back()];
    todo.pop_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = corner[i];
      const Index b = corner[(i + 1) % 3];
      if (!rim.contains(pair_key(a, b))) keep(triangle_of.at(pair_key(b, a)));
    }
  }
  std::vector<std::array<Index, 3>> result;
  for (Index t = 0; t < triangles.size(); ++t) {
    if (kept[t] != 0) result.push_back(triangles[t]);
  }
  return result;
}

/// Names the loops as boundary strings: open along the arc, land elsewhere; a string of the outer loop shares its ends with the next.
void name_boundaries(Mesh& mesh, const Outline& outline, const std::vector<std::uint8_t>& open) {
  int opens = 0;
  int lands = 0;
  const auto add = [&](bool is_open, int code, std::vector<Index> members) {
    const std::string role = is_open ? "open boundary" : "land boundary";
    const int number = is_open ? ++opens : ++lands;
    mesh.groups.push_back({role + " " + std::to_string(number), role, code, 0, std::move(members)});
  };
  const std::vector<Index>& outer = outline.loops.front();
  const std::size_t n = outer.size();
  // Finds the open edges, both of whose ends lie on the arc. Begins at a change of the kind.
  const auto edge_open = [&](std::size_t i) { return open[outer[i % n]] != 0 && open[outer[(i + 1) % n]] != 0; };
  std::size_t start = 0;
  while (start < n && edge_open(start) == edge_open(start + n - 1)) ++start;
  if (start == n) {
    add(edge_open(0), 0, outer);
  } else {
    for (std::size_t i = start; i < start + n;) {
      const bool is_open = edge_open(i);
      std::vector<Index> members{outer[i % n]};
      for (; i < start + n && edge_open(i) == is_open; ++i) members.push_back(outer[(i + 1) % n]);
      add(is_open, 0, std::move(members));
    }
  }
  for (std::size_t k = 1; k < outline.loops.size(); ++k) add(false, 1, outline.loops[k]);
  std::ranges::stable_sort(mesh.groups, {}, [](const Group& g) { return g.role != "open boundary"; });
}

/// Depth of the sea: shallow at the shore, a shelf, then a slope; metres to the decimetre.
double depth_at(Point p, const CoastMap& map, std::uint64_t seed) {
  const double d = map.from_land(p);
  const double shelf = 2.0 + 3.2 * d + 0.12 * d * d;
  const double slope = d > 12.0 ? 1.1 * (d - 12.0) * (d - 12.0) : 0.0;
  const double bumps = 1.0 + 0.25 * fractal_noise(p.x / 9.0, p.y / 9.0, 3, seed + 300) * std::min(1.0, d / 4.0);
  return std::round((shelf + slope) * bumps * 10.0) / 10.0;
}

/// Moves the vertices off the outlines at random, in some regions more than in others, like a mesh before any smoothing.
void roughen(Mesh& mesh, const Outline& outline, const CoastMap& map, const Request& request) {
  Random random(request.seed + 2);
  std::vector<Vec3> offsets;
  for (const Vec3& position : mesh.positions) {
    const Point p{position.x / 1000.0, position.y / 1000.0};
    const double strength = 0.22 + 0.3 * noise(p.x / 14.0, p.y / 14.0, request.seed + 400);
    const double reach = 1000.0 * std::max(0.05, strength) * map.edge_length(p);
    const double x = random.between(-reach, reach);
    offsets.push_back({x, random.between(-reach, reach), 0.0});
  }
  for (const auto& loop : outline.loops) {
    for (const Index v : loop) offsets[v] = {};
  }
  displace(mesh, offsets, 100.0, request.progress);
}

/// Generates a mesh with a given finest edge; false if the outline does not become edges of the triangulation of one sea.
bool try_coast(const CoastMap& map, const Request& request, Mesh& mesh) {
  Random random(request.seed + 1);
  Outline outline = make_outline(map, random);
  if (outline.loops.empty()) return false;
  std::vector<GridPoint> points = outline.points;
  const std::vector<GridPoint> inner = fill_sea(map, outline, random, request.progress);
  points.insert(points.end(), inner.begin(), inner.end());
  std::vector<std::array<Index, 3>> triangles;
  if (!triangulate(outline, points, triangles, request.progress)) return false;
  triangles = cut_out(outline, triangles);

  // Drops vertices of no triangle; there are none unless a loop had to be left out.
  std::vector<Index> renamed(points.size(), kNoIndex);
  for (const auto& t : triangles) {
    for (const Index v : t) renamed[v] = 0;
  }
  mesh = {};
  Field depth{.name = "depth", .on = Field::On::Vertices, .type = "double", .role = "depth"};
  std::vector<std::uint8_t> open;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (renamed[v] == kNoIndex) continue;
    renamed[v] = mesh.vertex_count();
    const Point p = from_grid(points[v]);
    mesh.positions.push_back({points[v].x / 100.0, points[v].y / 100.0, 0.0});  // converts to metres
    depth.values.push_back(depth_at(p, map, request.seed));
    open.push_back(map.on_arc(p) ? 1 : 0);
  }
  mesh.fields.push_back(std::move(depth));
  mesh.elements.reserve(triangles.size(), triangles.size() * 3);
  for (const auto& t : triangles) mesh.elements.add(ElementKind::Triangle, std::array{renamed[t[0]], renamed[t[1]], renamed[t[2]]});
  // Detects a strait that the edges of its two shores close, so that the sea falls apart.
  EdgeSurvey edges;
  const Topology topology(mesh, edges, request.progress);
  if (edges.components != 1) return false;
  for (auto& loop : outline.loops) {
    for (Index& v : loop) v = renamed[v];
  }
  name_boundaries(mesh, outline, open);
  roughen(mesh, outline, map, request);
  return true;
}

}  // namespace

Mesh coast(const Request& request) {
  // Searches the finest edge that yields about the wanted number of vertices, on a coarser map of the same sea.
  const auto wanted = static_cast<double>(request.size);
  double finest = 0.8 * std::sqrt(4000.0 / wanted);
  const CoastMap sketch(std::max(finest, 1.0), request.seed, request.progress);
  for (int round = 0; round < 6; ++round) finest *= std::sqrt(sketch.estimated_vertices(finest) / wanted);
  Mesh mesh;
  for (int attempt = 0; attempt < 8; ++attempt) {
    if (try_coast(CoastMap(finest, request.seed, request.progress), request, mesh)) return mesh;
    finest *= 0.96;
  }
  throw UsageError("coast: no mesh could be made with this size and seed; try another seed");
}

}  // namespace dmoscope::generators
