#include "ui/state/mesh_change.h"

#include <algorithm>

namespace dmoscope::ui {

MeshChange MeshWatch::follow(const SessionView& session) {
  std::vector<Known> meshes;
  Known now;
  for (const InputView& mesh : session.meshes) {
    meshes.push_back(
        {mesh.serial, mesh.input->path, mesh.input->mesh.vertex_count(), static_cast<Index>(mesh.input->mesh.elements.size())});
    if (mesh.input == session.input) now = meshes.back();
  }
  const MeshChange change = now.serial == active_.serial ? MeshChange::None : change_to(now, meshes);
  if (change != MeshChange::None) same_ids_ = now.vertices == active_.vertices && now.elements == active_.elements;
  meshes_ = std::move(meshes);
  active_ = std::move(now);
  return change;
}

MeshChange MeshWatch::change_to(const Known& now, const std::vector<Known>& meshes) const {
  const auto among = [](const std::vector<Known>& list, std::uint64_t serial) {
    return std::ranges::find(list, serial, &Known::serial) != list.end();
  };
  if (among(meshes_, now.serial)) return MeshChange::Switched;
  const bool was_read = !now.path.empty() && now.path == active_.path && !among(meshes, active_.serial);
  if (was_read) return MeshChange::ReadAgain;
  const bool others_stay = std::ranges::any_of(meshes_, [&](const Known& before) { return among(meshes, before.serial); });
  return others_stay ? MeshChange::Beside : MeshChange::Opened;
}

}  // namespace dmoscope::ui
