#include "app/comparison/order_spread.h"

#include <algorithm>

namespace dmoscope::app {

void OrderCurves::add(std::span<const double> sorted) {
  if (sorted.empty()) return;
  if (orders_++ == 0) {
    low_.assign(sorted.begin(), sorted.end());
    high_ = low_;
  }
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    low_[i] = std::min(low_[i], sorted[i]);
    high_[i] = std::max(high_[i], sorted[i]);
  }
  highest_minimum_ = std::max(highest_minimum_, sorted.front());
}

OrderSpread OrderCurves::spread(std::string name) const {
  OrderSpread spread;
  spread.name = std::move(name);
  spread.orders = orders_;
  spread.elements = low_.size();
  if (low_.empty()) return spread;
  spread.lowest_minimum = low_.front();
  spread.highest_minimum = highest_minimum_;
  double sum = 0.0;
  for (std::size_t i = 0; i < low_.size(); ++i) {
    const double difference = high_[i] - low_[i];
    sum += difference;
    if (difference <= spread.largest_difference) continue;
    spread.largest_difference = difference;
    spread.rank = i;
  }
  spread.mean_difference = sum / static_cast<double>(low_.size());
  return spread;
}

}  // namespace dmoscope::app
