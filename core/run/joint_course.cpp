#include "core/run/joint_course.h"

#include <limits>

namespace dmoscope {

namespace {

constexpr double kNoLevel = std::numeric_limits<double>::infinity();

/// Makes the state before an iteration the one after it.
void follow(JointState& state, const JointIteration& done) {
  if (done.anew) state = {};
  JointState next = done.rest;
  next.atoms = std::move(state.atoms);
  next.levels = std::move(state.levels);
  next.atoms.resize(done.atom_count, JointState::Of::Open);
  next.levels.resize(done.vertex_count, kNoLevel);
  for (const auto& [atom, of] : done.atoms) next.atoms[atom] = of;
  for (const auto& [vertex, level] : done.levels) next.levels[vertex] = level;
  state = std::move(next);
}

}  // namespace

std::shared_ptr<const JointIteration> JointCourse::find(std::uint64_t iteration) const {
  const auto& all = iterations_.values();
  return iteration < all.size() ? all[iteration] : nullptr;
}

std::optional<JointState> JointCourse::state_after(std::uint64_t iteration, std::uint64_t since) const {
  if (latest_ && latest_->iteration == iteration) return latest_->state;
  std::uint64_t from = iteration;
  const auto stands = [&](std::uint64_t i) { return standing_ && standing_->iteration == i; };
  while (from > since && !stands(from) && !(latest_ && latest_->iteration == from)) {
    const auto done = find(from);
    if (!done) return std::nullopt;
    --from;
    if (done->anew) break;
  }
  JointState state;
  if (latest_ && latest_->iteration == from && from > since)
    state = latest_->state;
  else if (stands(from))
    state = standing_->state;
  while (from < iteration) follow(state, *find(++from));
  latest_ = JointStanding{iteration, state};
  return state;
}

void JointCourse::add(std::uint64_t iteration, const JointState& before, JointState after, std::optional<JointCluster> cluster, bool anew) {
  auto done = std::make_shared<JointIteration>();
  done->cluster = std::move(cluster);
  done->anew = anew;
  done->atom_count = after.atoms.size();
  done->vertex_count = after.levels.size();
  for (std::size_t a = 0; a < after.atoms.size(); ++a)
    if (after.atoms[a] != (a < before.atoms.size() ? before.atoms[a] : JointState::Of::Open))
      done->atoms.emplace_back(static_cast<Index>(a), after.atoms[a]);
  for (std::size_t v = 0; v < after.levels.size(); ++v)
    if (after.levels[v] != (v < before.levels.size() ? before.levels[v] : kNoLevel))
      done->levels.emplace_back(static_cast<Index>(v), after.levels[v]);
  latest_ = JointStanding{iteration, after};
  done->rest = std::move(after);
  done->rest.atoms.clear();
  done->rest.levels.clear();
  auto& all = iterations_.change();
  if (all.size() <= iteration) all.resize(iteration + 1);
  all[iteration] = std::move(done);
}

void JointCourse::forget_after(std::uint64_t iteration) {
  if (iterations_.values().size() > iteration + 1) iterations_.change().resize(iteration + 1);
  if (standing_ && standing_->iteration > iteration) standing_.reset();
  if (latest_ && latest_->iteration > iteration) latest_.reset();
}

void JointCourse::restore(const JointPath& path) {
  if (path.iterations.size() > iterations_.values().size()) iterations_.replace(path.iterations.whole());
  if (!standing_) standing_ = path.standing;
}

}  // namespace dmoscope
