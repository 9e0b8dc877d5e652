#pragma once
// Findings about a mesh as it was read.

#include <string>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// Findings that the user should know of; never fatal.
struct MeshReport {
  std::vector<std::string> file_notes;  // contents of the file that the reader ignored (SourceFile::notes)
  std::vector<Index> unused_vertices;
  std::vector<Index> duplicate_elements;   // elements with exactly the corners (as a set) of an earlier one
  std::vector<Index> degenerate_elements;  // elements of zero area or volume, or with a repeated corner
  std::vector<Index> inverted_elements;    // elements with a corner Jacobian <= 0 (after orientation), without the degenerate ones
  Index non_manifold_edges = 0;            // edges with more than two elements
  Index non_manifold_faces = 0;            // faces that more than two volume elements share, each counted once
  Index boundary_loops = 0;                // closed boundary curves (edges.h)
  Index components = 0;
  Index flipped_elements = 0;
  Index seam_elements = 0;  // elements across the seam of a mesh in longitude and latitude that wraps (seam.h)
  double seam = 0.0;        // meridian of that seam, in degrees
  bool volume = false;      // the mesh is a volume mesh
  /// One clear sentence for each finding, such as "2 vertices belong to no element (first: 17)". Ids are 0-based.
  [[nodiscard]] std::vector<std::string> sentences() const;
};

}  // namespace dmoscope
