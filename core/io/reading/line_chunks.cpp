#include "core/io/reading/line_chunks.h"

namespace dmoscope {

std::vector<LineChunk> next_chunks(std::string_view text, std::size_t begin, std::size_t size, std::size_t most) {
  std::vector<LineChunk> chunks;
  while (chunks.size() < most && text.size() - begin > size) {
    const std::size_t last = text.substr(begin + size, size).find('\n');
    if (last == std::string_view::npos) break;
    const std::size_t end = begin + size + last + 1;
    chunks.push_back({begin, end});
    begin = end;
  }
  return chunks;
}

}  // namespace dmoscope
