#pragma once
// Viewports side by side: their number and the content of each. Plain state.

#include <algorithm>
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

namespace dmoscope::ui {

/// Rectangle in pixels of the window.
struct Rect {
  float x = 0, y = 0, w = 0, h = 0;
  [[nodiscard]] bool empty() const noexcept { return w <= 0 || h <= 0; }
  /// Part that lies in another one, too.
  [[nodiscard]] Rect within(const Rect& other) const noexcept {
    const float left = std::max(x, other.x), top = std::max(y, other.y);
    return {left, top, std::max(0.0F, std::min(x + w, other.x + other.w) - left), std::max(0.0F, std::min(y + h, other.y + other.h) - top)};
  }
};

/// Arrangement of the viewports. Split: two over each other under one camera, divided by a handle.
enum class PaneLayout { One, Two, Four, Split };
[[nodiscard]] std::size_t pane_count(PaneLayout layout);

/// State of a mesh that a pane shows, or that colours are compared with.
struct PaneContent {
  enum class Kind { Free, Active, Run, Input, MarkA, MarkB };
  Kind kind = Kind::Free;
  std::uint64_t run = 0;                     // id of the run (RunView::id), for Kind::Run
  std::optional<std::uint64_t> iteration{};  // iteration at whose end the run is shown, for Kind::Run; none: its present state
  friend bool operator==(const PaneContent&, const PaneContent&) = default;
};

struct Pane {
  PaneContent content;
  bool chosen = false;      // whether a person chose the content; else it is filled automatically, see Panes::follow
  render::Camera2D camera;  // camera while cameras are not linked and the pane is not the active one
};

struct Panes {
  static constexpr std::size_t kMost = 4;
  PaneLayout layout = PaneLayout::One;
  std::array<Pane, kMost> panes;
  bool linked = true;                  // one camera for all panes
  double split = 0.5;                  // place of the handle, 0 to 1
  std::size_t focus = 0;               // index of the active pane
  std::vector<std::uint64_t> run_ids;  // ids of the session's runs at the last follow()
  std::vector<std::uint64_t> reached;  // last iteration recorded by each run at the last follow()
  std::uint64_t active_id = 0;         // id of the active run at the last follow()
  /// Runs (RunView::id) that a person took out of viewports and plots. The active run's viewport stays: commands are about it.
  std::set<std::uint64_t> hidden_runs;

  [[nodiscard]] std::size_t count() const { return pane_count(layout); }
  [[nodiscard]] bool one() const { return layout == PaneLayout::One; }
  /// Sets the arrangement. Panes that nobody chose are filled anew. The active pane must be among those that stay.
  void set_layout(PaneLayout wanted);
  /// Brings the panes up to date with the session's runs. Content that no longer exists leaves its pane free. A single pane shows the
  /// active run. Of several panes, those without a person's choice show the runs in their order, the last pane always the active run; then
  /// one shows the input. Two panes without a choice show a single run before and after: on the left the input, on the right the run.
  /// Returns the pane that should be the active one: that of the active run if this run changed or the input took its pane, else the
  /// present one.
  [[nodiscard]] std::size_t follow(const SessionView& session);
  /// Takes a run out of viewports and plots, or puts it back.
  void hide_run(std::uint64_t id, bool hidden);
  /// Whether a pane shows the present state of a run (also as the active run).
  [[nodiscard]] bool shows(std::size_t pane, std::uint64_t id) const;

  /// Words of a content: "run 2", "run 2 10", "input", "mark a", "active"; "auto" for a pane that is filled automatically.
  [[nodiscard]] std::string words(const PaneContent& content) const;
  /// Content that words name; the reverse of words(). Throws UsageError for other words, or for a run or an iteration that does not exist.
  [[nodiscard]] PaneContent parse(const std::vector<std::string>& words) const;

 private:
  void fill(std::size_t panes);
  [[nodiscard]] bool are_reversed(const Pane& left, const Pane& right) const;
  [[nodiscard]] std::size_t pane_of_active() const;
};

/// Rectangles of the panes' pictures within `area`, in whole pixels, all of one size; both of a split view are all of it. `aspect`: width
/// over height of the mesh, which is shown as large as can be by putting panes beside or above each other; `title`: height of each pane's
/// title.
[[nodiscard]] std::vector<Rect> pane_rects(PaneLayout layout, const Rect& area, float gap, double aspect, float title);

}  // namespace dmoscope::ui
