#include "ui/commands/size_point.h"

#include <fmt/format.h>

#include "core/mesh/geographic.h"
#include "ui/commands/command_words.h"
#include "ui/state/format.h"

namespace dmoscope::ui {

const Vec3* size_point_of(const RunView& run) {
  const auto& combination = run.parameters.combination;
  const SizeFunction* size = combination ? combination->size() : nullptr;
  return size != nullptr && size->has_point() ? &size->point : nullptr;
}

void add_size_point_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add({"place-size-point", "place-size-point [on|off|toggle]", "the next click in the view places the point of the size function"},
            {0, 1}, [&state, &host](Arguments words) {
              const bool on = switched(words, 0, state.placing_size_point);
              const auto view = host.session();
              if (on && (!view || view->runs.empty() || size_point_of(view->runs[view->active]) == nullptr))
                throw UsageError("the active run has no size function with a point: see combine, with h1 or h2");
              state.placing_size_point = on;
            });
}

std::string size_point_command(const ViewState& state, const InputMesh& input, Vec2<double> pixel) {
  const Vec3 point = in_file(input.mesh, input.geometry.plane.lift(state.camera.to_plane(pixel, state.viewport)));
  std::string command = fmt::format("size-point {} {}", full_number(point.x), full_number(point.y));
  if (point.z != 0.0) command += ' ' + full_number(point.z);
  return command;
}

}  // namespace dmoscope::ui
