// Replacement of a mesh that has runs: after its file was read again, or the surface to slide on changed.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/mesh/materials.h"
#include "core/reference/slide_on.h"
#include "core/session/session.h"

namespace dmoscope {

namespace {

bool has_all(const InputMesh& input, const Kinds& kinds) {
  try {
    require_there(input, kinds);
    return true;
  } catch (const UsageError&) {
    return false;
  }
}

}  // namespace

std::string Session::reload(Progress& progress) {
  const std::shared_ptr<const InputMesh> stale = input();
  if (stale->path.empty()) throw UsageError("this mesh was made here: there is no file to read again");
  IoContext as_before = reading(progress);
  as_before.geographic = stale->mesh.degrees ? Geographic::On : Geographic::Off;
  as_before.thin = stale->mesh.thin ? Thin::Auto : Thin::Off;
  auto fresh = load_input(stale->path, Need::Smoothing, as_before, said_materials(stale->mesh));
  if (stale->surface) fresh = slide_on(*fresh, stale->surface);
  return exchange(stale, fresh);
}

std::string Session::slide_on_surface(const std::filesystem::path& path, Progress& progress) {
  const std::shared_ptr<const InputMesh> stale = input();
  IoContext of_all = reading(progress);
  of_all.thin = Thin::Off;  // the boundary of all cells counts
  const auto surface = path.empty() ? nullptr : load_input(path, Need::QualityOnly, of_all);
  std::string note = replace_in_runs(stale, slide_on(*stale, surface));
  if (surface) note_read(surface->path);
  return note;
}

std::string Session::name_materials(std::span<const std::string> fields) {
  const std::shared_ptr<const InputMesh> stale = input();
  return replace_in_runs(stale, with_materials(*stale, fields));
}

/// Calls exchange() with another mesh from the same source, which is recorded for it.
std::string Session::replace_in_runs(const std::shared_ptr<const InputMesh>& stale, const std::shared_ptr<const InputMesh>& fresh) {
  const std::filesystem::path source = source_path(stale);
  std::string note = exchange(stale, fresh);
  if (source != source_path(fresh)) originals_.emplace_back(fresh, source);
  return note;
}

/// Replaces a mesh in all runs on it, which start anew. Returns a sentence on what could not be kept.
std::string Session::exchange(const std::shared_ptr<const InputMesh>& stale, const std::shared_ptr<const InputMesh>& fresh) {
  const bool same_vertices = fresh->mesh.vertex_count() == stale->mesh.vertex_count();
  std::string note;
  const auto add_note = [&note](std::string_view sentence) {
    if (note.find(sentence) == std::string::npos) note += (note.empty() ? "" : "; ") + std::string(sentence);
  };
  std::vector<std::shared_ptr<Run>> runs;
  std::size_t active = 0;
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    std::shared_ptr<Run> run = runs_[i];
    if (run->shared_input() == stale) {
      RunParameters parameters = run->parameters();
      if (!same_vertices && !parameters.fixed.empty()) {
        add_note("the file has another number of vertices now: what was fixed by hand is free again");
        parameters.fixed.clear();
      }
      if (!parameters.kinds.empty() && (!same_vertices || !has_all(*fresh, parameters.kinds))) {
        add_note("the file has other edges now: corners and feature edges are as file and angles say again");
        parameters.kinds = {};
      }
      try {
        run = make_run(fresh, std::move(parameters));
        run->set_id(runs_[i]->id());
        run->set_given_name(runs_[i]->given_name());
      } catch (const Error& error) {  // for example a metric that is not defined for the new elements
        add_note(error.what());
        continue;
      }
    }
    if (i <= active_) active = runs.size();
    runs.push_back(std::move(run));
  }
  const bool none_left = std::ranges::none_of(runs, [&](const auto& run) { return run->shared_input() == fresh; });
  if (none_left) {
    runs.push_back(first_run(fresh));
    runs.back()->set_id(++last_id_);
    active = runs.size() - 1;
  }
  note_read(fresh->path);
  runs_ = std::move(runs);
  activate(active);
  share_history();
  return note;
}

}  // namespace dmoscope
