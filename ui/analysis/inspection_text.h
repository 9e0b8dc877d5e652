#pragma once
// Texts about an inspected visit.

#include <string>

#include "ui/analysis/inspection.h"

namespace dmoscope::ui {

/// Label of the shown level: "level 2 of 3 · best 0.8123", "dmo · level 2 of 3 · none better" (in a run of another method), "level 3 of 3 ·
/// none better", "moved · 0.31 → 0.82"; empty when there is nothing to say.
[[nodiscard]] std::string level_label(const InspectionState& state, const Inspection& inspection);

/// Sentences on why the vertex stays: the element that limits it, and whether there is a better place. Empty when it moves.
[[nodiscard]] std::string stuck_sentence(const Inspection& inspection);

/// Gap to the best place: "0.8123 found, 0.8130 best possible (gap 0.0007)"; empty if the best possible is not known.
[[nodiscard]] std::string gap_sentence(const Inspection& inspection);

/// Sentence saying that the shown search is not the one of the run's method; empty if it is.
[[nodiscard]] std::string other_method_sentence(const Inspection& inspection);

/// Element of least quality of the star, before or after the visit, which limits the vertex. kNoIndex for an empty star.
[[nodiscard]] Index limiting_element(const VisitSummary& visit, bool after);

/// A candidate in some lines: its number, place and quality.
[[nodiscard]] std::string candidate_text(const Inspection& inspection, int level, int index);

/// Origin of the trace: "fast search in float", "plain search in double, untangling", "not searched".
[[nodiscard]] std::string search_phrase(const VisitSummary& visit);

/// A level's trace as CSV with columns level,index,i,j,u,v,value,quality,chosen; u and v: offset from the vertex in the plane, mesh units.
/// `level`: from 1; 0: all.
[[nodiscard]] std::string trace_csv(const VisitTrace& trace, int level = 0);
/// A volume's trace as CSV with columns level,index,i,j,k,x,y,z,value,quality,chosen; x, y and z: offset from the vertex.
[[nodiscard]] std::string trace_csv(const VolumeTrace& trace, int level = 0);
[[nodiscard]] std::string trace_csv(const Inspection& inspection, int level = 0);

/// Number of candidates of a level: "8 × 8 × 8 candidates a level".
[[nodiscard]] std::string grid_phrase(const Inspection& inspection);
/// Name of a slice of a level of a volume: "z, slice 4 of 8".
[[nodiscard]] std::string slice_phrase(const GridSlice& slice);

}  // namespace dmoscope::ui
