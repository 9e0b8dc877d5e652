#include "core/joint/supernodes.h"

#include <algorithm>

namespace dmoscope {

namespace {

std::vector<Index> places_of(std::span<const Index> order) {
  std::vector<Index> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<Index>(i);
  return place;
}

/// Parent of each column in the elimination tree (Davis 2006, chapter 4): its first row below the diagonal.
std::vector<Index> elimination_tree(const Adjacency& graph, std::span<const Index> order) {
  const std::vector<Index> place = places_of(order);
  std::vector<Index> parent(order.size(), kNoIndex), ancestor(order.size(), kNoIndex);
  for (Index i = 0; i < order.size(); ++i)
    for (const Index w : graph.of(order[i]))
      for (Index k = place[w]; k != kNoIndex && k < i;) {
        const Index next = ancestor[k];
        ancestor[k] = i;
        if (next == kNoIndex) parent[k] = i;
        k = next;
      }
  return parent;
}

/// Columns with the children of each directly before it.
std::vector<Index> postorder(const std::vector<Index>& parent) {
  const std::size_t n = parent.size();
  std::vector<Index> first_child(n + 1, kNoIndex), sibling(n, kNoIndex), stack, result;
  for (std::size_t i = n; i-- > 0;) {
    Index& first = first_child[parent[i] == kNoIndex ? n : parent[i]];
    sibling[i] = first;
    first = static_cast<Index>(i);
  }
  result.reserve(n);
  for (Index root = first_child[n]; root != kNoIndex; root = sibling[root]) {
    stack.push_back(root);
    while (!stack.empty()) {
      const Index node = stack.back();
      const Index child = first_child[node];
      if (child == kNoIndex) {
        result.push_back(node);
        stack.pop_back();
        continue;
      }
      first_child[node] = sibling[child];
      stack.push_back(child);
    }
  }
  return result;
}

/// Number of rows that each column has below the diagonal.
std::vector<std::size_t> column_counts(const Adjacency& graph, std::span<const Index> order, const std::vector<Index>& parent) {
  const std::vector<Index> place = places_of(order);
  std::vector<std::size_t> count(order.size(), 0);
  std::vector<Index> mark(order.size(), kNoIndex);
  for (Index i = 0; i < order.size(); ++i) {
    mark[i] = i;
    for (const Index w : graph.of(order[i]))
      for (Index k = place[w]; k < i && mark[k] != i; k = parent[k]) {
        ++count[k];
        mark[k] = i;
      }
  }
  return count;
}

/// Returns whether to merge: few wide supernodes are faster than many narrow ones, at the price of some zeros (Ashcraft and Grimes 1989).
bool worth_merging(std::size_t width, std::size_t below, std::size_t zeros) {
  const double share = static_cast<double>(zeros) / (0.5 * static_cast<double>(width * (width + 1)) + static_cast<double>(width * below));
  if (width <= 4) return true;
  return share < (width <= 12 ? 0.5 : width <= 32 ? 0.15 : 0.05);
}

std::vector<Supernode> merged_columns(const std::vector<Index>& parent, const std::vector<std::size_t>& count) {
  std::vector<Supernode> nodes;
  const auto below = [&](const Supernode& node) { return count[node.end - 1]; };
  for (Index first = 0, end = 0; first < parent.size(); first = end) {
    for (end = first + 1; end < parent.size() && parent[end - 1] == end && count[end - 1] == count[end] + 1;) ++end;
    Supernode node{.first = first, .end = end};
    while (!nodes.empty()) {
      const Supernode& child = nodes.back();
      const Index to = parent[child.end - 1];
      if (to == kNoIndex || to >= end) break;
      const std::size_t more = child.width() * (node.width() + below(node) - below(child));
      const std::size_t zeros = child.zeros + node.zeros + more;
      if (!worth_merging(child.width() + node.width(), below(node), zeros)) break;
      node.first = child.first;
      node.zeros = zeros;
      nodes.pop_back();
    }
    nodes.push_back(node);
  }
  return nodes;
}

void find_parents(std::vector<Supernode>& nodes, const std::vector<Index>& parent) {
  std::vector<Index> node_of(parent.size());
  for (Index s = 0; s < nodes.size(); ++s)
    for (Index k = nodes[s].first; k < nodes[s].end; ++k) node_of[k] = s;
  for (Supernode& node : nodes)
    if (parent[node.end - 1] != kNoIndex) node.parent = node_of[parent[node.end - 1]];
}

/// Collects the rows of the matrix and of the children that are below a node's own columns.
void find_rows(SupernodeTree& tree, const Adjacency& graph) {
  const std::vector<Index> place = places_of(tree.order);
  std::vector<Index> mark(tree.order.size(), kNoIndex), last_child(tree.nodes.size(), kNoIndex), sibling(tree.nodes.size(), kNoIndex);
  for (Index s = 0; s < tree.nodes.size(); ++s) {
    Supernode& node = tree.nodes[s];
    node.rows = tree.rows.size();
    const auto take = [&](Index row) {
      if (row < node.end || mark[row] == s) return;
      mark[row] = s;
      tree.rows.push_back(row);
    };
    for (Index k = node.first; k < node.end; ++k)
      for (const Index w : graph.of(tree.order[k])) take(place[w]);
    for (Index child = last_child[s]; child != kNoIndex; child = sibling[child])
      for (std::size_t r = tree.nodes[child].rows; r < tree.nodes[child].rows_end; ++r) take(tree.rows[r]);
    node.rows_end = tree.rows.size();
    std::sort(tree.rows.begin() + static_cast<std::ptrdiff_t>(node.rows), tree.rows.end());
    if (node.parent == kNoIndex) continue;
    sibling[s] = last_child[node.parent];
    last_child[node.parent] = s;
  }
}

void find_parent_rows(SupernodeTree& tree) {
  tree.parent_rows.resize(tree.rows.size());
  for (const Supernode& node : tree.nodes) {
    if (node.parent == kNoIndex) continue;
    const Supernode& parent = tree.nodes[node.parent];
    std::size_t at = parent.rows;
    for (std::size_t r = node.rows; r < node.rows_end; ++r) {
      if (tree.rows[r] < parent.end) {
        tree.parent_rows[r] = tree.rows[r] - parent.first;
        continue;
      }
      while (tree.rows[at] != tree.rows[r]) ++at;
      tree.parent_rows[r] = static_cast<Index>(parent.width() + at - parent.rows);
    }
  }
}

}  // namespace

SupernodeTree find_supernodes(const Adjacency& graph, std::span<const Index> order) {
  SupernodeTree tree;
  for (const Index k : postorder(elimination_tree(graph, order))) tree.order.push_back(order[k]);
  const std::vector<Index> parent = elimination_tree(graph, tree.order);
  tree.nodes = merged_columns(parent, column_counts(graph, tree.order, parent));
  find_parents(tree.nodes, parent);
  find_rows(tree, graph);
  find_parent_rows(tree);
  return tree;
}

}  // namespace dmoscope
