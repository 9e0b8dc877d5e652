#pragma once
// CSV tables of the program: statistics of runs, and qualities of elements.

#include <span>
#include <string>
#include <vector>

#include "core/run/run.h"

namespace dmoscope {

/// Label of a run in such tables, without commas: "dmo:mean-ratio", "dmo:mean-ratio:0.7:density:h1", "dmo:mean-ratio:then-mean".
[[nodiscard]] std::string stats_label(const RunParameters& parameters);

/// Table of statistics with the columns run,iteration,min_quality,mean_quality,inverted,moved,seconds,movable_minimum; row 0 of a run is
/// the input. Values that do not exist (infinite movable minimum) are empty. With `percentiles`, one list for each run, also p1,p5,p50.
/// Numbers are the shortest that read back as the same double.
[[nodiscard]] std::string stats_csv(std::span<const std::string> titles, std::span<const std::vector<IterationRecord>* const> records,
                                    std::span<const SharedVector<Percentiles>> percentiles = {});

/// Table of elements with the columns element,kind, then one for each metric under its name; empty if a metric is not defined for the
/// element's kind.
[[nodiscard]] std::string elements_csv(const QualityContext& context, std::span<const Vec3> positions, std::span<const Metric> metrics);

}  // namespace dmoscope
