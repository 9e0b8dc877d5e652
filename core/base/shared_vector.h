#pragma once
// A vector that one thread extends and others read: the part that they read never changes.

#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace dmoscope {

/// Values that never change; copies share them. Reads like a const std::vector.
template <class T>
class SharedVector {
 public:
  SharedVector() = default;
  explicit SharedVector(std::shared_ptr<const std::vector<T>> values) : values_(std::move(values)) {}
  [[nodiscard]] const T* data() const noexcept { return values_ ? values_->data() : nullptr; }
  [[nodiscard]] std::size_t size() const noexcept { return values_ ? values_->size() : 0; }
  [[nodiscard]] bool empty() const noexcept { return size() == 0; }
  [[nodiscard]] const T* begin() const noexcept { return data(); }
  [[nodiscard]] const T* end() const noexcept { return data() + size(); }
  [[nodiscard]] std::reverse_iterator<const T*> rbegin() const noexcept { return std::reverse_iterator(end()); }
  [[nodiscard]] std::reverse_iterator<const T*> rend() const noexcept { return std::reverse_iterator(begin()); }
  [[nodiscard]] const T& operator[](std::size_t i) const noexcept { return data()[i]; }
  [[nodiscard]] const T& at(std::size_t i) const { return whole().at(i); }
  [[nodiscard]] const T& front() const noexcept { return *data(); }
  [[nodiscard]] const T& back() const noexcept { return data()[size() - 1]; }
  [[nodiscard]] const std::vector<T>& whole() const {
    static const std::vector<T> none;
    return values_ ? *values_ : none;
  }
  /// Whether both are the same memory: cheaper than a comparison.
  [[nodiscard]] bool is(const SharedVector& other) const noexcept { return values_ == other.values_; }

 private:
  std::shared_ptr<const std::vector<T>> values_;
};

/// The owner's side: copies shared values before changing them.
template <class T>
class GrowingVector {
 public:
  GrowingVector() = default;
  [[nodiscard]] const std::vector<T>& values() const noexcept { return *values_; }
  [[nodiscard]] SharedVector<T> share() const {
    shared_ = true;
    return SharedVector<T>(values_);
  }
  /// The values for an immediate change; the reference must not be kept.
  [[nodiscard]] std::vector<T>& change() {
    if (std::exchange(shared_, false)) values_ = std::make_shared<std::vector<T>>(*values_);
    return *values_;
  }
  void replace(std::vector<T> values) {
    values_ = std::make_shared<std::vector<T>>(std::move(values));
    shared_ = false;
  }

 private:
  std::shared_ptr<std::vector<T>> values_ = std::make_shared<std::vector<T>>();
  mutable bool shared_ = false;
};

}  // namespace dmoscope
