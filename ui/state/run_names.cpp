#include "ui/state/run_names.h"

#include <algorithm>
#include <array>

#include "core/quality/metric_phrase.h"

namespace dmoscope::ui {
namespace {

/// Parts of a method in which runs may differ.
using Parts = std::array<std::string, 4>;

Parts parts_of(const RunView& run) {
  const RunParameters& p = run.parameters;
  std::string aim = p.combination ? phrase(p.metric, *p.combination) : metric_phrase(p.metric);
  std::string others = other_than_usual(p, run.input && run.input->is_surface());
  std::string then = then_text(p);
  for (std::string* text : {&others, &then})
    if (text->starts_with(", ")) text->erase(0, 2);
  return {std::move(aim), std::move(then), std::move(others), run.input ? run.input->mesh.name : std::string()};
}

RunName name_among(const SessionView& session, const std::vector<Parts>& parts, std::size_t k) {
  const RunView& run = session.runs[k];
  const std::string& method = run.parameters.method;
  RunName name{std::to_string(k + 1), method, parts[k][0]};
  for (const RunView& other : session.runs) name.one_method = name.one_method && other.parameters.method == method;
  std::string former_rest;
  for (std::size_t part = 0; part < parts[k].size(); ++part) {
    bool differs = false;
    for (std::size_t other = 0; other < parts.size() && !differs; ++other)
      differs = session.runs[other].parameters.method == method && parts[other][part] != parts[k][part];
    if (!differs || parts[k][part].empty()) continue;
    const bool metric = part == 0 && !run.parameters.combination;
    name.rest += (name.rest.empty() ? "" : ", ") + parts[k][part];
    former_rest += (former_rest.empty() ? "" : ", ") + (metric ? std::string(info(run.parameters.metric).name) : parts[k][part]);
  }
  name.formerly = name.number + " " + method + (former_rest.empty() ? "" : " " + former_rest);
  if (run.name.empty()) return name;
  name.method = run.name;
  name.rest.clear();
  name.given = true;
  return name;
}

std::vector<Parts> parts_of(const SessionView& session) {
  std::vector<Parts> parts;
  for (const RunView& run : session.runs) parts.push_back(parts_of(run));
  return parts;
}

}  // namespace

std::string RunName::other_differences() const {
  if (!rest.starts_with(aim)) return rest;
  return rest.size() > aim.size() ? rest.substr(aim.size() + 2) : std::string();
}

std::string run_title(const SessionView& session, std::size_t k) {
  const std::string& title = session.runs[k].title;
  return session.runs.size() > 1 ? std::to_string(k + 1) + " " + title : title;
}

RunName run_name(const SessionView& session, std::size_t k) { return name_among(session, parts_of(session), k); }

std::vector<RunName> run_names(const SessionView& session) {
  const std::vector<Parts> parts = parts_of(session);
  std::vector<RunName> names;
  for (std::size_t k = 0; k < parts.size(); ++k) names.push_back(name_among(session, parts, k));
  return names;
}

std::map<std::string, std::string> KnownRunNames::follow(const SessionView& session) {
  // Names stay the same as long as runs and titles do.
  const auto is_known = [](const RunView& run, const Known& known) {
    return run.id == known.id && run.title == known.title && run.name == known.given;
  };
  if (std::ranges::equal(session.runs, known_, is_known)) return {};
  const std::vector<RunName> names = run_names(session);
  std::vector<Known> now;
  for (std::size_t k = 0; k < names.size(); ++k)
    now.push_back({session.runs[k].id, session.runs[k].title, session.runs[k].name, names[k].whole(), names[k].formerly});
  std::map<std::string, std::string> changed;
  for (const Known& before : known_) {
    const auto at = std::ranges::find(now, before.id, &Known::id);
    std::string name = at == now.end() ? std::string() : at->name;
    if (name != before.name) changed.emplace(before.name, std::move(name));
  }
  known_ = std::move(now);
  return changed;
}

std::map<std::string, std::string> KnownRunNames::former() const {
  std::map<std::string, std::string> names;
  for (const Known& one : known_)
    if (one.formerly != one.name) names.emplace(one.formerly, one.name);
  return names;
}

std::string KnownRunNames::of_now(const std::string& name) const {
  if (std::ranges::find(known_, name, &Known::name) != known_.end()) return name;
  const auto at = std::ranges::find(known_, name, &Known::formerly);
  return at == known_.end() ? name : at->name;
}

}  // namespace dmoscope::ui
