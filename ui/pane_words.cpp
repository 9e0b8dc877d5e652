// What is said of a viewport.
#include <fmt/format.h>

#include "ui/format.h"
#include "ui/panels/panels.h"
#include "ui/viewports.h"

namespace dmoscope::ui {
namespace {

std::string moment_of(const Frame& frame) {
  std::string text = fmt::format("it {}", count(frame.moment.iteration));
  if (frame.moment.visits > 0) text += fmt::format(" + {} visits", count(frame.moment.visits));
  if (frame.moment.edits > 0) text += fmt::format(" + {}", counted(frame.moment.edits, "edit", "edits"));
  return text;
}

}  // namespace

std::vector<TitlePiece> title_of(const PaneFacts& pane, Metric shown) {
  using Role = TitlePiece::Role;
  const Frame* frame = pane.frame();
  std::vector<TitlePiece> pieces;
  const bool of_run = pane.of_run && pane.run() != nullptr;
  if (!pane.name.empty()) pieces.push_back({pane.name, Role::Name, 0});
  if (of_run) {
    const RunView& run = *pane.run();
    const bool combined = run.parameters.combination.has_value();
    const std::string& what = combined ? run.title : run.parameters.method;
    pieces.push_back({pane.removed ? what : fmt::format("{} {}", pane.session->active + 1, what), Role::Name, 0});
    if (!combined) pieces.push_back({metric_phrase(run.parameters.metric), Role::Name, 5});
    if (frame != nullptr && run.mean_since && *run.mean_since < frame->moment.iteration) pieces.push_back({"then mean", Role::Name, 4});
  }
  if (frame == nullptr) return pieces;
  if (frame->run != Frame::kNoRun) pieces.push_back({moment_of(*frame), Role::Plain, 1});
  pieces.push_back({fmt::format("min {}", short_number(frame->shown_statistics.minimum)), Role::Dim, 2});
  if (const Index inverted = frame->shown_statistics.inverted; inverted > 0)
    pieces.push_back({fmt::format("{} inverted", count(inverted)), Role::Bad, 1});
  if (pane.colours && pane.colours->diverging)
    pieces.push_back({fmt::format("{} better, {} worse", count(pane.colours->better), count(pane.colours->worse)), Role::Plain, 3});
  const bool other_metric = frame->shown != shown;
  if (other_metric || (of_run && frame->shown != pane.run()->parameters.metric))
    pieces.push_back({fmt::format("shown: {}", metric_phrase(frame->shown)), Role::Warning, other_metric ? 1 : 6});
  if (pane.reduced) pieces.push_back({"reduced detail", Role::Warning, 4});
  if (pane.lacks_room) pieces.push_back({"zoom in for labels", Role::Warning, 4});
  return pieces;
}

}  // namespace dmoscope::ui
