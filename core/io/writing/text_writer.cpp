#include "core/io/writing/text_writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <string_view>
#include <vector>

#include "core/base/thread_pool.h"

namespace dmoscope {

namespace {

/// Lets threads that work on chunks write in turn, and lends them buffers.
class Turns {
 public:
  std::unique_ptr<TextBuffer> borrow() {
    const std::scoped_lock lock(mutex_);
    if (free_.empty()) return std::make_unique<TextBuffer>();
    std::unique_ptr<TextBuffer> buffer = std::move(free_.back());
    free_.pop_back();
    buffer->clear();
    return buffer;
  }
  void give_back(std::unique_ptr<TextBuffer> buffer) {
    const std::scoped_lock lock(mutex_);
    free_.push_back(std::move(buffer));
  }
  /// Waits until all before `first` is written. False: it never will be.
  [[nodiscard]] bool wait_for(std::size_t first) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return failed_ || written_ == first; });
    return !failed_;
  }
  void wrote_until(std::size_t last) {
    const std::scoped_lock lock(mutex_);
    written_ = last;
    changed_.notify_all();
  }
  void fail() {
    const std::scoped_lock lock(mutex_);
    failed_ = true;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t written_ = 0;
  bool failed_ = false;
  std::vector<std::unique_ptr<TextBuffer>> free_;
};

}  // namespace

void TextBuffer::grow(std::size_t least) {
  const std::size_t capacity = std::max({least, 2 * capacity_, std::size_t{4096}});
  auto larger = std::make_unique_for_overwrite<char[]>(capacity);
  std::memcpy(larger.get(), bytes_.get(), size_);
  bytes_ = std::move(larger);
  capacity_ = capacity;
}

void TextWriter::bytes(std::string_view bytes) {
  finish();
  while (!bytes.empty()) {  // writes in parts, so that a cancel is noticed in time
    context_.progress.check();
    file_->write(bytes.substr(0, kPiece));
    bytes.remove_prefix(std::min(kPiece, bytes.size()));
  }
}

void TextWriter::in_parts(std::size_t count, std::size_t grain, const std::function<void(TextBuffer&, std::size_t, std::size_t)>& format) {
  finish();
  Turns turns;
  // Chunks are taken in their order, so the one whose turn it is always is in work.
  for_chunks(context_.pool, count, grain, [&](std::size_t first, std::size_t last) {
    std::unique_ptr<TextBuffer> part = turns.borrow();
    std::exception_ptr error;
    try {
      format(*part, first, last);
    } catch (...) {
      error = std::current_exception();
    }
    if (!turns.wait_for(first)) return;
    try {
      if (error) std::rethrow_exception(error);
      context_.progress.check();
      file_->write(part->text());
    } catch (...) {
      turns.fail();
      throw;
    }
    turns.wrote_until(last);
    turns.give_back(std::move(part));
  });
}

void TextWriter::finish() {
  context_.progress.check();
  file_->write(buffer_.text());
  buffer_.clear();
}

namespace {

/// A positive number as its digits, d.ddd times ten to a power.
struct Digits {
  std::string digits;  // digits; the first is not 0, unless it is the only one
  int power = 0;
};

/// The digits of `text`, a number in the scientific notation of to_chars, without a sign.
Digits digits_of(std::string_view text) {
  Digits result;
  const std::size_t e = text.find('e');
  for (const char c : text.substr(0, e)) {
    if (c != '.') result.digits += c;
  }
  while (result.digits.size() > 1 && result.digits.back() == '0') result.digits.pop_back();
  std::string_view power = text.substr(e + 1);
  if (power.starts_with('+')) power.remove_prefix(1);
  std::from_chars(power.data(), power.data() + power.size(), result.power);
  return result;
}

/// The number in plain notation: 123.45, or 0.0123 (or .0123 to save a character).
std::string plain(const Digits& number, bool leading_zero) {
  constexpr int kMost = 32;  // longer ones fit in no field
  if (number.power > kMost || number.power < -kMost) return std::string(2 * kMost, '0');
  if (number.power < 0) {
    return (leading_zero ? "0." : ".") + std::string(static_cast<std::size_t>(-number.power - 1), '0') + number.digits;
  }
  const auto whole = static_cast<std::size_t>(number.power) + 1;
  if (number.digits.size() <= whole) return number.digits + std::string(whole - number.digits.size(), '0') + ".";
  return number.digits.substr(0, whole) + "." + number.digits.substr(whole);
}

std::string scientific(const Digits& number, ExponentStyle style) {
  std::string text = number.digits.substr(0, 1) + "." + number.digits.substr(1);
  if (style == ExponentStyle::Letter) text += 'e';
  if (number.power >= 0 && style == ExponentStyle::Sign) text += '+';
  return text + std::to_string(number.power);
}

double value_of(const Digits& number) {
  const std::string text = scientific(number, ExponentStyle::Letter);
  double value = HUGE_VAL;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() ? value : HUGE_VAL;
}

}  // namespace

FieldNumber number_in_field(double value, std::size_t width, ExponentStyle style) {
  constexpr int kDigits = 17;  // digits that distinguish every double
  const bool negative = std::signbit(value);
  const double size = std::abs(value);
  std::array<char, 64> buffer{};
  if (const auto most = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value); most.ec == std::errc()) {
    const std::string_view text(buffer.data(), static_cast<std::size_t>(most.ptr - buffer.data()));
    if (text.size() <= width && text.find('.') != std::string_view::npos && text.find('e') == std::string_view::npos) {
      return {std::string(text), value};
    }
  }
  for (int digits = kDigits + 1; digits > 0; --digits) {
    // Tries the shortest text that is exactly this double, then fewer and fewer digits.
    const auto written = digits > kDigits
                             ? std::to_chars(buffer.data(), buffer.data() + buffer.size(), size, std::chars_format::scientific)
                             : std::to_chars(buffer.data(), buffer.data() + buffer.size(), size, std::chars_format::scientific, digits - 1);
    const Digits number = digits_of({buffer.data(), static_cast<std::size_t>(written.ptr - buffer.data())});
    const double back = value_of(number);
    if (!std::isfinite(back)) continue;  // for the largest doubles, rounded up
    for (std::string text : {plain(number, true), scientific(number, style), plain(number, false)}) {
      if (negative) text.insert(text.begin(), '-');
      if (text.size() <= width) return {std::move(text), negative ? -back : back};
    }
  }
  return {"0.", 0.0};
}

}  // namespace dmoscope
