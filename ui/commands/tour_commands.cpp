#include "ui/commands/tour_commands.h"

#include "ui/commands/command_words.h"

namespace dmoscope::ui {

TourFacts tour_facts(const SessionView& session, const ViewState& state, bool busy) {
  TourFacts facts;
  facts.mesh = session.input != nullptr;
  facts.coast = facts.mesh && session.input->mesh.name.starts_with("coast");
  facts.busy = busy;
  if (session.active < session.runs.size()) facts.iteration = session.runs[session.active].moment.iteration;
  facts.inspecting = state.inspection.open;
  facts.side_by_side = !state.panes.one();
  facts.exporting = state.dialog == Dialog::Export;
  return facts;
}

void add_tour_command(CommandTable& table, ViewState& state) {
  table.add({"tour", "tour [on|off|next|offer]", "guided steps on the sample coast; next: leaves a step out"}, {0, 1},
            [&state](Arguments words) {
              Tour& tour = state.tour;
              static constexpr std::array<std::pair<std::string_view, void (*)(Tour&)>, 4> ways{
                  {{"on", [](Tour& one) { one.start(); }},
                   {"off", [](Tour& one) { one.stop(); }},
                   {"next", [](Tour& one) { one.advance(); }},
                   {"offer", [](Tour& one) { one.offer = !one.on; }}}};
              (words.empty() ? ways[0].second : choose(words[0], ways))(tour);
            });
}

}  // namespace dmoscope::ui
