#pragma once
// How much the order in which vertices are visited matters (paper, Section 5.4).

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace dmoscope::app {

struct OrderSpread {
  std::string name;        // of the run whose order was changed
  std::size_t orders = 0;  // that were tried
  double lowest_minimum = std::numeric_limits<double>::infinity(), highest_minimum = -std::numeric_limits<double>::infinity();
  double largest_difference = 0.0;  // between two curves of sorted qualities, at one rank
  double mean_difference = 0.0;     // of the widest curves at a rank, over all ranks
  std::size_t rank = 0;             // of the largest, from 0, the worst element, on
  std::size_t elements = 0;
};

/// Gathers sorted qualities, one curve per order.
class OrderCurves {
 public:
  /// `sorted`: ascending, the same number of elements for all.
  void add(std::span<const double> sorted);
  [[nodiscard]] OrderSpread spread(std::string name) const;

 private:
  std::size_t orders_ = 0;
  std::vector<double> low_, high_;  // of all curves at every rank
  double highest_minimum_ = -std::numeric_limits<double>::infinity();
};

}  // namespace dmoscope::app
