#include "core/view/summaries.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/base/radix_sort.h"
#include "core/view/frame_builder.h"

namespace dmoscope {

std::vector<float> sorted_choice(std::vector<float> values, std::size_t most) {
  std::erase_if(values, [](float q) { return std::isnan(q); });
  radix_sort(values, 32, [](float q) {  // key: the bits in the order of the numbers
    const auto bits = std::bit_cast<std::uint32_t>(q);
    return (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;
  });
  if (values.size() <= most) return values;
  std::vector<float> chosen(most);
  for (std::size_t i = 0; i < most; ++i) chosen[i] = values[i * (values.size() - 1) / (most - 1)];
  return chosen;
}

RunSummary summary_of(const Frame& frame) {
  RunSummary summary{frame.shown, frame.moment, frame.shown_statistics, frame.now, 0, {}, {}};
  summary.elements = static_cast<std::size_t>(std::ranges::count_if(frame.quality, [](float q) { return !std::isnan(q); }));
  summary.sorted = sorted_choice(frame.quality, Summaries::kMostSorted);
  return summary;
}

std::shared_ptr<const RunSummary> Summaries::of(Session& session, std::size_t run) const {
  const auto known = std::ranges::find(known_, session.standing(run), &Known::at);
  return known == known_.end() || known->summary->metric != session.shown() ? nullptr : known->summary;
}

StandingRule Summaries::rule_of(Session& session, const std::shared_ptr<const InputMesh>& input) {
  std::size_t run = session.active_index();
  for (std::size_t i = 0; session.run(run).shared_input() != input; ++i) run = i;
  return session.run(run).parameters().standing();
}

std::shared_ptr<const InputSummary> Summaries::of_input(Session& session, const std::shared_ptr<const InputMesh>& input) const {
  const auto known = std::ranges::find_if(inputs_, [&](const KnownInput& one) {
    return one.input.lock() == input && one.summary->metric == session.shown() && one.rule == rule_of(session, input);
  });
  return known == inputs_.end() ? nullptr : known->summary;
}

bool Summaries::find_inputs(Session& session, const std::function<bool()>& go_on) {
  bool found = false;
  std::vector<KnownInput> known;
  ThreadPool* pool = session.pool().get();
  for (const auto& input : session.inputs()) {
    const StandingRule rule = rule_of(session, input);
    auto summary = of_input(session, input);
    if (!summary && go_on()) {
      const QualityContext context = input->quality_context();
      const std::span<const Vec3> positions = input->mesh.positions;
      const std::vector<Index> immovable = immovable_elements(input->mesh, standing_vertices(*input, rule), pool);
      summary = std::make_shared<const InputSummary>(InputSummary{session.shown(),
                                                                  compute_statistics(context, positions, session.shown(), immovable, pool),
                                                                  compute_percentiles(context, positions, session.shown(), pool)});
      found = true;
    }
    if (summary) known.push_back({input, rule, std::move(summary)});
  }
  inputs_ = std::move(known);
  return found;
}

SizeCourse Summaries::sizes_of(Session& session, std::size_t index, std::span<const Vec3> positions) const {
  const auto run = session.identity(index).lock();
  if (!run->size_field()) return {};
  SizeCourse sizes;
  // Keeps the figure of the input, which never changes.
  const auto before = std::ranges::find_if(known_, [&](const Known& one) { return one.at.run.lock() == run; });
  sizes.before = before != known_.end() ? before->summary->sizes.before : size_correlation_at_input(*run);
  sizes.after = size_correlation(*run->size_field(), run->input(), positions, run->colouring().order);
  return sizes;
}

bool Summaries::find(Session& session, const std::function<const Frame*(std::size_t)>& whole, const std::function<bool()>& go_on) {
  std::vector<Known> known;
  bool found = find_inputs(session, go_on);
  for (std::size_t i = 0; i < session.run_count(); ++i) {
    auto summary = of(session, i);
    if (!summary && go_on()) {
      const Frame* there = whole(i);
      const Frame made = there != nullptr ? Frame{} : judged(session, i);
      const Frame& frame = there != nullptr ? *there : made;
      RunSummary found_now = summary_of(frame);
      found_now.sizes = sizes_of(session, i, frame.positions);
      summary = std::make_shared<const RunSummary>(std::move(found_now));
      found = true;
    }
    if (summary) known.push_back({session.standing(i), std::move(summary)});
  }
  known_ = std::move(known);
  return found;
}

}  // namespace dmoscope
