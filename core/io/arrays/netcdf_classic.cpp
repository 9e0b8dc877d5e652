// Classic netCDF files: CDF-1, CDF-2 (offsets of 64 bits) and CDF-5 (counts of 64 bits).
// https://docs.unidata.ucar.edu/netcdf-c/current/file_format_specifications.html
//
// Parsed here rather than by netCDF's library: a header and unpacked arrays need little code, the library would bring along several more
// (libcurl among them), and damaged bytes meet only checks of this program.

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/io/arrays/array_file.h"
#include "core/io/reading/binary.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {
namespace {

constexpr std::uint32_t kDimensions = 10, kVariables = 11, kAttributes = 12;  // tags at the begin of lists
constexpr std::uint32_t kByte = 1, kCharacter = 2;
/// Types of netCDF from kByte on; kCharacter is no number.
constexpr std::array kTypes{ScalarType::Int8,    ScalarType::Int8,    ScalarType::Int16, ScalarType::Int32,
                            ScalarType::Float32, ScalarType::Float64, ScalarType::UInt8, ScalarType::UInt16,
                            ScalarType::UInt32,  ScalarType::Int64,   ScalarType::UInt64};

std::uint64_t padded(std::uint64_t bytes) { return bytes + (4 - bytes % 4) % 4; }

class NetcdfClassic final : public ArrayFile {
 public:
  /// Reads the header; `bytes` must outlive this. Throws InputError.
  NetcdfClassic(std::string_view bytes, std::string file);

  std::optional<ArrayInfo> find(const std::string& name) override;
  std::vector<double> numbers(const std::string& name, std::span<const std::uint64_t> first = {}) override;
  std::vector<std::int64_t> wholes(const std::string& name) override;
  std::string text(const std::string& name) override;
  std::string attribute(const std::string& array, const std::string& name) override;
  std::optional<std::uint64_t> dimension(const std::string& name) override;
  std::string replaced(std::span<const ArrayValues> arrays) override;

 private:
  struct Variable {
    ArrayInfo info;
    bool of_records = false;  // its first size is the number of records, which are interleaved with those of other variables
    std::uint64_t begin = 0;
    std::uint64_t record_bytes = 0;  // bytes of one record of this variable, or of all of it
    std::map<std::string, std::string> attributes;
  };
  /// A contiguous range of values.
  struct Run {
    std::uint64_t offset, count;
  };

  class Header;
  const Variable& variable(const std::string& name) const;
  [[nodiscard]] std::vector<Run> runs(const Variable& variable, const std::string& name, std::span<const std::uint64_t> first) const;
  template <class Number, class Value>
  [[nodiscard]] std::vector<Number> load(const Variable& from, const std::string& name, std::span<const std::uint64_t> first, Value value);

  std::map<std::string, std::uint64_t> dimensions_;
  std::map<std::string, Variable> variables_;
  std::uint64_t records_ = 0;
  std::uint64_t record_stride_ = 0;  // bytes from one record to the next
};

/// Parser of the header.
class NetcdfClassic::Header {
 public:
  Header(NetcdfClassic& into, std::string_view bytes, const std::string& file)
      : into_(into), in_(bytes, 4, true, file, unwatched_), wide_(bytes[3] == 5), far_(bytes[3] != 1), size_(bytes.size()) {}

  void read() {
    into_.records_ = count("number of records");
    const bool streaming = into_.records_ == (wide_ ? std::numeric_limits<std::uint64_t>::max() : 0xffffffffU);
    for (std::uint64_t n = list(kDimensions, "dimensions"); n > 0; --n) dimension();
    (void)attributes();
    for (std::uint64_t n = list(kVariables, "variables"); n > 0; --n) variable();
    strides();
    if (streaming) into_.records_ = into_.record_stride_ == 0 ? 0 : (size_ - std::min(size_, first_record_)) / into_.record_stride_;
    if (into_.record_stride_ == 0) into_.records_ = 0;
    require_apart();
    if (into_.record_stride_ > 0 && into_.records_ > size_ / into_.record_stride_) in_.fail("truncated: records are missing at its end");
    for (auto& [name, variable] : into_.variables_) {
      if (variable.of_records) variable.info.sizes.front() = into_.records_;
    }
    for (auto& [name, length] : into_.dimensions_) {
      if (name == record_dimension_) length = into_.records_;
    }
  }

 private:
  std::uint64_t count(std::string_view what) { return wide_ ? in_.read<std::uint64_t>(what) : in_.read<std::uint32_t>(what); }

  std::string name() {
    const std::uint64_t length = count("a name");
    in_.require_count(length, 1, "characters of a name");
    std::string text(into_.bytes().substr(in_.offset(), length));
    in_.skip(std::min<std::uint64_t>(padded(length), in_.remaining()), "a name");
    return text;
  }

  /// The number of entries in a list.
  std::uint64_t list(std::uint32_t kind, std::string_view what) {
    const auto found = in_.read<std::uint32_t>(what);
    const std::uint64_t n = count(what);
    if (found != kind && (found != 0 || n != 0)) in_.fail(fmt::format("damaged: no list of {} stands where one should", what));
    in_.require_count(n, wide_ ? 16 : 8, what);
    return n;
  }

  std::uint32_t type() {
    const auto number = in_.read<std::uint32_t>("a type");
    if (number < kByte || number > kTypes.size()) in_.fail(fmt::format("damaged: a type {}, which netCDF does not have", number));
    return number;
  }

  void dimension() {
    std::string called = name();
    const std::uint64_t length = count("a dimension");
    if (length == 0 && record_dimension_.empty()) record_dimension_ = called;
    lengths_.push_back(length);
    into_.dimensions_.emplace(std::move(called), length);
  }

  std::map<std::string, std::string> attributes() {
    std::map<std::string, std::string> texts;
    for (std::uint64_t n = list(kAttributes, "attributes"); n > 0; --n) {
      std::string called = name();
      const std::uint32_t of = type();
      const std::uint64_t values = count("an attribute");
      const std::size_t each = of == kCharacter ? 1 : size_of(kTypes[of - 1]);
      in_.require_count(values, each, "values of an attribute");
      if (of == kCharacter) texts.emplace(std::move(called), into_.bytes().substr(in_.offset(), values));
      in_.skip(std::min<std::uint64_t>(padded(values * each), in_.remaining()), "an attribute");
    }
    return texts;
  }

  void variable() {
    std::string called = name();
    const std::uint64_t dimensions = count("a variable");
    in_.require_count(dimensions, wide_ ? 8 : 4, "dimensions of a variable");
    Variable one;
    std::uint64_t values = 1;
    for (std::uint64_t d = 0; d < dimensions; ++d) {
      const std::uint64_t id = count("a dimension's number");
      if (id >= lengths_.size()) in_.fail(fmt::format("damaged: variable {} has a dimension that is not there", quote_token(called)));
      one.info.sizes.push_back(lengths_[id]);
      if (d == 0 && lengths_[id] == 0) {
        one.of_records = true;
      } else {
        // Refuses more values than bytes.
        if (lengths_[id] > 0 && values > size_ / lengths_[id])
          in_.fail(fmt::format("truncated: variable {} is larger than the file", quote_token(called)));
        values *= lengths_[id];
      }
    }
    one.attributes = attributes();
    const std::uint32_t of = type();
    (void)count("a variable's size");  // ignored: some programs write a wrong size
    one.begin = far_ ? in_.read<std::uint64_t>("an offset") : in_.read<std::uint32_t>("an offset");
    one.info.text = of == kCharacter;
    one.info.type = kTypes[of - 1];
    one.record_bytes = values * size_of(one.info.type);
    into_.variables_.emplace(std::move(called), std::move(one));
  }

  void strides() {
    std::size_t of_records = 0;
    first_record_ = size_;
    for (const auto& [called, one] : into_.variables_) {
      if (!one.of_records) continue;
      ++of_records;
      into_.record_stride_ += padded(one.record_bytes);
      first_record_ = std::min(first_record_, one.begin);
    }
    if (of_records != 1) return;
    for (const auto& [called, one] : into_.variables_) {
      if (one.of_records) into_.record_stride_ = one.record_bytes;  // the records of a single variable are not padded
    }
  }

  /// Requires that each variable has bytes of its own: writing to one must change no other, nor the header.
  void require_apart() {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges;
    for (const auto& [called, one] : into_.variables_) {
      if (one.record_bytes == 0 || one.begin > size_) continue;  // data beyond the end of the file are reported when they are read
      if (!one.of_records && into_.records_ > 0 && one.begin + one.record_bytes > first_record_) overlap();
      ranges.emplace_back(one.begin, one.begin + one.record_bytes);
    }
    std::ranges::sort(ranges);
    std::uint64_t end = in_.offset();
    for (const auto& [first, last] : ranges) {
      if (first < end) overlap();
      end = last;
    }
    if (into_.records_ > 1 && end > first_record_ && end - first_record_ > into_.record_stride_) overlap();
  }
  [[noreturn]] void overlap() const { in_.fail("damaged: two of its variables lie at the same place"); }

  NetcdfClassic& into_;
  Progress unwatched_;
  BinaryReader in_;
  bool wide_;  // whether counts have 64 bits
  bool far_;   // whether offsets have 64 bits
  std::uint64_t size_;
  std::vector<std::uint64_t> lengths_;
  std::string record_dimension_;
  std::uint64_t first_record_ = 0;
};

NetcdfClassic::NetcdfClassic(std::string_view bytes, std::string file) : ArrayFile(bytes, std::move(file)) {
  Header(*this, bytes, this->file()).read();
}

std::optional<ArrayInfo> NetcdfClassic::find(const std::string& name) {
  const auto found = variables_.find(name);
  if (found == variables_.end()) return std::nullopt;
  return found->second.info;
}

const NetcdfClassic::Variable& NetcdfClassic::variable(const std::string& name) const {
  const auto found = variables_.find(name);
  if (found == variables_.end()) fail(fmt::format("the file has no variable {}", quote_token(name)));
  return found->second;
}

std::vector<NetcdfClassic::Run> NetcdfClassic::runs(const Variable& variable, const std::string& name,
                                                    std::span<const std::uint64_t> first) const {
  const std::size_t each = size_of(variable.info.type);
  const auto damaged = [&](std::string_view what) { fail(fmt::format("variable {}: {}", quote_token(name), what)); };
  if (first.size() > variable.info.sizes.size()) damaged("it has fewer dimensions than are asked for");
  std::uint64_t record = 0, skipped = 0, values = variable.record_bytes / each;
  for (std::size_t d = 0; d < first.size(); ++d) {
    const std::uint64_t size = variable.info.sizes[d];
    if (first[d] >= size) damaged("it is shorter than it should be");
    if (d == 0 && variable.of_records) {
      record = first[d];
    } else {
      values /= size;
      skipped += first[d] * values;
    }
  }
  std::vector<Run> found;
  const bool all_records = variable.of_records && first.empty();
  for (std::uint64_t r = record; r < (all_records ? records_ : record + 1); ++r) {
    const std::uint64_t from = (variable.of_records ? r * record_stride_ : 0) + skipped * each;
    if (variable.begin > bytes().size() || from > bytes().size() - variable.begin ||
        values * each > bytes().size() - variable.begin - from) {
      damaged("truncated: it lies beyond the end of the file");
    }
    found.push_back({variable.begin + from, values});
  }
  return found;
}

/// The numbers of a variable from the first of its rows on; value(bytes, type, big_endian) decodes one of them.
template <class Number, class Value>
std::vector<Number> NetcdfClassic::load(const Variable& from, const std::string& name, std::span<const std::uint64_t> first, Value value) {
  std::vector<Number> values;
  const std::size_t each = size_of(from.info.type);
  for (const Run& run : runs(from, name, first)) {
    values.reserve(values.size() + run.count);
    for (std::uint64_t i = 0; i < run.count; ++i) values.push_back(value(bytes().data() + run.offset + i * each, from.info.type, true));
  }
  return values;
}

std::vector<double> NetcdfClassic::numbers(const std::string& name, std::span<const std::uint64_t> first) {
  const Variable& from = variable(name);
  if (from.info.text) fail(fmt::format("variable {} holds text, where numbers should be", quote_token(name)));
  return load<double>(from, name, first, load_scalar);
}

std::vector<std::int64_t> NetcdfClassic::wholes(const std::string& name) {
  const Variable& from = variable(name);
  if (from.info.text || !is_whole(from.info.type)) fail(fmt::format("variable {} does not hold whole numbers", quote_token(name)));
  return load<std::int64_t>(from, name, {}, load_whole);
}

std::string NetcdfClassic::text(const std::string& name) {
  const Variable& from = variable(name);
  if (!from.info.text) fail(fmt::format("variable {} holds no text", quote_token(name)));
  std::string all;
  for (const Run& run : runs(from, name, {})) all += bytes().substr(run.offset, run.count);
  return all;
}

std::string NetcdfClassic::attribute(const std::string& array, const std::string& name) {
  const auto& attributes = variable(array).attributes;
  const auto found = attributes.find(name);
  return found == attributes.end() ? std::string() : found->second;
}

std::optional<std::uint64_t> NetcdfClassic::dimension(const std::string& name) {
  const auto found = dimensions_.find(name);
  return found == dimensions_.end() ? std::nullopt : std::optional(found->second);
}

std::string NetcdfClassic::replaced(std::span<const ArrayValues> arrays) {
  std::string whole(bytes());
  for (const ArrayValues& array : arrays) {
    const Variable& to = variable(array.name);
    const std::size_t each = size_of(to.info.type);
    const double* value = array.values.data();
    for (const Run& run : runs(to, array.name, {})) {
      for (std::uint64_t i = 0; i < run.count; ++i) store_scalar(whole.data() + run.offset + i * each, to.info.type, true, *value++);
    }
  }
  return whole;
}

}  // namespace

bool is_netcdf_classic(std::string_view bytes) noexcept {
  return bytes.starts_with("CDF\x01") || bytes.starts_with("CDF\x02") || bytes.starts_with("CDF\x05");
}

std::unique_ptr<ArrayFile> open_netcdf(const SourceFile& source, const IoContext& context) {
  if (is_netcdf_classic(source.bytes())) return std::make_unique<NetcdfClassic>(source.bytes(), source.path().string());
  if (is_hdf5(source.bytes())) return open_hdf5(source, context);
  throw InputError(source.path().string(), 0, "this is no netCDF file, which an Exodus file is");
}

}  // namespace dmoscope
