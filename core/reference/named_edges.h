#pragma once
// Names that a file gives to edges: by its lines, and by its strings of vertices.

#include <optional>
#include <span>
#include <vector>

#include "core/mesh/named_lists.h"

namespace dmoscope {

/// Groups that name each edge. Mesh and topology must outlive it.
class NamedEdges {
 public:
  NamedEdges(const Mesh& mesh, const Topology& topology);
  /// Whether two edges at a vertex are named by exactly the same groups.
  [[nodiscard]] bool same(Index vertex, Index one, Index other) const;
  /// Calls visit(a, b) for every edge that a line names, except if all edges around are merely listed.
  template <class Visit>
  void for_lines(const Visit& visit) {
    for (const Name& name : names_)
      if (mesh_.groups[name.group].dimension == 1 && !list_->surrounds(name.low) && !list_->surrounds(name.high))
        visit(name.low, name.high);
  }

 private:
  struct Name {
    Index low, high, group;
    friend auto operator<=>(const Name&, const Name&) = default;
  };
  void add(Index a, Index b, Index group);
  [[nodiscard]] std::span<const Name> of(Index a, Index b) const;

  const Mesh& mesh_;
  std::vector<Name> names_;  // names in ascending order
  std::vector<const Group*> lines_;
  std::optional<NamedList> list_;
};

}  // namespace dmoscope
