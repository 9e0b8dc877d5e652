#pragma once
// Trace of the search of one vertex.

#include <cstddef>
#include <string>
#include <vector>

#include "dmoscope/export.h"
#include "dmoscope/mesh.h"
#include "dmoscope/smooth.h"

namespace dmo {

/// Level of the search: a grid of candidates, finer than that of the level before.
struct TraceLevel {
  std::size_t points = 0;          // candidates per axis
  std::vector<double> candidates;  // places, mesh units: points^2 x 3, in a volume points^3 x 3; the last axis varies fastest
  std::vector<double> values;      // one per candidate: the number that the search compared; more is better
  std::vector<double> quality;     // one per candidate: quality of the worst cell of the star, with the vertex there
  long best = -1;                  // number of the chosen candidate; -1: none is better than the one found before
};

struct Trace {
  double from[3] = {}, to[3] = {};   // places of the vertex before and after, mesh units
  double before = 0.0, after = 0.0;  // quality of the worst cell of its star, before and after
  std::vector<TraceLevel> levels;    // empty if the vertex may not move
  std::string value;                 // name of the number in `values`: "mean ratio"
  std::string sentence;              // the outcome: "moved: worst element of its star 0.31 -> 0.82"
};

/// Returns what the first visit of dmo would do to a vertex of the mesh at its present positions. Options as in smooth(). Not for curved
/// surfaces. Throws UsageError.
[[nodiscard]] DMO_API Trace trace(const Mesh& mesh, Index vertex, const SmoothOptions& options = {});

}  // namespace dmo
