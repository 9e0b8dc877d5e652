#include "core/mesh/edges.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/base/memory.h"
#include "core/base/vec.h"
#include "core/mesh/faces.h"

namespace dmoscope {

// Disjoint sets of indices that can be joined.

/// Disjoint sets with path halving. The root of a set is its lowest index.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(large_vector<Index>(count)) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  [[nodiscard]] Index find(Index i) noexcept {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Joins the sets of a and b. True if they were disjoint.
  bool join(Index a, Index b) noexcept {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }
  /// Moves out the parents, one for each index and never above it: the lowest index of a set is its own parent.
  [[nodiscard]] std::vector<Index> take_parents() noexcept { return std::move(parent_); }

 private:
  std::vector<Index> parent_;
};

namespace {

constexpr Index kCheckEvery = 1U << 16U;  // vertices between two checks for a cancel

bool planar(const Mesh& mesh, Index e) { return info(mesh.elements.kind(e)).dimension == 2; }

/// Finds elements with the corners of an earlier one. Two such elements share an edge, so only elements of one edge are compared.
class Duplicates {
 public:
  explicit Duplicates(const Mesh& mesh) : mesh_(mesh) {}

  void look_at(std::span<const EdgeSide> sides) {
    around_.clear();
    for (const EdgeSide& side : sides) around_.emplace_back(corner_set(mesh_.elements.corners(side.element)), side.element);
    std::ranges::sort(around_);
    for (std::size_t k = 1; k < around_.size(); ++k) {
      if (around_[k].first == around_[k - 1].first && around_[k].second != around_[k - 1].second) found_.push_back(around_[k].second);
    }
  }
  [[nodiscard]] std::vector<Index> take() {
    std::ranges::sort(found_);
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    return std::move(found_);
  }

 private:
  const Mesh& mesh_;
  std::vector<Index> found_;
  std::vector<std::pair<std::array<Index, 4>, Index>> around_;
};

/// Numbers the components in the order of their first elements.
void number_components(const Mesh& mesh, DisjointSets& sets, EdgeSurvey& survey) {
  survey.component = sets.take_parents();
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    Index& component = survey.component[e];  // the parent comes before its children, so its component has a number already
    if (component != e) {
      component = survey.component[component];
    } else {
      component = planar(mesh, e) ? survey.components++ : kNoIndex;
    }
  }
}

}  // namespace

bool same_corners(const Mesh& mesh, Index a, Index b) {
  const auto of_a = mesh.elements.corners(a);
  const auto of_b = mesh.elements.corners(b);
  if (of_a.size() != of_b.size()) return false;
  Index difference = 0;  // difference of the sums of the vertex numbers, which nearly always tells the elements apart
  for (std::size_t i = 0; i < of_a.size(); ++i) difference += of_a[i] - of_b[i];
  return difference == 0 && std::ranges::is_permutation(of_a, of_b);
}

namespace {

/// The edges from a vertex to higher ones in the usual case: a few elements, and two on each edge, which run it in opposite directions.
/// Finds them without sorting: the comparisons made do not depend on the vertices' numbers, which no processor predicts.
class PlainStar {
 public:
  PlainStar(const Mesh& mesh, const Topology& topology) : elements_(mesh.elements), topology_(topology) {}

  /// Looks at a vertex. False if its star is not the usual case.
  bool look_at(Index vertex) {
    const auto star = topology_.star(vertex);
    if (star.size() >= kMost) return false;
    std::size_t leaving = 0;
    std::size_t arriving = 0;
    for (const auto& [element, corner] : star) {
      if (info(elements_.kind(element)).dimension != 2) return false;
      const auto corners = elements_.corners(element);
      const Index next = corners[corner + 1 < corners.size() ? corner + 1 : 0];
      const Index before = corners[corner > 0 ? corner - 1 : corners.size() - 1];
      Index sum = corners[0] + corners[1] + corners[2];
      if (corners.size() > 3) sum += corners[3];
      leaving_[leaving] = {next, element, sum};
      leaving += next > vertex ? 1U : 0U;
      arriving_[arriving] = {before, element, sum};
      arriving += before > vertex ? 1U : 0U;
    }
    count_ = leaving;
    return leaving == arriving && match();
  }
  [[nodiscard]] std::size_t edges() const noexcept { return count_; }
  /// The two elements on an edge.
  [[nodiscard]] std::pair<Index, Index> sides(std::size_t i) const noexcept { return {leaving_[i].element, partner_[i]}; }

 private:
  static constexpr std::size_t kMost = 16;
  struct Side {
    Index other, element, corner_sum;
  };

  /// Whether each leaving side has one arriving side of its own, of an element with other corners (judged by their sum).
  bool match() {
    std::uint32_t taken = 0;
    bool plain = true;
    for (std::size_t i = 0; i < count_; ++i) {
      std::size_t at = 0;
      for (std::size_t k = 0; k < count_; ++k) at = arriving_[k].other == leaving_[i].other ? k : at;
      plain = plain && arriving_[at].other == leaving_[i].other && arriving_[at].corner_sum != leaving_[i].corner_sum;
      taken |= 1U << at;
      partner_[i] = arriving_[at].element;
    }
    return plain && taken == (1U << count_) - 1U;  // every side is taken exactly once
  }

  const ElementTable& elements_;
  const Topology& topology_;
  std::array<Side, kMost> leaving_{}, arriving_{};
  std::array<Index, kMost> partner_{};
  std::size_t count_ = 0;
};

class Surveyor {
 public:
  Surveyor(const Mesh& mesh, const Topology& topology)
      : mesh_(mesh), finder_(mesh, topology), plain_(mesh, topology), sets_(mesh.elements.size()), duplicates_(mesh) {}

  void look_at(Index vertex) {
    if (!plain_.look_at(vertex)) {
      finder_.around(vertex, vertex + 1, [&](Index other, std::span<const EdgeSide> sides) { look_at({vertex, other}, sides); });
      return;
    }
    survey_.edges += static_cast<Index>(plain_.edges());
    for (std::size_t i = 0; i < plain_.edges(); ++i) sets_.join(plain_.sides(i).first, plain_.sides(i).second);
  }
  EdgeSurvey finish() {
    survey_.duplicates = duplicates_.take();
    number_components(mesh_, sets_, survey_);
    return std::move(survey_);
  }

 private:
  void look_at(Edge edge, std::span<const EdgeSide> sides) {
    ++survey_.edges;
    if (sides.size() == 1) {
      survey_.boundary.push_back({edge, sides[0].element});
    } else if (sides.size() > 2) {
      survey_.non_manifold.push_back(edge);
      duplicates_.look_at(sides);
    } else if (sides[0].element != sides[1].element) {
      sets_.join(sides[0].element, sides[1].element);
      const bool twins = same_corners(mesh_, sides[0].element, sides[1].element);
      if (twins) duplicates_.look_at(sides);
      survey_.consistent = survey_.consistent && !twins && sides[0].leaving != sides[1].leaving;
    }
  }

  const Mesh& mesh_;
  EdgeFinder finder_;
  PlainStar plain_;
  DisjointSets sets_;
  Duplicates duplicates_;
  EdgeSurvey survey_;
};

}  // namespace

EdgeSurvey survey_edges(const Mesh& mesh, const Topology& topology, Progress* progress) {
  Surveyor surveyor(mesh, topology);
  for (Index v = 0; v < topology.vertex_count(); ++v) {
    if (progress != nullptr && v % kCheckEvery == 0) progress->check();
    surveyor.look_at(v);
  }
  return surveyor.finish();
}

namespace {

/// Curves of boundary edges, joined at vertices.
class BoundaryCurves {
 public:
  BoundaryCurves(const Mesh& mesh, const Topology& topology, const EdgeSurvey& survey) : survey_(survey) {
    std::unordered_map<Index, Index> degree;  // number of boundary edges at each vertex
    for (const auto& [edge, element] : survey.boundary) {
      if (++degree[edge.low] == 3) split_fans(mesh, topology, edge.low);
      if (++degree[edge.high] == 3) split_fans(mesh, topology, edge.high);
    }
  }

  [[nodiscard]] Index count() {
    // Curves are the connected sets of boundary edges: count = edges - successful joins.
    DisjointSets curves(survey_.boundary.size());
    std::unordered_map<std::uint64_t, Index> seen;
    Index loops = static_cast<Index>(survey_.boundary.size());
    for (Index k = 0; k < survey_.boundary.size(); ++k) {
      const auto& [edge, element] = survey_.boundary[k];
      for (const Index v : {edge.low, edge.high}) {
        const auto fan = fans_.find(corner_key(v, element));
        const std::uint64_t key = fan == fans_.end() ? corner_key(v, kNoIndex) : corner_key(v, fan->second);
        const auto [place, fresh] = seen.try_emplace(key, k);
        if (!fresh && curves.join(place->second, k)) --loops;
      }
    }
    return loops;
  }

 private:
  static std::uint64_t corner_key(Index vertex, Index element) { return (static_cast<std::uint64_t>(vertex) << 32U) | element; }

  /// Finds the fans of elements at a vertex where more than two boundary edges meet: those that are connected across edges through it.
  void split_fans(const Mesh& mesh, const Topology& topology, Index vertex) {
    const auto star = topology.star(vertex);
    const auto place = [star](Index element) {
      return static_cast<Index>(std::ranges::lower_bound(star, element, {}, &Incidence::element) - star.begin());
    };
    DisjointSets fans(star.size());
    EdgeFinder(mesh, topology).around(vertex, 0, [&](Index, std::span<const EdgeSide> sides) {
      if (sides.size() == 2) fans.join(place(sides[0].element), place(sides[1].element));
    });
    for (const Incidence& incidence : star) {
      fans_.try_emplace(corner_key(vertex, incidence.element), star[fans.find(place(incidence.element))].element);
    }
  }

  const EdgeSurvey& survey_;
  std::unordered_map<std::uint64_t, Index> fans_;  // first element of an element's fan, at the vertices with more than two boundary edges
};

}  // namespace

Index count_boundary_loops(const Mesh& mesh, const Topology& topology, const EdgeSurvey& survey) {
  return BoundaryCurves(mesh, topology, survey).count();
}

}  // namespace dmoscope
