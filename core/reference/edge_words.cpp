#include "core/reference/edge_words.h"

#include <algorithm>
#include <charconv>
#include <map>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/mesh/group_facts.h"
#include "core/mesh/named_lists.h"
#include "core/mesh/vertex_words.h"

namespace dmoscope {
namespace {

std::vector<std::string_view> split_at(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(at);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// Finds the edges that one word names in one mesh.
class EdgeWord {
 public:
  EdgeWord(const InputMesh& input, const StandingRule& rule, const Domain* domain, std::string_view word)
      : input_(input), rule_(rule), domain_(domain), word_(word) {}

  std::vector<EdgeEnds> edges() {
    const std::size_t colon = word_.find(':');
    const std::string_view head = word_.substr(0, colon == std::string_view::npos ? 0 : colon);
    const std::string_view rest = word_.substr(colon == std::string_view::npos ? 0 : colon + 1);
    if (head == "edges") {
      list(rest);
    } else if (head == "chain") {
      chain(rest);
    } else if (looks_like_list(word_) && !is_group()) {
      list(word_);
    } else {
      groups();
    }
    return std::move(found_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw UsageError(fmt::format("{}: {}", word_, what)); }

  static bool looks_like_list(std::string_view text) {
    return text.find('-') != std::string_view::npos && text.find_first_not_of("0123456789,-") == std::string_view::npos;
  }
  [[nodiscard]] bool is_group() const {
    return std::ranges::any_of(input_.mesh.groups, [&](const Group& group) { return group.name == word_; });
  }

  [[nodiscard]] Index id(std::string_view text) const {
    std::uint64_t value{};
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || stop != text.data() + text.size()) fail("no list of edges like 3-4,4-9");
    const Index count = input_.mesh.vertex_count();
    if (value >= count) fail(fmt::format("there is no vertex {} (the mesh has {}, counted from 0)", value, count));
    return static_cast<Index>(value);
  }
  [[nodiscard]] EdgeEnds edge(Index a, Index b) const {
    Kinds one;
    one.features.push_back(edge_ends(a, b));
    try {
      require_there(input_, one);
    } catch (const UsageError& error) {
      fail(error.what());
    }
    return one.features.front();
  }

  void list(std::string_view text) {
    for (const std::string_view part : split_at(text, ',')) {
      const auto ends = split_at(part, '-');
      if (ends.size() < 2) fail("no list of edges like 3-4,4-9");
      for (std::size_t i = 0; i + 1 < ends.size(); ++i) found_.push_back(edge(id(ends[i]), id(ends[i + 1])));
    }
  }

  void chain(std::string_view text) {
    const auto ends = split_at(text, '-');
    if (ends.size() != 2) fail("a chain is named by one of its edges, as in chain:3-4");
    const EdgeEnds first = edge(id(ends[0]), id(ends[1]));
    std::map<Index, std::vector<Index>> beside;
    const auto add = [&](const EdgeEnds& one) { beside[one[0]].push_back(one[1]), beside[one[1]].push_back(one[0]); };
    std::vector<EdgeEnds> all;
    if (domain_ != nullptr) all.assign(domain_->feature_edges().begin(), domain_->feature_edges().end());
    for (const auto* list : {&rule_.kinds.features, &rule_.kinds.no_features}) all.insert(all.end(), list->begin(), list->end());
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    if (!std::ranges::binary_search(all, first)) fail("this is no feature edge, so no chain goes on from it");
    std::ranges::for_each(all, add);
    found_.push_back(first);
    for (const auto& [start, towards] : {std::pair(first[0], first[1]), std::pair(first[1], first[0])}) {
      Index from = start, at = towards;
      while (beside[at].size() == 2 && (domain_ == nullptr || !domain_->is_held(at))) {
        const Index next = beside[at][0] == from ? beside[at][1] : beside[at][0];
        const EdgeEnds one = edge_ends(at, next);
        if (one == first) return;  // back at the first edge
        found_.push_back(one);
        from = at, at = next;
      }
    }
  }

  void groups() {
    for (const Group* group : groups_named(input_.mesh, word_)) {
      if (group->dimension == 1 || is_string(*group)) {
        const std::size_t step = group->dimension == 1 ? 2 : 1;
        for (std::size_t i = 0; i + 1 < group->members.size(); i += step) found_.push_back(edge(group->members[i], group->members[i + 1]));
      } else if (group->dimension == 0) {
        fail("a group of points has no edges");
      } else {
        border(*group);
      }
    }
  }

  /// Adds the border of a group: the edges with only one of its faces.
  void border(const Group& group) {
    std::map<EdgeEnds, Index> count;
    const auto add = [&](std::span<const Index> c) {
      for (std::size_t i = 0; i < c.size(); ++i) ++count[edge_ends(c[i], c[i + 1 < c.size() ? i + 1 : 0])];
    };
    if (group.of_elements()) {
      if (input_.is_volume()) fail("the elements of this group are volumes; name faces or lines");
      for (const Index e : group.members) add(input_.mesh.elements.corners(e));
    } else {
      for (Index f = 0; f < group.faces.size(); ++f) add(group.faces.corners(f));
    }
    for (const auto& [one, times] : count)
      if (times == 1) found_.push_back(one);
    if (found_.empty()) fail("the faces of this group have no border");
  }

  const InputMesh& input_;
  const StandingRule& rule_;
  const Domain* domain_;
  std::string_view word_;
  std::vector<EdgeEnds> found_;
};

}  // namespace

std::vector<EdgeEnds> edges_named(const InputMesh& input, const StandingRule& rule, const Domain* domain,
                                  std::span<const std::string> words) {
  std::vector<EdgeEnds> all;
  for (const std::string& word : words) {
    const auto some = EdgeWord(input, rule, domain, word).edges();
    all.insert(all.end(), some.begin(), some.end());
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace dmoscope
