#pragma once
// Parsing of many lines of one kind by several threads.

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/io/reading/io_context.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {

/// Range of a chunk's lines in a text. Both ends are begins of lines (or the text's end).
struct LineChunk {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The next chunks of about `size` bytes each, at most `most` of them. Fewer, or none, if lines do not end with a line feed.
[[nodiscard]] inline std::vector<LineChunk> next_chunks(std::string_view text, std::size_t begin, std::size_t size, std::size_t most) {
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

/// Parses lines from `tokens` on in chunks, one for each thread at a time, until an error:
///
/// - parse(Tokenizer&, Part&) parses all lines of a chunk. Its Tokenizer ends where the chunk ends; offsets are those of the text.
/// - take(Part&) adds the result of a chunk, chunk by chunk; false if it must not (it has more lines than wanted).
///
/// Stops before the first chunk with an error or one that was not taken, and leaves `tokens` there: a reader that continues line by line
/// from there reports the error in its place, and finds the end of the lines of this kind. Does nothing without several threads. Throws
/// Cancelled.
template <class Part, class Parse, class Take>
void read_in_chunks(Tokenizer& tokens, const IoContext& context, Parse parse, Take take) {
  constexpr std::size_t kBytes = std::size_t{1} << 19U;
  if (context.pool == nullptr || context.pool->size() < 2) return;
  struct Parsed {
    Part part;
    std::size_t lines = 0;
    bool well = false;
  };
  std::vector<Parsed> parsed(4 * std::size_t{context.pool->size()});
  for (;;) {
    const std::vector<LineChunk> chunks = next_chunks(tokens.text(), tokens.offset(), kBytes, parsed.size());
    if (chunks.empty()) return;
    context.pool->parallel_for(chunks.size(), 1, [&](std::size_t i, std::size_t) {
      Progress unwatched;
      Tokenizer lines = tokens.over(chunks[i].begin, chunks[i].end, unwatched);
      parsed[i].part.clear();
      try {
        parse(lines, parsed[i].part);
        parsed[i].well = true;
      } catch (const InputError&) {
        parsed[i].well = false;
      }
      parsed[i].lines = lines.line() - 1;
    });
    for (std::size_t i = 0; i < chunks.size(); ++i) {
      if (!parsed[i].well || !take(parsed[i].part)) return;
      tokens.seek(chunks[i].end, tokens.line() + parsed[i].lines);
    }
    tokens.report();
  }
}

}  // namespace dmoscope
