#pragma once
// Kinds of vertices and edges that the user gives by hand, against file and angles.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/input/input_mesh.h"

namespace dmoscope {

/// An edge by its ends, the lower first.
using EdgeEnds = std::array<Index, 2>;
[[nodiscard]] inline EdgeEnds edge_ends(Index a, Index b) noexcept { return a < b ? EdgeEnds{a, b} : EdgeEnds{b, a}; }

/// Kinds given by hand. Each list ascends without repetitions; lists never contradict each other.
struct Kinds {
  std::vector<Index> corners;         // vertices that stay though they could slide
  std::vector<Index> no_corners;      // vertices that slide along their curve, however much it turns there
  std::vector<EdgeEnds> features;     // feature edges: nothing crosses them, and vertices slide along them
  std::vector<EdgeEnds> no_features;  // smooth edges, however much the surface folds there

  [[nodiscard]] bool empty() const noexcept { return size() == 0; }
  [[nodiscard]] std::size_t size() const noexcept { return corners.size() + no_corners.size() + features.size() + no_features.size(); }
  [[nodiscard]] bool has_corner(Index vertex) const;
  [[nodiscard]] bool has_no_corner(Index vertex) const;
  [[nodiscard]] bool has_feature(EdgeEnds edge) const;
  [[nodiscard]] bool has_no_feature(EdgeEnds edge) const;
  friend bool operator==(const Kinds&, const Kinds&) = default;
};

/// Statement of the user on a vertex or an edge: it is a corner or feature edge, it is none, or as file and angles say.
enum class Saying : std::uint8_t { Is, IsNot, Automatic };

/// Adds statements on vertices; the last one counts.
void say_corners(Kinds& kinds, std::span<const Index> vertices, Saying saying);
void say_features(Kinds& kinds, std::span<const EdgeEnds> edges, Saying saying);
/// Kinds with only these vertices, as stated; empty if they are automatic.
[[nodiscard]] Kinds only_corners(std::span<const Index> vertices, Saying saying);
[[nodiscard]] Kinds only_features(std::span<const EdgeEnds> edges, Saying saying);

/// The other ends of the edges at a vertex, of elements of any kind, ascending.
[[nodiscard]] std::vector<Index> edges_at(const InputMesh& input, Index vertex);
/// Checks that the mesh has all vertices and edges. Throws UsageError.
void require_there(const InputMesh& input, const Kinds& kinds);

/// Phrase on the numbers: "2 corners, 1 no corner and 14 features by hand"; empty for none.
[[nodiscard]] std::string phrase(const Kinds& kinds);

}  // namespace dmoscope
