#pragma once
// One thread of a kernel, and the instructions that it runs.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/gpu/ptx/memory.h"
#include "tests/gpu/ptx/races.h"

namespace dmoscope::gpu::ptx {

/// Number of an operand: registers, constants and the special registers all have a slot.
using Slot = std::uint32_t;
inline constexpr Slot kThread = 0, kBlock = 1, kLocal = 2, kFirstParameter = 3;

struct Instruction;
class Lane;
/// Does one instruction; the lane already stands at the next.
using Handler = void (*)(Lane& lane, const Instruction& instruction);

struct Instruction {
  Handler run = nullptr;
  std::int64_t offset = 0;             // added to an address; target of a branch
  std::array<Slot, 6> slots{};         // slots that are written, then those that are read
  std::uint8_t written = 0, used = 0;  // their numbers
  std::uint8_t copied = 0;             // a bit for each that is not computed with, but copied to the first slot or to memory
  std::uint8_t aligned = 1;            // required alignment of an address
  std::uint32_t text = 0;              // index into Entry::texts
};

/// A kernel, decoded.
struct Entry {
  std::string name;  // mangled
  std::vector<Instruction> code;
  std::vector<std::string> texts;
  std::vector<std::uint64_t> initial;   // values of the first slots: special registers and parameters, which are kPoison, then constants
  std::size_t slot_count = 0;           // including the registers, which come last
  std::vector<std::size_t> parameters;  // their offsets in the block of parameters
  std::vector<std::size_t> parameter_sizes;
  std::size_t parameter_bytes = 0, local_bytes = 0, shared_bytes = 0;
  std::size_t most_threads = 1024;  // limit of a block
  std::size_t team = 1;             // number of lanes that work together
};
/// Start of a block's shared memory; addresses below it are invalid.
inline constexpr std::uintptr_t kSharedBase = 256;
inline constexpr std::uint64_t kPoison = 0x7ff4cdcd7fa4cdcd;  // not a number, in both formats

class Lane {
 public:
  enum class State { Running, AtButterfly, AtIndexedShuffle, AtActiveMask, AtBarrier, AtMeeting, Done };

  /// Begins a kernel. `parameters`: in the entry's layout. `shared`: the block's memory, of the entry's size. See also watch_for_races().
  void start(const Entry& entry, const GlobalMemory& global, const std::vector<std::byte>& parameters, std::span<std::byte> shared,
             std::uint32_t block, std::uint32_t thread);
  /// Sets the detector of races; null: none.
  void watch_for_races(Races* races, Agent agent) noexcept {
    races_ = races;
    agent_ = agent;
  }
  /// Runs until the lane is done or waits for others.
  void run();

  [[nodiscard]] State state() const noexcept { return state_; }
  /// Number of instructions so far, in all kernels of this lane.
  [[nodiscard]] std::uint64_t instructions() const noexcept { return instructions_; }
  void wait(State why) noexcept {
    state_ = why;
    --at_;
  }
  void finish() noexcept { state_ = State::Done; }
  /// Continues after the instruction that it waited at.
  void go_on() noexcept {
    state_ = State::Running;
    ++at_;
  }
  void jump(std::int64_t to) {
    if (--jumps_left_ == 0) throw Fault("the lane comes to no end");
    at_ = static_cast<std::size_t>(to);
  }
  [[nodiscard]] std::size_t at() const noexcept { return at_; }
  [[nodiscard]] const Instruction& instruction() const { return entry_->code[at_]; }

  /// The low bits of a slot.
  template <class T>
  [[nodiscard]] T get(Slot slot) const {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= 8);
    if constexpr (std::is_same_v<T, bool>) {
      return slots_[slot] != 0;
    } else {
      T value;
      std::memcpy(&value, &slots_[slot], sizeof(T));
      return value;
    }
  }
  /// Sets the low bits of a slot; the higher bits become zero.
  template <class T>
  void put(Slot slot, T value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof(T));
    slots_[slot] = bits;
  }

  enum class Space { Global, Local, Shared, Parameter, Generic };
  /// Returns memory that the lane accesses. Throws Fault if the lane has none there, or if the address is not a multiple of `aligned`.
  [[nodiscard]] std::byte* memory(Space space, std::uintptr_t address, std::size_t size, std::size_t aligned) const;
  /// Notes an access to memory. Throws Fault if it conflicts with another lane of the launch.
  template <class T>
  void reads(std::uintptr_t address) const {
    if (is_watched(address))
      for (std::size_t at = 0; at < sizeof(T); at += kWord) races_->read(address + at, agent_);
  }
  template <class T>
  void writes(std::uintptr_t address, T value) const {
    if (is_watched(address))
      for (std::size_t at = 0; at < sizeof(T); at += kWord) races_->write(address + at, agent_, std::uint64_t{value} >> (8 * at));
  }
  void counts_up(std::uintptr_t address) const {
    if (is_watched(address)) races_->count_up(address, agent_);
  }

 private:
  static constexpr std::size_t kWord = 4;
  /// Whether accesses are checked for races: local memory is not shared, and parameters are not written.
  [[nodiscard]] bool is_watched(std::uintptr_t address) const {
    return races_ != nullptr && !local_.holds(address, 1) && global_->holds(address, 1);
  }

  const Entry* entry_ = nullptr;
  const GlobalMemory* global_ = nullptr;
  std::unique_ptr<std::uint64_t[]> slots_;  // uninitialised, for no register is read before it is written (see assigned.h)
  std::vector<std::max_align_t> local_memory_;
  Extent local_, parameters_;
  std::span<std::byte> shared_;
  std::size_t at_ = 0;
  std::uint64_t jumps_left_ = 0;
  std::uint64_t instructions_ = 0;
  State state_ = State::Done;
  Races* races_ = nullptr;
  Agent agent_ = 0;
};

}  // namespace dmoscope::gpu::ptx
