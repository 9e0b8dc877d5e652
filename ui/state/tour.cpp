#include "ui/state/tour.h"

#include <algorithm>

namespace dmoscope::ui {
namespace {

bool stepped(const TourFacts& begin, const TourFacts& now) { return !now.busy && now.iteration > begin.iteration; }

constexpr std::array<TourStep, 7> kTourSteps{{
    {"Open a mesh",
     "The tour uses the sample coast, a sea with islands. Click its picture.",
     "The tour uses the sample coast. Choose it in the menu File, below Samples.",
     "generate coast",
     {"sample:coast", "menu:sample-coast", "menu:File"},
     [](const TourFacts& /*begin*/, const TourFacts& now) { return now.coast && !now.busy; }},
    {"One step",
     "Colours show how good each element is; the bar explains them. Press N or click Iteration. Each vertex moves once, to where the worst "
     "of its elements is better.",
     {},
     "step iteration",
     {"step-iteration"},
     stepped},
    {"Why this place?",
     "The plot shows that the minimum has risen. Click why? beside the worst element. You see the places that one of its "
     "vertices tries.",
     {},
     "inspect-worst",
     {"why?", "fold:right"},
     [](const TourFacts& /*begin*/, const TourFacts& now) { return now.inspecting; }},
    {"Let it run",
     "L shows the search level by level. Now press U or click Run. The run goes on until nothing gets better.",
     {},
     "until-converged",
     {"run-pause"},
     stepped},
    {"Compare",
     "F shows the whole mesh. Press 2 to see the result beside the input. The menu Compare also runs other methods.",
     {},
     "viewports 2",
     {"menu:viewports-2", "menu:Compare"},
     [](const TourFacts& /*begin*/, const TourFacts& now) { return now.side_by_side; }},
    {"Export",
     "Press Ctrl+S, or choose Export in the menu File. The ending of the file's name chooses the format.",
     {},
     "dialog export",
     {"menu:export", "menu:File"},
     [](const TourFacts& /*begin*/, const TourFacts& now) { return now.exporting; }},
    {"That is all",
     "Export the mesh, or cancel. Ctrl+P finds every command, and F1 lists all keys. This tour is in the menu Help.",
     {},
     {},
     {},
     [](const TourFacts& /*begin*/, const TourFacts& /*now*/) { return false; }},
}};

}  // namespace

std::span<const TourStep> tour_steps() { return kTourSteps; }

void Tour::start() {
  on = offered = true;
  offer = false;
  go_to(0);
}

void Tour::stop() {
  on = offer = false;
  offered = true;
}

void Tour::go_to(std::size_t wanted) {
  step = wanted;
  begun_ = false;
}

void Tour::advance() {
  if (!on) return;
  if (step + 1 == tour_steps().size()) return stop();
  go_to(step + 1);
}

void Tour::follow(const TourFacts& now) {
  while (on) {
    if (!begun_) begin_ = now;
    begun_ = true;
    begin_.iteration = std::min(begin_.iteration, now.iteration);  // after an undo, the same step counts again
    if (!tour_steps()[step].done(begin_, now)) return;
    go_to(step + 1);
  }
}

}  // namespace dmoscope::ui
