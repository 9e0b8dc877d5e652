#include "ui/state/run_names.h"

#include <algorithm>
#include <array>

namespace dmoscope::ui {
namespace {

/// What a run may differ in from others by its method.
using Parts = std::array<std::string, 4>;

Parts parts_of(const RunView& run) {
  const RunParameters& p = run.parameters;
  std::string aim = p.combination ? phrase(p.metric, *p.combination) : std::string(info(p.metric).name);
  std::string others = other_than_usual(p);
  if (others.starts_with(", ")) others.erase(0, 2);
  return {std::move(aim), p.then_mean ? "then mean" : "", std::move(others), run.input ? run.input->mesh.name : std::string()};
}

RunName name_among(const SessionView& session, const std::vector<Parts>& parts, std::size_t k) {
  const std::string& method = session.runs[k].parameters.method;
  RunName name{std::to_string(k + 1), method};
  for (const RunView& run : session.runs) name.one_method = name.one_method && run.parameters.method == method;
  for (std::size_t part = 0; part < parts[k].size(); ++part) {
    bool differs = false;
    for (std::size_t other = 0; other < parts.size() && !differs; ++other)
      differs = session.runs[other].parameters.method == method && parts[other][part] != parts[k][part];
    if (differs && !parts[k][part].empty()) name.rest += (name.rest.empty() ? "" : ", ") + parts[k][part];
  }
  return name;
}

std::vector<Parts> parts_of(const SessionView& session) {
  std::vector<Parts> parts;
  for (const RunView& run : session.runs) parts.push_back(parts_of(run));
  return parts;
}

}  // namespace

RunName run_name(const SessionView& session, std::size_t k) { return name_among(session, parts_of(session), k); }

std::vector<RunName> run_names(const SessionView& session) {
  const std::vector<Parts> parts = parts_of(session);
  std::vector<RunName> names;
  for (std::size_t k = 0; k < parts.size(); ++k) names.push_back(name_among(session, parts, k));
  return names;
}

std::map<std::string, std::string> KnownRunNames::follow(const SessionView& session) {
  // As long as runs and titles are the same, so are the names.
  const auto is_known = [](const RunView& run, const Known& known) { return run.id == known.id && run.title == known.title; };
  if (std::ranges::equal(session.runs, known_, is_known)) return {};
  const std::vector<RunName> names = run_names(session);
  std::vector<Known> now;
  for (std::size_t k = 0; k < names.size(); ++k) now.push_back({session.runs[k].id, session.runs[k].title, names[k].whole()});
  std::map<std::string, std::string> changed;
  for (const Known& before : known_) {
    const auto at = std::ranges::find(now, before.id, &Known::id);
    std::string name = at == now.end() ? std::string() : at->name;
    if (name != before.name) changed.emplace(before.name, std::move(name));
  }
  known_ = std::move(now);
  return changed;
}

}  // namespace dmoscope::ui
