#pragma once
// The tour: two minutes of guided steps on the coast sample. Plain state; each step waits until the person has done it.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace dmoscope::ui {

/// Facts by which the tour goes on.
struct TourFacts {
  bool mesh = false;   // a mesh is open
  bool coast = false;  // the open mesh is the tour's
  bool busy = false;
  std::uint64_t iteration = 0;  // iteration of the active run
  bool inspecting = false;      // the search of a vertex is inspected
  bool side_by_side = false;    // two meshes are on show
  bool exporting = false;       // the dialog for exporting is open
};

struct TourStep {
  std::string_view title, text;
  std::string_view text_with_mesh;        // text if another mesh is open; empty: the same text
  std::string_view command;               // command of Next; empty: none
  std::array<std::string_view, 3> items;  // names of controls on screen: the tour points to the first that is there
  bool (*done)(const TourFacts& begin, const TourFacts& now);
};
[[nodiscard]] std::span<const TourStep> tour_steps();

struct Tour {
  bool offered = false;  // was offered once, or taken; remembered in the settings
  bool offer = false;    // is offered while nothing is open
  bool on = false;
  std::size_t step = 0;

  void start();
  /// Ends the tour, or turns the offer down.
  void stop();
  /// Goes to the next step whether or not this one was done; ends after the last one.
  void advance();
  [[nodiscard]] const TourStep& now() const { return tour_steps()[step]; }
  /// Goes on when the step has been done, over several steps if they were done before. To be called every frame with the present facts.
  void follow(const TourFacts& now);

 private:
  void go_to(std::size_t wanted);
  TourFacts begin_;  // facts at the begin of the step
  bool begun_ = false;
};

}  // namespace dmoscope::ui
