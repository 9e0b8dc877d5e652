#include "core/session/input_marks.h"

#include <algorithm>
#include <bit>
#include <map>

#include <fmt/format.h>

#include "core/base/fnv1a.h"
#include "core/base/terminal_text.h"
#include "core/mesh/materials.h"

namespace dmoscope {

namespace {

std::string mark_of(const Field& field) {
  Fnv1a hash;
  hash.add_number(static_cast<std::uint64_t>(field.components));
  for (const double value : field.values) hash.add_number(std::bit_cast<std::uint64_t>(value));
  return hash.text();
}

std::string mark_of(const Group& group) {
  Fnv1a hash;
  hash.add_bytes(group.role);
  hash.add_number(static_cast<std::uint64_t>(group.dimension));
  for (const Index member : group.members) hash.add_number(member);
  for (const Index corner : group.faces.all_corners()) hash.add_number(corner);
  return hash.text();
}

/// Marks by name: several may share one, and a change of one of these must not go unnoticed.
std::multimap<std::string, std::string> by_name(const std::vector<DataMark>& marks) { return {marks.begin(), marks.end()}; }

}  // namespace

std::string standing_mark(const InputMesh& input, const StandingRule& rule) {
  Fnv1a hash;
  const std::vector<std::uint8_t> standing = standing_vertices(input, rule);
  for (Index v = 0; v < standing.size(); ++v)
    if (standing[v] != 0) hash.add_number(v);
  return hash.text();
}

std::string size_mark(const InputMesh& input, const SizeField* size) {
  if (size == nullptr || size->function().kind != SizeFunction::Kind::Field) return {};
  for (const Field& field : input.mesh.fields)
    if (field.on == Field::On::Vertices && field.components == 1 && field.name == size->function().field) return mark_of(field);
  return {};
}

std::vector<DataMark> data_marks(const Mesh& mesh) {
  std::vector<DataMark> marks;
  for (const Group& group : mesh.groups) marks.emplace_back(fmt::format("group \"{}\"", terminal_line(group.name)), mark_of(group));
  for (const Field& field : mesh.fields)
    if (naming_of(field) != Naming::Nothing) marks.emplace_back(fmt::format("field \"{}\"", terminal_line(field.name)), mark_of(field));
  return marks;
}

std::string changed_data(const std::vector<DataMark>& then, const std::vector<DataMark>& now) {
  constexpr std::size_t kMost = 4;
  const auto before = by_name(then), after = by_name(now);
  const auto differ = [](const auto& marks, const auto& others, const std::string& name) {
    std::vector<std::string> a, b;
    for (auto [it, end] = marks.equal_range(name); it != end; ++it) a.push_back(it->second);
    for (auto [it, end] = others.equal_range(name); it != end; ++it) b.push_back(it->second);
    std::ranges::sort(a);
    std::ranges::sort(b);
    return a != b;
  };
  std::vector<std::string> parts;
  const auto add = [&](const std::string& name, const char* what) {
    std::string part = fmt::format("{} {}", name, what);
    if (std::ranges::find(parts, part) == parts.end()) parts.push_back(std::move(part));
  };
  for (const auto& [name, mark] : then) {
    if (!after.contains(name))
      add(name, "is gone");
    else if (differ(before, after, name))
      add(name, "has changed");
  }
  for (const auto& [name, mark] : now)
    if (!before.contains(name)) add(name, "is new");
  const std::size_t more = parts.size() > kMost ? parts.size() - kMost : 0;
  parts.resize(parts.size() - more);
  return fmt::format("{}{}", fmt::join(parts, ", "), more > 0 ? fmt::format(" and {} more", more) : std::string());
}

}  // namespace dmoscope
