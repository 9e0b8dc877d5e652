#include "core/io/reading/binary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "core/io/reading/tokenizer.h"

namespace dmoscope {

namespace {

struct Word {
  std::string_view word;
  ScalarType type;
};
constexpr std::array kWords{
    Word{"char", ScalarType::Int8},           Word{"int8", ScalarType::Int8},       Word{"signed_char", ScalarType::Int8},
    Word{"uchar", ScalarType::UInt8},         Word{"uint8", ScalarType::UInt8},     Word{"unsigned_char", ScalarType::UInt8},
    Word{"short", ScalarType::Int16},         Word{"int16", ScalarType::Int16},     Word{"ushort", ScalarType::UInt16},
    Word{"uint16", ScalarType::UInt16},       Word{"int", ScalarType::Int32},       Word{"unsigned_short", ScalarType::UInt16},
    Word{"int32", ScalarType::Int32},         Word{"uint", ScalarType::UInt32},     Word{"uint32", ScalarType::UInt32},
    Word{"unsigned_int", ScalarType::UInt32}, Word{"long", ScalarType::Int64},      Word{"unsigned_long", ScalarType::UInt64},
    Word{"vtktypeint64", ScalarType::Int64},  Word{"vtkidtype", ScalarType::Int32}, Word{"vtktypeuint64", ScalarType::UInt64},
    Word{"float", ScalarType::Float32},       Word{"float32", ScalarType::Float32}, Word{"double", ScalarType::Float64},
    Word{"float64", ScalarType::Float64},     Word{"int64", ScalarType::Int64},     Word{"uint64", ScalarType::UInt64},
};

template <class T>
T nearest(double value) noexcept {
  if constexpr (std::is_integral_v<T>) {
    if (std::isnan(value)) return 0;
    const double whole = std::nearbyint(value);
    // Compares as doubles: the upper ends of the 64-bit ranges round up to the first number that does not fit.
    if (whole <= static_cast<double>(std::numeric_limits<T>::min())) return std::numeric_limits<T>::min();
    if (whole >= static_cast<double>(std::numeric_limits<T>::max())) return std::numeric_limits<T>::max();
    return static_cast<T>(whole);
  } else if constexpr (std::is_same_v<T, float>) {
    if (std::abs(value) > static_cast<double>(std::numeric_limits<float>::max()) && std::isfinite(value)) {
      return value > 0 ? std::numeric_limits<float>::max() : std::numeric_limits<float>::lowest();
    }
    return static_cast<float>(value);
  } else {
    return value;
  }
}

/// Calls `use` with a value of the C++ type that corresponds to `type`.
template <class Use>
auto with_type(ScalarType type, Use&& use) noexcept {
  switch (type) {
    case ScalarType::Int8:
      return use(std::int8_t{});
    case ScalarType::UInt8:
      return use(std::uint8_t{});
    case ScalarType::Int16:
      return use(std::int16_t{});
    case ScalarType::UInt16:
      return use(std::uint16_t{});
    case ScalarType::Int32:
      return use(std::int32_t{});
    case ScalarType::UInt32:
      return use(std::uint32_t{});
    case ScalarType::Int64:
      return use(std::int64_t{});
    case ScalarType::UInt64:
      return use(std::uint64_t{});
    case ScalarType::Float32:
      return use(float{});
    case ScalarType::Float64:
      break;
  }
  return use(double{});
}

}  // namespace

std::size_t size_of(ScalarType type) noexcept {
  return with_type(type, [](auto kind) { return sizeof(kind); });
}

bool is_whole(ScalarType type) noexcept { return type != ScalarType::Float32 && type != ScalarType::Float64; }

double load_scalar(const char* bytes, ScalarType type, bool big_endian) noexcept {
  return with_type(type, [&](auto kind) { return static_cast<double>(load_number<decltype(kind)>(bytes, big_endian)); });
}

std::int64_t load_whole(const char* bytes, ScalarType type, bool big_endian) noexcept {
  return with_type(type, [&](auto kind) -> std::int64_t {
    if constexpr (std::is_integral_v<decltype(kind)>) {
      const auto value = load_number<decltype(kind)>(bytes, big_endian);
      return std::in_range<std::int64_t>(value) ? static_cast<std::int64_t>(value) : -1;
    } else {
      return -1;
    }
  });
}

void store_scalar(char* bytes, ScalarType type, bool big_endian, double value) noexcept {
  with_type(type, [&](auto kind) {
    const auto raw = store_number(nearest<decltype(kind)>(value), big_endian);
    std::copy(raw.begin(), raw.end(), bytes);
  });
}

double rounded_to(ScalarType type, double value) noexcept {
  return with_type(type, [&](auto kind) { return static_cast<double>(nearest<decltype(kind)>(value)); });
}

bool holds_exactly(ScalarType type, double value) noexcept {
  if (std::isnan(value)) return !is_whole(type);
  return rounded_to(type, value) == value && !(is_whole(type) && std::abs(value) >= 9007199254740992.0);
}

bool scalar_of_word(std::string_view word, ScalarType& type) noexcept {
  const auto found = std::find_if(kWords.begin(), kWords.end(), [&](const Word& entry) { return equal_ignoring_case(entry.word, word); });
  if (found == kWords.end()) return false;
  type = found->type;
  return true;
}

std::string_view vtk_word(ScalarType type) noexcept {
  constexpr static std::array<std::string_view, 10> words{"char",         "unsigned_char", "short",         "unsigned_short", "int",
                                                          "unsigned_int", "vtktypeint64",  "vtktypeuint64", "float",          "double"};
  return words[static_cast<std::size_t>(type)];
}

std::string_view ply_word(ScalarType type) noexcept {
  constexpr static std::array<std::string_view, 10> words{"char", "uchar",  "short",  "ushort", "int",
                                                          "uint", "double", "double", "float",  "double"};
  return words[static_cast<std::size_t>(type)];
}

}  // namespace dmoscope
