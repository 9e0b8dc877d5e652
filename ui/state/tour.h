#pragma once
// The tour: two minutes of guided steps on the coast sample. Plain state; each step waits until the person has done it.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace dmoscope::ui {

/// What the tour goes by.
struct TourFacts {
  bool mesh = false;   // one is open
  bool coast = false;  // it is the tour's
  bool busy = false;
  std::uint64_t iteration = 0;  // of the active run
  bool inspecting = false;      // a vertex' search is looked at
  bool side_by_side = false;    // two meshes are seen
  bool exporting = false;       // the dialog for that is open
};

struct TourStep {
  std::string_view title, text;
  std::string_view text_with_mesh;        // instead, where another mesh is open; empty: the same text
  std::string_view command;               // what Next does; empty: nothing is to be done
  std::array<std::string_view, 3> items;  // the control concerned, by its name on screen: the first that is there
  bool (*done)(const TourFacts& begin, const TourFacts& now);
};
[[nodiscard]] std::span<const TourStep> tour_steps();

struct Tour {
  bool offered = false;  // once, or taken; remembered in the settings
  bool offer = false;    // while nothing is open
  bool on = false;
  std::size_t step = 0;

  void start();
  /// Ends it, or turns the offer down.
  void stop();
  /// To the next step whether or not this one was done; after the last one: ends.
  void advance();
  [[nodiscard]] const TourStep& now() const { return tour_steps()[step]; }
  /// Goes on where the step has been done; several steps where they were done before. To be called with the facts of every frame.
  void follow(const TourFacts& now);

 private:
  void go_to(std::size_t wanted);
  TourFacts begin_;  // as the step began
  bool begun_ = false;
};

}  // namespace dmoscope::ui
