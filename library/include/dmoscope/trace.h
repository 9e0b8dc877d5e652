#pragma once
// Looking into the search of one vertex.

#include <cstddef>
#include <string>
#include <vector>

#include "dmoscope/export.h"
#include "dmoscope/mesh.h"
#include "dmoscope/smooth.h"

namespace dmo {

/// A level of the search: a grid of candidates, each next one finer.
struct TraceLevel {
  std::size_t points = 0;          // per axis
  std::vector<double> candidates;  // points^2 x 3, of a volume points^3 x 3: places, mesh units. The last axis counts fastest
  std::vector<double> values;      // of each: what the search compared; more is better
  std::vector<double> quality;     // of each: the worst cell of the star, with the vertex there
  long best = -1;                  // the candidate that was chosen; -1: none is better than what was found before
};

struct Trace {
  double from[3] = {}, to[3] = {};   // where the vertex stands, and where it goes
  double before = 0.0, after = 0.0;  // the worst cell of its star
  std::vector<TraceLevel> levels;    // none of a vertex that may not move
  std::string value;                 // what `values` are: "mean ratio"
  std::string sentence;              // what came of it: "moved: worst element of its star 0.31 -> 0.82"
};

/// What the first visit of dmo would do to a vertex of the mesh as it is. Options as in smooth(). Not of curved surfaces. Throws
/// UsageError.
[[nodiscard]] DMO_API Trace trace(const Mesh& mesh, Index vertex, const SmoothOptions& options = {});

}  // namespace dmo
