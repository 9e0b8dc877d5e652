#include "core/smooth/composite_objective.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/base/number_in.h"
#include "core/quality/metric_phrase.h"
#include "core/smooth/place_aim.h"

namespace dmoscope {

namespace {

constexpr std::string_view kOff = "off", kInput = "input";  // words of guards
constexpr std::string_view kSizes = "h1:X,Y (the distance to a point), h2:X,Y (its inverse), constant, or field:NAME";

/// Names of all second aims that are no metrics.
std::string place_names() {
  std::vector<std::string_view> names;
  for (const PlaceAimInfo& one : place_aims()) names.push_back(one.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

[[noreturn]] void refuse_size(std::string_view text) { throw UsageError(fmt::format("'{}' is no size function: it is {}", text, kSizes)); }

bool read_number(std::string_view word, double& value) {
  value = number_in<double>(word).value_or(std::numeric_limits<double>::infinity());
  return std::isfinite(value);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t at = text.find(separator); at != std::string_view::npos; at = text.find(separator)) {
    parts.push_back(text.substr(0, at));
    text.remove_prefix(at + 1);
  }
  parts.push_back(text);
  return parts;
}

Vec3 parse_point(std::string_view coordinates, std::string_view text) {
  const auto words = split(coordinates, ',');
  double values[3]{};
  if (words.size() < 2 || words.size() > 3) refuse_size(text);
  for (std::size_t i = 0; i < words.size(); ++i)
    if (!read_number(words[i], values[i])) refuse_size(text);
  return {values[0], values[1], values[2]};
}

constexpr std::array<std::string_view, 4> kSizeNames{"h1", "h2", "constant", "field"};  // in the order of SizeFunction::Kind
std::string_view short_name(SizeFunction::Kind kind) { return kSizeNames[static_cast<std::size_t>(kind)]; }

bool is_second(std::string_view text) {
  if (find_place_aim(text) != nullptr) return true;
  try {
    (void)parse_metric(text);
    return true;
  } catch (const UsageError&) {
    return false;
  }
}

/// Splits a combination into FIRST, THRESHOLD and SECOND. Formulas and targets have colons and numbers of their own: the threshold is the
/// first number between two that have metrics on both sides.
std::array<std::string_view, 3> parts_of_combination(std::string_view text) {
  const auto words = split(text, ':');
  if (words.size() == 3) return {words[0], words[1], words[2]};
  std::size_t first = words[0].size();
  for (std::size_t i = 1; i + 1 < words.size(); first += 1 + words[i++].size()) {
    double value = 0.0;
    if (!read_number(words[i], value)) continue;
    const std::array<std::string_view, 3> parts{text.substr(0, first), words[i], text.substr(first + 2 + words[i].size())};
    if (is_second(parts[2]) && find_place_aim(parts[0]) == nullptr && is_second(parts[0])) return parts;
  }
  throw UsageError(fmt::format("'{}' is no combination: it is FIRST:THRESHOLD:SECOND, such as mean-ratio:0.7:density", text));
}

}  // namespace

std::string to_text(const SizeFunction& size) {
  const std::string_view kind = short_name(size.kind);
  if (size.kind == SizeFunction::Kind::Field) return fmt::format("{}:{}", kind, size.field);
  if (!size.has_point()) return std::string(kind);
  const auto& [x, y, z] = size.point;
  return z == 0.0 ? fmt::format("{}:{},{}", kind, x, y) : fmt::format("{}:{},{},{}", kind, x, y, z);
}

SizeFunction parse_size_function(std::string_view text) {
  const std::size_t colon = text.find(':');
  const std::string_view kind = text.substr(0, colon);
  const std::string_view rest = colon == std::string_view::npos ? std::string_view{} : text.substr(colon + 1);
  using Kind = SizeFunction::Kind;
  if (text == "constant") return {};
  if (kind == "h1") return {Kind::Distance, parse_point(rest, text), {}};
  if (kind == "h2") return {Kind::InverseDistance, parse_point(rest, text), {}};
  if (kind == "field" && !rest.empty()) return {Kind::Field, {}, std::string(rest)};
  refuse_size(text);
}

std::string to_text(Metric first, const CompositeTerms& combination) {
  return fmt::format("{}:{}:{}", info(first).name, combination.threshold, combination.second_name());
}

std::string_view CompositeTerms::second_name() const {
  const auto* metric = std::get_if<Metric>(&second);
  return metric != nullptr ? info(*metric).name : place;
}

std::string CompositeTerms::size_text() const {
  return size() != nullptr && find_place_aim(place)->sized ? to_text(*size()) : std::string();
}

std::pair<Metric, CompositeTerms> parse_composite(std::string_view text, std::string_view size) {
  CompositeTerms combination;
  const auto parts = parts_of_combination(text);
  if (!read_number(parts[1], combination.threshold)) throw UsageError(fmt::format("the threshold '{}' is no number", parts[1]));
  const Metric first = parse_metric(parts[0]);
  const PlaceAimInfo* place = find_place_aim(parts[2]);
  if (!size.empty() && (place == nullptr || !place->sized))
    throw UsageError(fmt::format("a size function is for density alone, not for {}", parts[2]));
  if (place != nullptr) {
    combination.place = place->name;
    if (!size.empty()) combination.second = parse_size_function(size);
  } else {
    try {
      combination.second = parse_metric(parts[2]);
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("{}; or {}", error.what(), place_names()));
    }
  }
  validate(first, combination);
  return {first, std::move(combination)};
}

std::string phrase(Metric first, const CompositeTerms& combination) {
  const std::string start = fmt::format("{} > {}", metric_phrase(first), combination.threshold);
  const SizeFunction* size = combination.size();
  if (size == nullptr) return fmt::format("{} · {}", start, metric_phrase(std::get<Metric>(combination.second)));
  const std::string_view sizes = size->kind == SizeFunction::Kind::Field ? size->field : short_name(size->kind);
  const bool sized = !combination.size_text().empty();
  return fmt::format("{} · {}{}{}", start, combination.place, sized ? " " : "", sized ? sizes : "");
}

void validate(Metric first, const CompositeTerms& combination) {
  if (!(combination.threshold > 0.0 && combination.threshold < 1.0))
    throw UsageError(fmt::format("the threshold of a combination must be above 0 and below 1, not {}", combination.threshold));
  if (const auto* second = std::get_if<Metric>(&combination.second); second != nullptr && *second == first)
    throw UsageError(fmt::format("{0} cannot be combined with itself: beyond the threshold another metric counts, or {1}", info(first).name,
                                 place_names()));
  if (const SizeFunction* size = combination.size();
      size != nullptr && !(std::isfinite(size->point.x) && std::isfinite(size->point.y) && std::isfinite(size->point.z)))
    throw UsageError("the point of a size function must be finite");
}

std::string to_text(const std::optional<GuardRule>& rule) {
  if (!rule) return std::string(kOff);
  return fmt::format("{}:{}", info(rule->metric).name, rule->floor ? fmt::format("{}", *rule->floor) : std::string(kInput));
}

std::optional<GuardRule> parse_guard(std::string_view text) {
  if (text == kOff) return std::nullopt;
  const std::size_t colon = text.rfind(':');  // formulas have colons of their own
  const std::string_view word = colon == std::string_view::npos ? std::string_view{} : text.substr(colon + 1);
  const std::optional<double> floor = number_in<double>(word);
  if (word != kInput && !(floor && std::isfinite(*floor)))
    throw UsageError(fmt::format("'{}' is no guard: it is METRIC:input, METRIC:VALUE, such as mean-ratio:0.2, or off", text));
  return GuardRule{parse_metric(text.substr(0, colon)), floor};
}

}  // namespace dmoscope
