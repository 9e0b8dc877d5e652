#pragma once
// Influence of the order in which vertices are visited (paper, Section 5.4).

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace dmoscope::app {

struct OrderSpread {
  std::string name;        // the run whose order was changed
  std::size_t orders = 0;  // number of orders that were tried
  double lowest_minimum = std::numeric_limits<double>::infinity(), highest_minimum = -std::numeric_limits<double>::infinity();
  double largest_difference = 0.0;  // between two curves of sorted qualities, at one rank
  double mean_difference = 0.0;     // mean over all ranks of the widest distance of curves at a rank
  std::size_t rank = 0;             // rank of the largest difference, from 0 for the worst element
  std::size_t elements = 0;
};

/// Gathers sorted qualities, one curve per order.
class OrderCurves {
 public:
  /// Adds a curve. `sorted`: ascending, the same number of elements for all.
  void add(std::span<const double> sorted);
  [[nodiscard]] OrderSpread spread(std::string name) const;

 private:
  std::size_t orders_ = 0;
  std::vector<double> low_, high_;  // over all curves, by rank
  double highest_minimum_ = -std::numeric_limits<double>::infinity();
};

}  // namespace dmoscope::app
