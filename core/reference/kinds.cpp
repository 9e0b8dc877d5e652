#include "core/reference/kinds.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/number_text.h"

namespace dmoscope {

namespace {

template <class One>
void normalise(std::vector<One>& list) {
  std::ranges::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

template <class One>
void add(std::vector<One>& list, const std::vector<One>& more) {
  list.insert(list.end(), more.begin(), more.end());
  normalise(list);
}

template <class One>
void take(std::vector<One>& list, const std::vector<One>& less) {
  std::erase_if(list, [&](const One& one) { return std::ranges::binary_search(less, one); });
}

template <class One>
void say(std::vector<One>& are, std::vector<One>& are_not, std::vector<One> ones, Saying saying) {
  normalise(ones);
  take(are, ones);
  take(are_not, ones);
  if (saying == Saying::Is) add(are, ones);
  if (saying == Saying::IsNot) add(are_not, ones);
}

}  // namespace

bool Kinds::has_corner(Index vertex) const { return std::ranges::binary_search(corners, vertex); }
bool Kinds::has_no_corner(Index vertex) const { return std::ranges::binary_search(no_corners, vertex); }
bool Kinds::has_feature(EdgeEnds edge) const { return std::ranges::binary_search(features, edge); }
bool Kinds::has_no_feature(EdgeEnds edge) const { return std::ranges::binary_search(no_features, edge); }

void say_corners(Kinds& kinds, std::span<const Index> vertices, Saying saying) {
  say(kinds.corners, kinds.no_corners, {vertices.begin(), vertices.end()}, saying);
}

void say_features(Kinds& kinds, std::span<const EdgeEnds> edges, Saying saying) {
  std::vector<EdgeEnds> ordered;
  for (const auto& [a, b] : edges) ordered.push_back(edge_ends(a, b));
  say(kinds.features, kinds.no_features, std::move(ordered), saying);
}

Kinds only_corners(std::span<const Index> vertices, Saying saying) {
  Kinds kinds;
  say_corners(kinds, vertices, saying);
  return kinds;
}

Kinds only_features(std::span<const EdgeEnds> edges, Saying saying) {
  Kinds kinds;
  say_features(kinds, edges, saying);
  return kinds;
}

std::vector<Index> edges_at(const InputMesh& input, Index vertex) {
  std::vector<Index> others;
  const ElementTable& elements = input.mesh.elements;
  for (const Incidence& at : input.topology.star(vertex)) {
    const auto corners = elements.corners(at.element);
    for (const LocalFace& face : faces_of(elements.kind(at.element))) {
      const auto c = face.span();
      for (std::size_t i = 0; i < c.size(); ++i) {
        if (corners[c[i]] != vertex) continue;
        others.push_back(corners[c[i + 1 < c.size() ? i + 1 : 0]]);
        others.push_back(corners[c[i > 0 ? i - 1 : c.size() - 1]]);
      }
    }
  }
  normalise(others);
  std::erase(others, vertex);
  return others;
}

void require_there(const InputMesh& input, const Kinds& kinds) {
  const Index count = input.mesh.vertex_count();
  const auto require_vertex = [&](Index v) {
    if (v >= count) throw UsageError(fmt::format("there is no vertex {} (the mesh has {}, counted from 0)", v, count));
  };
  for (const auto* list : {&kinds.corners, &kinds.no_corners}) std::ranges::for_each(*list, require_vertex);
  for (const auto* list : {&kinds.features, &kinds.no_features}) {
    for (const auto& [a, b] : *list) {
      require_vertex(a), require_vertex(b);
      const std::vector<Index> others = edges_at(input, a);
      if (std::ranges::binary_search(others, b)) continue;
      const std::string to = others.empty() ? "none begins there" : fmt::format("those of {} lead to {}", a, fmt::join(others, ", "));
      throw UsageError(fmt::format("there is no edge {}-{}: {}", a, b, to));
    }
  }
}

std::string phrase(const Kinds& kinds) {
  std::vector<std::string> parts;
  const auto part = [&](std::size_t count, const char* one, const char* many) {
    if (count > 0) parts.push_back(counted(count, one, many));
  };
  part(kinds.corners.size(), "corner", "corners");
  part(kinds.no_corners.size(), "no corner", "no corners");
  part(kinds.features.size(), "feature edge", "feature edges");
  part(kinds.no_features.size(), "smooth edge", "smooth edges");
  if (parts.empty()) return {};
  const std::string last = std::move(parts.back());
  parts.pop_back();
  return fmt::format("{}{}{} by hand", fmt::join(parts, ", "), parts.empty() ? "" : " and ", last);
}

}  // namespace dmoscope
