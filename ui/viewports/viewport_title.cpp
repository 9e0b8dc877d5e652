// Title of a viewport.
#include <fmt/format.h>

#include "ui/state/format.h"
#include "ui/state/run_names.h"
#include "ui/viewports/viewports.h"

namespace dmoscope::ui {
namespace {

std::string moment_of(const Frame& frame) {
  std::string text = fmt::format("iteration {}", count(frame.moment.iteration));
  if (frame.moment.visits > 0) text += fmt::format(" + {} visits", count(frame.moment.visits));
  if (frame.moment.edits > 0) text += fmt::format(" + {}", counted(frame.moment.edits, "edit", "edits"));
  return text;
}

std::string difference_words(const ElementColours& colours) {
  if (colours.better == 0 && colours.worse == 0) return "no difference";
  return fmt::format("{} better, {} worse", count(colours.better), count(colours.worse));
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
    RunName name = run_name(*pane.session, pane.session->active);
    if (pane.removed) name = {{}, run.name.empty() ? run.parameters.method : run.name, name.aim};
    if (pane.session->runs.size() == 1) name.number.clear();
    if (name.number.empty()) {
      pieces.push_back({name.method, Role::Name, 0});
    } else if (name.rest.empty() || !name.one_method) {
      pieces.push_back({name.whole(), Role::Name, 0});
    } else {
      // If there is little room, differences to other runs are worth more than the method that all share.
      pieces.push_back({name.number, Role::Name, 0});
      pieces.push_back({name.method, Role::Name, 3});
      pieces.push_back({"· " + name.rest, Role::Name, 0});
    }
    if (!name.given && !name.rest.starts_with(name.aim)) pieces.push_back({"· " + name.aim, Role::Name, 5});
    const Phase phase = frame != nullptr ? run.phases.of(frame->moment.iteration) : Phase::Method;
    if (phase == Phase::Mean && name.rest.find("then mean") == std::string::npos) pieces.push_back({"· then mean", Role::Name, 4});
    if (phase == Phase::Joint && run.parameters.then_joint && name.rest.find("then joint") == std::string::npos)
      pieces.push_back({"· then joint", Role::Name, 4});
  }
  if (frame == nullptr) return pieces;
  const bool difference = pane.colours && pane.colours->diverging;
  if (frame->run != Frame::kNoRun) pieces.push_back({moment_of(*frame), Role::Plain, difference ? 2 : 1});
  const bool own = !of_run || frame->shown == pane.run()->parameters.metric;
  pieces.push_back({fmt::format("min {}{}", short_number(frame->shown_statistics.minimum), own ? "" : " by " + metric_phrase(frame->shown)),
                    Role::Dim, difference ? 3 : 2});
  if (const Index inverted = frame->shown_statistics.inverted; inverted > 0)
    pieces.push_back({fmt::format("{} inverted", count(inverted)), Role::Bad, 1});
  if (difference) pieces.push_back({difference_words(*pane.colours), Role::Plain, 1});
  if (pane.colours && pane.colours->by == ColourBy::SizeOverTarget && !pane.colours->has_values)
    pieces.push_back({"no target size", Role::Warning, 1});
  if (pane.colours && takes_long(pane.colours->by) && !pane.colours->has_values) pieces.push_back({"nothing slides", Role::Warning, 1});
  if (pane.colours && pane.colours->by == ColourBy::Difference && !pane.colours->has_values)
    pieces.push_back({"other elements: no difference", Role::Warning, 1});
  const bool other_metric = frame->shown != shown;
  if (other_metric) pieces.push_back({fmt::format("shown: {}", metric_phrase(frame->shown)), Role::Warning, 1});
  if (pane.reduced) pieces.push_back({"reduced detail", Role::Warning, 4});
  if (pane.lacks_room) pieces.push_back({"zoom in for labels", Role::Warning, 4});
  return pieces;
}

}  // namespace dmoscope::ui
