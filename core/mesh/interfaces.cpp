#include "core/mesh/interfaces.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/base/unknown_value.h"
#include "core/base/words.h"
#include "core/mesh/materials.h"
#include "core/mesh/named_lists.h"
#include "core/mesh/topology.h"

namespace dmoscope {
namespace {

/// Labels that meet at a vertex: two kinds of material, or more.
using Labels = std::vector<Index>;

/// Enumeration of names in a sentence: "A", "A and B", "A, B and C".
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

/// Enumeration of the first few names in a sentence: "A, B, C and 4 more".
std::string first_listed(std::vector<std::string> names) {
  constexpr std::size_t kMost = 4;
  if (names.size() > kMost) {
    const std::size_t more = names.size() - (kMost - 1);
    names.resize(kMost - 1);
    names.push_back(fmt::format("{} more", more));
  }
  return listed(names);
}

std::string quoted(const std::string& name) { return fmt::format("\"{}\"", name); }

/// Whether a group of elements tells materials apart; those that MEDIT calls required do not.
bool is_material(const Group& group) { return group.of_elements() && !is_required(group); }

/// The set of groups that each element belongs to, numbered.
class Memberships {
 public:
  explicit Memberships(const Mesh& mesh) : mesh_(mesh), set_of_(mesh.elements.size(), 0) {
    for (std::size_t g = 0; g < mesh.groups.size(); ++g)
      if (is_material(mesh.groups[g])) add(g);
  }
  [[nodiscard]] const std::vector<Index>& sets() const noexcept { return set_of_; }
  /// Names that tell these sets apart, one for each: their groups without those that all sets share.
  [[nodiscard]] std::vector<std::string> names(const Labels& sets) const {
    std::vector<std::size_t> shared = groups_of_[sets.front()];
    for (const Index set : sets) {
      std::vector<std::size_t> both;
      std::ranges::set_intersection(shared, groups_of_[set], std::back_inserter(both));
      shared = std::move(both);
    }
    std::vector<std::string> names;
    for (const Index set : sets) {
      std::vector<std::string> own;
      for (const std::size_t g : groups_of_[set])
        if (!std::ranges::binary_search(shared, g)) own.push_back(quoted(mesh_.groups[g].name));
      if (!own.empty()) names.push_back(fmt::format("{}", fmt::join(own, " with ")));
    }
    if (names.size() < sets.size()) names.emplace_back("the rest");
    return names;
  }

 private:
  void add(std::size_t group) {
    std::map<Index, Index> grown;  // number of a set, and that of the set with this group added
    for (const Index e : mesh_.groups[group].members) {
      const Index before = set_of_[e];
      if (!groups_of_[before].empty() && groups_of_[before].back() == group) continue;
      const auto [at, added] = grown.try_emplace(before, static_cast<Index>(groups_of_.size()));
      if (added) {
        groups_of_.push_back(groups_of_[before]);
        groups_of_.back().push_back(group);
      }
      set_of_[e] = at->second;
    }
  }

  const Mesh& mesh_;
  std::vector<Index> set_of_;                            // set of each element
  std::vector<std::vector<std::size_t>> groups_of_{{}};  // groups of each set, ascending
};

/// Number of each element's value of a field.
struct NumberedValues {
  std::vector<Index> of_element;
  std::vector<double> values;  // distinct values, ascending

  explicit NumberedValues(const Field& field) : values(field.values) {
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    of_element.reserve(field.values.size());
    for (const double value : field.values)
      of_element.push_back(static_cast<Index>(std::ranges::lower_bound(values, value) - values.begin()));
  }
};

bool all_same(const std::vector<Index>& labels) { return std::ranges::adjacent_find(labels, std::not_equal_to<>()) == labels.end(); }

}  // namespace

/// Fills in the members of Interfaces.
class Interfaces::Finder {
 public:
  Finder(Interfaces& found, const Mesh& mesh, const Topology& topology)
      : found_(found), mesh_(mesh), topology_(topology), reason_(mesh.positions.size(), kNoIndex) {}

  void find() {
    between_groups();
    between_values();
    named(HeldBy::Faces, NamedKind::Faces, [](const Group& g) { return g.dimension == 2 && g.faces.size() > 0; });
    for (const Group& group : mesh_.groups)
      if (group.of_elements() && is_required(group)) hold_corners(group);
    named(HeldBy::Lines, NamedKind::Lines, [](const Group& g) { return g.dimension == 1; });
    for (const Group& group : mesh_.groups)
      if (is_string(group)) hold_all(HeldBy::Strings, group);
    named(HeldBy::Points, NamedKind::Points, [](const Group& g) { return g.dimension == 0 && !is_string(g); });
    offer_others();
    finish();
  }

 private:
  [[nodiscard]] bool on_boundary(Index v) const { return topology_.boundary()[v] != 0; }
  [[nodiscard]] bool inside(Index v) const { return topology_.boundary()[v] == 0 && !topology_.star(v).empty(); }
  [[nodiscard]] bool held(Index v) const { return reason_[v] != kNoIndex; }
  Index add_reason(std::string text) {
    found_.reasons_.push_back(std::move(text));
    return static_cast<Index>(found_.reasons_.size() - 1);
  }
  void hold(HeldBy by, Index vertex, Index reason) {
    reason_[vertex] = reason;
    ++found_.counts_[static_cast<std::size_t>(by)];
  }

  void between_groups() {
    if (std::ranges::none_of(mesh_.groups, is_material)) return;
    const Memberships memberships(mesh_);
    if (all_same(memberships.sets())) return;
    told_apart_ = true;
    found_.between_groups_ = between(HeldBy::Groups, memberships.sets(), [&](const Labels& sets) { return memberships.names(sets); });
  }

  void between_values() {
    for (const Naming naming : {Naming::Materials, Naming::Geometry}) {
      if (naming == Naming::Geometry && told_apart_) return;
      for (const Field& field : mesh_.fields) {
        if (naming_of(field) != naming) continue;
        const NumberedValues numbered(field);
        if (numbered.values.size() < 2) {
          if (field.said_material) found_.offers_.push_back({field.name, 1});
          continue;
        }
        told_apart_ = true;
        const Index pairs = between(HeldBy::Values, numbered.of_element, [&](const Labels& labels) {
          std::vector<std::string> names;
          for (const Index label : labels)
            names.push_back(fmt::format("{}{}", names.empty() ? field.name + " " : "", numbered.values[label]));
          return names;
        });
        if (pairs == 0) continue;
        found_.between_values_ += pairs;
        found_.value_names_ += (found_.value_names_.empty() ? "" : " and ") + field.name;
      }
    }
  }

  /// Offers cell data that would hold more vertices if they named materials.
  void offer_others() {
    for (const Field& field : mesh_.fields) {
      const std::size_t values = possible_materials(field);
      if (values > 0 && parts_free_vertices(field)) found_.offers_.push_back({field.name, values});
    }
  }

  [[nodiscard]] bool parts_free_vertices(const Field& field) const {
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (!inside(v) || held(v)) continue;
      const auto star = topology_.star(v);
      const double first = field.values[star.front().element];
      if (std::ranges::any_of(star, [&](const Incidence& at) { return field.values[at.element] != first; })) return true;
    }
    return false;
  }

  /// Refines the materials: elements of one material have all labels in common.
  void add_material(const std::vector<Index>& label_of) {
    std::vector<Index>& material = found_.material_;
    material.resize(label_of.size(), 0);
    std::map<std::pair<Index, Index>, Index> known;
    for (std::size_t e = 0; e < label_of.size(); ++e)
      material[e] = known.try_emplace({material[e], label_of[e]}, static_cast<Index>(known.size())).first->second;
  }

  /// Holds the vertices whose elements have different labels; returns the number of pairs of labels that meet along more than single
  /// points.
  template <class Names>
  Index between(HeldBy by, const std::vector<Index>& label_of, const Names& names) {
    add_material(label_of);
    std::map<Labels, Index> reasons;
    Labels labels;
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (!(inside(v) || on_boundary(v)) || held(v)) continue;
      labels.clear();
      for (const Incidence& at : topology_.star(v)) {
        const Index label = label_of[at.element];
        if (std::ranges::find(labels, label) == labels.end()) labels.push_back(label);
      }
      if (labels.size() < 2) continue;
      if (on_boundary(v)) {
        found_.meets_.resize(reason_.size(), 0);
        found_.meets_[v] = 1;
        continue;
      }
      std::ranges::sort(labels);
      auto known = reasons.find(labels);
      if (known == reasons.end())
        known =
            reasons
                .emplace(labels, add_reason(fmt::format("it lies on the interface between {}, which stays", first_listed(names(labels)))))
                .first;
      hold(by, v, known->second);
    }
    const auto pairs = std::ranges::count_if(reasons, [](const auto& one) { return one.first.size() == 2; });
    return reasons.empty() ? 0 : std::max<Index>(1, static_cast<Index>(pairs));
  }

  static std::string sentence_of(HeldBy by, const Group& group) {
    const std::string name = quoted(group.name);
    if (by == HeldBy::Faces) return fmt::format("it lies on a face of {}, which stays", name);
    if (by == HeldBy::Lines) return fmt::format("it lies on the line {}, which stays", name);
    if (by == HeldBy::Strings) return fmt::format("it lies on {}, which stays", name);
    return fmt::format("it is one of the points {}, which stay", name);
  }

  void hold_all(HeldBy by, const Group& group, NamedList* list = nullptr) {
    Index reason = kNoIndex;
    for (const Index v : group.vertices()) {
      if (!inside(v) || held(v)) continue;
      if (list != nullptr && list->surrounds(v)) {
        listed_.resize(reason_.size(), 0);
        listed_[v] = 1;
        continue;
      }
      if (reason == kNoIndex) reason = add_reason(sentence_of(by, group));
      hold(by, v, reason);
    }
  }

  /// Holds the corners of elements that shall stay as they are.
  void hold_corners(const Group& group) {
    Index reason = kNoIndex;
    for (const Index e : group.members) {
      for (const Index v : mesh_.elements.corners(e)) {
        if (!inside(v) || held(v)) continue;
        if (reason == kNoIndex) reason = add_reason(sentence_of(HeldBy::Faces, group));
        hold(HeldBy::Faces, v, reason);
      }
    }
  }

  /// Holds the vertices that groups of one kind name, except by lists that enumerate everything.
  template <class Is>
  void named(HeldBy by, NamedKind kind, const Is& is) {
    std::vector<const Group*> groups;
    for (const Group& group : mesh_.groups)
      if (is(group)) groups.push_back(&group);
    if (groups.empty()) return;
    NamedList list(kind, groups, mesh_, topology_);
    for (const Group* group : groups) hold_all(by, *group, is_required(*group) ? nullptr : &list);
  }

  void finish() {
    for (Index v = 0; v < listed_.size(); ++v) found_.listed_ += listed_[v] != 0 && !held(v) ? 1 : 0;
    if (found_.count() == 0) return;
    found_.all_ = true;
    for (Index v = 0; v < mesh_.vertex_count() && found_.all_; ++v) found_.all_ = !inside(v) || held(v);
    found_.reason_ = std::move(reason_);
  }

  Interfaces& found_;
  const Mesh& mesh_;
  const Topology& topology_;
  std::vector<Index> reason_;
  std::vector<std::uint8_t> listed_;  // by vertex, whether a list that enumerates everything names it; empty if there is none
  bool told_apart_ = false;           // whether groups or values tell elements apart
};

Interfaces::Interfaces(const Mesh& mesh, const Topology& topology) {
  const bool names_elements =
      std::ranges::any_of(mesh.fields, [](const Field& f) { return naming_of(f) != Naming::Nothing || possible_materials(f) > 0; });
  if (!mesh.groups.empty() || names_elements) Finder(*this, mesh, topology).find();
}

Index Interfaces::count() const noexcept { return std::accumulate(counts_.begin(), counts_.end(), Index{0}); }

std::string Interfaces::sentence(std::string_view way_out) const {
  std::vector<std::string> parts;
  const auto add = [&](HeldBy by, const std::string& where) {
    const Index n = count(by);
    if (n == 0) return;
    parts.push_back(fmt::format("{} {}", parts.empty() ? counted(n, "vertex", "vertices") : grouped(n), where));
  };
  const auto interfaces = [](Index n) { return n == 1 ? std::string("the interface") : grouped(n) + " interfaces"; };
  add(HeldBy::Groups, fmt::format("on {} between groups", interfaces(between_groups_)));
  add(HeldBy::Values, fmt::format("on {} between values of {}", interfaces(between_values_), value_names_));
  add(HeldBy::Faces, "on faces that the file names");
  add(HeldBy::Lines, "on lines that the file names");
  add(HeldBy::Strings, "on boundary strings");
  add(HeldBy::Points, "named by the file as points");
  std::string text;
  if (!parts.empty()) {
    text = fmt::format("{} {} ({} {})", listed(parts), count() == 1 ? "stays" : "stay", way_out, count() == 1 ? "moves it" : "moves them");
    if (all_) text += "; no vertex is left to move";
  }
  if (listed_ == 0) return text;
  return fmt::format("{}{} named only in lists of all lines, faces or points there are; such lists hold nothing",
                     text.empty() ? "" : text + "; ", counted(listed_, "vertex is", "vertices are"));
}

std::vector<std::string> Interfaces::offers(std::string_view way_in) const {
  std::vector<std::string> sentences;
  for (const Offer& offer : offers_) {
    sentences.push_back(offer.values == 1
                            ? fmt::format("cell data {} has the same value everywhere: it makes no interface", quoted(offer.field))
                            : fmt::format("cell data {} has {} values: {} {} keeps their interfaces", quoted(offer.field), offer.values,
                                          way_in, quote_word(offer.field)));
  }
  return sentences;
}

namespace {
constexpr std::array<std::string_view, 3> kRules{"fixed", "free", "slide"};  // words in the order of InterfaceRule
}

std::string_view name(InterfaceRule rule) noexcept { return kRules[static_cast<std::size_t>(rule)]; }

InterfaceRule parse_interface_rule(std::string_view word) { return parse_choice<InterfaceRule>("rule for interfaces", word, kRules); }

}  // namespace dmoscope
