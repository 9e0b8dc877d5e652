// Small kernels: memory, lanes that pass values to each other, and all errors.

#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/gpu/ptx/probe_kernel.h"

namespace dmoscope::gpu::ptx {
namespace {

using ::testing::HasSubstr;
using testing::probe;
using testing::run_probe;
using ::testing::ThrowsMessage;
using U32 = std::uint32_t;
using Words = std::array<U32, 32>;

/// %mine: the address of the lane's word of `out`; %v: its word of `in`; %team: the mask of its eight lanes.
const std::string kOwnWord =
    "mul.wide.u32 %at, %tid, 4; add.s64 %mine, %out, %at; add.s64 %from, %in, %at; ld.global.u32 %v, [%from];\n"
    "and.b32 %first, %tid, 24; mov.u32 %ones, 255; shl.b32 %team, %ones, %first;\n";

Words counted() {
  Words words{};
  std::iota(words.begin(), words.end(), 100U);
  return words;
}
Words run_words(const std::string& body, Schedule schedule = {}) {
  Words out{};
  run_probe(kOwnWord + body, counted(), out, schedule);
  return out;
}
void run_one(const std::string& body) {
  struct {
    alignas(16) std::array<std::uint64_t, 4> in{}, nobodys{}, out{};
  } memory;
  run_probe(body, memory.in, memory.out);
}

TEST(PtxInterpreter, EightLanesPassValues) {
  for (const U32 mask : {1U, 2U, 4U}) {
    const Words out = run_words(fmt::format("shfl.sync.bfly.b32 %w|%p, %v, {}, 31, %team; st.global.u32 [%mine], %w;", mask));
    for (U32 i = 0; i < 32; ++i) EXPECT_EQ(out[i], 100 + (i ^ mask));
  }
  const Words out = run_words("shfl.sync.idx.b32 %w|%p, %v, 3, 6175, %team; st.global.u32 [%mine], %w;");  // the fourth of each eight
  for (U32 i = 0; i < 32; ++i) EXPECT_EQ(out[i], 100 + i / 8 * 8 + 3);
}

TEST(PtxInterpreter, InstructionsAreCounted) {
  const Entry entry = probe("mov.u32 %left, %tid;\n$L__BB0_1:\nadd.s32 %left, %left, -1; setp.ge.s32 %q, %left, 0; @%q bra $L__BB0_1;\n");
  const std::vector<std::byte> parameters(2 * sizeof(std::uint64_t));
  const GlobalMemory global;
  const std::uint64_t rounds = 32 * 33 / 2;  // lane 0 goes round once, each other lane once more than the lane before
  EXPECT_EQ(run_blocks(entry, global, parameters, 3, {}, 32), 3 * (32 * 5 + 3 * rounds)) << "five are no part of the round";
}

/// Every lane leaves its word in the block's memory; after the barrier it takes that of the lane on the other side.
TEST(PtxInterpreter, LanesShareMemoryAcrossABarrier) {
  const std::string body =
      ".shared .align 4 .b8 words[128];\nmov.u32 %base, words; shl.b32 %own, %tid, 2; add.s32 %to, %base, %own; st.shared.u32 [%to], %v;\n"
      "bar.sync 0;\nsub.s32 %far, 124, %own; add.s32 %other, %base, %far; ld.shared.u32 %w, [%other]; st.global.u32 [%mine], %w;";
  for (const bool backwards : {false, true}) {
    const Words out = run_words(body, {.backwards = backwards});
    for (U32 i = 0; i < 32; ++i) EXPECT_EQ(out[i], 100 + 31 - i);
  }
}
/// The eight of a team meet without the others of their warp.
TEST(PtxInterpreter, TeamsShareMemoryAcrossTheirMeetings) {
  const std::string body =
      ".shared .align 4 .b8 words[128];\nmov.u32 %base, words; shl.b32 %own, %tid, 2; add.s32 %to, %base, %own; st.shared.u32 [%to], %v;\n"
      "bar.warp.sync %team;\nxor.b32 %other, %tid, 7; shl.b32 %far, %other, 2; add.s32 %there, %base, %far; ld.shared.u32 %w, [%there];\n"
      "st.global.u32 [%mine], %w;";
  for (const bool backwards : {false, true}) {
    const Words out = run_words(body, {.backwards = backwards});
    for (U32 i = 0; i < 32; ++i) EXPECT_EQ(out[i], 100 + (i ^ 7U));
  }
}
/// Shared memory as nvcc declares it for a function of two kernels.
TEST(PtxInterpreter, SharedMemoryIsDeclaredBeforeAKernelToo) {
  const std::string text =
      ".shared .align 16 .b8 first[32];\n.shared .align 4 .b8 other[8];\n.visible .entry probe(\n)\n{\nmov.u32 %a, first; ret;\n\n}\n"
      ".visible .entry none(\n)\n{\nret;\n\n}\n";
  const auto entries = find_entries(text);
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(decode(entries[0]).shared_bytes, 32U);
  EXPECT_EQ(decode(entries[1]).shared_bytes, 0U);
}
TEST(PtxInterpreter, LanesAddInSharedMemory) {
  const Words out = run_words(
      ".shared .align 4 .b8 sum[4];\nmov.u32 %at0, sum; mov.u32 %zero, 0; st.shared.u32 [%at0], %zero; bar.sync 0;\n"
      "atom.shared.add.u32 %before, [%at0], 2; bar.sync 0; ld.shared.u32 %w, [%at0]; st.global.u32 [%mine], %w;");
  for (const U32 word : out) EXPECT_EQ(word, 64U);
}
TEST(PtxInterpreter, SharedMemoryHasBounds) {
  EXPECT_THAT([] { (void)run_words(".shared .align 4 .b8 sum[4];\nmov.u32 %at0, sum; st.shared.u32 [%at0+4], %v;"); },
              ThrowsMessage<Fault>(HasSubstr("shared memory")));
}
/// A lane that has finished never reaches the barrier.
TEST(PtxInterpreter, ABarrierWantsAll) {
  EXPECT_THAT([] { (void)run_words("setp.eq.s32 %p, %tid, 3; @%p bra $L__BB0_1;\nbar.sync 0;\n$L__BB0_1:\n"); },
              ThrowsMessage<Fault>(HasSubstr("wait for each other")));
}

/// Accesses of lanes to words of `out` that are not their own.
class PtxRaces : public ::testing::Test {
 protected:
  void run(const std::string& body) {
    for (const bool backwards : {false, true}) {
      races.forget();
      Words out{};
      run_probe(kOwnWord + body, counted(), out, {.backwards = backwards, .races = &races});
    }
  }
  void expect_race(const std::string& body, const std::string& what) {
    SCOPED_TRACE(body);
    EXPECT_THAT([&] { run(body); }, ThrowsMessage<Fault>(HasSubstr("race: ")));
    EXPECT_THAT([&] { run(body); }, ThrowsMessage<Fault>(HasSubstr(what)));
  }
  Races races;
};

TEST_F(PtxRaces, AreSeen) {
  expect_race("st.global.u32 [%out], %v;", "to something else");
  expect_race("st.global.u32 [%mine], %v; ld.global.u32 %w, [%out+12];", "another");
  expect_race("ld.global.u32 %w, [%out+12]; st.global.u32 [%mine], %w;", "another");
  expect_race("atom.global.add.u32 %old, [%out+12], 1; ld.global.u32 %w, [%out+12];", "counted up");
  expect_race("atom.global.add.u32 %old, [%out+12], 1; st.global.u32 [%mine], %v;", "another");
  expect_race("mov.u64 %wide, %at; st.global.u64 [%out+8], %wide;", "to something else");
}
TEST_F(PtxRaces, AreNoneWhereTheOrderDoesNotMatter) {
  EXPECT_NO_THROW(run("st.global.u32 [%mine], %v; ld.global.u32 %w, [%mine]; st.global.u32 [%mine], %w;"));
  EXPECT_NO_THROW(run("mov.u32 %one, 1; st.global.u32 [%out+12], %one;")) << "a flag";
  EXPECT_NO_THROW(run("atom.global.add.u32 %old, [%out+12], 1;"));
  EXPECT_NO_THROW(run("ld.global.u32 %w, [%in+12]; add.s32 %w, %w, %v; st.global.u32 [%mine], %w;"));
  EXPECT_NO_THROW(
      run("and.b32 %low, %tid, 3; mul.wide.u32 %byte, %tid, 1; add.s64 %to, %out, %byte; cvt.u16.u32 %s, %low;\n"
          "st.global.u8 [%to], %s;"))
      << "bytes side by side";
}

/// A later group of lanes may read an earlier one's values, not the other way round, as CUDA documents __shfl_xor_sync.
TEST(PtxInterpreter, BeyondItsSegmentALaneKeepsItsValue) {
  const Words out = run_words(
      "shfl.sync.bfly.b32 %w|%p, %v, 8, 6175, -1; selp.u32 %e, 1, 0, %p; shl.b32 %f, %e, 16; add.s32 %g, %w, %f;\n"
      "st.global.u32 [%mine], %g;");
  for (U32 i = 0; i < 32; ++i) EXPECT_EQ(out[i], i % 16 < 8 ? i + 100 : i - 8 + 100 + (1U << 16U));
}

/// Each team goes round as often as its number, and its lanes wait for each other every time.
TEST(PtxInterpreter, TeamsGoTheirOwnWays) {
  const Words out = run_words(
      "shr.u32 %left, %tid, 3; mov.u32 %sum, 0;\n$L__BB0_1:\nshfl.sync.bfly.b32 %w|%p, %v, 1, 31, %team; add.s32 %sum, %sum, %w;\n"
      "setp.eq.s32 %q, %left, 0; @%q bra $L__BB0_2;\nadd.s32 %left, %left, -1; bra.uni $L__BB0_1;\n$L__BB0_2:\nst.global.u32 [%mine], "
      "%sum;");
  for (U32 i = 0; i < 32; ++i) EXPECT_EQ(out[i], (i / 8 + 1) * (100 + (i ^ 1U)));
}

TEST(PtxInterpreter, ActiveLanesAreOneOrAll) {
  const std::string body =
      "setp.lt.u32 %p, %tid, 5; @%p bra $L__BB0_1;\nret;\n$L__BB0_1:\nactivemask.b32 %w; st.global.u32 [%mine], %w;\n"
      "atom.global.add.u32 %old, [%out+124], 2;";
  const Words alone = run_words(body), together = run_words(body, {.together = true, .backwards = true});
  for (U32 i = 0; i < 5; ++i) {
    EXPECT_EQ(alone[i], 1U << i);
    EXPECT_EQ(together[i], 31U);
  }
  EXPECT_EQ(alone[5], 0U);
  EXPECT_EQ(alone[31], 10U);
  EXPECT_EQ(together[31], 10U);
}

TEST(PtxInterpreter, MemoryInAllItsForms) {
  alignas(16) std::array<std::uint32_t, 4> in{0x04030201U, 0x80000000U, 7, 8}, out{};
  run_probe(
      "ld.global.v4.u8 {%a, %b, %c, %d}, [%in]; cvt.u32.u16 %e, %d; ld.global.u32 %wide, [%in+4]; shr.u64 %high, %wide, 31;\n"
      "cvt.u32.u64 %f, %high; st.global.v2.u32 [%out], {%e, %f}; mov.u64 %SPL, __local_depot0; cvta.local.u64 %SP, %SPL;\n"
      "mov.f32 %one, 0f3F800000; st.local.f32 [%SPL+12], %one; ld.f32 %g, [%SP+12]; st.global.f32 [%out+8], %g;\n"
      "mov.b64 %params, probe_param_0; add.s64 %end, %params, 16; ld.param.u64 %again, [%end+-16]; mov.b64 {%lo, %hi}, %again;\n"
      "mov.b64 %whole, {%lo, %hi}; setp.eq.s64 %p, %whole, %in; selp.u32 %h, 5, 6, %p; st.global.u32 [%out+12], %h;",
      in, out);
  EXPECT_EQ(out, (std::array<std::uint32_t, 4>{4, 1, 0x3f800000U, 5}));
}

TEST(PtxInterpreter, HalvesOfARegister) {
  alignas(16) std::array<std::uint32_t, 4> in{0x00020001U, 0, 0, 0}, out{};
  run_probe(
      "ld.global.u32 %whole, [%in]; mov.b32 {%lo, %hi}, %whole; cvt.u32.u16 %a, %lo; cvt.u32.u16 %b, %hi; mov.b32 %turned, {%hi, %lo};\n"
      "st.global.v2.u32 [%out], {%a, %b}; st.global.u32 [%out+8], %turned;",
      in, out);
  EXPECT_EQ(out, (std::array<std::uint32_t, 4>{1, 2, 0x00010002U, 0}));
}

/// Expects a fault with this text and this instruction.
void expect_fault(const std::string& body, const std::string& instruction, const std::string& what) {
  SCOPED_TRACE(body);
  EXPECT_THAT([&] { run_one(body); }, ThrowsMessage<Fault>(HasSubstr(instruction)));
  EXPECT_THAT([&] { run_one(body); }, ThrowsMessage<Fault>(HasSubstr(what)));
  EXPECT_THAT([&] { run_one(body); }, ThrowsMessage<Fault>(HasSubstr("probe")));
}

TEST(PtxFaults, WhatIsNotKnownIsQuoted) {
  expect_fault("sin.approx.f32 %f1, 0f00000000;", "sin.approx.f32 %f1, 0f00000000", "not known");
  expect_fault("call.uni (retval0), vprintf, (param0, param1);", "call.uni (retval0)", "not known");
  expect_fault("mov.u32 %r, %clock.lo;", "mov.u32", "special register that is not known: %clock.lo");
  expect_fault("bra $L__BB0_9;", "$L__BB0_9", "no label");
  expect_fault("add.s32 %r, 1;", "add.s32 %r, 1", "operands");
  const std::string table = ".global .align 4 .b8 table[16] = {1, 2};\n", kernel = ".visible .entry kernel()\n{\n";
  EXPECT_THROW((void)find_entries(table + kernel + "mov.u64 %rd1, table;\nret;\n}\n"), Fault);
  EXPECT_EQ(find_entries(table + kernel + "ret;\n}\n").size(), 1U) << "nobody reads the table";
  EXPECT_THROW((void)find_entries(".func helper()\n{\nret;\n}\n"), Fault);
}

TEST(PtxFaults, MemoryThatIsNotTheirs) {
  expect_fault("ld.global.u32 %r, [%in+32];", "[%in+32]", "out of bounds");
  expect_fault("ld.global.u32 %r, [%in+-4];", "[%in+-4]", "out of bounds");
  expect_fault("mov.f32 %f, 0f00000000; mov.u64 %z, 0; st.global.f32 [%z], %f;", "[%z], %f", "out of bounds");
  expect_fault("mov.u64 %l, __local_depot0; ld.local.f64 %f, [%l+12];", "[%l+12]", "out of bounds");
  expect_fault("mov.u64 %l, __local_depot0; ld.global.u32 %r, [%l];", "ld.global.u32 %r, [%l]", "out of bounds");
  expect_fault("ld.local.u32 %r, [%in];", "ld.local.u32 %r, [%in]", "out of bounds");
  expect_fault("mov.b64 %p, probe_param_0; ld.param.u64 %r, [%p+16];", "[%p+16]", "out of bounds");
  expect_fault("ld.global.f64 %f, [%in+4];", "[%in+4]", "misaligned");
  expect_fault("ld.global.v2.u32 {%a, %b}, [%in+4];", "[%in+4]", "misaligned");
}

TEST(PtxFaults, RegistersThatNobodyWrote) {
  expect_fault("add.s32 %r1, %r2, 1;", "add.s32 %r1, %r2, 1", "not written");
  expect_fault("setp.eq.s32 %p, %tid, 0; @%p bra $L__BB0_1;\nmov.u32 %r1, 1;\n$L__BB0_1:\nadd.s32 %r2, %r1, 1;", "add.s32 %r2",
               "not written");
  expect_fault("mov.u32 %r1, %r0; not.b32 %r2, %r1;", "not.b32 %r2, %r1", "not written");
  EXPECT_NO_THROW(
      run_one("setp.eq.s32 %p, %tid, 0; @!%p bra $L__BB0_1;\nmov.u32 %r0, 1; bra.uni $L__BB0_2;\n$L__BB0_1:\nmov.u32 %r0, 2;\n"
              "$L__BB0_2:\nadd.s32 %r1, %r0, 1;"));
  EXPECT_NO_THROW(run_one("mov.u32 %r1, %r0; st.global.u32 [%out], %r1;")) << "a gap in a structure is copied with it";
}

TEST(PtxFaults, LanesThatWaitForEver) {
  const std::string odd_ones_leave = "and.b32 %odd, %tid, 1; setp.eq.s32 %p, %odd, 0; @%p bra $L__BB0_1;\n";
  expect_fault(odd_ones_leave + "ret;\n$L__BB0_1:\nshfl.sync.bfly.b32 %w|%q, %tid, 1, 31, -1;", "probe", "which is gone");
  expect_fault(odd_ones_leave + "shfl.sync.bfly.b32 %w|%q, %tid, 1, 31, -1; ret;\n$L__BB0_1:\nshfl.sync.bfly.b32 %v|%q, %tid, 2, 31, -1;",
               "probe", "wait for each other for ever");
  expect_fault("$L__BB0_1:\nbra.uni $L__BB0_1;", "bra.uni $L__BB0_1", "no end");
}

}  // namespace
}  // namespace dmoscope::gpu::ptx
