#include "tests/gpu/ptx/operations.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>
#include <utility>

namespace dmoscope::gpu::ptx {

namespace {

using U16 = std::uint16_t;
using U32 = std::uint32_t;
using U64 = std::uint64_t;
using I16 = std::int16_t;
using I32 = std::int32_t;
using I64 = std::int64_t;
__extension__ using U128 = unsigned __int128;

// --- From a function of values to a handler of slots.

template <class F, class R, class... A, std::size_t... I>
void apply(Lane& lane, const Instruction& instruction, std::index_sequence<I...> /*operands*/) {
  lane.put<R>(instruction.slots[0], F{}(lane.get<A>(instruction.slots[I + 1])...));
}
template <class F, class R, class... A>
constexpr Operation operation(R (*)(A...)) {
  return {[](Lane& lane, const Instruction& i) { apply<F, R, A...>(lane, i, std::index_sequence_for<A...>{}); }, 1, sizeof...(A) + 1};
}
/// Makes a handler. f: a lambda without captures, with the operands that are read.
template <class F>
constexpr Operation op(F f) {
  return operation<F>(+f);
}
/// `operands`: a bit for each that is copied unchanged.
template <class F>
constexpr Operation copies(unsigned operands, F f) {
  Operation made = operation<F>(+f);
  made.copied = static_cast<std::uint8_t>(operands);
  return made;
}
constexpr unsigned kFirst = 1U << 1U, kSecond = 1U << 2U;

// --- Differences of the device from the host, and behaviour that C++ leaves open.

/// Replaces a single-precision NaN by the one that the device gives.
float canonical(float x) { return std::isnan(x) ? std::bit_cast<float>(U32{0x7fffffff}) : x; }
double canonical(double x) { return x; }

/// Minimum or maximum: the other operand if one is not a number; -0 is less than +0.
template <class T>
T least(T a, T b) {
  if (std::isnan(a) || std::isnan(b)) return canonical(std::isnan(a) ? b : a);
  if (a == b) return std::signbit(a) ? a : b;
  return a < b ? a : b;
}
template <class T>
T greatest(T a, T b) {
  if (std::isnan(a) || std::isnan(b)) return canonical(std::isnan(a) ? b : a);
  if (a == b) return std::signbit(a) ? b : a;
  return a < b ? b : a;
}

/// Converts to an integer, towards zero, and to the nearest one in range.
U64 truncated(double x) {
  if (std::isnan(x)) return U64{1} << 63U;
  if (x <= 0.0) return 0;
  if (x >= 0x1p64) return std::numeric_limits<U64>::max();
  return static_cast<U64>(x);
}

template <class T>
T shifted_left(T x, U32 by) {
  return by < sizeof(T) * 8 ? static_cast<T>(x << by) : T{0};
}
template <class T>
T shifted_right(T x, U32 by) {
  return by < sizeof(T) * 8 ? static_cast<T>(x >> by) : T{0};
}

template <class T>
T remainder_of(T a, T b) {
  if (b == 0) throw Fault("the remainder of a division by zero");
  return a % b;
}

U32 unsigned_quotient_of(U32 a, U32 b) {
  if (b == 0) throw Fault("a division without a quotient");
  return a / b;
}
/// Quotient, rounded towards zero.
U32 quotient_of(I32 a, I32 b) {
  if (b == 0 || (b == -1 && a == std::numeric_limits<I32>::min())) throw Fault("a division without a quotient");
  return static_cast<U32>(a / b);
}

/// Inserts the low `length` bits of `from` into `into`, from bit `position` on.
U64 inserted(U64 from, U64 into, U32 position, U32 length) {
  position &= 0xffU;
  length &= 0xffU;
  const U64 mask = shifted_left(length < 64 ? (U64{1} << length) - 1 : ~U64{0}, position);
  return (into & ~mask) | (shifted_left(from, position) & mask);
}

/// Returns `length` bits of `from`, from bit `position` on.
U32 extracted(U32 from, U32 position, U32 length) {
  length &= 0xffU;
  const U32 rest = shifted_right(from, position & 0xffU);
  return length < 32 ? rest & ((U32{1} << length) - 1) : rest;
}

U32 reversed(U32 x) {
  U32 result = 0;
  for (unsigned i = 0; i < 32; ++i) result |= (x >> i & 1U) << (31U - i);
  return result;
}

// --- The table.

using Table = std::unordered_map<std::string_view, Operation>;

void add_floats(Table& t) {
  t["add.rn.f32"] = op([](float a, float b) { return canonical(a + b); });
  t["sub.rn.f32"] = op([](float a, float b) { return canonical(a - b); });
  t["mul.rn.f32"] = op([](float a, float b) { return canonical(a * b); });
  t["div.rn.f32"] = op([](float a, float b) { return canonical(a / b); });
  t["rcp.rn.f32"] = op([](float a) { return canonical(1.0F / a); });
  t["sqrt.rn.f32"] = op([](float a) { return canonical(std::sqrt(a)); });
  t["min.f32"] = op([](float a, float b) { return least(a, b); });
  t["max.f32"] = op([](float a, float b) { return greatest(a, b); });
  t["abs.f32"] = op([](U32 a) { return a & 0x7fffffffU; });
  t["neg.f32"] = op([](U32 a) { return a ^ 0x80000000U; });

  t["add.rn.f64"] = op([](double a, double b) { return a + b; });
  t["sub.rn.f64"] = op([](double a, double b) { return a - b; });
  t["mul.rn.f64"] = op([](double a, double b) { return a * b; });
  t["div.rn.f64"] = op([](double a, double b) { return a / b; });
  t["rcp.rn.f64"] = op([](double a) { return 1.0 / a; });
  t["sqrt.rn.f64"] = op([](double a) { return std::sqrt(a); });
  t["fma.rn.f64"] = op([](double a, double b, double c) { return std::fma(a, b, c); });
  t["min.f64"] = op([](double a, double b) { return least(a, b); });
  t["max.f64"] = op([](double a, double b) { return greatest(a, b); });
  t["abs.f64"] = op([](U64 a) { return a & ~(U64{1} << 63U); });
  t["neg.f64"] = op([](U64 a) { return a ^ U64 { 1 } << 63U; });
  t["copysign.f64"] = op([](double sign, double value) { return std::copysign(value, sign); });

  t["cvt.f64.f32"] = op([](float a) { return static_cast<double>(a); });
  t["cvt.rn.f32.f64"] = op([](double a) { return canonical(static_cast<float>(a)); });
  t["cvt.rn.f32.s32"] = op([](I32 a) { return static_cast<float>(a); });
  t["cvt.rn.f32.u32"] = op([](U32 a) { return static_cast<float>(a); });
  t["cvt.rn.f64.s32"] = op([](I32 a) { return static_cast<double>(a); });
  t["cvt.rn.f64.u32"] = op([](U32 a) { return static_cast<double>(a); });
  t["cvt.rn.f64.s64"] = op([](I64 a) { return static_cast<double>(a); });
  t["cvt.rn.f64.u64"] = op([](U64 a) { return static_cast<double>(a); });
  t["cvt.rzi.u64.f64"] = op([](double a) { return truncated(a); });
  t["cvt.rzi.s64.f64"] = op([](double a) {  // the end of the range for NaN and values out of range
    if (!(a > -0x1p63)) return std::numeric_limits<I64>::min();
    return a < 0x1p63 ? static_cast<I64>(a) : std::numeric_limits<I64>::max();
  });
  t["cvt.rzi.s32.f64"] = op([](double a) {  // 0 for NaN, the nearest number in range for others
    if (a != a) return U32{0};
    const double bounded = std::clamp(std::trunc(a), -0x1p31, 0x1p31 - 1.0);
    return static_cast<U32>(static_cast<std::int32_t>(bounded));
  });
}

void add_integers(Table& t) {
  for (const char* name : {"add.s32", "add.u32"}) t[name] = op([](U32 a, U32 b) { return a + b; });
  for (const char* name : {"add.s64", "add.u64"}) t[name] = op([](U64 a, U64 b) { return a + b; });
  t["add.s16"] = op([](U16 a, U16 b) { return static_cast<U16>(a + b); });
  t["sub.s16"] = op([](U16 a, U16 b) { return static_cast<U16>(a - b); });
  t["mul.lo.s16"] = op([](U16 a, U16 b) { return static_cast<U16>(U32{a} * b); });
  t["mul.wide.u16"] = op([](U16 a, U16 b) { return U32{a} * b; });
  t["sub.s32"] = op([](U32 a, U32 b) { return a - b; });
  t["sub.s64"] = op([](U64 a, U64 b) { return a - b; });
  t["neg.s32"] = op([](U32 a) { return U32{0} - a; });
  t["neg.s64"] = op([](U64 a) { return U64{0} - a; });
  t["abs.s32"] = op([](U32 a) { return (a >> 31U) != 0 ? U32{0} - a : a; });
  t["min.s32"] = op([](I32 a, I32 b) { return a < b ? a : b; });
  t["max.s32"] = op([](I32 a, I32 b) { return a < b ? b : a; });
  t["min.u32"] = op([](U32 a, U32 b) { return a < b ? a : b; });
  t["max.u32"] = op([](U32 a, U32 b) { return a < b ? b : a; });
  t["min.u64"] = op([](U64 a, U64 b) { return a < b ? a : b; });
  t["max.u64"] = op([](U64 a, U64 b) { return a < b ? b : a; });
  t["mul.lo.s32"] = op([](U32 a, U32 b) { return a * b; });
  t["mul.lo.s64"] = op([](U64 a, U64 b) { return a * b; });
  t["mul.hi.u32"] = op([](U32 a, U32 b) { return static_cast<U32>(U64{a} * b >> 32U); });
  t["mul.hi.u64"] = op([](U64 a, U64 b) { return static_cast<U64>(static_cast<U128>(a) * b >> 64U); });
  t["mul.wide.s32"] = op([](I32 a, I32 b) { return static_cast<I64>(a) * b; });
  t["mul.wide.u32"] = op([](U32 a, U32 b) { return U64{a} * b; });
  t["mad.lo.s64"] = op([](U64 a, U64 b, U64 c) { return a * b + c; });
  t["mad.lo.s32"] = op([](U32 a, U32 b, U32 c) { return a * b + c; });
  t["div.s32"] = op([](I32 a, I32 b) { return quotient_of(a, b); });
  t["div.u32"] = op([](U32 a, U32 b) { return unsigned_quotient_of(a, b); });
  t["rem.s32"] =
      op([](I32 a, I32 b) { return static_cast<I32>(static_cast<U32>(a) - static_cast<U32>(quotient_of(a, b)) * static_cast<U32>(b)); });
  t["rem.u32"] = op([](U32 a, U32 b) { return remainder_of(a, b); });
  t["rem.u64"] = op([](U64 a, U64 b) { return remainder_of(a, b); });

  t["cvt.u32.u64"] = op([](U64 a) { return static_cast<U32>(a); });
  t["cvt.u64.u32"] = op([](U32 a) { return U64{a}; });
  t["cvt.u64.u16"] = op([](U16 a) { return U64{a}; });
  t["cvt.u32.u16"] = op([](U16 a) { return U32{a}; });
  t["cvt.u16.u64"] = op([](U64 a) { return static_cast<U16>(a); });
  t["cvt.u16.u32"] = op([](U32 a) { return static_cast<U16>(a); });
  t["cvt.s64.s32"] = op([](I32 a) { return static_cast<I64>(a); });
}

template <class T>
void add_bitwise(Table& t, std::array<std::string_view, 4> names) {
  t[names[0]] = op([](T a, T b) { return static_cast<T>(a & b); });
  t[names[1]] = op([](T a, T b) { return static_cast<T>(a | b); });
  t[names[2]] = op([](T a, T b) { return static_cast<T>(a ^ b); });
  t[names[3]] = op([](T a) { return static_cast<T>(~a); });
}

void add_bits(Table& t) {
  add_bitwise<U16>(t, {"and.b16", "or.b16", "xor.b16", "not.b16"});
  add_bitwise<U32>(t, {"and.b32", "or.b32", "xor.b32", "not.b32"});
  add_bitwise<U64>(t, {"and.b64", "or.b64", "xor.b64", "not.b64"});
  t["and.pred"] = op([](bool a, bool b) { return a && b; });
  t["or.pred"] = op([](bool a, bool b) { return a || b; });
  t["xor.pred"] = op([](bool a, bool b) { return a != b; });
  t["not.pred"] = op([](bool a) { return !a; });
  t["shl.b32"] = op([](U32 a, U32 by) { return shifted_left(a, by); });
  t["shl.b64"] = op([](U64 a, U32 by) { return shifted_left(a, by); });
  t["shr.u32"] = op([](U32 a, U32 by) { return shifted_right(a, by); });
  t["shr.u64"] = op([](U64 a, U32 by) { return shifted_right(a, by); });
  t["shf.l.wrap.b32"] = op([](U32 low, U32 high, U32 by) { return static_cast<U32>((U64{high} << 32U | low) << (by % 32U) >> 32U); });
  t["bfi.b64"] = op([](U64 from, U64 into, U32 position, U32 length) { return inserted(from, into, position, length); });
  t["bfi.b32"] = op([](U32 from, U32 into, U32 position, U32 length) { return static_cast<U32>(inserted(from, into, position, length)); });
  t["bfe.u32"] = op([](U32 from, U32 position, U32 length) { return extracted(from, position, length); });
  t["brev.b32"] = op([](U32 a) { return reversed(a); });
  t["bfind.shiftamt.u32"] = op([](U32 a) { return a == 0 ? ~U32{0} : static_cast<U32>(std::countl_zero(a)); });
  t["popc.b32"] = op([](U32 a) { return static_cast<U32>(std::popcount(a)); });
  t["clz.b64"] = op([](U64 a) { return static_cast<U32>(std::countl_zero(a)); });
}

void add_moves(Table& t) {
  t["mov.pred"] = copies(kFirst, [](bool a) { return a; });
  for (const char* name : {"mov.u16", "mov.b16"}) t[name] = copies(kFirst, [](U16 a) { return a; });
  for (const char* name : {"mov.u32", "mov.b32", "mov.f32"}) t[name] = copies(kFirst, [](U32 a) { return a; });
  for (const char* name : {"mov.u64", "mov.b64", "mov.f64"}) t[name] = copies(kFirst, [](U64 a) { return a; });
  for (const char* name : {"cvta.to.global.u64", "cvta.to.local.u64", "cvta.local.u64"}) t[name] = t["mov.u64"];
  for (const char* name : {"selp.u16", "selp.b16"}) t[name] = copies(kFirst | kSecond, [](U16 a, U16 b, bool p) { return p ? a : b; });
  for (const char* name : {"selp.u32", "selp.s32", "selp.b32", "selp.f32"})
    t[name] = copies(kFirst | kSecond, [](U32 a, U32 b, bool p) { return p ? a : b; });
  for (const char* name : {"selp.u64", "selp.s64", "selp.b64", "selp.f64"})
    t[name] = copies(kFirst | kSecond, [](U64 a, U64 b, bool p) { return p ? a : b; });
}

template <class T>
void add_order(Table& t, std::array<std::string_view, 6> names) {
  t[names[0]] = op([](T a, T b) { return a == b; });
  t[names[1]] = op([](T a, T b) { return a != b; });
  t[names[2]] = op([](T a, T b) { return a < b; });
  t[names[3]] = op([](T a, T b) { return a <= b; });
  t[names[4]] = op([](T a, T b) { return a > b; });
  t[names[5]] = op([](T a, T b) { return a >= b; });
}

/// Comparisons of numbers are false, the others true if an operand is not a number.
template <class T>
void add_float_order(Table& t, std::array<std::string_view, 14> n) {
  add_order<T>(t, {n[0], n[1], n[2], n[3], n[4], n[5]});
  t[n[1]] = op([](T a, T b) { return a < b || a > b; });
  t[n[6]] = op([](T a, T b) { return !(a < b || a > b); });
  t[n[7]] = op([](T a, T b) { return !(a == b); });
  t[n[8]] = op([](T a, T b) { return !(a >= b); });
  t[n[9]] = op([](T a, T b) { return !(a > b); });
  t[n[10]] = op([](T a, T b) { return !(a <= b); });
  t[n[11]] = op([](T a, T b) { return !(a < b); });
  t[n[12]] = op([](T a, T b) { return !std::isnan(a) && !std::isnan(b); });
  t[n[13]] = op([](T a, T b) { return std::isnan(a) || std::isnan(b); });
}

void add_comparisons(Table& t) {
  add_order<U16>(t, {"setp.eq.b16", "setp.ne.b16", "setp.lt.u16", "setp.le.u16", "setp.gt.u16", "setp.ge.u16"});
  add_order<I16>(t, {"setp.eq.s16", "setp.ne.s16", "setp.lt.s16", "setp.le.s16", "setp.gt.s16", "setp.ge.s16"});
  add_order<U32>(t, {"setp.eq.b32", "setp.ne.b32", "setp.lt.u32", "setp.le.u32", "setp.gt.u32", "setp.ge.u32"});
  add_order<I32>(t, {"setp.eq.s32", "setp.ne.s32", "setp.lt.s32", "setp.le.s32", "setp.gt.s32", "setp.ge.s32"});
  add_order<U64>(t, {"setp.eq.b64", "setp.ne.b64", "setp.lt.u64", "setp.le.u64", "setp.gt.u64", "setp.ge.u64"});
  add_order<I64>(t, {"setp.eq.s64", "setp.ne.s64", "setp.lt.s64", "setp.le.s64", "setp.gt.s64", "setp.ge.s64"});
  add_float_order<float>(
      t, {"setp.eq.f32", "setp.ne.f32", "setp.lt.f32", "setp.le.f32", "setp.gt.f32", "setp.ge.f32", "setp.equ.f32", "setp.neu.f32",
          "setp.ltu.f32", "setp.leu.f32", "setp.gtu.f32", "setp.geu.f32", "setp.num.f32", "setp.nan.f32"});
  add_float_order<double>(
      t, {"setp.eq.f64", "setp.ne.f64", "setp.lt.f64", "setp.le.f64", "setp.gt.f64", "setp.ge.f64", "setp.equ.f64", "setp.neu.f64",
          "setp.ltu.f64", "setp.leu.f64", "setp.gtu.f64", "setp.geu.f64", "setp.num.f64", "setp.nan.f64"});
}

void add_control(Table& t) {
  t["ret"] = {[](Lane& lane, const Instruction& /*i*/) { lane.finish(); }, 0, 0};
  t["bar.sync"] = {[](Lane& lane, const Instruction& /*i*/) { lane.wait(Lane::State::AtBarrier); }, 0, 1};
  t["bar.warp.sync"] = {[](Lane& lane, const Instruction& /*i*/) { lane.wait(Lane::State::AtMeeting); }, 0, 1};
  t["activemask.b32"] = {[](Lane& lane, const Instruction& /*i*/) { lane.wait(Lane::State::AtActiveMask); }, 1, 1};
  t["shfl.sync.bfly.b32"] = {[](Lane& lane, const Instruction& /*i*/) { lane.wait(Lane::State::AtButterfly); }, 2, 6, kSecond};
  t["shfl.sync.idx.b32"] = {[](Lane& lane, const Instruction& /*i*/) { lane.wait(Lane::State::AtIndexedShuffle); }, 2, 6, kSecond};
}

Table make_table() {
  Table table;
  add_floats(table);
  add_integers(table);
  add_bits(table);
  add_moves(table);
  add_comparisons(table);
  add_control(table);
  return table;
}

// --- Memory.

using Space = Lane::Space;

template <class T, Space S>
void load(Lane& lane, const Instruction& i) {
  const U64 address = lane.get<U64>(i.slots[1]) + static_cast<U64>(i.offset);
  T value;
  std::memcpy(&value, lane.memory(S, address, sizeof(T), i.aligned), sizeof(T));
  if constexpr (S == Space::Global || S == Space::Generic) lane.reads<T>(address);
  lane.put(i.slots[0], value);
}
template <class T, Space S>
void store(Lane& lane, const Instruction& i) {
  const U64 address = lane.get<U64>(i.slots[0]) + static_cast<U64>(i.offset);
  const T value = lane.get<T>(i.slots[1]);
  std::memcpy(lane.memory(S, address, sizeof(T), i.aligned), &value, sizeof(T));
  if constexpr (S == Space::Global || S == Space::Generic) lane.writes<T>(address, value);
}
template <Space S>
void add_atomically(Lane& lane, const Instruction& i) {
  const U64 address = lane.get<U64>(i.slots[1]) + static_cast<U64>(i.offset);
  std::byte* const memory = lane.memory(S, address, sizeof(U32), i.aligned);
  if constexpr (S == Space::Global) lane.counts_up(address);
  U32 value = 0;
  std::memcpy(&value, memory, sizeof value);
  const U32 sum = value + lane.get<U32>(i.slots[2]);
  std::memcpy(memory, &sum, sizeof sum);
  lane.put(i.slots[0], value);
}

template <class T, Space S>
Access access(bool is_load) {
  if (is_load) return {{load<T, S>, 1, 2}, sizeof(T), 1, true};
  return {{store<T, S>, 0, 2, kFirst}, sizeof(T), 1, false};
}
template <Space S>
std::optional<Access> access_of(std::string_view type, bool is_load) {
  if (type == "u8") return access<std::uint8_t, S>(is_load);
  if (type == "u16") return access<U16, S>(is_load);
  if (type == "u32" || type == "f32" || type == "b32") return access<U32, S>(is_load);
  if (type == "u64" || type == "f64" || type == "b64") return access<U64, S>(is_load);
  return std::nullopt;
}

/// Removes `part` from the beginning of `text`, if it is there.
bool take(std::string_view& text, std::string_view part) {
  if (!text.starts_with(part)) return false;
  text.remove_prefix(part.size());
  return true;
}

}  // namespace

std::optional<Operation> find_operation(std::string_view opcode) {
  static const Table table = make_table();
  const auto found = table.find(opcode);
  if (found == table.end()) return std::nullopt;
  return found->second;
}

std::optional<Access> find_access(std::string_view opcode) {
  if (opcode == "atom.global.add.u32") return Access{{add_atomically<Space::Global>, 1, 3}, sizeof(U32), 1, true};
  if (opcode == "atom.shared.add.u32") return Access{{add_atomically<Space::Shared>, 1, 3}, sizeof(U32), 1, true};
  const bool is_load = take(opcode, "ld.");
  if (!is_load && !take(opcode, "st.")) return std::nullopt;
  Space space = Space::Generic;
  if (take(opcode, "global."))
    space = Space::Global;
  else if (take(opcode, "local."))
    space = Space::Local;
  else if (take(opcode, "shared."))
    space = Space::Shared;
  else if (is_load && take(opcode, "param."))
    space = Space::Parameter;
  std::size_t count = 1;
  if (take(opcode, "v2."))
    count = 2;
  else if (take(opcode, "v4."))
    count = 4;
  std::optional<Access> found;
  if (space == Space::Global) found = access_of<Space::Global>(opcode, is_load);
  if (space == Space::Local) found = access_of<Space::Local>(opcode, is_load);
  if (space == Space::Shared) found = access_of<Space::Shared>(opcode, is_load);
  if (space == Space::Parameter) found = access_of<Space::Parameter>(opcode, is_load);
  if (space == Space::Generic) found = access_of<Space::Generic>(opcode, is_load);
  if (found) found->count = count;
  return found;
}

const Operation kJump{[](Lane& lane, const Instruction& i) { lane.jump(i.offset); }, 0, 0};
const Operation kJumpIf{[](Lane& lane, const Instruction& i) {
                          if (lane.get<bool>(i.slots[0])) lane.jump(i.offset);
                        },
                        0, 1};
const Operation kJumpUnless{[](Lane& lane, const Instruction& i) {
                              if (!lane.get<bool>(i.slots[0])) lane.jump(i.offset);
                            },
                            0, 1};
const Operation kPack = copies(kFirst | kSecond, [](U32 low, U32 high) { return U64{high} << 32U | low; });
const Operation kLowHalf = copies(kFirst, [](U64 a) { return static_cast<U32>(a); });
const Operation kHighHalf = copies(kFirst, [](U64 a) { return static_cast<U32>(a >> 32U); });
const Operation kPackShort = copies(kFirst | kSecond, [](U16 low, U16 high) { return U32{high} << 16U | low; });
const Operation kLowShort = copies(kFirst, [](U32 a) { return static_cast<U16>(a); });
const Operation kHighShort = copies(kFirst, [](U32 a) { return static_cast<U16>(a >> 16U); });

}  // namespace dmoscope::gpu::ptx
