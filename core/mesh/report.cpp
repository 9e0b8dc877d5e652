#include "core/mesh/report.h"

#include <fmt/format.h>

namespace dmoscope {
namespace {

/// Adds a sentence with the first id: "1 vertex belongs to no element (17)", "2 vertices belong to no element (first: 17)".
void add(std::vector<std::string>& sentences, const std::vector<Index>& ids, const char* one, const char* many) {
  if (ids.size() == 1) sentences.push_back(fmt::format("1 {} ({})", one, ids.front()));
  if (ids.size() > 1) sentences.push_back(fmt::format("{} {} (first: {})", ids.size(), many, ids.front()));
}

void add(std::vector<std::string>& sentences, Index count, const char* one, const char* many) {
  if (count > 0) sentences.push_back(fmt::format("{} {}", count, count == 1 ? one : many));
}

}  // namespace

std::vector<std::string> MeshReport::sentences() const {
  std::vector<std::string> all = file_notes;
  if (seam_elements > 0)
    all.push_back(fmt::format("{} the meridian of {:g} degrees and {} judged unwrapped",
                              seam_elements == 1 ? "1 element crosses" : fmt::format("{} elements cross", seam_elements), seam,
                              seam_elements == 1 ? "is" : "are"));
  add(all, inverted_elements, "element is inverted", "elements are inverted");
  if (volume)
    add(all, degenerate_elements, "element has no volume", "elements have no volume");
  else
    add(all, degenerate_elements, "element has no area", "elements have no area");
  add(all, duplicate_elements, "element has the same corners as an earlier one", "elements have the same corners as an earlier one");
  add(all, non_manifold_edges, "edge has more than two elements; its ends stay fixed",
      "edges have more than two elements; their ends stay fixed");
  add(all, non_manifold_faces, "face is shared by more than two elements, or by an element and its duplicate; its corners stay fixed",
      "faces are shared by more than two elements, or by an element and its duplicate; their corners stay fixed");
  add(all, unused_vertices, "vertex belongs to no element", "vertices belong to no element");
  if (volume)
    add(all, flipped_elements, "element is wound inside out; it is turned over here, and its file gets it back as it was",
        "elements are wound inside out; they are turned over here, and their file gets them back as they were");
  else
    add(all, flipped_elements, "element is wound clockwise; it is turned over here and written back as it was",
        "elements are wound clockwise; they are turned over here and written back as they were");
  if (components > 1) all.push_back(fmt::format("the mesh has {} parts that share no {}", components, volume ? "face" : "edge"));
  return all;
}

}  // namespace dmoscope
