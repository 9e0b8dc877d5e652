#include "core/session/summaries.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/session/frame_builder.h"

namespace dmoscope {

std::vector<float> sorted_choice(std::vector<float> values, std::size_t most) {
  std::erase_if(values, [](float q) { return std::isnan(q); });
  std::sort(values.begin(), values.end());
  if (values.size() <= most) return values;
  std::vector<float> chosen(most);
  for (std::size_t i = 0; i < most; ++i) chosen[i] = values[i * (values.size() - 1) / (most - 1)];
  return chosen;
}

RunSummary summary_of(const Frame& frame) {
  RunSummary summary{frame.shown, frame.moment, frame.shown_statistics, frame.now, 0, {}};
  summary.elements = static_cast<std::size_t>(std::ranges::count_if(frame.quality, [](float q) { return !std::isnan(q); }));
  summary.sorted = sorted_choice(frame.quality, Summaries::kMostSorted);
  return summary;
}

bool Summaries::fits(const Known& known, Session& session, std::size_t index) {
  const auto run = session.identity(index).lock();
  return known.run.lock() == run && known.path == run->path() && known.summary->moment == run->moment() &&
         known.summary->metric == session.shown();
}

std::shared_ptr<const RunSummary> Summaries::of(Session& session, std::size_t run) const {
  for (const Known& known : known_)
    if (fits(known, session, run)) return known.summary;
  return nullptr;
}

bool Summaries::find(Session& session, const std::function<const Frame*(std::size_t)>& whole, const std::function<bool()>& go_on) {
  std::vector<Known> known;
  bool found = false;
  for (std::size_t i = 0; i < session.run_count(); ++i) {
    auto summary = of(session, i);
    if (!summary && go_on()) {
      const Frame* frame = whole(i);
      summary = std::make_shared<const RunSummary>(summary_of(frame != nullptr ? *frame : judged(session, i)));
      found = true;
    }
    if (summary) known.push_back({session.identity(i), session.run(i).path(), std::move(summary)});
  }
  known_ = std::move(known);
  return found;
}

}  // namespace dmoscope
