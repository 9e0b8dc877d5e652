// Reading the mesh's file again.

#include <vector>

#include "core/base/error.h"
#include "core/session/session.h"

namespace dmoscope {

std::string Session::reload(Progress& progress) {
  if (input()->path.empty()) throw UsageError("this mesh was made here: there is no file to read again");
  std::vector<RunParameters> parameters;
  std::vector<std::uint64_t> ids;
  for (const auto& run : runs_) {
    parameters.push_back(run->parameters());
    ids.push_back(run->id());
  }
  const std::size_t was_active = active_index();
  auto fresh = load_input(input()->path, Need::Smoothing, reading(progress));
  std::string note;
  if (fresh->mesh.vertex_count() != input()->mesh.vertex_count()) {
    for (RunParameters& one : parameters) {
      if (!one.fixed.empty()) note = "the file has another number of vertices now: what was fixed by hand is free again";
      one.fixed.clear();
    }
  }
  replace_input(std::move(fresh));  // with one fresh run; may throw, with nothing replaced yet
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    try {
      runs_[k == 0 ? change(parameters[k]) : add_run(parameters[k])]->set_id(ids[k]);
    } catch (const UsageError& error) {  // such as a metric that is not defined for the elements of now
      note += (note.empty() ? "" : "; ") + std::string(error.what());
    }
  }
  select(std::min(was_active, run_count() - 1));
  return note;
}

}  // namespace dmoscope
