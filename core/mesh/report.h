#pragma once
// What a person should know about a mesh as it was read.

#include <string>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// Findings a person should know of; never fatal.
struct MeshReport {
  std::vector<std::string> file_notes;  // what the reader passed over (SourceFile::notes)
  std::vector<Index> unused_vertices;
  std::vector<Index> duplicate_elements;   // elements with the very corners (as a set) of an earlier one
  std::vector<Index> degenerate_elements;  // zero area or volume, or a corner twice
  std::vector<Index> inverted_elements;    // some corner Jacobian <= 0 (after orientation), degenerate ones not counted again
  Index non_manifold_edges = 0;            // edges with more than two elements
  Index non_manifold_faces = 0;            // faces of volume elements that are of more than two, once for each
  Index boundary_loops = 0;                // closed boundary curves (edges.h)
  Index components = 0;
  Index flipped_elements = 0;
  Index seam_elements = 0;  // of a mesh in longitude and latitude that wraps (seam.h): elements that cross its seam,
  double seam = 0.0;        // which is this meridian, degrees
  bool volume = false;      // the mesh is a volume mesh
  /// One clear sentence a finding, e.g. "2 vertices belong to no element (first: 17)". Ids are 0-based.
  [[nodiscard]] std::vector<std::string> sentences() const;
};

}  // namespace dmoscope
