#include "ui/state/selection.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "core/commands/commands.h"

namespace dmoscope::ui {
namespace {

void order(std::vector<Index>& vertices) {
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

Index parse_id(const std::string& word, Index count) {
  const std::uint64_t id = to_count(word);
  if (id >= count) throw UsageError(fmt::format("there is no vertex {}: the mesh has {}", id, count));
  return static_cast<Index>(id);
}

}  // namespace

bool Selection::contains(Index vertex) const { return std::binary_search(vertices_.begin(), vertices_.end(), vertex); }

void Selection::assign(std::vector<Index> vertices) {
  order(vertices);
  vertices_ = std::move(vertices);
  ++serial_;
}

void Selection::add(std::span<const Index> vertices) {
  std::vector<Index> all = vertices_;
  all.insert(all.end(), vertices.begin(), vertices.end());
  assign(std::move(all));
}

void Selection::remove(std::vector<Index> vertices) {
  order(vertices);
  std::vector<Index> rest;
  std::set_difference(vertices_.begin(), vertices_.end(), vertices.begin(), vertices.end(), std::back_inserter(rest));
  assign(std::move(rest));
}

Selection after_stroke(const Selection& selection, const Brush& brush) {
  Selection result = selection;
  const std::vector<Index>& touched = brush.stroke.vertices();
  if (brush.kind == StrokeKind::Select) result.assign(touched);
  if (brush.kind == StrokeKind::Add) result.add(touched);
  if (brush.kind == StrokeKind::Remove) result.remove(touched);
  return result;
}

std::string id_ranges(std::span<const Index> vertices) {
  std::string text;
  for (std::size_t first = 0; first < vertices.size();) {
    std::size_t last = first;
    while (last + 1 < vertices.size() && vertices[last + 1] == vertices[last] + 1) ++last;
    if (!text.empty()) text += ' ';
    text += fmt::to_string(vertices[first]);
    if (last > first) text += fmt::format("-{}", vertices[last]);
    first = last + 1;
  }
  return text;
}

std::vector<Index> parse_id_ranges(std::span<const std::string> words, Index count) {
  std::vector<Index> vertices;
  for (const std::string& word : words) {
    const std::size_t dash = word.find('-', 1);
    const Index first = parse_id(word.substr(0, dash), count);
    const Index last = dash == std::string::npos ? first : parse_id(word.substr(dash + 1), count);
    if (last < first) throw UsageError(fmt::format("\"{}\": the second number must not be below the first", word));
    for (Index v = first; v <= last; ++v) vertices.push_back(v);
  }
  order(vertices);
  return vertices;
}

}  // namespace dmoscope::ui
