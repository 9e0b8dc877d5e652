#pragma once
// Viewports side by side: how many there are, and what each shows. Plain state.

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/view/view.h"
#include "render/camera.h"
#include "ui/state/layout_rect.h"

namespace dmoscope::ui {

/// Split: two over each other under one camera, parted by a handle.
enum class PaneLayout { One, Two, Four, Split };
[[nodiscard]] std::size_t pane_count(PaneLayout layout);

/// What a pane shows, or colours are compared with.
struct PaneContent {
  enum class Kind { Free, Active, Run, Input, MarkA, MarkB };
  Kind kind = Kind::Free;
  std::uint64_t run = 0;                     // of Kind::Run: RunView::id
  std::optional<std::uint64_t> iteration{};  // of Kind::Run: at the end of which; none: as it stands
  friend bool operator==(const PaneContent&, const PaneContent&) = default;
};

struct Pane {
  PaneContent content;
  bool chosen = false;      // by a person; else it is filled by itself, see Panes::follow
  render::Camera2D camera;  // while cameras are not linked and it is not the active pane
};

struct Panes {
  static constexpr std::size_t kMost = 4;
  PaneLayout layout = PaneLayout::One;
  std::array<Pane, kMost> panes;
  bool linked = true;                  // one camera for all
  double split = 0.5;                  // where the handle is, 0 to 1
  std::size_t focus = 0;               // the active pane
  std::vector<std::uint64_t> run_ids;  // of the session's runs, as followed last
  std::vector<std::uint64_t> reached;  // likewise: the last iteration that each has a record of
  std::uint64_t active_id = 0;         // likewise
  /// Runs (RunView::id) that a person took out of viewports and plots. The active run's viewport stays: commands are about it.
  std::set<std::uint64_t> hidden_runs;

  [[nodiscard]] std::size_t count() const { return pane_count(layout); }
  [[nodiscard]] bool one() const { return layout == PaneLayout::One; }
  /// Panes that nobody chose are filled anew. The active pane must be among those that stay.
  void set_layout(PaneLayout wanted);
  /// Brings the panes up to date with the runs there are. What is no more leaves its pane free. A single pane shows the active run; of
  /// several, those that nobody chose show the runs in their order, the last one in any case the active one; then one the input. Of two, of
  /// which nobody chose one, and a single run the left one shows the input, the right one the run: before and after. Returns which pane
  /// should be the active one: the one of the active run where that has changed or the input has come to where one was, else the one that
  /// is.
  [[nodiscard]] std::size_t follow(const SessionView& session);
  /// Takes a run out of viewports and plots, or puts it back.
  void hide_run(std::uint64_t id, bool hidden);
  /// Whether a pane shows a run (the active one when `id` is that one's) as it stands.
  [[nodiscard]] bool shows(std::size_t pane, std::uint64_t id) const;

  /// "run 2", "run 2 10", "input", "mark a", "active"; "auto" for a pane that is filled by itself.
  [[nodiscard]] std::string words(const PaneContent& content) const;
  /// The reverse. Throws UsageError for words that are none of these, or for a run or an iteration that does not
  /// exist.
  [[nodiscard]] PaneContent parse(const std::vector<std::string>& words) const;

 private:
  void fill(std::size_t panes);
  [[nodiscard]] bool are_reversed(const Pane& left, const Pane& right) const;
  [[nodiscard]] std::size_t pane_of_active() const;
};

/// Where the panes' pictures are within `area`; of a split view both are all of it. Whole pixels, all of one size. `aspect`: width over
/// height of the mesh, which stand beside or above each other as makes it largest; `title`: the height that titles take from each.
[[nodiscard]] std::vector<Rect> pane_rects(PaneLayout layout, const Rect& area, float gap, double aspect, float title);

}  // namespace dmoscope::ui
