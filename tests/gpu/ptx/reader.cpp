#include "tests/gpu/ptx/reader.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <unordered_map>

#include <fmt/format.h>

#include "gpu/defined/formula_source.h"
#include "tests/gpu/ptx/assigned.h"
#include "tests/gpu/ptx/operations.h"

namespace dmoscope::gpu::ptx {

namespace {

constexpr std::string_view kSpaces = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kSpaces);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpaces) - first + 1);
}

/// Removes and returns the text before `end`, which is removed too. Throws Fault if it does not occur.
std::string_view take_until(std::string_view& text, std::string_view end) {
  const std::size_t at = text.find_first_of(end);
  if (at == std::string_view::npos) throw Fault(fmt::format("PTX breaks off in: {}", text.substr(0, 80)));
  const std::string_view taken = trimmed(text.substr(0, at));
  text.remove_prefix(at + 1);
  return taken;
}

std::string_view take_word(std::string_view& text) {
  text = trimmed(text);
  const std::string_view word = text.substr(0, text.find_first_of(kSpaces));
  text = trimmed(text.substr(word.size()));
  return word;
}

std::string without_comments(std::string_view text) {
  std::string kept;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    kept += line.substr(0, line.find("//"));
    kept += '\n';
  }
  return kept;
}

template <class T>
T number(std::string_view text, int base = 10) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc{} || end != text.data() + text.size()) throw Fault(fmt::format("no number: {}", text));
  return value;
}

/// Splits operands, without spaces; commas in braces do not separate them.
std::vector<std::string> operands_of(std::string_view text) {
  std::vector<std::string> operands;
  int depth = 0;
  for (const char c : text) {
    if (kSpaces.find(c) != std::string_view::npos) continue;
    if (operands.empty()) operands.emplace_back();
    depth += c == '{' ? 1 : c == '}' ? -1 : 0;
    if (c == ',' && depth == 0)
      operands.emplace_back();
    else
      operands.back() += c;
  }
  return operands;
}
/// Splits "{a,b}" into a and b; "a" is a alone.
std::vector<std::string> members_of(std::string_view operand) {
  if (!operand.starts_with('{')) return {std::string(operand)};
  return operands_of(operand.substr(1, operand.size() - 2));
}

class Decoder {
 public:
  explicit Decoder(const EntryText& source) {
    entry_.name = source.name;
    const auto is_of = [this](const char* word) { return entry_.name.find(word) != std::string::npos; };
    entry_.team = is_of("CudaTeam") ? 8 : is_of("4Warp") || is_of(kFormulaKernel) ? 32 : 1;  // see gpu/cuda_team.cuh, gpu/defined/warp.h
    slots_ = {{"%tid.x", kThread}, {"%ctaid.x", kBlock}};
    entry_.initial.assign(kFirstParameter, kPoison);
    std::string_view text = source.text;
    read_head(text);
    for (const std::string& declaration : source.shared)
      if (source.text.find(shared_name(declaration)) != std::string::npos) add_shared(declaration);
    read_body(text);
  }
  [[nodiscard]] Entry finish() {
    for (const auto& [at, label] : jumps_) {
      const auto found = labels_.find(label);
      if (found == labels_.end()) throw Fault(fmt::format("{}: no label {}", entry_.name, label));
      entry_.code[at].offset = static_cast<std::int64_t>(found->second);
    }
    if (entry_.code.empty() || (entry_.code.back().run != kJump.run && entry_.code.back().run != find_operation("ret")->run))
      throw Fault(fmt::format("{} runs on beyond its end", entry_.name));
    if (const auto instruction = read_before_written(entry_))
      throw Fault(fmt::format("{}: {}: may compute with what was not written", entry_.name, *instruction));
    put_registers_last();
    return std::move(entry_);
  }

 private:
  void read_head(std::string_view& text) {
    (void)take_until(text, "(");
    std::string_view parameters = take_until(text, ")");
    while (!parameters.empty()) {
      const std::size_t end = std::min(parameters.find(','), parameters.size());
      add_parameter(parameters.substr(0, end));
      parameters.remove_prefix(std::min(parameters.size(), end + 1));
    }
    std::string_view directives = take_until(text, "{");
    while (!directives.empty()) {
      const std::string_view directive = trimmed(directives.substr(0, directives.find('\n')));
      directives = trimmed(directives.substr(std::min(directives.size(), directives.find('\n'))));
      constexpr std::string_view kMost = ".maxntid ";
      if (directive.starts_with(kMost))
        entry_.most_threads = number<std::size_t>(directive.substr(kMost.size(), directive.find(',') - kMost.size()));
      else if (!directive.starts_with(".minnctapersm "))
        throw Fault(fmt::format("not known of {}: {}", entry_.name, directive));
    }
  }
  /// Adds a parameter: ".param .align 8 .b8 NAME[424]", ".param .u64 NAME" or ".param .u64 .ptr .align 1 NAME".
  void add_parameter(std::string_view text) {
    std::string_view rest = text;
    std::size_t bytes = 8, align = 8;
    if (take_word(rest) != ".param") throw Fault(fmt::format("no parameter: {}", text));
    std::string_view type = take_word(rest);
    if (type == ".align") {
      align = number<std::size_t>(take_word(rest));
      type = take_word(rest);
    }
    if (rest.starts_with(".ptr ")) {  // properties of the pointer are skipped
      (void)take_word(rest);
      if (take_word(rest) == ".align") (void)number<std::size_t>(take_word(rest));
    }
    std::string_view name = rest;
    if (type == ".b8" && name.ends_with(']')) {
      name = rest.substr(0, rest.find('['));
      bytes = number<std::size_t>(rest.substr(name.size() + 1, rest.size() - name.size() - 2));
    } else if (type != ".u64") {
      throw Fault(fmt::format("a parameter of an unknown type: {}", text));
    }
    const std::size_t at = (entry_.parameter_bytes + align - 1) / align * align;
    slots_[std::string(name)] = static_cast<Slot>(entry_.initial.size());
    entry_.initial.push_back(kPoison);
    entry_.parameters.push_back(at);
    entry_.parameter_sizes.push_back(bytes);
    entry_.parameter_bytes = at + bytes;
  }

  void read_body(std::string_view text) {
    for (int depth = 1; depth > 0;) {
      text = trimmed(text);
      if (text.starts_with('{') || text.starts_with('}')) {
        depth += text[0] == '{' ? 1 : -1;
        text.remove_prefix(1);
      } else if (text.starts_with('$')) {
        labels_[std::string(take_until(text, ":"))] = entry_.code.size();
      } else {
        read_statement(take_until(text, ";"));
      }
    }
    if (!trimmed(text).empty()) throw Fault(fmt::format("after the end of {}: {}", entry_.name, text));
  }

  void read_statement(std::string_view statement) {
    if (statement.starts_with(".reg ") || statement.starts_with(".pragma ")) return;
    if (statement.starts_with(".local ")) return add_local(statement);
    if (statement.starts_with(".shared ")) return add_shared(statement);
    entry_.texts.emplace_back(statement);
    try {
      read_instruction(statement);
    } catch (const Fault& fault) {
      throw Fault(fmt::format("{}: {}: {}", entry_.name, statement, fault.what()));
    }
  }
  /// Adds local memory: ".local .align 8 .b8 NAME[16]", the only declaration.
  void add_local(std::string_view text) {
    const std::size_t open = text.find('['), name = text.find("__local_depot");
    if (entry_.local_bytes != 0 || open == std::string_view::npos || name == std::string_view::npos || !text.ends_with(']'))
      throw Fault(fmt::format("{}: {}: not the one local memory", entry_.name, text));
    slots_[std::string(text.substr(name, open - name))] = kLocal;
    entry_.local_bytes = number<std::size_t>(text.substr(open + 1, text.size() - open - 2));
  }

  static std::string_view shared_name(std::string_view declaration) {
    const std::string_view named = declaration.substr(0, declaration.find('['));
    return named.substr(named.find_last_of(kSpaces) + 1);
  }
  /// Adds shared memory: ".shared .align 4 .b8 NAME[268]".
  void add_shared(std::string_view text) {
    std::string_view rest = text;
    (void)take_word(rest);
    if (take_word(rest) != ".align") throw Fault(fmt::format("{}: {}: not known", entry_.name, text));
    const auto align = number<std::size_t>(take_word(rest));
    const std::size_t open = rest.find('[');
    if (take_word(rest) != ".b8" || open == std::string_view::npos || !rest.ends_with(']'))
      throw Fault(fmt::format("{}: {}: not known", entry_.name, text));
    const std::string_view name = rest.substr(0, rest.find('['));
    const std::size_t at = (entry_.shared_bytes + align - 1) / align * align;
    slots_[std::string(name)] = static_cast<Slot>(entry_.initial.size());
    entry_.initial.push_back(kSharedBase + at);
    entry_.shared_bytes = at + number<std::size_t>(rest.substr(name.size() + 1, rest.size() - name.size() - 2));
  }

  void read_instruction(std::string_view text) {
    std::string_view rest = text;
    if (text.starts_with('@')) {
      const std::string_view guard = take_word(rest);
      const bool unless = guard.starts_with("@!");
      if (!rest.starts_with("bra")) throw Fault("only jumps may have a condition");
      (void)take_word(rest);
      jumps_.emplace_back(entry_.code.size(), rest);
      emit(unless ? kJumpUnless : kJumpIf, {slot_of(guard.substr(unless ? 2 : 1))});
      return;
    }
    const std::string_view opcode = take_word(rest);
    const std::vector<std::string> operands = operands_of(rest);
    if (opcode == "bra" || opcode == "bra.uni") {
      jumps_.emplace_back(entry_.code.size(), rest);
      emit(kJump, {});
    } else if (const auto access = find_access(opcode)) {
      read_access(*access, operands);
    } else if ((opcode == "mov.b64" || opcode == "mov.b32") && operands.size() == 2 && (operands[0][0] == '{' || operands[1][0] == '{')) {
      read_halves(operands, opcode == "mov.b64");
    } else if (const auto operation = find_operation(opcode)) {
      read_plain(*operation, operands);
    } else {
      throw Fault("not known");
    }
  }

  void read_plain(const Operation& operation, const std::vector<std::string>& operands) {
    std::vector<Slot> slots;
    for (const std::string& operand : operands) {
      const std::size_t bar = operand.find('|');
      slots.push_back(slot_of(operand.substr(0, bar)));
      if (bar != std::string::npos) slots.push_back(slot_of(operand.substr(bar + 1)));
    }
    emit(operation, slots);
  }
  void read_halves(const std::vector<std::string>& operands, bool wide) {
    const auto to = members_of(operands[0]), from = members_of(operands[1]);
    if (to.size() == 1 && from.size() == 2) {
      emit(wide ? kPack : kPackShort, {slot_of(to[0]), slot_of(from[0]), slot_of(from[1])});
    } else if (to.size() == 2 && from.size() == 1) {
      emit(wide ? kLowHalf : kLowShort, {slot_of(to[0]), slot_of(from[0])});
      emit(wide ? kHighHalf : kHighShort, {slot_of(to[1]), slot_of(from[0])});
    } else {
      throw Fault("not known");
    }
  }
  void read_access(const Access& access, const std::vector<std::string>& operands) {
    const std::size_t where = access.is_load ? 1 : 0;
    if (operands.size() < 2) throw Fault("not known");
    std::string_view address = operands[where];
    if (!address.starts_with('[') || !address.ends_with(']')) throw Fault("no address");
    address = address.substr(1, address.size() - 2);
    const std::size_t plus = std::min(address.find('+'), address.size());
    const Slot base = slot_of(address.substr(0, plus));
    const std::int64_t offset = plus < address.size() ? number<std::int64_t>(address.substr(plus + 1)) : 0;
    const auto values = members_of(operands[1 - where]);
    if (values.size() != access.count) throw Fault("not as many values as it says");
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Slot value = slot_of(values[i]);
      if (access.is_load && value == base && i + 1 < values.size()) throw Fault("overwrites its address");
      std::vector<Slot> slots{value, base};
      if (!access.is_load) std::swap(slots[0], slots[1]);
      for (std::size_t k = 2; k < operands.size(); ++k) slots.push_back(slot_of(operands[k]));
      emit(access.operation, slots);
      Instruction& instruction = entry_.code.back();
      instruction.offset = offset + static_cast<std::int64_t>(i * access.size);
      instruction.aligned = static_cast<std::uint8_t>(i == 0 ? access.size * access.count : access.size);
    }
  }

  void emit(const Operation& operation, const std::vector<Slot>& slots) {
    if (slots.size() != operation.used) throw Fault(fmt::format("{} operands, not {}", slots.size(), operation.used));
    Instruction instruction;
    instruction.run = operation.run;
    instruction.written = operation.written;
    instruction.used = operation.used;
    instruction.copied = operation.copied;
    instruction.text = static_cast<std::uint32_t>(entry_.texts.size() - 1);
    std::ranges::copy(slots, instruction.slots.begin());
    for (std::size_t i = 0; i < operation.written; ++i)
      if (slots[i] < kFirstParameter || entry_.initial[slots[i]] != kPoison) throw Fault("writes what is no register");
    entry_.code.push_back(instruction);
  }

  /// Puts the registers last, so that a lane begins with a copy of the other slots alone: a kernel has some 100,000 registers, of which a
  /// small launch writes few.
  void put_registers_last() {
    const std::size_t given = kFirstParameter + entry_.parameters.size();
    const auto is_register = [&](Slot slot) { return slot >= given && entry_.initial[slot] == kPoison; };
    std::vector<Slot> order(entry_.initial.size()), place(order.size());
    std::iota(order.begin(), order.end(), Slot{0});
    const auto registers = std::stable_partition(order.begin(), order.end(), [&](Slot slot) { return !is_register(slot); });
    std::vector<std::uint64_t> initial;
    for (auto slot = order.begin(); slot != registers; ++slot) initial.push_back(entry_.initial[*slot]);
    for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<Slot>(i);
    for (Instruction& instruction : entry_.code)
      for (std::size_t i = 0; i < instruction.used; ++i) instruction.slots[i] = place[instruction.slots[i]];
    entry_.initial = std::move(initial);
    entry_.slot_count = order.size();
  }

  Slot slot_of(std::string_view operand) {
    const auto [place, is_new] = slots_.try_emplace(std::string(operand), static_cast<Slot>(entry_.initial.size()));
    if (is_new) entry_.initial.push_back(operand.starts_with('%') ? register_of(operand) : constant(operand));
    return place->second;
  }
  static std::uint64_t register_of(std::string_view name) {
    if (name.find('.') != std::string_view::npos) throw Fault(fmt::format("a special register that is not known: {}", name));
    return kPoison;
  }
  static std::uint64_t constant(std::string_view text) {
    if (text.starts_with("0f") || text.starts_with("0d")) return number<std::uint64_t>(text.substr(2), 16);
    if (text.starts_with('-')) return static_cast<std::uint64_t>(number<std::int64_t>(text));
    return number<std::uint64_t>(text);
  }

  Entry entry_;
  std::unordered_map<std::string, Slot> slots_;
  std::unordered_map<std::string, std::size_t> labels_;
  std::vector<std::pair<std::size_t, std::string>> jumps_;
};

}  // namespace

std::vector<EntryText> find_entries(std::string_view ptx) {
  const std::string kept = without_comments(ptx);
  std::vector<EntryText> entries;
  std::vector<std::string> shared, globals;
  for (std::string_view text = trimmed(kept); !text.empty(); text = trimmed(text)) {
    if (text.starts_with(".version ") || text.starts_with(".target ") || text.starts_with(".address_size ")) {
      (void)take_until(text, "\n");
    } else if (text.starts_with(".visible .entry ") || text.starts_with(".entry ")) {
      const std::string_view rest = text.substr(text.find(".entry ") + std::string_view(".entry ").size());
      const std::size_t end = text.find("\n}");  // braces of inner blocks are indented, or not first on a line
      if (end == std::string_view::npos) throw Fault("PTX breaks off in an entry");
      entries.push_back({std::string(trimmed(rest.substr(0, rest.find('(')))), std::string(text.substr(0, end + 2)), shared});
      text.remove_prefix(end + 2);
    } else if (text.starts_with(".shared ")) {  // memory of a function that several kernels have
      shared.emplace_back(take_until(text, ";"));
    } else if (text.starts_with(".global ")) {
      std::string_view named = take_until(text, ";");
      named = trimmed(named.substr(0, named.find_first_of("=[")));
      globals.emplace_back(named.substr(named.find_last_of(kSpaces) + 1));
    } else {
      throw Fault(fmt::format("not known in PTX: {}", text.substr(0, std::min<std::size_t>(text.find('\n'), 200))));
    }
  }
  // Constants that the compiler wrote down, although it put their values into the code.
  for (const std::string& global : globals)
    for (const EntryText& entry : entries)
      if (entry.text.find(global) != std::string::npos) throw Fault(fmt::format("{} reads {}", entry.name, global));
  return entries;
}

Entry decode(const EntryText& entry) { return Decoder(entry).finish(); }

}  // namespace dmoscope::gpu::ptx
