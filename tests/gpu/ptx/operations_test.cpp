// Single instructions, against independent values.

#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/gpu/ptx/probe_kernel.h"

namespace dmoscope::gpu::ptx {
namespace {

using testing::result;
using U32 = std::uint32_t;
using U64 = std::uint64_t;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

U32 bits(float x) { return std::bit_cast<U32>(x); }
U64 bits(double x) { return std::bit_cast<U64>(x); }

struct Order {
  const char* name;
  bool less, equal, greater, unordered;  // results for 1 and 2, 2 and 2, 3 and 2, and with a NaN
};

TEST(PtxOperations, ComparisonsKnowWhatIsNoNumber) {
  for (const Order& order :
       {Order{"eq", false, true, false, false}, Order{"ne", true, false, true, false}, Order{"lt", true, false, false, false},
        Order{"le", true, true, false, false}, Order{"gt", false, false, true, false}, Order{"ge", false, true, true, false},
        Order{"equ", false, true, false, true}, Order{"neu", true, false, true, true}, Order{"ltu", true, false, false, true},
        Order{"leu", true, true, false, true}, Order{"gtu", false, false, true, true}, Order{"geu", false, true, true, true},
        Order{"num", true, true, true, false}, Order{"nan", false, false, false, true}}) {
    const std::string in_float = std::string("setp.") + order.name + ".f32", in_double = std::string("setp.") + order.name + ".f64";
    SCOPED_TRACE(order.name);
    EXPECT_EQ(result<bool>(in_float, 1.0F, 2.0F), order.less);
    EXPECT_EQ(result<bool>(in_float, 2.0F, 2.0F), order.equal);
    EXPECT_EQ(result<bool>(in_float, 0.0F, -0.0F), order.equal);
    EXPECT_EQ(result<bool>(in_float, 3.0F, 2.0F), order.greater);
    EXPECT_EQ(result<bool>(in_float, kNan, 2.0F), order.unordered);
    EXPECT_EQ(result<bool>(in_float, 2.0F, kNan), order.unordered);
    EXPECT_EQ(result<bool>(in_double, 1.0, 2.0), order.less);
    EXPECT_EQ(result<bool>(in_double, 2.0, 2.0), order.equal);
    EXPECT_EQ(result<bool>(in_double, 3.0, 2.0), order.greater);
    EXPECT_EQ(result<bool>(in_double, 3.0, std::nan("")), order.unordered);
  }
}

TEST(PtxOperations, IntegersCompareWithAndWithoutSigns) {
  EXPECT_TRUE(result<bool>("setp.lt.s32", -1, 0));
  EXPECT_FALSE(result<bool>("setp.lt.u32", -1, 0));
  EXPECT_TRUE(result<bool>("setp.gt.s64", std::int64_t{1}, std::int64_t{-1}));
  EXPECT_FALSE(result<bool>("setp.gt.u64", std::int64_t{1}, std::int64_t{-1}));
  EXPECT_TRUE(result<bool>("setp.eq.s16", std::uint16_t{65535}, std::int16_t{-1}));
  EXPECT_TRUE(result<bool>("setp.ge.u64", U64{7}, U64{7}));
  EXPECT_FALSE(result<bool>("setp.ne.s32", 7, 7));
  EXPECT_TRUE(result<bool>("setp.le.u32", 6, 7));
}

TEST(PtxOperations, TheSmallerAndTheGreater) {
  EXPECT_EQ(bits(result<float>("min.f32", 0.0F, -0.0F)), 0x80000000U);
  EXPECT_EQ(bits(result<float>("min.f32", -0.0F, 0.0F)), 0x80000000U);
  EXPECT_EQ(bits(result<float>("max.f32", 0.0F, -0.0F)), 0U);
  EXPECT_EQ(bits(result<float>("max.f32", -0.0F, 0.0F)), 0U);
  EXPECT_EQ(result<float>("min.f32", kNan, 3.0F), 3.0F);
  EXPECT_EQ(result<float>("min.f32", 3.0F, kNan), 3.0F);
  EXPECT_EQ(result<float>("max.f32", kNan, -3.0F), -3.0F);
  EXPECT_EQ(bits(result<float>("max.f32", -kNan, -kNan)), 0x7fffffffU);
  EXPECT_EQ(result<float>("min.f32", -1.0F, 2.0F), -1.0F);
  EXPECT_EQ(result<float>("max.f32", -1.0F, kInf), kInf);
  EXPECT_EQ(bits(result<double>("min.f64", 0.0, -0.0)), U64{1} << 63U);
  EXPECT_EQ(result<double>("min.f64", std::nan(""), 1.0), 1.0);
  EXPECT_EQ(result<std::int32_t>("min.s32", -1, 1), -1);
  EXPECT_EQ(result<std::int32_t>("max.s32", -1, 1), 1);
  EXPECT_EQ(result<U64>("min.u64", ~U64{0}, U64{1}), 1U);
}

TEST(PtxOperations, EachRoundsOnceToTheNearest) {
  EXPECT_EQ(result<float>("add.rn.f32", 1.0F, 0x1p-24F), 1.0F) << "ties go to even";
  EXPECT_EQ(result<float>("add.rn.f32", 1.0F + 0x1p-23F, 0x1p-24F), 1.0F + 0x1p-22F);
  EXPECT_EQ(result<float>("sub.rn.f32", 1.0F, 3.0F), -2.0F);
  EXPECT_EQ(result<float>("mul.rn.f32", 0x1p-100F, 0x1p-40F), 0x1p-140F) << "small ones are kept";
  EXPECT_EQ(bits(result<float>("div.rn.f32", 1.0F, 3.0F)), 0x3eaaaaabU);
  EXPECT_EQ(bits(result<float>("rcp.rn.f32", 3.0F)), 0x3eaaaaabU);
  EXPECT_EQ(bits(result<float>("sqrt.rn.f32", 2.0F)), 0x3fb504f3U);
  EXPECT_EQ(bits(result<float>("sub.rn.f32", kInf, kInf)), 0x7fffffffU) << "what is no number in single precision is always the same";
  EXPECT_EQ(bits(result<double>("div.rn.f64", 1.0, 3.0)), 0x3fd5555555555555U);
  EXPECT_EQ(bits(result<double>("sqrt.rn.f64", 2.0)), 0x3ff6a09e667f3bcdU);
  EXPECT_EQ(result<double>("mul.rn.f64", 1.0 + 0x1p-52, 1.0 + 0x1p-52), 1.0 + 0x1p-51);
  EXPECT_EQ(result<double>("fma.rn.f64", 1.0 + 0x1p-52, 1.0 + 0x1p-52, -1.0 - 0x1p-51), 0x1p-104) << "once, not twice";
  EXPECT_EQ(bits(result<float>("abs.f32", -0.0F)), 0U);
  EXPECT_EQ(bits(result<double>("neg.f64", 0.0)), U64{1} << 63U);
  EXPECT_EQ(result<double>("copysign.f64", -1.0, 5.0), -5.0) << "the first gives the sign";
}

TEST(PtxOperations, Conversions) {
  EXPECT_EQ(result<float>("cvt.rn.f32.f64", 1.0 + 0x1p-24), 1.0F);
  EXPECT_EQ(result<float>("cvt.rn.f32.f64", 1.0 + 0x1p-24 + 0x1p-50), 1.0F + 0x1p-23F);
  EXPECT_EQ(result<double>("cvt.f64.f32", 0.1F), 0.100000001490116119384765625);
  EXPECT_EQ(result<float>("cvt.rn.f32.s32", -16777217), -16777216.0F);
  EXPECT_EQ(result<float>("cvt.rn.f32.u32", 0xffffffffU), 0x1p32F);
  EXPECT_EQ(result<std::int32_t>("cvt.rzi.s32.f64", -1.9), -1);
  EXPECT_EQ(result<std::int32_t>("cvt.rzi.s32.f64", 1e10), 0x7fffffff);
  EXPECT_EQ(result<std::int32_t>("cvt.rzi.s32.f64", std::nan("")), 0);
  EXPECT_EQ(result<double>("cvt.rn.f64.s32", -7), -7.0);
  EXPECT_EQ(result<double>("cvt.rn.f64.u64", ~U64{0}), 0x1p64);
  EXPECT_EQ(result<double>("cvt.rn.f64.s64", std::int64_t{-7}), -7.0);
  EXPECT_EQ(result<std::int64_t>("cvt.rzi.s64.f64", -1.9), -1);
  EXPECT_EQ(result<std::int64_t>("cvt.rzi.s64.f64", -1e30), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(result<std::int64_t>("cvt.rzi.s64.f64", 1e30), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(result<U64>("cvt.u16.u64", U64{0x12345}), 0x2345U);
  EXPECT_EQ(result<U64>("cvt.rzi.u64.f64", 1.99), 1U);
  EXPECT_EQ(result<U64>("cvt.rzi.u64.f64", -5.0), 0U);
  EXPECT_EQ(result<U64>("cvt.rzi.u64.f64", 0x1p70), ~U64{0});
  EXPECT_EQ(result<U64>("cvt.rzi.u64.f64", 0x1p63), U64{1} << 63U);
  EXPECT_EQ(result<U64>("cvt.s64.s32", -2), ~U64{1});
  EXPECT_EQ(result<U64>("cvt.u64.u32", -2), 0xfffffffeU);
  EXPECT_EQ(result<U64>("cvt.u64.u16", std::uint16_t{0xfffe}), 0xfffeU);
  EXPECT_EQ(result<U64>("cvt.u32.u64", 0x123456789U), 0x23456789U) << "the register's upper half is not the lower one's";
}

TEST(PtxOperations, Integers) {
  EXPECT_EQ(result<U64>("add.s32", 0xffffffffU, 2U), 1U);
  EXPECT_EQ(result<U64>("sub.s64", U64{1}, U64{2}), ~U64{0});
  EXPECT_EQ(result<U64>("mul.lo.s64", U64{1} << 63U, U64{3}), U64{1} << 63U);
  EXPECT_EQ(result<U64>("mul.hi.u64", ~U64{0}, U64{5}), 4U);
  EXPECT_EQ(result<U64>("mul.hi.u32", 0xffffffffU, 5U), 4U);
  EXPECT_EQ(result<std::int64_t>("mul.wide.s32", -3, 0x7fffffff), -3 * std::int64_t{0x7fffffff});
  EXPECT_EQ(result<U64>("mul.wide.u32", 0xffffffffU, 24U), 103079215080U);
  EXPECT_EQ(result<U64>("mad.lo.s32", 7U, 6U, 0xffffffffU), 41U);
  EXPECT_EQ(result<U64>("mad.lo.s64", U64{1} << 32U, U64{1} << 31U, U64{5}), (U64{1} << 63U) + 5);
  EXPECT_EQ(result<U64>("min.u32", 0xffffffffU, 1U), 1U);
  EXPECT_EQ(result<U64>("rem.u64", U64{103}, U64{10}), 3U);
  EXPECT_EQ(result<std::int32_t>("rem.s32", -103, 10), -3);
  EXPECT_EQ(result<U64>("abs.s32", -5), 5U);
  EXPECT_EQ(result<U64>("neg.s64", U64{1}), ~U64{0});
}

TEST(PtxOperations, Bits) {
  EXPECT_EQ(result<U64>("bfi.b64", U64{0xabc}, ~U64{0}, 4U, 8U), 0xfffffffffffffbcfU);
  EXPECT_EQ(result<U64>("bfi.b64", U64{5}, U64{3}, 13U, 51U), (U64{5} << 13U) + 3);
  EXPECT_EQ(result<U64>("bfi.b64", U64{5}, U64{3}, 64U, 8U), 3U);
  EXPECT_EQ(result<U64>("bfi.b64", U64{5}, U64{3}, 0U, 64U), 5U);
  EXPECT_EQ(result<U64>("bfe.u32", 0xabcdef01U, 8U, 12U), 0xdefU);
  EXPECT_EQ(result<U64>("bfe.u32", 0xabcdef01U, 24U, 32U), 0xabU);
  EXPECT_EQ(result<U64>("bfe.u32", 0xabcdef01U, 32U, 4U), 0U);
  EXPECT_EQ(result<U64>("bfi.b32", 0xabcU, 0xffffffffU, 4U, 8U), 0xfffffbcfU);
  EXPECT_EQ(result<U64>("brev.b32", 0x00000005U), 0xa0000000U);
  EXPECT_EQ(result<U64>("bfind.shiftamt.u32", 0x00800000U), 8U);
  EXPECT_EQ(result<U64>("bfind.shiftamt.u32", 0U), 0xffffffffU);
  EXPECT_EQ(result<U64>("add.s16", std::uint16_t{65535}, std::uint16_t{3}), 2U) << "16 bits, not 32";
  EXPECT_EQ(result<U64>("sub.s16", std::uint16_t{2}, std::uint16_t{3}), 65535U);
  EXPECT_EQ(result<U64>("mul.lo.s16", std::uint16_t{300}, std::uint16_t{300}), 90000U - 65536U);
  EXPECT_EQ(result<U64>("mul.wide.u16", std::uint16_t{300}, std::uint16_t{300}), 90000U);
  EXPECT_EQ(result<std::int32_t>("div.s32", -7, 2), -3) << "towards zero";
  EXPECT_THROW((void)result<std::int32_t>("div.s32", 7, 0), Fault);
  EXPECT_EQ(result<U64>("div.u32", 0xfffffff9U, 2U), 0x7ffffffcU);
  EXPECT_THROW((void)result<U64>("div.u32", 7U, 0U), Fault);
  EXPECT_EQ(result<U64>("popc.b32", 0xf0f00001U), 9U);
  EXPECT_EQ(result<U64>("clz.b64", U64{1} << 40U), 23U);
  EXPECT_EQ(result<U64>("clz.b64", U64{0}), 64U);
  EXPECT_EQ(result<U64>("shl.b32", 0x80000001U, 1U), 2U);
  EXPECT_EQ(result<U64>("shl.b32", 1U, 32U), 0U) << "not taken modulo 32";
  EXPECT_EQ(result<U64>("shl.b64", U64{1}, 40U), U64{1} << 40U);
  EXPECT_EQ(result<U64>("shr.u64", ~U64{0}, 64U), 0U);
  EXPECT_EQ(result<U64>("shf.l.wrap.b32", 0x89abcdefU, 0x01234567U, 8U), 0x23456789U);
  EXPECT_EQ(result<U64>("shf.l.wrap.b32", 0x89abcdefU, 0x01234567U, 32U), 0x01234567U) << "taken modulo 32";
  EXPECT_EQ(result<U64>("not.b32", 1U), 0xfffffffeU);
  EXPECT_EQ(result<U64>("xor.b32", 6U, 3U), 5U);
  EXPECT_TRUE(result<bool>("xor.pred", true, false));
  EXPECT_FALSE(result<bool>("not.pred", true));
  EXPECT_EQ(result<U64>("selp.b64", U64{1}, U64{2}, true), 1U);
  EXPECT_EQ(result<float>("selp.f32", 1.0F, 2.0F, false), 2.0F);
}

}  // namespace
}  // namespace dmoscope::gpu::ptx
