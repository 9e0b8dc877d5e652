#pragma once
// Memory for large arrays.

#include <cstddef>
#include <vector>

namespace dmoscope {

/// Requests large pages for memory that was allocated and not yet touched: touching it then takes a fraction of the time. Without effect
/// for little memory or if the system has none.
void advise_large_pages(void* memory, std::size_t bytes) noexcept;

/// Reserves memory of a std::vector in large pages, for vectors that will be filled.
template <class T>
void reserve_large(std::vector<T>& vector, std::size_t count) {
  if (count <= vector.capacity()) return;
  vector.reserve(count);
  advise_large_pages(vector.data() + vector.size(), (vector.capacity() - vector.size()) * sizeof(T));
}

/// A vector of equal values, in large pages.
template <class T>
[[nodiscard]] std::vector<T> large_vector(std::size_t count, T value = {}) {
  std::vector<T> vector;
  reserve_large(vector, count);
  vector.resize(count, value);
  return vector;
}

}  // namespace dmoscope
