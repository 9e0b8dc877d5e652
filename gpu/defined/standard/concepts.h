#pragma once
#include <type_traits>
namespace std {
template <class T>
concept floating_point = is_same_v<T, float> || is_same_v<T, double>;
}  // namespace std
