#pragma once
// Vertices of a cluster that slide on a surface of the input.

#include <optional>
#include <vector>

#include "core/mesh/plane.h"
#include "core/reference/deviation_bound.h"

namespace dmoscope {

/// A vertex on a surface, as a joint move has it: it goes in the plane that touches the surface where it stands, and then straight down.
struct SurfaceSlider {
  struct Stand {
    FacetPlace place;
    Vec3 position{};
  };
  Index free, vertex;  // its number in the problem, and in the mesh
  Stand begin, now, trial, best;
  Vec3 normal{};              // where it stands
  Vec3 wished{};              // how far the trial would lead it, in mesh units
  Vec3 asked{};               // the share of it that it goes
  Vec3 blocked{};             // of length 1: the way on which something stopped it, until that is open again; zero: none
  double blocked_step = 0.0;  // how far that way must be open, in mesh units
  bool held = false;          // on another way, too: it stays meanwhile
  bool stopped = false;       // is it drawn to where it may not go?
};

/// Where a way along the tangent plane leads. None: to no place of the surface.
[[nodiscard]] std::optional<SurfaceSlider::Stand> stand_on_surface(const Facets& facets, const SurfaceSlider::Stand& from, Vec3 normal,
                                                                   Vec3 way);
/// Goes as much of the way that is asked as the surface lets it: all, half, and so on, or nothing.
void walk_on_surface(const Facets& facets, SurfaceSlider& slider);

}  // namespace dmoscope
