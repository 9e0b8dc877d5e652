#include "ui/analysis/inspection_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "ui/state/format.h"

namespace dmoscope::ui {
std::string level_label(const InspectionState& state, const Inspection& inspection) {
  if (inspection.visit() == nullptr) return {};
  const VisitSummary& trace = *inspection.visit();
  const std::size_t levels = inspection.level_count();
  if (levels == 0) return trace.end == VisitEnd::Waits ? "waits" : "fixed";
  if (state.applied) {
    if (trace.end != VisitEnd::Moved) return fmt::format("stays · {}", short_number(quality_of(trace.before)));
    return fmt::format("moved · {} → {}", short_number(quality_of(trace.before)), short_number(quality_of(trace.after)));
  }
  if (state.all_levels) return fmt::format("levels 1 to {}", levels);
  if (state.level < 1) return {};
  const LevelValues& level = inspection.level(state.level);
  const std::string name = fmt::format("{}level {} of {}", inspection.other_method.empty() ? "" : "dmo · ", state.level, levels);
  if (!level.best) return name + " · none better";
  return fmt::format("{} · best {}", name, short_number(level.quality[static_cast<std::size_t>(*level.best)]));
}

std::string other_method_sentence(const Inspection& inspection) {
  if (inspection.other_method.empty()) return {};
  return fmt::format("This run's method is {}, which uses no grid of candidates: shown is what dmo would do here.",
                     inspection.other_method);
}

Index limiting_element(const VisitSummary& trace, bool after) {
  const auto quality = [after](const ElementChange& change) { return after ? change.after : change.before; };
  const auto least = std::min_element(trace.elements.begin(), trace.elements.end(),
                                      [&](const ElementChange& a, const ElementChange& b) { return quality(a) < quality(b); });
  return least == trace.elements.end() ? kNoIndex : least->element;
}

std::string gap_sentence(const Inspection& inspection) {
  if (!inspection.trace || !inspection.optimum) return {};
  const double found = inspection.trace->after.quality, best = inspection.optimum->quality;
  if (!(inspection.trace->after.jacobian > 0.0)) return fmt::format("{} is the best possible here", short_number(best));
  return fmt::format("{} {}, {} best possible (gap {})", short_number(found),
                     inspection.trace->end == VisitEnd::Moved ? "found" : "where it stands", short_number(best),
                     short_number(std::max(0.0, best - found)));
}

std::string stuck_sentence(const Inspection& inspection) {
  if (inspection.visit() == nullptr) return {};
  const VisitSummary& trace = *inspection.visit();
  if (trace.end == VisitEnd::Moved) return {};
  if (trace.end == VisitEnd::Fixed) return "It is fixed: no search moves it. How good its elements can get depends on their other corners.";
  if (trace.end == VisitEnd::Waits)
    return "It waits: none of its elements is inverted, and this iteration only moves vertices back whose own place is wrong, to where all "
           "their elements are sound.";
  if (trace.end == VisitEnd::Deviates)
    return "It may not move to the best candidate, nor part of the way: faces would deviate from the input by more than the bound "
           "(max-deviation).";
  if (trace.end == VisitEnd::Leans)
    return "It may not move to the best candidate, nor part of the way: faces would tilt against the input by more than 60 degrees.";
  std::string text = trace.end == VisitEnd::NotConfirmed ? "The search found a candidate, but the exact check shows no gain."
                     : trace.combined ? fmt::format("No candidate is better than where it stands. They are compared by this number: {}.",
                                                    trace.value_phrase)
                                      : "No candidate is better than where it stands.";
  if (trace.combined) return text;
  if (const Index limit = limiting_element(trace, false); limit != kNoIndex) text += fmt::format(" Element {} limits it.", count(limit));
  if (inspection.optimum) {
    constexpr double kNothing = 1e-6;  // a gap too small to be seen
    text += inspection.optimum->quality - trace.before.quality < kNothing
                ? " No place is better for this vertex: only its neighbours can change that."
                : " The best position lies between the candidates.";
  }
  return text;
}

namespace {

std::string name_of(const TracedLevel& level, int index) {
  const Vec2<double> at = level.at(index);
  return fmt::format("candidate {} ({}, {})\noffset {}, {}\n", index, index / level.points, index % level.points, short_number(at.x),
                     short_number(at.y));
}
std::string name_of(const VolumeLevel& level, int index) {
  const Vec3 at = level.at(index);
  const int n = level.points;
  return fmt::format("candidate {} ({}, {}, {})\noffset {}, {}, {}\n", index, index / (n * n), index / n % n, index % n, short_number(at.x),
                     short_number(at.y), short_number(at.z));
}

}  // namespace

std::string candidate_text(const Inspection& inspection, int number, int index) {
  const auto slot = static_cast<std::size_t>(index), of = static_cast<std::size_t>(number - 1);
  const LevelValues& level = inspection.level(number);
  const VisitSummary& trace = *inspection.visit();
  std::string text = inspection.trace ? name_of(inspection.trace->levels[of], index) : name_of(inspection.solid->levels[of], index);
  const CandidateFate fate = inspection.grid ? inspection.grid->levels[of].fates[slot] : CandidateFate::Counts;
  if (fate == CandidateFate::Feature || fate == CandidateFate::TurnedAway) return text + fmt::format("does not count: {}", phrase(fate));
  if (fate == CandidateFate::Deviates || fate == CandidateFate::Leans) text += fmt::format("{}\n", phrase(fate));
  text += is_valid(level.quality[slot]) ? fmt::format("quality {}\n", full_number(level.quality[slot]))
                                        : fmt::format("an element is inverted: least Jacobian {}\n", full_number(level.quality[slot]));
  text += fmt::format("{} {}", trace.value_phrase, full_number(level.values[slot]));
  if (level.best == index) text += "\nchosen: the best so far";
  return text;
}

std::string search_phrase(const VisitSummary& trace) {
  if (trace.end == VisitEnd::Fixed || trace.end == VisitEnd::Waits) return "not searched";
  std::string text = trace.fast ? "searched in single precision, checked in double" : "searched in double precision";
  if (trace.untangling) text += ", untangling";
  return text;
}

std::string trace_csv(const VisitTrace& trace, int level) {
  std::string text = "level,index,i,j,u,v,value,quality,chosen\n";
  for (std::size_t k = 0; k < trace.levels.size(); ++k) {
    if (level != 0 && static_cast<std::size_t>(level) != k + 1) continue;
    const TracedLevel& one = trace.levels[k];
    for (int index = 0; index < one.points * one.points; ++index) {
      const Vec2<double> at = one.at(index);
      const auto slot = static_cast<std::size_t>(index);
      text += fmt::format("{},{},{},{},{},{},{},{},{}\n", k + 1, index, index / one.points, index % one.points, at.x, at.y,
                          one.values[slot], one.quality[slot], one.best == index ? 1 : 0);
    }
  }
  return text;
}

std::string trace_csv(const VolumeTrace& trace, int level) {
  std::string text = "level,index,i,j,k,x,y,z,value,quality,chosen\n";
  for (std::size_t l = 0; l < trace.levels.size(); ++l) {
    if (level != 0 && static_cast<std::size_t>(level) != l + 1) continue;
    const VolumeLevel& one = trace.levels[l];
    const int n = one.points;
    for (int index = 0; index < n * n * n; ++index) {
      const Vec3 at = one.at(index);
      const auto slot = static_cast<std::size_t>(index);
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", l + 1, index, index / (n * n), index / n % n, index % n, at.x, at.y, at.z,
                          one.values[slot], one.quality[slot], one.best == index ? 1 : 0);
    }
  }
  return text;
}

std::string trace_csv(const Inspection& inspection, int level) {
  return inspection.trace ? trace_csv(*inspection.trace, level) : trace_csv(*inspection.solid, level);
}

std::string grid_phrase(const Inspection& inspection) {
  if (inspection.level_count() == 0) return {};
  const int n = inspection.level(1).points;
  if (inspection.grid)
    return fmt::format("{} × {} candidates a level, on the surface; crosses do not count, squares deviate too far", n, n);
  return inspection.trace ? fmt::format("{} × {} candidates a level", n, n) : fmt::format("{} × {} × {} candidates a level", n, n, n);
}

std::string slice_phrase(const GridSlice& slice) {
  return slice.axis ? fmt::format("{}, slice {} of {}", "xyz"[*slice.axis], slice.number + 1, slice.points) : std::string();
}

}  // namespace dmoscope::ui
