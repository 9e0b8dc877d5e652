#include "core/target/target.h"

#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/number_in.h"

namespace dmoscope {

namespace {

using Words = std::vector<std::string_view>;

/// Splits text at separators outside of quotation marks.
Words split(std::string_view text, char separator) {
  Words parts;
  bool quoted = false;
  std::size_t first = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (quoted || text[i] != separator) continue;
    parts.push_back(text.substr(first, i - first));
    first = i + 1;
  }
  parts.push_back(text.substr(first));
  return parts;
}

bool is_quoted(std::string_view name) { return name.size() >= 2 && name.starts_with('"') && name.ends_with('"'); }
std::string unquoted(std::string_view name) { return std::string(is_quoted(name) ? name.substr(1, name.size() - 2) : name); }
/// Name with quotation marks where it would be read as something else.
std::string quoted(const std::string& name) {
  const bool plain =
      name.find_first_of("+:@# ") == std::string::npos && name != "input" && name != "ideal" && name != "field" && name != "aspect";
  return plain ? name : fmt::format("\"{}\"", name);
}

std::optional<double> number_in(std::string_view word) {
  const std::optional<double> value = dmoscope::number_in<double>(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

[[noreturn]] void refuse(std::string_view what, std::string_view why) {
  throw UsageError(fmt::format("'{}' is no target: {}. Targets are {}", what, why, kTargetHelp));
}

TargetShape parse_input(std::string_view text, const Words& words, bool of_group) {
  TargetShape shape{.kind = TargetShape::Kind::Input, .tolerance = of_group ? kKeptTolerance : 0.0};
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i].ends_with('%')) {
      const auto percent = number_in(words[i].substr(0, words[i].size() - 1));
      if (!percent || !(*percent == 0.0 || (*percent >= kLeastTolerance && *percent <= 100.0)))
        refuse(text, fmt::format("a tolerance is {}% to 100%, or 0% for none", kLeastTolerance));
      shape.tolerance = *percent;
    } else {
      const auto rounds = number_in(words[i]);
      if (!rounds || *rounds != std::floor(*rounds) || *rounds < 0.0 || *rounds > 1000.0)
        refuse(text, "after input come rounds of averaging, 0 to 1000, or a tolerance such as 5%");
      shape.rounds = static_cast<int>(*rounds);
    }
  }
  return shape;
}

TargetShape parse_aspect(std::string_view text, const Words& words) {
  TargetShape shape{.kind = TargetShape::Kind::Aspect};
  if (words.size() != 3 && words.size() != 5) refuse(text, "an aspect has a ratio and a direction, by degrees or by x, y and z");
  std::vector<double> numbers;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto number = number_in(words[i]);
    if (!number) refuse(text, fmt::format("'{}' is no number", words[i]));
    numbers.push_back(*number);
  }
  shape.aspect = numbers[0];
  if (!(shape.aspect >= 1.0 && shape.aspect <= 1e6)) refuse(text, "the ratio of an aspect is 1 to 1e6");
  shape.planar = words.size() == 3;
  if (shape.planar) {
    shape.angle = numbers[1];
    const double radians = shape.angle / 180.0 * std::numbers::pi;
    shape.direction = {std::cos(radians), std::sin(radians), 0.0};
  } else {
    shape.direction = {numbers[1], numbers[2], numbers[3]};
    if (!(length(shape.direction) > 0.0 && std::isfinite(length(shape.direction))))
      refuse(text, "the direction of an aspect has no length");
  }
  return shape;
}

/// Reads a shape; none where the text is no shape.
std::optional<TargetShape> parse_shape(std::string_view text, bool of_group) {
  const Words words = split(text, ':');
  if (text == "ideal") return TargetShape{};
  if (words[0] == "input") return parse_input(text, words, of_group);
  if (text == "field") return TargetShape{.kind = TargetShape::Kind::Field};
  if (words[0] == "field" && words.size() > 1 && text.size() > 6)
    return TargetShape{.kind = TargetShape::Kind::Field, .field = unquoted(text.substr(6))};
  if (words[0] == "aspect") return parse_aspect(text, words);
  return std::nullopt;
}

std::string to_text(const TargetShape& shape, bool of_group) {
  switch (shape.kind) {
    case TargetShape::Kind::Input: {
      std::string text = shape.rounds > 0 ? fmt::format("input:{}", shape.rounds) : "input";
      if (shape.tolerance != (of_group ? kKeptTolerance : 0.0)) text += fmt::format(":{}%", shape.tolerance);
      return text;
    }
    case TargetShape::Kind::Field:
      return shape.field.empty() ? "field" : fmt::format("field:{}", quoted(shape.field));
    case TargetShape::Kind::Aspect:
      if (shape.planar) return fmt::format("aspect:{}:{}", shape.aspect, shape.angle);
      return fmt::format("aspect:{}:{}:{}:{}", shape.aspect, shape.direction.x, shape.direction.y, shape.direction.z);
    case TargetShape::Kind::Ideal:
      break;
  }
  return "ideal";
}

}  // namespace

std::string to_text(const Target& target) {
  std::string text;
  for (const Target::OfGroup& one : target.groups)
    text += fmt::format("{}{}:{}", text.empty() ? "" : "+", quoted(one.group), to_text(one.shape, true));
  if (target.groups.empty()) return to_text(target.others, false);
  if (target.others.kind != TargetShape::Kind::Ideal) text.append(1, '+').append(to_text(target.others, false));
  return text;
}

Target parse_target(std::string_view text) {
  Target target;
  bool have_others = false;
  for (const std::string_view piece : split(text, '+')) {
    if (const auto shape = parse_shape(piece, false)) {
      if (have_others) refuse(text, "there are two shapes for the elements of no group");
      target.others = *shape;
      have_others = true;
      continue;
    }
    // Splits at the shape's colon: the group's name may have colons itself.
    bool found = false;
    const std::size_t after = piece.starts_with('"') ? piece.find('"', 1) : 0;
    for (std::size_t colon = piece.find(':', after); colon != std::string_view::npos && !found; colon = piece.find(':', colon + 1)) {
      const auto shape = parse_shape(piece.substr(colon + 1), true);
      if (!shape || colon == 0) continue;
      target.groups.push_back({unquoted(piece.substr(0, colon)), *shape});
      found = true;
    }
    if (!found) refuse(text, fmt::format("'{}' is neither a shape nor GROUP:SHAPE", piece));
  }
  return target;
}

}  // namespace dmoscope
