#include "core/mesh/front_faces.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "core/base/vec.h"

namespace dmoscope {
namespace {

/// A way for a cell to stand between two sheets: the corners of one face, and each one's partner on the opposite face, which is the corner
/// itself on an edge that both faces share. Seen from outside of the cell the first face runs clockwise: its normal points to the other.
struct PairedFaces {
  std::array<std::uint8_t, 4> bottom, top;
  std::uint8_t count;  // 3 or 4
};

constexpr std::array<PairedFaces, 3> kOfHexahedra{
    {{{0, 1, 2, 3}, {4, 5, 6, 7}, 4}, {{0, 3, 7, 4}, {1, 2, 6, 5}, 4}, {{0, 4, 5, 1}, {3, 7, 6, 2}, 4}}};
/// Ways of a wedge: upright, or lying with one of its three long edges on the axis.
constexpr std::array<PairedFaces, 4> kOfWedges{
    {{{0, 1, 2, 0}, {3, 4, 5, 0}, 3}, {{0, 3, 4, 1}, {0, 3, 5, 2}, 4}, {{1, 4, 5, 2}, {1, 4, 3, 0}, 4}, {{2, 5, 3, 0}, {2, 5, 4, 1}, 4}}};

std::span<const PairedFaces> ways_of(ElementKind kind) {
  return kind == ElementKind::Wedge ? std::span<const PairedFaces>(kOfWedges) : std::span<const PairedFaces>(kOfHexahedra);
}

/// A way chosen for a cell, as an index into ways_of(); `turned`: its top is the front.
struct Way {
  std::uint8_t number = 0;
  bool turned = false;
};

class Finder {
 public:
  Finder(const Mesh& mesh, const FaceNeighbours& faces)
      : mesh_(mesh), faces_(faces), way_(mesh.elements.size()), possible_(mesh.elements.size()) {
    const std::size_t vertices = mesh.positions.size();
    found_.front.assign(vertices, kNoIndex);
    found_.back.assign(vertices, kNoIndex);
  }

  FrontFaces find() {
    if (!faces_.non_manifold().empty()) return refused("some of its faces are of more than two cells");
    for (Index e = 0; e < size(); ++e) {
      possible_[e] = possible_ways(e);
      if (possible_[e] == 0) return refused(fmt::format("cell {} has no two faces across from each other on the boundary", e));
    }
    for (Index e = 0; e < size(); ++e)
      if (!way_[e] && std::has_single_bit(possible_[e]) && !follow(e)) return refused(std::move(why_not_));
    for (Index e = 0; e < size(); ++e)
      if (!way_[e]) return refused(fmt::format("cell {} may stand in several ways, and no neighbour tells in which", e));
    if (!keeps_its_thickness()) return refused(std::move(why_not_));
    take();
    return std::move(found_);
  }

 private:
  [[nodiscard]] Index size() const noexcept { return mesh_.elements.size(); }

  static FrontFaces refused(std::string why) {
    FrontFaces none;
    none.why_not = std::move(why);
    return none;
  }

  /// Bits of those of ways_of() whose two faces are both on the boundary.
  [[nodiscard]] std::uint8_t possible_ways(Index e) const {
    const ElementKind kind = mesh_.elements.kind(e);
    const auto local = faces_of(kind);
    const auto across = faces_.of(e);
    const auto outside = [&](const std::array<std::uint8_t, 4>& corners, std::uint8_t count) {
      for (std::size_t f = 0; f < local.size(); ++f) {
        const auto own = local[f].span();
        const auto has = [own](Index corner) { return std::ranges::find(own, corner) != own.end(); };
        if (own.size() == count && std::all_of(corners.begin(), corners.begin() + count, has)) return across[f] == kNoIndex;
      }
      return false;
    };
    const auto ways = ways_of(kind);
    unsigned possible = 0;
    for (std::size_t w = 0; w < ways.size(); ++w)
      if (outside(ways[w].bottom, ways[w].count) && outside(ways[w].top, ways[w].count)) possible |= 1U << w;
    return static_cast<std::uint8_t>(possible);
  }

  /// Calls see(vertex of the front, its partner) for each corner of the front.
  template <class See>
  void for_pairs(Index e, Way way, const See& see) const {
    const auto corners = mesh_.elements.corners(e);
    const PairedFaces& pair = ways_of(mesh_.elements.kind(e))[way.number];
    for (std::size_t i = 0; i < pair.count; ++i) {
      const Index low = corners[pair.bottom[i]], high = corners[pair.top[i]];
      way.turned ? see(high, low) : see(low, high);
    }
  }

  /// Whether the pairs of this way agree with those known already.
  [[nodiscard]] bool fits(Index e, Way way) const {
    bool fit = true;
    for_pairs(e, way, [&](Index front, Index back) {
      const Index known = found_.front[front], known_back = found_.front[back];
      if (known != kNoIndex && (known != front || found_.back[front] != back)) fit = false;
      if (known_back != kNoIndex && known_back != front) fit = false;
    });
    return fit;
  }

  /// The only way of the cell that agrees with the known pairs; none if there are several or none.
  [[nodiscard]] std::optional<Way> fitting(Index e) const {
    std::optional<Way> only;
    for (std::uint8_t w = 0; w < ways_of(mesh_.elements.kind(e)).size(); ++w) {
      if ((possible_[e] >> w & 1U) == 0) continue;
      for (const bool turned : {false, true}) {
        if (!fits(e, {w, turned})) continue;
        if (only) return std::nullopt;
        only = Way{w, turned};
      }
    }
    return only;
  }

  void stand(Index e, Way way) {
    way_[e] = way;
    for_pairs(e, way, [&](Index front, Index back) {
      found_.front[front] = found_.front[back] = front;
      found_.back[front] = back;
    });
  }

  [[nodiscard]] Vec3 offset(Index e, Way way) const {
    Vec3 sum;
    for_pairs(e, way, [&](Index front, Index back) { sum = sum + (mesh_.positions[back] - mesh_.positions[front]); });
    return sum;
  }

  /// Way of the first cell of a part: in the first part the front has the lowest vertex; further parts have their front on that side.
  [[nodiscard]] Way first_way(Index e) {
    Way way{static_cast<std::uint8_t>(std::countr_zero(possible_[e])), false};
    if (const Way other{way.number, true}; !fits(e, way) && fits(e, other)) return other;
    if (!begun_) {
      std::pair<Index, Index> least{kNoIndex, kNoIndex};
      for_pairs(e, way, [&](Index front, Index back) {
        if (front != back) least = {std::min(least.first, front), std::min(least.second, back)};
      });
      way.turned = least.second < least.first;
      ahead_ = offset(e, way);
      begun_ = true;
    } else if (fits(e, {way.number, true})) {
      way.turned = dot(offset(e, way), ahead_) < 0.0;
    }
    return way;
  }

  /// Follows the neighbours from a cell to all connected ones. False: they contradict each other.
  bool follow(Index first) {
    const Way way = first_way(first);
    if (!fits(first, way)) return contradicted(first);
    stand(first, way);
    std::vector<Index> queue{first};
    while (!queue.empty()) {
      const Index e = queue.back();
      queue.pop_back();
      for (const Index next : faces_.of(e)) {
        if (next == kNoIndex || way_[next]) continue;
        const std::optional<Way> way_on = fitting(next);
        if (!way_on) return contradicted(next);
        stand(next, *way_on);
        queue.push_back(next);
      }
    }
    return true;
  }

  bool contradicted(Index e) {
    why_not_ = fmt::format("cell {} does not stand between front and back as its neighbours do", e);
    return false;
  }

  /// Whether the thickness changes slowly enough, see take_front().
  bool keeps_its_thickness() {
    constexpr double kMost = 0.25;
    for (Index e = 0; e < size(); ++e) {
      std::array<std::pair<Vec3, Vec3>, 4> corners;  // position, and offset to the back
      std::size_t n = 0;
      for_pairs(e, *way_[e], [&](Index front, Index back) {
        corners[n++] = {mesh_.positions[front], mesh_.positions[back] - mesh_.positions[front]};
      });
      for (std::size_t i = 0; i < n; ++i) {
        const auto& [at, ahead] = corners[i];
        const auto& [next, next_ahead] = corners[(i + 1) % n];
        if (length(next_ahead - ahead) <= kMost * length(next - at)) continue;
        why_not_ = fmt::format("the back of cell {} has another shape than its front", e);
        return false;
      }
    }
    return true;
  }

  void take() {
    found_.corners.resize(size());
    found_.counts.resize(size());
    for (Index e = 0; e < size(); ++e) {
      std::array<Index, 4>& corners = found_.corners[e];
      std::uint8_t& n = found_.counts[e];
      for_pairs(e, *way_[e], [&](Index front, Index) { corners[n++] = front; });
      if (way_[e]->turned) std::reverse(corners.begin() + 1, corners.begin() + n);
    }
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      if (found_.front[v] == kNoIndex) found_.front[v] = v;
  }

  const Mesh& mesh_;
  const FaceNeighbours& faces_;
  std::vector<std::optional<Way>> way_;
  std::vector<std::uint8_t> possible_;
  FrontFaces found_;
  std::string why_not_;
  Vec3 ahead_{};
  bool begun_ = false;
};

}  // namespace

std::string why_not_prismatic(const Mesh& mesh) {
  const auto prismatic = [](ElementKind kind) { return kind == ElementKind::Wedge || kind == ElementKind::Hexahedron; };
  if (mesh.elements.size() == 0 || !std::ranges::all_of(mesh.elements.kinds(), prismatic))
    return "not all of its cells are hexahedra and wedges";
  // Bounds the number of ways at a vertex: around a vertex of a triangulated sheet are six cells on average, and more only if sheets have
  // many handles.
  constexpr std::size_t kMost = 7;
  if (mesh.elements.all_corners().size() > kMost * mesh.positions.size()) return "its vertices have cells on all sides";
  return {};
}

FrontFaces find_front_faces(const Mesh& mesh, const FaceNeighbours& faces) { return Finder(mesh, faces).find(); }

}  // namespace dmoscope
