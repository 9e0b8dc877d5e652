#pragma once
// The --max-memory option: the most memory that a subcommand may use.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace dmoscope::app {

struct MemoryLimit {
  std::string text;  // the option's text; empty: not given
  /// Bytes; 0: no limit. Throws UsageError.
  [[nodiscard]] std::uint64_t bytes() const;
};

/// Declares --max-memory.
void add_memory_option(CLI::App& subcommand, MemoryLimit& limit);

/// Does the work within the limit, which holds for the whole process from now on; if it needs more it ends with an error that names `file`
/// (empty: none).
int within_memory(const MemoryLimit& limit, const std::filesystem::path& file, const std::function<int()>& work);

}  // namespace dmoscope::app
