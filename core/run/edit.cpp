#include "core/run/edit.h"

#include <algorithm>
#include <limits>

namespace dmoscope {

const Edit* Edits::at(const Moment& moment) const {
  const auto found = std::ranges::lower_bound(all(), moment, {}, &Edit::at);
  return found != all().end() && found->at == moment ? &*found : nullptr;
}

const Edit* Edits::after(const Moment& moment) const {
  const auto found = std::ranges::upper_bound(all(), moment, {}, &Edit::at);
  return found != all().end() ? &*found : nullptr;
}

std::uint64_t Edits::count_at(const Moment& place) const {
  constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();
  const auto first = std::ranges::lower_bound(all(), Moment{place.iteration, place.visits, 0}, {}, &Edit::at);
  const auto last = std::ranges::upper_bound(all(), Moment{place.iteration, place.visits, kAll}, {}, &Edit::at);
  return static_cast<std::uint64_t>(last - first);
}

std::size_t Edits::done_by(const Moment& moment) const {
  return static_cast<std::size_t>(std::ranges::lower_bound(all(), moment, {}, &Edit::at) - all().begin());
}

void Edits::cut(const Moment& moment) {
  const auto from = std::ranges::lower_bound(all(), moment, {}, &Edit::at);
  if (from == all().end()) return;
  const std::ptrdiff_t kept = from - all().begin();
  auto& edits = edits_.change();
  edits.erase(edits.begin() + kept, edits.end());
}

}  // namespace dmoscope
