#include "tests/gpu/ptx/warp.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

namespace dmoscope::gpu::ptx {

namespace {

using State = Lane::State;

bool shuffles(const Lane& lane) { return lane.state() == State::AtButterfly || lane.state() == State::AtIndexedShuffle; }
bool meets(const Lane& lane) { return shuffles(lane) || lane.state() == State::AtMeeting; }
bool is_member(std::uint32_t members, std::size_t lane) { return (members >> lane & 1U) != 0; }
/// The mask of lanes of a shuffle (shfl.sync d|p, a, b, c, members) or of bar.warp.sync members.
std::uint32_t members_of(const Lane& lane) { return lane.get<std::uint32_t>(lane.instruction().slots[shuffles(lane) ? 5 : 0]); }

/// Runs all warps to the end, and to every barrier together.
void run_block(std::vector<Warp>& warps, const Entry& entry, Schedule schedule) {
  for (;;) {
    std::size_t done = 0;
    for (std::size_t i = 0; i < warps.size(); ++i) done += warps[schedule.backwards ? warps.size() - 1 - i : i].run(schedule) ? 1 : 0;
    if (done == warps.size()) return;
    if (done > 0) throw Fault(fmt::format("{}: some of a block are at a barrier, and others are gone", entry.name));
    for (Warp& warp : warps) warp.pass_barrier();
  }
}

}  // namespace

std::uint64_t run_blocks(const Entry& entry, const GlobalMemory& global, const std::vector<std::byte>& parameters, std::size_t blocks,
                         Schedule schedule, std::size_t threads) {
  if (threads == 0 || threads > entry.most_threads)
    throw Fault(fmt::format("{} is not meant for blocks of {} but of up to {}", entry.name, threads, entry.most_threads));
  if (parameters.size() != entry.parameter_bytes)
    throw Fault(fmt::format("{} takes {} bytes of parameters, not {}", entry.name, entry.parameter_bytes, parameters.size()));
  std::vector<Warp> warps((threads + Warp::kSize - 1) / Warp::kSize);
  std::vector<std::byte> shared(entry.shared_bytes);
  const Agent first_agent = schedule.races != nullptr ? schedule.races->first_agent() : 0;
  for (std::size_t k = 0; k < blocks; ++k) {
    const std::size_t block = schedule.backwards ? blocks - 1 - k : k;
    std::ranges::fill(shared, std::byte{0xcd});
    for (std::size_t i = 0; i < warps.size(); ++i) {
      warps[i].start(entry, global, parameters, shared, static_cast<std::uint32_t>(block), static_cast<std::uint32_t>(i * Warp::kSize),
                     threads);
      warps[i].watch_for_races(schedule.races, first_agent + (block * threads + i * Warp::kSize) / entry.team);
    }
    run_block(warps, entry, schedule);
  }
  std::uint64_t instructions = 0;
  for (const Warp& warp : warps) instructions += warp.instructions();
  return instructions;
}

void Warp::start(const Entry& entry, const GlobalMemory& global, const std::vector<std::byte>& parameters, std::span<std::byte> shared,
                 std::uint32_t block, std::uint32_t first, std::size_t threads) {
  entry_ = &entry;
  present_ = std::min(kSize, threads - first);
  for (std::uint32_t i = 0; i < kSize; ++i) {
    lanes_[i].start(entry, global, parameters, shared, block, first + i);
    if (i >= present_) lanes_[i].finish();  // the block has no such lane
  }
}

bool Warp::run(Schedule schedule) {
  const auto all_are = [&](State state) {
    return std::all_of(lanes_.begin(), lanes_.begin() + static_cast<std::ptrdiff_t>(present_),
                       [&](const Lane& lane) { return lane.state() == state; });
  };
  for (;;) {
    for (std::size_t i = 0; i < kSize; ++i) lanes_[schedule.backwards ? kSize - 1 - i : i].run();
    if (all_are(State::Done)) return true;
    if (all_are(State::AtBarrier)) return false;
    try {
      if (exchange() || tell_who_is_active(schedule.together)) continue;
    } catch (const Fault& fault) {
      throw Fault(fmt::format("{}: {}", entry_->name, fault.what()));
    }
    throw Fault(fmt::format("{}: lanes wait for each other for ever", entry_->name));
  }
}

void Warp::watch_for_races(Races* races, Agent first) {
  for (std::size_t i = 0; i < kSize; ++i) lanes_[i].watch_for_races(races, first + i / entry_->team);
}

std::uint64_t Warp::instructions() const {
  std::uint64_t sum = 0;
  for (const Lane& lane : lanes_) sum += lane.instructions();
  return sum;
}

void Warp::pass_barrier() {
  for (std::size_t i = 0; i < present_; ++i) lanes_[i].go_on();
}

bool Warp::has_arrived(std::size_t lane, std::uint32_t members) const {
  if (!is_member(members, lane)) throw Fault("a lane shuffles with others and not with itself");
  for (std::size_t i = 0; i < kSize; ++i) {
    if (!is_member(members, i)) continue;
    if (lanes_[i].state() == State::Done) throw Fault(fmt::format("lane {} shuffles with lane {}, which is gone", lane, i));
    if (!meets(lanes_[i]) || lanes_[i].at() != lanes_[lane].at()) return false;
    if (members_of(lanes_[i]) != members) throw Fault("lanes at one shuffle name different members");
  }
  return true;
}

bool Warp::exchange() {
  bool any = false;
  for (std::size_t i = 0; i < kSize; ++i) {
    if (!meets(lanes_[i])) continue;
    const std::uint32_t members = members_of(lanes_[i]);
    if (!has_arrived(i, members)) continue;
    if (shuffles(lanes_[i])) {
      pass_values(members);
    } else {
      for (std::size_t k = 0; k < kSize; ++k)
        if (is_member(members, k)) lanes_[k].go_on();
    }
    any = true;
  }
  return any;
}

void Warp::pass_values(std::uint32_t members) {
  std::array<std::uint32_t, kSize> values{};
  for (std::size_t i = 0; i < kSize; ++i)
    if (is_member(members, i)) values[i] = lanes_[i].get<std::uint32_t>(lanes_[i].instruction().slots[2]);
  for (std::uint32_t i = 0; i < kSize; ++i) {
    if (!is_member(members, i)) continue;
    Lane& lane = lanes_[i];
    const Instruction& shuffle = lane.instruction();
    const Source source = shuffle_source(lane.state() == State::AtButterfly, i, lane.get<std::uint32_t>(shuffle.slots[3]),
                                         lane.get<std::uint32_t>(shuffle.slots[4]));
    if (!is_member(members, source.lane)) throw Fault("a lane is to get the value of one that is no member");
    lane.put(shuffle.slots[0], values[source.lane]);
    lane.put(shuffle.slots[1], source.within);
    lane.go_on();
  }
}

bool Warp::tell_who_is_active(bool together) {
  for (std::size_t i = 0; i < kSize; ++i) {
    if (lanes_[i].state() != State::AtActiveMask) continue;
    const std::size_t at = lanes_[i].at();
    std::uint32_t active = 0;
    for (std::size_t k = i; k < kSize; ++k)
      if (lanes_[k].state() == State::AtActiveMask && lanes_[k].at() == at && (together || k == i)) active |= 1U << k;
    for (std::size_t k = i; k < kSize; ++k)
      if (is_member(active, k)) {
        lanes_[k].put(lanes_[k].instruction().slots[0], active);
        lanes_[k].go_on();
      }
    return true;
  }
  return false;
}

Source shuffle_source(bool butterfly, std::uint32_t lane, std::uint32_t b, std::uint32_t c) {
  const std::uint32_t by = b & 0x1fU, clamp = c & 0x1fU, segments = c >> 8U & 0x1fU;
  const std::uint32_t first = lane & segments, last = first | (clamp & ~segments);
  const std::uint32_t wanted = butterfly ? lane ^ by : first | (by & ~segments);
  return wanted <= last ? Source{wanted, true} : Source{lane, false};
}

}  // namespace dmoscope::gpu::ptx
