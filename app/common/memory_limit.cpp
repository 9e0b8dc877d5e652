#include "app/common/memory_limit.h"

#include <algorithm>
#include <cerrno>
#include <new>
#include <system_error>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <sys/resource.h>

#include "core/base/byte_size.h"
#include "core/base/error.h"

namespace dmoscope::app {

namespace {

/// The threads' stacks count as data, though next to nothing of them is ever used.
std::uint64_t room_for_stacks() {
  rlimit stack{};
  if (getrlimit(RLIMIT_STACK, &stack) != 0) return 0;
  constexpr rlim_t kLargest = rlim_t{64} << 20U, kOthers = 2;
  return (std::thread::hardware_concurrency() + kOthers) * std::min(stack.rlim_cur, kLargest);
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& limit) {
  const std::string within = limit.empty() ? std::string() : fmt::format(" within --max-memory {}", limit);
  if (file.empty()) throw Error("not enough memory" + within);
  throw InputError(file.string(), 0, "not enough memory for this mesh" + within);
}

}  // namespace

std::uint64_t MemoryLimit::bytes() const { return text.empty() ? 0 : parse_byte_size(text); }

void add_memory_option(CLI::App& subcommand, MemoryLimit& limit) {
  subcommand
      .add_option(
          "--max-memory", limit.text,
          "Memory limit, such as 800M or 2G. Also limits how far a compressed file may unpack (otherwise 256M or 100 times its size, "
          "whichever is more)")
      ->type_name("SIZE");
}

int within_memory(const MemoryLimit& limit, const std::filesystem::path& file, const std::function<int()>& work) {
  if (const std::uint64_t most = limit.bytes(); most != 0) {
    // Limits data alone: addresses that a driver reserves and never touches are not memory.
    rlimit now{};
    if (getrlimit(RLIMIT_DATA, &now) != 0) throw std::system_error(errno, std::generic_category(), "--max-memory");
    now.rlim_cur = std::min<rlim_t>(most + room_for_stacks(), now.rlim_max);
    if (setrlimit(RLIMIT_DATA, &now) != 0) throw std::system_error(errno, std::generic_category(), "--max-memory");
  }
  try {
    return work();
  } catch (const std::bad_alloc&) {
    fail(file, limit.text);
  } catch (const std::system_error& error) {  // no memory for a thread's stack
    if (limit.text.empty() || error.code() != std::errc::resource_unavailable_try_again) throw;
    fail(file, limit.text);
  }
}

}  // namespace dmoscope::app
