// Below the viewport: plots.
#include <algorithm>

#include "ui/panels/panels.h"
#include "ui/panels/plot_parts.h"

namespace dmoscope::ui {

void draw_plots(PanelContext& context, const Layout& layout) {
  const Rect& rect = layout.bottom;
  if (rect.empty()) return;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(12), context.px(6)});
  begin_panel("plots", rect);
  ImGui::PopStyleVar();
  draw_plot_tabs(context);
  draw_plot_controls(context, rect);
  // The keyboard goes into the table, not into plots, because it would leave a frame around them.
  const ImGuiWindowFlags keys =
      context.state.plot == PlotTab::Runs || context.state.plot == PlotTab::Compare ? ImGuiWindowFlags_None : ImGuiWindowFlags_NoNav;
  ImGui::BeginChild("plot area", {0, std::max(1.0F, ImGui::GetContentRegionAvail().y)}, false,
                    keys | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  if (context.state.plot == PlotTab::Runs) {
    draw_run_table(context);
  } else if (context.state.plot == PlotTab::Compare) {
    draw_comparison(context);
  } else {
    const TimelineRoom below = timeline_room(context, layout);
    draw_plot_area(context, below.below_plot ? std::optional(Range{below.left, below.right}) : std::nullopt);
  }
  ImGui::EndChild();
  end_panel();
}

}  // namespace dmoscope::ui
