#include "app/verbs/input_report.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include <fmt/format.h>

#include "app/console.h"
#include "core/base/error.h"

namespace dmoscope::app {
namespace {

Index parse_id(std::string_view word, const std::string& text, Index count) {
  Index id = 0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, id);
  if (error != std::errc{} || stop != end) {
    throw UsageError(fmt::format("--fix {}: neither a group of the mesh nor a list of vertices like 3,7-9", text));
  }
  if (id >= count) throw UsageError(fmt::format("--fix {}: there is no vertex {} (the mesh has {}, counted from 0)", text, id, count));
  return id;
}

void add_list(const std::string& text, Index count, std::vector<Index>& vertices) {
  std::string_view rest = text;
  while (true) {
    const auto comma = rest.find(',');
    const std::string_view word = rest.substr(0, comma);
    const auto dash = word.find('-');
    const Index first = parse_id(word.substr(0, dash), text, count);
    const Index last = dash == std::string_view::npos ? first : parse_id(word.substr(dash + 1), text, count);
    if (last < first) throw UsageError(fmt::format("--fix {}: the range {} runs backwards", text, word));
    for (Index v = first; v <= last; ++v) vertices.push_back(v);
    if (comma == std::string_view::npos) return;
    rest.remove_prefix(comma + 1);
  }
}

bool add_group(const std::string& name, const Mesh& mesh, std::vector<Index>& vertices) {
  bool found = false;
  for (const Group& group : mesh.groups) {
    if (group.name != name) continue;
    found = true;
    const auto of_group = group.vertices();
    vertices.insert(vertices.end(), of_group.begin(), of_group.end());
    if (!group.of_elements()) continue;
    for (const Index element : group.members) {
      const auto corners = mesh.elements.corners(element);
      vertices.insert(vertices.end(), corners.begin(), corners.end());
    }
  }
  return found;
}

}  // namespace

std::vector<std::string> tell_findings(const InputMesh& input) {
  std::vector<std::string> sentences = input.report.sentences();
  for (const std::string& sentence : sentences) complain(fmt::format("{}: {}", input.mesh.name, sentence));
  return sentences;
}

std::vector<Index> named_vertices(const Mesh& mesh, const std::vector<std::string>& texts) {
  std::vector<Index> vertices;
  for (const std::string& text : texts) {
    if (!add_group(text, mesh, vertices)) add_list(text, mesh.vertex_count(), vertices);
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace dmoscope::app
