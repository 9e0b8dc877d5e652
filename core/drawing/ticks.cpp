#include "core/drawing/ticks.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace dmoscope {
namespace {

double nice_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  const double mantissa = least / power;
  // Tolerance for rounding: 0.2 / 0.1 may come out as 2.0000000000000004.
  constexpr double kSlack = 1.0 + 1e-9;
  if (mantissa <= kSlack) return power;
  if (mantissa <= 2.0 * kSlack) return 2.0 * power;
  if (mantissa <= 5.0 * kSlack) return 5.0 * power;
  return 10.0 * power;
}

std::string tick_label(double value, double step, double largest) {
  if (largest >= 1e6 || step < 1e-6) return value == 0.0 ? "0" : fmt::format("{:.4g}", value);
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  return fmt::format("{:.{}f}", value, decimals);
}

std::vector<Tick> ticks_at(double lowest, double highest, double step) {
  std::vector<Tick> ticks;
  const double largest = std::max(std::abs(lowest), std::abs(highest));
  const auto first = static_cast<long long>(std::ceil(lowest / step - 1e-9));
  const auto last = static_cast<long long>(std::floor(highest / step + 1e-9));
  for (long long k = first; k <= last; ++k) {
    const double value = static_cast<double>(k) * step;
    ticks.push_back({value, tick_label(value, step, largest)});
  }
  return ticks;
}

bool drawable(double lowest, double highest) {
  // Refuses ranges below one part in 1e12 of the values, where ticks would be rounding noise.
  return std::isfinite(lowest) && std::isfinite(highest) && highest > lowest &&
         highest - lowest > 1e-12 * std::max(std::abs(lowest), std::abs(highest));
}

std::string power_label(double value) {
  if (value >= 1e-4 && value < 1e5)
    return fmt::format("{:.{}f}", value, std::max(0, static_cast<int>(std::ceil(-std::log10(value) - 1e-9))));
  return fmt::format("{:.0e}", value);
}

}  // namespace

std::vector<Tick> linear_ticks(double lowest, double highest, int most) {
  if (!drawable(lowest, highest) || most < 1) return {};
  return ticks_at(lowest, highest, nice_step((highest - lowest) / most));
}

std::vector<Tick> integer_ticks(double lowest, double highest, int most) {
  if (!drawable(lowest, highest) || most < 1) return {};
  return ticks_at(lowest, highest, std::max(1.0, nice_step((highest - lowest) / most)));
}

std::vector<Tick> log_ticks(double lowest, double highest, int most) {
  if (!drawable(lowest, highest) || lowest <= 0.0 || most < 1) return {};
  const int first = static_cast<int>(std::floor(std::log10(lowest) + 1e-9));
  const int last = static_cast<int>(std::ceil(std::log10(highest) - 1e-9));
  const int decades = last - first;
  const int every = std::max(1, (decades + most - 1) / most);
  std::vector<Tick> ticks;
  for (int power = first; power <= last; ++power) {
    const double base = std::pow(10.0, power);
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * base;
      if (value < lowest * (1 - 1e-12) || value > highest * (1 + 1e-12)) continue;
      const bool labelled = (digit == 1 && (power - first) % every == 0) || (decades <= 2 && (digit == 2 || digit == 5));
      if (labelled) {
        ticks.push_back({value, power_label(value)});
      } else if (every == 1 && decades <= 8) {
        ticks.push_back({value, {}});
      }
    }
  }
  if (std::ranges::count_if(ticks, [](const Tick& tick) { return !tick.label.empty(); }) >= 2) return ticks;
  // Uses linear ticks over so short a range, where the axis is nearly linear; over a longer one every power of ten needs its label.
  if (highest < 10.0 * lowest) {
    for (int n = most; n < most + 5; ++n) {
      if (std::vector<Tick> even = linear_ticks(lowest, highest, n); even.size() >= 2) return even;
    }
    return ticks;
  }
  return every > 1 ? log_ticks(lowest, highest, decades) : ticks;
}

std::vector<Tick> log_ticks_from_zero(double lowest, double highest, double pivot, int most) {
  if (!drawable(lowest, highest) || !(pivot > 0.0) || most < 1) return {};
  const auto shape = [pivot](double value) { return std::log10(1.0 + value / pivot); };
  const double gap = (shape(highest) - shape(lowest)) / (most + 1);
  std::vector<Tick> ticks;
  const auto offer = [&](double value) {
    if (value < lowest - 1e-9 * highest || value > highest * (1.0 + 1e-9)) return;
    const auto near = [&](const Tick& other) { return std::abs(shape(other.value) - shape(value)) < gap; };
    if (std::ranges::none_of(ticks, near))
      ticks.push_back({value, value >= 1e5 ? fmt::format("{:.0e}", value) : fmt::format("{:g}", value)});
  };
  offer(0.0);
  const int first = static_cast<int>(std::floor(std::log10(pivot) + 1e-9)), last = static_cast<int>(std::ceil(std::log10(highest)));
  for (const double digit : {1.0, 5.0, 2.0}) {
    for (int power = first; power <= last; ++power) {
      if (const double value = digit * std::pow(10.0, power); value >= pivot * (1.0 - 1e-9)) offer(value);
    }
  }
  if (ticks.size() < 3) return {};
  std::ranges::sort(ticks, {}, &Tick::value);
  return ticks;
}

std::vector<Stroke> decimate(std::span<const double> x, std::span<const double> y, double lowest, double highest, std::size_t columns) {
  std::vector<Stroke> strokes;
  if (x.empty() || columns == 0 || !(highest >= lowest)) return strokes;
  auto begin = static_cast<std::size_t>(std::lower_bound(x.begin(), x.end(), lowest) - x.begin());
  auto end = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), highest) - x.begin());
  if (begin > 0) --begin;
  if (end < x.size()) ++end;

  const double width = highest > lowest ? (highest - lowest) / static_cast<double>(columns) : 1.0;
  const auto column_of = [&](std::size_t i) { return static_cast<long long>(std::floor((x[i] - lowest) / width)); };
  Stroke stroke;
  const auto finish = [&] {
    if (!stroke.empty()) strokes.push_back(std::move(stroke));
    stroke.clear();
  };
  for (std::size_t i = begin; i < end;) {
    if (!std::isfinite(y[i])) {
      finish();
      ++i;
      continue;
    }
    std::size_t stop = i + 1, smallest = i, largest = i;
    for (const long long column = column_of(i); stop < end && std::isfinite(y[stop]) && column_of(stop) == column; ++stop) {
      if (y[stop] < y[smallest]) smallest = stop;
      if (y[stop] > y[largest]) largest = stop;
    }
    std::size_t keep[4] = {i, std::min(smallest, largest), std::max(smallest, largest), stop - 1};
    for (std::size_t k = 0; k < 4; ++k) {
      if (k == 0 || keep[k] != keep[k - 1]) stroke.push_back({x[keep[k]], y[keep[k]]});
    }
    i = stop;
  }
  finish();
  return strokes;
}

}  // namespace dmoscope
