#pragma once
// Vertices of a cluster that slide on a surface of the input.

#include <optional>
#include <vector>

#include "core/mesh/plane.h"
#include "core/reference/deviation_bound.h"

namespace dmoscope {

/// Vertex on a surface in a joint move: it goes in the plane that touches the surface at its place, and then straight down.
struct SurfaceSlider {
  struct Stand {
    FacetPlace place;
    Vec3 position{};
  };
  Index free, vertex;  // its number in the problem, and in the mesh
  Stand begin, now, trial, best;
  Vec3 normal{};              // normal at its place
  Vec3 wished{};              // the way that the trial would lead it, in mesh units
  Vec3 asked{};               // the share of that way that it goes
  Vec3 blocked{};             // the way on which something stopped it, of length 1, until that is open again; zero: none
  double blocked_step = 0.0;  // how far that way must be open, in mesh units
  bool held = false;          // blocked on another way, too: it stays meanwhile
  bool stopped = false;       // whether it is drawn to a place where it may not go
};

/// Place where a way along the tangent plane ends. None: at no place of the surface.
[[nodiscard]] std::optional<SurfaceSlider::Stand> stand_on_surface(const Facets& facets, const SurfaceSlider::Stand& from, Vec3 normal,
                                                                   Vec3 way);
/// Goes as much of the asked way as the surface allows: all, half, and so on, or nothing.
void walk_on_surface(const Facets& facets, SurfaceSlider& slider);

}  // namespace dmoscope
