// Connections of CGNS zones, point to point, which identify vertices that may be at different places.

#include <algorithm>
#include <array>
#include <cstdlib>

#include <fmt/format.h>

#include "core/io/cgns/cgns.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {
namespace {

using Indices = std::array<std::int64_t, 3>;

/// A block of points: its begin and end along each index, from 1, both included; it may run downwards.
struct IndexBlock {
  Indices begin{1, 1, 1}, end{1, 1, 1};
};

/// Reads the connections of a zone, point by point, with the points of the other zone that they are identified with.
class ConnectionReader {
 public:
  ConnectionReader(const CgnsTree& tree, const CgnsPoints& points, const CgnsZone& zone) : tree_(tree), points_(points), zone_(zone) {}

  std::vector<std::array<Index, 2>> read() {
    for (const CgnsNode& all : tree_.children(zone_.node, "ZoneGridConnectivity_t")) {
      for (const CgnsNode& node : tree_.children(all, "GridConnectivity1to1_t")) block(node);
      for (const CgnsNode& node : tree_.children(all, "GridConnectivity_t")) list(node);
    }
    return std::move(pairs_);
  }

 private:
  [[nodiscard]] std::vector<std::int64_t> numbers(const CgnsNode& of, std::string_view name) const {
    const auto node = tree_.named(of, name);
    return node ? tree_.wholes(*node) : std::vector<std::int64_t>();
  }

  /// The zone on the other side.
  [[nodiscard]] const CgnsZone& donor(const CgnsNode& node) const {
    const std::string name = tree_.text(node);
    const std::string last = name.substr(name.rfind('/') + 1);  // last part of "Base/Zone"
    const auto found = std::ranges::find_if(points_.zones, [&](const CgnsZone& zone) { return zone.node.name == last; });
    if (found == points_.zones.end()) tree_.fail(node, fmt::format("it connects to the zone {}, which is not there", quote_token(name)));
    return *found;
  }

  void pair(Index one, Index other) {
    if (one != other) pairs_.push_back({std::min(one, other), std::max(one, other)});
  }

  [[nodiscard]] IndexBlock range(const CgnsNode& node, std::string_view name, const CgnsZone& zone) const {
    const std::vector<std::int64_t> ends = numbers(node, name);
    const std::size_t n = zone.sizes.size();
    if (!zone.structured || ends.size() != 2 * n) tree_.fail(node, fmt::format("{} is no range of points", name));
    IndexBlock block;
    for (std::size_t i = 0; i < n; ++i) {
      block.begin[i] = ends[i];
      block.end[i] = ends[n + i];
      for (const std::int64_t at : {ends[i], ends[n + i]})
        if (at < 1 || at > zone.sizes[i]) tree_.fail(node, fmt::format("{} leaves the zone {}", name, quote_token(zone.node.name)));
    }
    return block;
  }

  [[nodiscard]] Index vertex(const CgnsNode& node, const CgnsZone& zone, const Indices& at) const {
    std::int64_t number = 0;
    for (std::size_t i = zone.sizes.size(); i-- > 0;) {
      if (at[i] < 1 || at[i] > zone.sizes[i]) tree_.fail(node, fmt::format("it leaves the zone {}", quote_token(zone.node.name)));
      number = number * zone.sizes[i] + (at[i] - 1);
    }
    return points_.vertex_of[zone.first + static_cast<Index>(number)];
  }

  /// For each index of this zone the index of the other zone, from 1, negative if it runs in the other direction.
  [[nodiscard]] Indices transform(const CgnsNode& node) const {
    const std::size_t n = zone_.sizes.size();
    Indices to{1, 2, 3};
    const std::vector<std::int64_t> given = numbers(node, "Transform");
    if (given.empty()) return to;
    std::array<bool, 3> taken{};
    bool fits = given.size() == n;
    for (std::size_t i = 0; fits && i < n; ++i) {
      fits =
          given[i] != 0 && std::abs(given[i]) <= static_cast<std::int64_t>(n) && !taken[static_cast<std::size_t>(std::abs(given[i]) - 1)];
      if (fits) taken[static_cast<std::size_t>(std::abs(given[i]) - 1)] = true;
    }
    if (!fits) tree_.fail(node, "its Transform is none");
    std::ranges::copy(given, to.begin());
    return to;
  }

  /// Pairs the points of two structured zones, by ranges and a transform.
  void block(const CgnsNode& node) {
    const CgnsZone& other = donor(node);
    const IndexBlock own = range(node, "PointRange", zone_), across = range(node, "PointRangeDonor", other);
    if (other.sizes.size() != zone_.sizes.size()) tree_.fail(node, "it connects zones of different dimensions");
    const Indices to = transform(node);
    const std::size_t n = zone_.sizes.size();
    Indices step{0, 0, 0};
    for (std::size_t i = 0; i < n; ++i) step[i] = own.end[i] < own.begin[i] ? -1 : 1;
    for (Indices at = own.begin;;) {
      Indices there = across.begin;
      for (std::size_t i = 0; i < n; ++i) {
        const auto axis = static_cast<std::size_t>(std::abs(to[i]) - 1);
        there[axis] += to[i] < 0 ? own.begin[i] - at[i] : at[i] - own.begin[i];
      }
      pair(vertex(node, zone_, at), vertex(node, other, there));
      std::size_t i = 0;
      for (; i < n && at[i] == own.end[i]; ++i) at[i] = own.begin[i];
      if (i == n) return;
      at[i] += step[i];
    }
  }

  /// Pairs the points of two unstructured zones, by two lists in the same order. Lists of faces pair nothing: they name no points.
  void list(const CgnsNode& node) {
    const auto type = tree_.child(node, "GridConnectivityType_t");
    const auto location = tree_.child(node, "GridLocation_t");
    if (!type || tree_.text(*type) != "Abutting1to1" || (location && tree_.text(*location) != "Vertex")) return;
    const std::vector<std::int64_t> own = numbers(node, "PointList"), across = numbers(node, "PointListDonor");
    if (own.empty() && across.empty()) return;
    const CgnsZone& other = donor(node);
    if (zone_.structured || other.structured) return;  // such lists have several indices for each point
    if (own.size() != across.size()) tree_.fail(node, fmt::format("{} points are connected to {}", own.size(), across.size()));
    for (std::size_t i = 0; i < own.size(); ++i) pair(vertex(node, zone_, {own[i], 1, 1}), vertex(node, other, {across[i], 1, 1}));
  }

  const CgnsTree& tree_;
  const CgnsPoints& points_;
  const CgnsZone& zone_;
  std::vector<std::array<Index, 2>> pairs_;
};

}  // namespace

std::vector<std::array<Index, 2>> read_cgns_pairs(const CgnsTree& tree, const CgnsPoints& points) {
  std::vector<std::array<Index, 2>> pairs;
  for (const CgnsZone& zone : points.zones) {
    const auto some = ConnectionReader(tree, points, zone).read();
    pairs.insert(pairs.end(), some.begin(), some.end());
  }
  std::ranges::sort(pairs);  // each pair is in both zones
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace dmoscope
