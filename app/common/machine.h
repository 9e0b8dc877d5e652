#pragma once
// Conditions of a measurement besides the code: the machine, and how the program was built.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dmoscope::app {

/// "g++ 12.2.0" or "clang 14.0.6".
[[nodiscard]] std::string_view compiler();
/// The options that affect the code of the search: optimisation, instruction set, floating point, sanitizers.
[[nodiscard]] std::string_view compiler_flags();
/// The commit as git describes it, taken at the build; "unknown" without git.
[[nodiscard]] std::string_view commit();

/// The processor's name by the kernel; "unknown" if it gives none.
[[nodiscard]] std::string processor();
/// Bytes of memory in all, and bytes available without swapping; none if the kernel does not tell.
[[nodiscard]] std::optional<std::uint64_t> total_memory();
[[nodiscard]] std::optional<std::uint64_t> available_memory();
/// The present time in UTC: "2026-11-21T10:15:00Z".
[[nodiscard]] std::string date_and_time();

}  // namespace dmoscope::app
