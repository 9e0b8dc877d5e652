#pragma once
// Small kernels for the tests of the interpreter itself.

#include <array>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "tests/gpu/ptx/reader.h"
#include "tests/gpu/ptx/warp.h"

namespace dmoscope::gpu::ptx::testing {

/// A kernel of two pointers, which are in %in and %out; its lane is in %tid.
inline Entry probe(const std::string& body) {
  const std::string text =
      ".version 9.0\n.target sm_75\n\n.visible .entry probe(\n\t.param .u64 probe_param_0,\n\t.param .u64 .ptr .align 1 probe_param_1\n)\n"
      ".maxntid 128, 1, 1\n{\n\t.local .align 8 .b8 \t__local_depot0[16];\n\tld.param.u64 %in, [probe_param_0];\n"
      "\tld.param.u64 \t%out, [probe_param_1]; // a comment\n\tmov.u32 %tid, %tid.x;\n" +
      body + "\nret;\n\n}\n";
  return decode(find_entries(text).at(0));
}

/// Runs one warp of the kernel.
template <class In, class Out, std::size_t N, std::size_t M>
void run_probe(const std::string& body, const std::array<In, N>& in, std::array<Out, M>& out, Schedule schedule = {}) {
  const Entry entry = probe(body);
  GlobalMemory global;
  global.add(in.data(), sizeof in);
  global.add(out.data(), sizeof out);
  const std::array<const void*, 2> pointers{in.data(), out.data()};
  std::vector<std::byte> parameters(sizeof pointers);
  std::memcpy(parameters.data(), pointers.data(), sizeof pointers);
  Warp warp;
  std::vector<std::byte> shared(entry.shared_bytes);
  warp.start(entry, global, parameters, shared, 0, 0);
  warp.watch_for_races(schedule.races, schedule.races != nullptr ? schedule.races->first_agent() : 0);
  while (!warp.run(schedule)) warp.pass_barrier();
}

/// Result of one instruction with these operands.
template <class R, class... A>
R result(const std::string& opcode, A... operands) {
  alignas(8) std::array<std::uint64_t, 4> in{}, out{};
  std::string body, list;
  std::size_t count = 0;
  const auto add = [&](const auto& operand) {
    using T = std::remove_cvref_t<decltype(operand)>;
    if constexpr (std::is_same_v<T, bool>)
      in[count] = operand ? 1 : 0;
    else
      std::memcpy(&in[count], &operand, sizeof operand);
    const std::size_t bits = std::is_same_v<T, bool> ? 64 : 8 * sizeof(T);
    body += fmt::format("ld.global.u{} %a{}, [%in+{}];\n", bits, count, 8 * count);
    if (std::is_same_v<T, bool>) body += fmt::format("setp.ne.s64 %a{0}, %a{0}, 0;\n", count);
    list += fmt::format(", %a{}", count++);
  };
  (add(operands), ...);
  body += fmt::format("{} %d{};\n", opcode, list);
  body += std::is_same_v<R, bool> ? "selp.u32 %e, 1, 0, %d;\nst.global.u32 [%out], %e;" : "st.global.u64 [%out], %d;";
  run_probe(body, in, out);
  R value{};
  std::memcpy(&value, out.data(), sizeof(R));
  return value;
}

}  // namespace dmoscope::gpu::ptx::testing
