#pragma once
// Smoothing: moves vertices so that the worst cell becomes as good as possible; cells and boundary stay.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dmoscope/export.h"
#include "dmoscope/mesh.h"
#include "dmoscope/options.h"

namespace dmo {

/// Reason why the worst cell gets no better. In a mesh one cell thick, numbers are those of its front.
struct Held {
  Index cell = 0;                    // the worst cell, or the worst that can move
  double quality = 0.0;              // its quality
  std::string by;                    // main reason: "boundary", "interface", "corner", "hand", "neighbours" ...; "free": none
  std::vector<Index> vertices;       // its corners
  std::vector<std::string> reasons;  // reason of each corner
  std::string change;                // words for SmoothOptions::set() that would free it: "boundary slide"; empty: none is known
  bool certified = false;            // whether it is proved that no joint move raises the minimum, to first order
  std::string sentence;              // all of that for people
};

struct Smoothed {
  Mesh mesh;
  std::vector<Iteration> history;     // history[0] is the input
  std::uint64_t iteration = 0;        // number of the iteration whose end is `mesh`
  bool converged = false;             // whether until_converged was reached
  bool cancelled = false;             // whether after_iteration or progress ended it; `mesh` is the result until then
  std::string sentence;               // reason for the end: "converged: no vertex moved any more; ..."
  std::vector<std::string> warnings;  // sentences for the user
  std::optional<Held> held;           // see SmoothOptions::explain
  std::string fields;                 // changes of the point data: "depth was taken anew at the new places ..."; empty without any
};

/// Smooths the mesh. The positions have the bits that `dmoscope smooth` writes. Throws UsageError that begins with the option's name for
/// values out of range, unknown names, vertices that do not exist, and options that do not fit each other or the mesh.
[[nodiscard]] DMO_API Smoothed smooth(const Mesh& mesh, const SmoothOptions& options = {});

}  // namespace dmo
