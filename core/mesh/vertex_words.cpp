#include "core/mesh/vertex_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/number_in.h"
#include "core/mesh/group_facts.h"
#include "core/mesh/outline.h"
#include "core/mesh/thin.h"

namespace dmoscope {

std::vector<std::string_view> split_at_commas(std::string_view text) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t comma = text.find(',');
    words.push_back(text.substr(0, comma));
    if (comma == std::string_view::npos) return words;
    text.remove_prefix(comma + 1);
  }
}

std::vector<NumberRange> parse_number_list(std::string_view list, std::string_view word) {
  std::vector<NumberRange> ranges;
  for (const std::string_view part : split_at_commas(list)) {
    const std::size_t dash = part.find('-');
    const auto first = number_in<std::uint64_t>(part.substr(0, dash));
    const auto last = dash == std::string_view::npos ? first : number_in<std::uint64_t>(part.substr(dash + 1));
    if (!first || !last) throw UsageError(fmt::format("{}: no list of vertices like 3,7-9", word));
    if (*last < *first) throw UsageError(fmt::format("{}: the range {} runs backwards", word, part));
    ranges.push_back({*first, *last});
  }
  return ranges;
}

NamedBox parse_box(std::string_view text, std::string_view word) {
  const auto fail = [&](const std::string& what) { throw UsageError(fmt::format("{}: {}", word, what)); };
  NamedBox box;
  for (const std::string_view part : split_at_commas(text)) {
    const auto value = number_in<double>(part);
    if (!value || std::isnan(*value)) fail(fmt::format("'{}' is no number", part));
    box.limits.push_back(*value);
  }
  if (box.limits.size() != 4 && box.limits.size() != 6) fail("a box is box:X0,Y0,X1,Y1 or box:X0,Y0,Z0,X1,Y1,Z1");
  const std::size_t axes = box.limits.size() / 2;
  for (std::size_t a = 0; a < axes; ++a)
    if (box.limits[a + axes] < box.limits[a])
      fail(fmt::format("the box ends at {} before it begins at {}", box.limits[a + axes], box.limits[a]));
  return box;
}

bool NamedBox::has(Vec3 p) const {
  const std::array<double, 3> at{p.x, p.y, p.z};
  const std::size_t axes = limits.size() / 2;
  bool inside = axes > 0;
  for (std::size_t a = 0; a < axes; ++a) inside = inside && at[a] >= limits[a] && at[a] <= limits[a + axes];
  return inside;
}

namespace {

/// Enumeration of names that ends with a count: "inlet, wall and 7 more".
std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 12;
  const std::vector<std::string> first(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min(kMost, names.size())));
  const std::string more = names.size() > kMost ? fmt::format(" and {} more", names.size() - kMost) : "";
  return fmt::format("{}{}", fmt::join(first, ", "), more);
}

/// Finds the vertices that one word names in one mesh.
class VertexWord {
 public:
  VertexWord(const Mesh& mesh, std::string_view word) : mesh_(mesh), word_(word) {
    const std::size_t colon = word.find(':');
    if (colon == std::string_view::npos) return;
    head_ = word.substr(0, colon);
    rest_ = word.substr(colon + 1);
  }

  std::vector<Index> vertices() {
    if (head_ == "vertices") {
      list(rest_);
    } else if (head_ == "box") {
      box(rest_);
    } else if (head_ == "loop" || head_ == "part") {
      found_ = vertices_of_outline(mesh_, head_, rest_);
    } else if (names_groups()) {
      groups(rest_, members());
    } else if (head_ == "data" || head_ == "point-data" || head_ == "cell-data") {
      data(rest_, head_);
    } else {
      bare();
    }
    std::ranges::sort(found_);
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    return std::move(found_);
  }

  [[nodiscard]] std::vector<const Group*> named_groups() const {
    return names_groups() ? require_groups(rest_, members()) : require_groups(word_, "");
  }

 private:
  [[nodiscard]] bool names_groups() const {
    constexpr std::array<std::string_view, 5> kHeads{"group", "points", "lines", "faces", "elements"};
    return std::ranges::find(kHeads, head_) != kHeads.end();
  }
  /// Kind of the members of the groups that the word names; empty: any.
  [[nodiscard]] std::string_view members() const { return head_ == "group" ? std::string_view() : head_; }

  [[noreturn]] void fail(const std::string& what) const { throw UsageError(fmt::format("{}: {}", word_, what)); }
  [[noreturn]] void fail_choice(const std::vector<std::string>& choices) const {
    fail(fmt::format("this can mean more than one thing; write '{}'", fmt::join(choices, "' or '")));
  }

  // --- Names by number ---

  static bool looks_like_list(std::string_view text) {
    return !text.empty() && text.find_first_not_of("0123456789,-") == std::string_view::npos;
  }

  void list(std::string_view text) {
    for (const NumberRange& range : parse_number_list(text, word_)) {
      for (const std::uint64_t end : {range.first, range.last})
        if (end >= mesh_.vertex_count())
          fail(fmt::format("there is no vertex {} (the mesh has {}, counted from 0)", end, mesh_.vertex_count()));
      for (std::uint64_t v = range.first; v <= range.last; ++v) found_.push_back(static_cast<Index>(v));
    }
  }

  // --- Names by group ---

  /// Groups with this name, or else with this number; of one kind of members if `of` says so.
  [[nodiscard]] std::vector<const Group*> groups_called(std::string_view name, std::string_view of) const {
    std::vector<const Group*> called, numbered;
    const auto number = number_in<int>(name);
    for (const Group& group : mesh_.groups) {
      if (!of.empty() && members_of(group) != of) continue;
      if (group.name == name) called.push_back(&group);
      if (number && number_of(group) == number) numbered.push_back(&group);
    }
    return called.empty() ? numbered : called;
  }

  /// Unambiguous words for groups: "group:wall", or with the kind of members if groups of several kinds have that name.
  [[nodiscard]] static std::vector<std::string> ways_to_say(const std::vector<const Group*>& groups) {
    std::vector<std::string> precise, short_ones;
    for (const Group* group : groups) {
      const std::string one = fmt::format("{}:{}", members_of(*group), group->name);
      if (std::ranges::find(precise, one) != precise.end()) continue;
      precise.push_back(one);
      short_ones.push_back("group:" + group->name);
    }
    return precise.size() == 1 ? short_ones : precise;
  }

  std::vector<const Group*> require_groups(std::string_view name, std::string_view of) const {
    const auto called = groups_called(name, of);
    if (called.empty()) {
      std::vector<std::string> names;
      for (const Group& group : mesh_.groups)
        if (of.empty() || members_of(group) == of) names.push_back(group.name);
      const std::string what = of.empty() ? "groups" : fmt::format("groups of {}", of);
      fail(names.empty() ? fmt::format("the mesh has no {}", what) : fmt::format("no such group; the mesh's {}: {}", what, some_of(names)));
    }
    const auto ways = ways_to_say(called);
    if (ways.size() > 1) fail_choice(ways);
    return called;
  }

  void groups(std::string_view name, std::string_view of) {
    for (const Group* group : require_groups(name, of)) {
      const auto some = vertices_of(mesh_, *group);
      found_.insert(found_.end(), some.begin(), some.end());
    }
  }

  // --- Names by data ---

  [[nodiscard]] std::vector<const Field*> fields_called(std::string_view name, std::string_view head) const {
    std::vector<const Field*> called;
    for (const Field& field : mesh_.fields) {
      const bool of_cells = field.on == Field::On::Elements;
      if (field.name == name && !(head == "point-data" && of_cells) && !(head == "cell-data" && !of_cells)) called.push_back(&field);
    }
    return called;
  }

  void data(std::string_view text, std::string_view head) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string_view::npos) fail("data are named as in mat_id=3 or mat_id=3,5");
    const std::string_view name = text.substr(0, equals);
    const auto called = fields_called(name, head);
    if (called.empty()) {
      std::vector<std::string> names;
      for (const Field& field : mesh_.fields) names.push_back(field.name);
      fail(names.empty() ? "the file has no data" : fmt::format("no such data; the file's are {}", some_of(names)));
    }
    if (called.size() > 1 && called[0]->on != called[1]->on)
      fail_choice({fmt::format("point-data:{}", text), fmt::format("cell-data:{}", text)});
    for (const std::string_view value : split_at_commas(text.substr(equals + 1))) with_value(*called.front(), value);
  }

  void with_value(const Field& field, std::string_view text) {
    const auto value = number_in<double>(text);
    if (!value) fail(fmt::format("'{}' is no number", text));
    if (field.components != 1) fail(fmt::format("{} has {} numbers for each, not one", field.name, field.components));
    bool any = false;
    for (Index at = 0; at < field.values.size(); ++at) {
      if (field.values[at] != *value) continue;
      any = true;
      if (field.on == Field::On::Vertices) {
        found_.push_back(at);
      } else {
        const auto corners = mesh_.elements.corners(at);
        found_.insert(found_.end(), corners.begin(), corners.end());
      }
    }
    if (any) return;
    std::set<double> values;
    for (const double one : field.values)
      if (!std::isnan(one)) values.insert(one);
    std::vector<std::string> there;
    for (const double one : values) there.push_back(fmt::format("{}", one));
    fail(fmt::format("{} is nowhere {}; it is {}", field.name, text, some_of(there)));
  }

  // --- Names by place ---

  void box(std::string_view text) {
    const NamedBox box = parse_box(text, word_);
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      if (box.has(mesh_.degrees ? (*mesh_.degrees)[v] : mesh_.positions[v])) found_.push_back(v);
    if (found_.empty()) fail("no vertex lies in this box");
  }

  // --- Names of any kind ---

  void bare() {
    const std::size_t equals = word_.rfind('=');
    const auto called = groups_called(word_, "");
    const bool is_list = looks_like_list(word_);
    const bool is_data = equals != std::string_view::npos && !fields_called(word_.substr(0, equals), "").empty();
    std::vector<std::string> ways = called.empty() ? std::vector<std::string>{} : ways_to_say(called);
    if (is_list) ways.push_back(fmt::format("vertices:{}", word_));
    if (is_data) ways.push_back(fmt::format("data:{}", word_));
    if (ways.size() > 1) fail_choice(ways);
    if (is_list) return list(word_);
    if (is_data) return data(word_, "");
    if (!called.empty()) return groups(word_, "");
    fail("neither a list of vertices like 3,7-9 nor " + groups_and_data());
  }

  [[nodiscard]] std::string groups_and_data() const {
    std::vector<std::string> groups, fields;
    for (const Group& group : mesh_.groups) groups.push_back(group.name);
    for (const Field& field : mesh_.fields) fields.push_back(field.name);
    std::string text = groups.empty() ? "a group of the mesh, which has none" : fmt::format("one of its groups ({})", some_of(groups));
    if (!fields.empty()) text += fmt::format(" nor its data with a number, as in {}=3 (data: {})", fields.front(), some_of(fields));
    return text;
  }

  const Mesh& mesh_;
  std::string_view word_, head_, rest_;  // the whole word, and what is before and behind its colon
  std::vector<Index> found_;
};

}  // namespace

std::vector<const Group*> groups_named(const Mesh& mesh, std::string_view word) { return VertexWord(mesh, word).named_groups(); }

std::vector<Index> vertices_named(const Mesh& mesh, std::string_view word) { return VertexWord(mesh, word).vertices(); }

std::vector<Index> vertices_named(const Mesh& mesh, std::span<const std::string> words) {
  std::vector<Index> all;
  for (const std::string& word : words) {
    const auto some = vertices_named(mesh, word);
    all.insert(all.end(), some.begin(), some.end());
  }
  for (Index& v : all) v = on_front(mesh, v);
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace dmoscope
