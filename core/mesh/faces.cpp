#include "core/mesh/faces.h"

#include <algorithm>
#include <numeric>

#include "core/base/memory.h"
#include "core/mesh/edges.h"

namespace dmoscope {

namespace {

constexpr std::array<LocalFace, 1> kTriangle{{{3, {0, 1, 2}}}}, kQuadrilateral{{{4, {0, 1, 2, 3}}}};
constexpr std::array<LocalFace, 4> kTetrahedron{{{3, {0, 2, 1}}, {3, {0, 1, 3}}, {3, {1, 2, 3}}, {3, {0, 3, 2}}}};
constexpr std::array<LocalFace, 6> kHexahedron{
    {{4, {0, 3, 2, 1}}, {4, {4, 5, 6, 7}}, {4, {0, 1, 5, 4}}, {4, {1, 2, 6, 5}}, {4, {2, 3, 7, 6}}, {4, {3, 0, 4, 7}}}};
constexpr std::array<LocalFace, 5> kWedge{{{3, {0, 2, 1}}, {3, {3, 4, 5}}, {4, {0, 1, 4, 3}}, {4, {1, 2, 5, 4}}, {4, {2, 0, 3, 5}}}};
constexpr std::array<LocalFace, 5> kPyramid{{{4, {0, 3, 2, 1}}, {3, {0, 1, 4}}, {3, {1, 2, 4}}, {3, {2, 3, 4}}, {3, {3, 0, 4}}}};

constexpr Index kFacesBetweenLooks = 1U << 16U;

using Corners = std::array<Index, 4>;

/// A face with its sorted vertices and its place.
struct KeyedFace {
  Corners key;
  std::uint32_t place;  // index into across_
  Index element;
};

}  // namespace

std::span<const LocalFace> faces_of(ElementKind kind) noexcept {
  switch (kind) {
    case ElementKind::Tetrahedron:
      return kTetrahedron;
    case ElementKind::Hexahedron:
      return kHexahedron;
    case ElementKind::Wedge:
      return kWedge;
    case ElementKind::Pyramid:
      return kPyramid;
    case ElementKind::Triangle:
      return kTriangle;
    case ElementKind::Quadrilateral:
      return kQuadrilateral;
  }
  return {};
}

std::array<Index, 4> corner_set(std::span<const Index> corners) noexcept {
  Corners set{kNoIndex, kNoIndex, kNoIndex, kNoIndex};
  std::ranges::copy(corners, set.begin());
  std::ranges::sort(set);
  return set;
}

std::array<Index, 4> vertices_of(const ElementTable& elements, ElementFace face) noexcept {
  const LocalFace& local = faces_of(elements.kind(face.element))[face.face];
  const auto corners = elements.corners(face.element);
  Corners vertices{kNoIndex, kNoIndex, kNoIndex, kNoIndex};
  for (Index i = 0; i < local.count; ++i) vertices[i] = corners[local.corners[i]];
  return vertices;
}

FaceNeighbours::FaceNeighbours(const Mesh& mesh, Progress* progress) {
  const ElementTable& elements = mesh.elements;
  const Index count = elements.size();
  reserve_large(offsets_, count + 1);
  for (Index e = 0; e < count; ++e) offsets_.push_back(offsets_.back() + static_cast<std::uint32_t>(faces_of(elements.kind(e)).size()));
  across_ = large_vector<Index>(offsets_.back());
  std::ranges::fill(across_, kNoIndex);

  // Sorts faces into buckets by their lowest vertex, and then the few faces of each bucket.
  auto first = large_vector<std::uint32_t>(mesh.positions.size() + 2);
  const auto lowest = [&](ElementFace f) { return std::ranges::min(vertices_of(elements, f)); };
  const auto for_all = [&](auto&& visit) {
    for (Index e = 0; e < count; ++e) {
      if (progress != nullptr && e % kFacesBetweenLooks == 0) progress->check();
      const auto faces = static_cast<Index>(faces_of(elements.kind(e)).size());
      for (Index f = 0; f < faces; ++f) visit(ElementFace{e, f});
    }
  };
  for_all([&](ElementFace f) { ++first[lowest(f) + 2]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  auto order = large_vector<ElementFace>(across_.size());
  for_all([&](ElementFace f) { order[first[lowest(f) + 1]++] = f; });

  std::vector<std::uint8_t> shared_by_many;  // by place in across_; empty unless there is such a face
  std::vector<KeyedFace> bucket;
  for (std::size_t v = 0; v + 1 < first.size(); ++v) {
    bucket.clear();
    for (std::uint32_t i = first[v]; i < first[v + 1]; ++i)
      bucket.push_back({corner_set(vertices_of(elements, order[i])), offsets_[order[i].element] + order[i].face, order[i].element});
    std::ranges::stable_sort(bucket, {}, &KeyedFace::key);
    for (std::size_t i = 0, end = 0; i < bucket.size(); i = end) {
      while (end < bucket.size() && bucket[end].key == bucket[i].key) ++end;
      ++face_count_;
      // Leaves out an element and its duplicate, which lie on top of each other: neither is across the other's faces.
      if (end - i == 2 && !same_corners(mesh, bucket[i].element, bucket[i + 1].element)) {
        across_[bucket[i].place] = bucket[i + 1].element;
        across_[bucket[i + 1].place] = bucket[i].element;
      } else if (end - i >= 2) {
        shared_by_many.resize(across_.size(), 0);
        for (std::size_t k = i; k < end; ++k) shared_by_many[bucket[k].place] = 1;
      }
    }
  }
  for_all([&](ElementFace f) {
    const std::uint32_t place = offsets_[f.element] + f.face;
    if (across_[place] != kNoIndex) return;
    (shared_by_many.empty() || shared_by_many[place] == 0 ? boundary_ : non_manifold_).push_back(f);
  });
}

Index FaceNeighbours::face_across(const ElementTable& elements, ElementFace at) const noexcept {
  const Index other = of(at.element)[at.face];
  if (other == kNoIndex) return kNoIndex;
  const Corners wanted = corner_set(vertices_of(elements, at));
  const auto faces = static_cast<Index>(faces_of(elements.kind(other)).size());
  for (Index f = 0; f < faces; ++f)
    if (corner_set(vertices_of(elements, {other, f})) == wanted) return f;
  return kNoIndex;
}

bool same_direction(const ElementTable& elements, ElementFace a, ElementFace b) noexcept {
  const Corners one = vertices_of(elements, a), other = vertices_of(elements, b);
  const std::size_t n = one[3] == kNoIndex ? 3 : 4;
  const auto start = static_cast<std::size_t>(std::ranges::find(other, one[0]) - other.begin());
  return start < n && other[(start + 1) % n] == one[1];
}

}  // namespace dmoscope
