#include "core/quality/metric_phrase.h"

#include <cctype>

namespace dmoscope {

std::string metric_phrase(Metric metric) {
  std::string title(info(metric).title);
  if (info(metric).name.starts_with("formula:")) return title;  // as it was written
  if (title.size() > 1 && std::islower(static_cast<unsigned char>(title[1])) != 0)
    title[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(title[0])));
  return title;
}

}  // namespace dmoscope
