#include "core/mesh/kind_set.h"

#include <vector>

#include <fmt/format.h>

namespace dmoscope {

std::string words(KindSet kinds) {
  std::vector<std::string_view> each;
  for (std::size_t k = 0; k < kElementKindCount; ++k)
    if (contains(kinds, static_cast<ElementKind>(k))) each.push_back(kElementKinds[k].plural);
  std::string text;
  for (std::size_t i = 0; i < each.size(); ++i) text += fmt::format("{}{}", i == 0 ? "" : i + 1 < each.size() ? ", " : " and ", each[i]);
  return text;
}

}  // namespace dmoscope
