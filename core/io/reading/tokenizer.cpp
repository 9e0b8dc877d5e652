#include "core/io/reading/tokenizer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace dmoscope {
namespace {

constexpr std::size_t kReportEvery = std::size_t{1} << 20;  // interval in bytes

/// Whether a decimal number beyond the range of double is too small (rather than too large), by the place of its first digit.
bool is_tiny(std::string_view number) {
  std::int64_t exponent = 0;  // power of ten of the first digit that is not 0
  bool point = false;
  bool leading = true;
  std::size_t i = 0;
  for (; i < number.size() && number[i] != 'e' && number[i] != 'E'; ++i) {
    const char c = number[i];
    if (c == '.') {
      point = true;
    } else if (c >= '0' && c <= '9') {
      if (leading && c == '0') {
        if (point) --exponent;
      } else if (leading) {
        leading = false;
        if (point) --exponent;
      } else if (!point) {
        ++exponent;
      }
    }
  }
  if (i + 1 >= number.size()) return exponent < 0;
  const bool negative = number[i + 1] == '-';
  const std::size_t digits = i + ((negative || number[i + 1] == '+') ? 2 : 1);
  std::int64_t power = 0;
  const auto result = std::from_chars(number.data() + digits, number.data() + number.size(), power);
  if (result.ec != std::errc()) return negative;  // the exponent has more than 18 digits
  return exponent + (negative ? -power : power) < 0;
}

/// The nearest double of a plain decimal number; infinite if it is too large; none if it is no number.
std::optional<double> plain_double(std::string_view number) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (end != number.data() + number.size() || number.empty()) return std::nullopt;
  if (error == std::errc()) return value;
  if (error != std::errc::result_out_of_range) return std::nullopt;
  const double sign = number.front() == '-' ? -1.0 : 1.0;
  return is_tiny(number) ? std::copysign(0.0, sign) : std::copysign(HUGE_VAL, sign);
}

/// The nearest double of a number in other spellings: a leading +, Fortran's D exponent.
std::optional<double> foreign_double(std::string_view token) {
  std::string number(token);
  if (number.size() > 1 && number[0] == '+' && number[1] != '-' && number[1] != '+') number.erase(0, 1);
  for (char& c : number) {
    if (c == 'd' || c == 'D') c = 'e';
  }
  return plain_double(number);
}

bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }

/// Parses a number of few digits without an exponent: digits and power of ten are both exact doubles, so one division rounds to the nearest
/// double. Returns its end; null if it is no such number.
const char* short_decimal(const char* at, const char* end, double& value) noexcept {
  constexpr std::array<double, 20> kPowers{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,
                                           1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19};
  constexpr std::uint64_t kExact = std::uint64_t{1} << 53U;
  const bool negative = at != end && *at == '-';
  if (negative) ++at;
  std::uint64_t digits = 0;
  const char* const first = at;
  for (; at != end && is_digit(*at); ++at) digits = 10 * digits + static_cast<std::uint64_t>(*at - '0');
  auto count = static_cast<std::size_t>(at - first);
  std::size_t behind_point = 0;
  if (at != end && *at == '.') {
    const char* const point = ++at;
    for (; at != end && is_digit(*at); ++at) digits = 10 * digits + static_cast<std::uint64_t>(*at - '0');
    behind_point = static_cast<std::size_t>(at - point);
    count += behind_point;
  }
  if (count == 0 || count >= kPowers.size() || digits > kExact || (at != end && (*at == 'e' || *at == 'E'))) return nullptr;
  const double size = static_cast<double>(digits) / kPowers[behind_point];
  value = negative ? -size : size;
  return at;
}

}  // namespace

Tokenizer::Tokenizer(std::string_view text, std::string file, TextSyntax syntax, Progress& progress)
    : text_(text), file_(std::move(file)), syntax_(syntax), progress_(&progress) {
  for (const char c : {' ', '\t', '\v', '\f'}) kind_[static_cast<unsigned char>(c)] = kBlank;
  for (const char c : {'\n', '\r'}) kind_[static_cast<unsigned char>(c)] = kLineEnd;
  if (syntax.comment != '\0') kind_[static_cast<unsigned char>(syntax.comment)] = kComment;
  if (syntax.comma_is_blank) kind_[static_cast<unsigned char>(',')] = kBlank;
  if (syntax.backslash_joins_lines) kind_[static_cast<unsigned char>('\\')] = kJoin;
}

void Tokenizer::report() {
  next_report_ = position_ + kReportEvery;
  progress_->check();
  progress_->set(static_cast<double>(position_) / static_cast<double>(text_.size() + 1));
}

std::string_view Tokenizer::rest_of_line() {
  if (position_ >= next_report_) report();
  const std::size_t begin = position_;
  std::size_t end = begin;
  for (;;) {
    skip_to_line_end();
    end = position_;
    if (position_ == text_.size()) break;
    step_over_line_end();
    if (end == begin || kind_[byte(end - 1)] != kJoin) break;
  }
  return text_.substr(begin, end - begin);
}

void Tokenizer::end_line_of(std::string_view thing) {
  if (const std::string_view surplus = token_on_line(); !surplus.empty())
    fail(fmt::format("{} is one number too many for {}", quote_token(surplus), thing));
  end_line();
}

void Tokenizer::end_numbers_of(std::string_view thing) {
  if (const std::string_view next = token_on_line(); !next.empty() && (plain_double(next) || foreign_double(next)))
    fail(fmt::format("{} is one number too many for {}", quote_token(next), thing));
  end_line();
}

std::string_view Tokenizer::read_token(std::string_view what) {
  const std::string_view found = syntax_.free_form ? token() : token_on_line();
  if (!found.empty()) return found;
  if (position_ == text_.size()) fail_at_end(what);
  fail(fmt::format("expected {}, but the line ends", what));
}

bool Tokenizer::take_double(double& value, std::size_t& begin) {
  skip_to_token();
  const char* const at = text_.data() + position_;
  const char* const last = text_.data() + text_.size();
  const char* end = short_decimal(at, last, value);
  if (end == nullptr) {
    const auto [stop, error] = std::from_chars(at, last, value);
    if (error != std::errc() || !std::isfinite(value)) return false;
    end = stop;
  }
  if (!ends_token(end)) return false;
  begin = position_;
  position_ = static_cast<std::size_t>(end - text_.data());
  return true;
}

bool Tokenizer::take_integer(std::int64_t& value, std::size_t& begin) {
  constexpr std::ptrdiff_t kMostDigits = 18;
  skip_to_token();
  const char* at = text_.data() + position_;
  const char* const last = text_.data() + text_.size();
  const bool negative = at != last && *at == '-';
  if (negative) ++at;
  const char* const first = at;
  std::uint64_t digits = 0;
  for (; at != last && is_digit(*at); ++at) digits = 10 * digits + static_cast<std::uint64_t>(*at - '0');
  if (at == first || at - first > kMostDigits || !ends_token(at)) return false;
  value = negative ? -static_cast<std::int64_t>(digits) : static_cast<std::int64_t>(digits);
  begin = position_;
  position_ = static_cast<std::size_t>(at - text_.data());
  return true;
}

double Tokenizer::read_double(std::string_view what) {
  double value = 0.0;
  std::size_t begin = 0;
  return take_double(value, begin) ? value : parse_double(read_token(what), what);
}

double Tokenizer::parse_double(std::string_view token, std::string_view what) const {
  std::optional<double> value = plain_double(token);
  if (!value) value = foreign_double(token);
  if (!value) fail(fmt::format("expected {}, got {}", what, quote_token(token)));
  if (!std::isfinite(*value)) fail(fmt::format("{} is not a finite number: {}", what, quote_token(token)));
  return *value;
}

std::int64_t Tokenizer::read_integer(std::string_view what) {
  std::int64_t value = 0;
  std::size_t begin = 0;
  return take_integer(value, begin) ? value : parse_integer(read_token(what), what);
}

Vec3 Tokenizer::read_point(int components, std::size_t& place) {
  skip_to_token();
  place = position_;
  Vec3 p;
  p.x = read_double("x coordinate");
  p.y = read_double("y coordinate");
  if (components == 3) p.z = read_double("z coordinate");
  return p;
}

std::int64_t Tokenizer::parse_integer(std::string_view token, std::string_view what) const {
  std::string_view digits = token;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) fail(fmt::format("{} is too large: {}", what, quote_token(token)));
  if (error != std::errc() || end != digits.data() + digits.size()) fail(fmt::format("expected {}, got {}", what, quote_token(token)));
  return value;
}

Index Tokenizer::read_index(std::string_view what, std::size_t count, std::string_view plural, std::int64_t base) {
  const std::int64_t value = read_integer(what);
  if (value < base || static_cast<std::uint64_t>(value - base) >= count) {
    fail(fmt::format("{} {} out of range (the file has {} {})", what, value, count, plural));
  }
  return static_cast<Index>(value - base);
}

std::size_t Tokenizer::read_count(std::string_view what, std::size_t bytes_each) {
  return check_count(read_integer(what), what, bytes_each);
}

std::size_t Tokenizer::check_count(std::int64_t count, std::string_view what, std::size_t bytes_each) const {
  if (count < 0) fail(fmt::format("{} is negative: {}", what, count));
  if (count >= static_cast<std::int64_t>(kNoIndex)) fail(fmt::format("{} is {}: a mesh can have {} at most", what, count, kNoIndex - 1));
  const auto wanted = static_cast<std::uint64_t>(count) * bytes_each;
  if (wanted > remaining() + 1) {  // the last entry may lack its line end
    fail(fmt::format("{} is {}, but only {} bytes of the file are left", what, count, remaining()));
  }
  return static_cast<std::size_t>(count);
}

std::size_t Tokenizer::line_at(std::size_t offset) const noexcept {
  std::size_t line = 1;
  for (std::size_t i = 0; i < offset; ++i) {
    if (kind_[byte(i)] == kLineEnd && !(text_[i] == '\r' && i + 1 < offset && text_[i + 1] == '\n')) ++line;
  }
  return line;
}

void Tokenizer::fail(const std::string& what) const { throw InputError(file_, line_, what); }

void Tokenizer::fail_at_end(std::string_view what) const {
  const bool after_line_end = line_ > 1 && !text_.empty() && (text_.back() == '\n' || text_.back() == '\r');
  throw InputError(file_, after_line_end ? line_ - 1 : line_, fmt::format("the file ends where {} is expected", what));
}

std::string quote_token(std::string_view token) {
  constexpr std::size_t kLongest = 40;
  std::string result = "\"";
  for (const char c : token.substr(0, kLongest)) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code >= 0x7f) {
      result += fmt::format("\\x{:02x}", code);
    } else {
      result += c;
    }
  }
  result += token.size() > kLongest ? "...\"" : "\"";
  return result;
}

std::string_view trimmed(std::string_view line) noexcept {
  constexpr std::string_view kBlanks = " \t\v\f\r\n";
  const std::size_t first = line.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(kBlanks) - first + 1);
}

bool equal_ignoring_case(std::string_view a, std::string_view b) noexcept {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  if (a.size() != b.size()) return false;
  if (a == b) return true;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (lower(a[i]) != lower(b[i])) return false;
  }
  return true;
}

std::vector<std::string_view> words_of(std::string_view line, std::size_t most) {
  std::vector<std::string_view> words;
  for (line = trimmed(line); !line.empty() && words.size() < most; line = trimmed(line)) {
    words.push_back(line.substr(0, line.find_first_of(" \t")));
    line.remove_prefix(words.back().size());
  }
  return words;
}

std::string_view unquoted(std::string_view text) noexcept {
  return text.size() >= 2 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2) : text;
}

std::string in_capitals(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return capitals;
}

std::string_view take_line(std::string_view& text) noexcept {
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  text.remove_prefix(line.size());
  text.remove_prefix(text.starts_with("\r\n") ? 2 : std::min<std::size_t>(text.size(), 1));
  return line;
}

std::optional<double> not_finite(std::string_view word) {
  const bool negative = word.starts_with('-');
  if (negative || word.starts_with('+')) word.remove_prefix(1);
  if (equal_ignoring_case(word, "nan")) return std::numeric_limits<double>::quiet_NaN();
  if (!equal_ignoring_case(word, "inf") && !equal_ignoring_case(word, "infinity")) return std::nullopt;
  return negative ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
}

double any_double(Tokenizer& tokens) {
  double value = 0.0;
  std::size_t begin = 0;
  if (tokens.take_double(value, begin)) return value;
  const std::string_view token = tokens.read_token("a number");
  const std::optional<double> special = not_finite(token);
  return special ? *special : tokens.parse_double(token, "a number");
}

}  // namespace dmoscope
