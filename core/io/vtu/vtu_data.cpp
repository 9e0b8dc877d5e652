#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "core/base/base64.h"
#include "core/base/error.h"
#include "core/io/reading/binary.h"
#include "core/io/reading/gzip.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/vtu/vtu_document.h"

namespace dmoscope {
namespace {

constexpr std::string_view kZlib = "vtkZLibDataCompressor";

/// The content of an array's place in the file, part by part: base64 decoded, raw bytes unchanged.
class EncodedBytes {
 public:
  EncodedBytes(std::string_view text, bool base64) : text_(text), base64_(base64), reader_(text) {}

  /// The next bytes, valid until the next call; none if the text ends before. Throws nothing.
  std::optional<std::string_view> take(std::size_t count) {
    if (base64_) {
      buffer_.clear();
      if (!reader_.read(count, buffer_)) return std::nullopt;
      return std::string_view(buffer_.data(), buffer_.size());
    }
    if (count > text_.size() - at_) return std::nullopt;
    at_ += count;
    return text_.substr(at_ - count, count);
  }
  /// Upper bound of the bytes left.
  [[nodiscard]] std::size_t left() const noexcept { return base64_ ? text_.size() - reader_.position() : text_.size() - at_; }
  [[nodiscard]] std::size_t position() const noexcept { return base64_ ? reader_.position() : at_; }
  /// Moves the bytes taken last into the caller's data.
  void give(VtuData& data, std::string_view taken) {
    if (base64_) {
      data.owned = std::move(buffer_);
      data.bytes = {data.owned.data(), data.owned.size()};
    } else {
      data.bytes = taken;
    }
  }

 private:
  std::string_view text_;
  bool base64_;
  Base64Reader reader_;
  std::size_t at_ = 0;
  std::vector<char> buffer_;
};

class ArrayDecoder {
 public:
  ArrayDecoder(const VtuDocument& document, const VtuArray& array, std::size_t expected)
      : document_(document),
        array_(array),
        expected_(expected),
        encoded_(document.bytes().substr(array.begin, array.limit - array.begin), array.base64) {}

  VtuData decode() {
    if (expected_ > 0) document_.compressed() ? packed() : plain();
    data_.end = array_.begin + encoded_.position();
    if (!array_.appended) {
      const std::string_view rest = document_.bytes().substr(data_.end, array_.limit - data_.end);
      if (expected_ > 0 && !trimmed(rest).empty()) fail("more data than its numbers take");
    }
    return std::move(data_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { document_.fail(array_.node, what); }
  std::string_view need(std::size_t count, std::string_view what) {
    const std::optional<std::string_view> bytes = encoded_.take(count);
    if (!bytes) fail(fmt::format("the data end, or are no {}, within {}", array_.base64 ? "base64" : "such bytes", what));
    return *bytes;
  }
  /// A size in a header.
  [[nodiscard]] std::uint64_t size_at(std::string_view header, std::size_t i) const {
    const char* const bytes = header.data() + i * size_of(document_.header());
    return document_.header() == ScalarType::UInt64 ? load_number<std::uint64_t>(bytes, document_.big_endian())
                                                    : load_number<std::uint32_t>(bytes, document_.big_endian());
  }

  void plain() {
    const std::uint64_t size = size_at(need(size_of(document_.header()), "their size"), 0);
    if (size != expected_) fail(fmt::format("{} bytes, but its numbers take {}", size, expected_));
    encoded_.give(data_, need(expected_, "the numbers"));
  }

  void packed() {
    if (document_.compressor() != kZlib) {
      fail(fmt::format("compressed by {}: only {} is read; save the file with that, or uncompressed", document_.compressor(), kZlib));
    }
    const std::string_view head = need(3 * size_of(document_.header()), "the sizes of its blocks");
    const std::uint64_t blocks = size_at(head, 0);
    const std::uint64_t block = size_at(head, 1);
    const std::uint64_t last = size_at(head, 2);
    // Divides instead of multiplying, which could overflow; the last block's size is 0 if it is a whole one.
    const bool fits = blocks > 0 && block > 0 && blocks - 1 <= expected_ / block && last <= block;
    const std::uint64_t total = !fits ? 0 : (blocks - 1) * block + (last == 0 ? block : last);
    if (total != expected_) fail(fmt::format("{} blocks of {} and {} bytes, but its numbers take {}", blocks, block, last, expected_));
    data_.block = static_cast<std::size_t>(block);
    unpack(static_cast<std::size_t>(blocks), static_cast<std::size_t>(last == 0 ? block : last));
  }

  void unpack(std::size_t blocks, std::size_t last) {
    if (blocks > encoded_.left() / size_of(document_.header()) + 1) fail(fmt::format("{} blocks are more than the file holds", blocks));
    std::vector<std::uint64_t> sizes(blocks);
    const std::string_view table = need(blocks * size_of(document_.header()), "the sizes of its blocks");
    for (std::size_t i = 0; i < blocks; ++i) sizes[i] = size_at(table, i);
    for (std::size_t i = 0; i < blocks; ++i) {
      document_.progress().check();
      if (sizes[i] > encoded_.left()) fail(fmt::format("block {} is said to have {} bytes, more than the file holds", i + 1, sizes[i]));
      const std::string_view bytes = need(static_cast<std::size_t>(sizes[i]), "its blocks");
      if (!zlib_unpack(bytes, i + 1 < blocks ? data_.block : last, data_.owned)) {
        fail(fmt::format("block {} does not unpack to the size that is said of it", i + 1));
      }
    }
    data_.bytes = {data_.owned.data(), data_.owned.size()};
  }

  const VtuDocument& document_;
  const VtuArray& array_;
  std::size_t expected_;
  EncodedBytes encoded_;
  VtuData data_;
};

template <class Value, class Read>
std::vector<Value> ascii(const VtuDocument& document, const VtuArray& array, std::size_t expected, std::vector<std::uint64_t>* places,
                         Read read) {
  const std::size_t size = array.limit - array.begin;
  if (expected > size / 2 + 1) document.fail(array.node, fmt::format("{} numbers do not fit in its {} bytes", expected, size));
  Tokenizer tokens(document.bytes().substr(0, array.limit), document.file(), vtu_text_syntax(), document.progress());
  tokens.seek(array.begin, document.line_at(array.begin));
  std::vector<Value> values;
  values.reserve(expected);
  if (places != nullptr) places->reserve(expected);
  while (!tokens.at_end()) {
    if (values.size() == expected) tokens.fail(fmt::format("more than the {} numbers that {} has", expected, quote_token(array.name)));
    if (places != nullptr) places->push_back(tokens.offset());
    values.push_back(read(tokens));
  }
  if (values.size() != expected) document.fail(array.node, fmt::format("{} numbers, not {}", values.size(), expected));
  return values;
}

/// Accounts for the memory of numbers, 8 bytes each: packed bytes may unpack to a thousand times as many, and arrays may share their data.
void take_memory(const VtuDocument& document, const VtuArray& array, std::size_t count, UnpackBudget& budget) {
  if (!budget.take(std::uint64_t{8} * count))
    document.fail(array.node, fmt::format("the file's arrays unpack to {}", UnpackBudget::advice()));
}

}  // namespace

TextSyntax vtu_text_syntax() { return {.comment = '<', .comma_is_blank = false, .backslash_joins_lines = false, .free_form = true}; }

VtuData vtu_data(const VtuDocument& document, const VtuArray& array, std::size_t expected) {
  return ArrayDecoder(document, array, expected).decode();
}

std::vector<double> vtu_numbers(const VtuDocument& document, const VtuArray& array, std::size_t expected, std::size_t& end,
                                UnpackBudget& budget, std::vector<std::uint64_t>* places) {
  if (array.ascii) return ascii<double>(document, array, expected, places, any_double);
  const std::size_t size = size_of(array.type);
  const VtuData data = vtu_data(document, array, expected * size);
  end = data.end;
  take_memory(document, array, expected, budget);
  std::vector<double> values(expected);
  for (std::size_t i = 0; i < expected; ++i) values[i] = load_scalar(data.bytes.data() + i * size, array.type, document.big_endian());
  return values;
}

std::vector<std::int64_t> vtu_wholes(const VtuDocument& document, const VtuArray& array, std::size_t expected, std::size_t& end,
                                     UnpackBudget& budget) {
  if (!is_whole(array.type)) document.fail(array.node, "must be of a whole-number type");
  if (array.ascii) {
    return ascii<std::int64_t>(document, array, expected, nullptr, [](Tokenizer& tokens) { return tokens.read_integer("a whole number"); });
  }
  const std::size_t size = size_of(array.type);
  const VtuData data = vtu_data(document, array, expected * size);
  end = data.end;
  take_memory(document, array, expected, budget);
  std::vector<std::int64_t> values(expected);
  for (std::size_t i = 0; i < expected; ++i) values[i] = load_whole(data.bytes.data() + i * size, array.type, document.big_endian());
  return values;
}

std::string vtu_encoded(const std::string& file, std::string_view bytes, const VtuEncoding& encoding, ThreadPool* pool) {
  std::string header;
  const auto add_size = [&](std::size_t size) {
    if (encoding.header == ScalarType::UInt64) {
      const auto raw = store_number(static_cast<std::uint64_t>(size), encoding.big_endian);
      header.append(raw.data(), raw.size());
      return;
    }
    if (size > std::numeric_limits<std::uint32_t>::max()) {
      throw OutputError(file, "too large for the 32-bit sizes that this VTU file uses: save it with header_type UInt64");
    }
    const auto raw = store_number(static_cast<std::uint32_t>(size), encoding.big_endian);
    header.append(raw.data(), raw.size());
  };
  const auto text = [&](std::string_view some) {
    return to_base64(std::span(reinterpret_cast<const std::uint8_t*>(some.data()), some.size()));
  };
  if (!encoding.zlib) {
    add_size(bytes.size());
    header += bytes;
    return encoding.base64 ? text(header) : header;
  }
  const std::size_t block = std::max<std::size_t>(encoding.block, 1);
  std::vector<std::string> packed((bytes.size() + block - 1) / block);
  for_chunks(pool, packed.size(), 8, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) packed[i] = zlib_packed(bytes.substr(i * block, block));
  });
  add_size(packed.size());
  add_size(block);
  add_size(bytes.size() % block);
  std::string all;
  for (const std::string& one : packed) {
    add_size(one.size());
    all += one;
  }
  return encoding.base64 ? text(header) + text(all) : header + all;
}

}  // namespace dmoscope
