#pragma once
namespace std {
template <class T, unsigned long N>
struct array {
  T at_[N];
  constexpr T& operator[](unsigned long i) { return at_[i]; }
  constexpr const T& operator[](unsigned long i) const { return at_[i]; }
};
template <class T, class... Others>
array(T, Others...) -> array<T, 1 + sizeof...(Others)>;
}  // namespace std
