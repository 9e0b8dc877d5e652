#pragma once
// A metric in a sentence.

#include <string>

#include "core/quality/metric.h"

namespace dmoscope {

/// "mean ratio": what sentences, titles and legends call it. Its name, "mean-ratio", is what is typed.
[[nodiscard]] std::string metric_phrase(Metric metric);

}  // namespace dmoscope
