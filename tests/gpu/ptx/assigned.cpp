#include "tests/gpu/ptx/assigned.h"

#include <algorithm>

#include "tests/gpu/ptx/operations.h"

namespace dmoscope::gpu::ptx {

namespace {

using Set = std::vector<std::uint64_t>;  // a bit per slot

void remove(Set& set, Slot slot) { set[slot / 64] &= ~(std::uint64_t{1} << slot % 64); }
void add(Set& set, Slot slot) { set[slot / 64] |= std::uint64_t{1} << slot % 64; }
bool holds(const Set& set, Slot slot) { return (set[slot / 64] >> slot % 64 & 1U) != 0; }
/// Intersects `set` with another; returns whether it became smaller.
bool intersect(Set& set, const Set& other) {
  bool changed = false;
  for (std::size_t i = 0; i < set.size(); ++i) {
    const std::uint64_t both = set[i] & other[i];
    changed = changed || both != set[i];
    set[i] = both;
  }
  return changed;
}

bool is_copied(const Instruction& i, std::size_t operand) { return (i.copied >> operand & 1U) != 0; }
/// Adds the slots that an instruction writes to those written before.
void pass(Set& written, const Instruction& i) {
  bool whole = true;
  for (std::size_t k = i.written; k < i.used; ++k) whole = whole && (!is_copied(i, k) || holds(written, i.slots[k]));
  for (std::size_t k = 0; k < i.written; ++k) add(written, i.slots[k]);
  if (!whole && i.written > 0) remove(written, i.slots[0]);
}

bool is_jump(const Instruction& i) { return i.run == kJump.run || i.run == kJumpIf.run || i.run == kJumpUnless.run; }
bool ends_here(const Instruction& i) { return i.run == kJump.run || i.run == find_operation("ret")->run; }

/// Straight pieces of the code, with the slots that are surely written at the start of each.
class Pieces {
 public:
  explicit Pieces(const Entry& entry) : entry_(entry), piece_of_(entry.code.size() + 1) {
    std::vector<bool> begins(entry.code.size() + 1);
    begins[0] = true;
    for (std::size_t i = 0; i < entry.code.size(); ++i) {
      if (is_jump(entry.code[i])) begins[static_cast<std::size_t>(entry.code[i].offset)] = true;
      if (is_jump(entry.code[i]) || ends_here(entry.code[i])) begins[i + 1] = true;
    }
    for (std::size_t i = 0; i <= entry.code.size(); ++i) {
      if (begins[i]) first_.push_back(i);
      piece_of_[i] = first_.size() - 1;
    }
    const std::size_t words = (entry.initial.size() + 63) / 64;
    written_.assign(first_.size(), Set(words, ~std::uint64_t{0}));  // all, until a path is found that writes less
    std::ranges::fill(written_[0], 0);
    for (Slot slot = 0; slot < entry.initial.size(); ++slot)
      if (slot < kFirstParameter + entry.parameters.size() || entry.initial[slot] != kPoison) add(written_[0], slot);
    reached_.assign(first_.size(), false);
    reached_[0] = true;
  }

  void settle() {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t piece = 0; piece + 1 < first_.size(); ++piece)
        if (reached_[piece]) changed = pass_on(piece) || changed;
    }
  }
  [[nodiscard]] std::optional<std::string> fault() const {
    for (std::size_t piece = 0; piece + 1 < first_.size(); ++piece) {
      if (!reached_[piece]) continue;
      Set written = written_[piece];
      for (std::size_t i = first_[piece]; i < first_[piece + 1]; ++i) {
        const Instruction& instruction = entry_.code[i];
        for (std::size_t k = instruction.written; k < instruction.used; ++k)
          if (!is_copied(instruction, k) && !holds(written, instruction.slots[k])) return entry_.texts[instruction.text];
        pass(written, instruction);
      }
    }
    return std::nullopt;
  }

 private:
  bool pass_on(std::size_t piece) {
    Set written = written_[piece];
    for (std::size_t i = first_[piece]; i < first_[piece + 1]; ++i) pass(written, entry_.code[i]);
    const Instruction& last = entry_.code[first_[piece + 1] - 1];
    bool changed = false;
    if (is_jump(last)) changed = reach(piece_of_[static_cast<std::size_t>(last.offset)], written);
    if (!ends_here(last)) changed = reach(piece + 1, written) || changed;
    return changed;
  }
  bool reach(std::size_t piece, const Set& written) {
    const bool first_time = !reached_[piece];
    reached_[piece] = true;
    return intersect(written_[piece], written) || first_time;
  }

  const Entry& entry_;
  std::vector<std::size_t> first_, piece_of_;
  std::vector<Set> written_;
  std::vector<bool> reached_;
};

}  // namespace

std::optional<std::string> read_before_written(const Entry& entry) {
  Pieces pieces(entry);
  pieces.settle();
  return pieces.fault();
}

}  // namespace dmoscope::gpu::ptx
