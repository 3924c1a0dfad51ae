#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <stdexcept>
#include <utility>
#include <vector>

namespace orthonav::render {

/// A list that keeps the memory of its items when it is cleared, for the items added next: a scene
/// is refilled for every frame, and the frame loop must not allocate. `T` has a `renew(T&)` that
/// makes it as new except for reserved memory. Copies and comparisons regard the current items
/// only.
template <class T>
class ItemList {
 public:
  using value_type = T;

  ItemList() = default;
  ItemList(std::initializer_list<T> items) : items_(items), size_(items.size()) {}
  ItemList(const ItemList& other) : items_(other.begin(), other.end()), size_(other.size_) {}
  ItemList(ItemList&& other) noexcept
      : items_(std::move(other.items_)), size_(std::exchange(other.size_, 0)) {}
  ItemList& operator=(const ItemList& other) {
    if (this == &other) {
      return *this;
    }
    clear();
    for (const T& item : other) {
      emplace_back() = item;
    }
    return *this;
  }
  ItemList& operator=(ItemList&& other) noexcept {
    items_.swap(other.items_);
    std::swap(size_, other.size_);
    other.clear();
    return *this;
  }
  ~ItemList() = default;

  /// Adds an item at the end. References to others stay valid only until the list grows.
  T& emplace_back() {
    if (size_ == items_.size()) {
      items_.emplace_back();
    }
    return items_[size_++];
  }
  void push_back(const T& item) {
    if (size_ < items_.size()) {
      items_[size_] = item;
    } else {
      items_.push_back(item);
    }
    ++size_;
  }
  void pop_back() { shrink(size_ - 1); }
  void clear() { shrink(0); }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] T* data() { return items_.data(); }
  [[nodiscard]] const T* data() const { return items_.data(); }
  [[nodiscard]] T* begin() { return items_.data(); }
  [[nodiscard]] T* end() { return items_.data() + size_; }
  [[nodiscard]] const T* begin() const { return items_.data(); }
  [[nodiscard]] const T* end() const { return items_.data() + size_; }
  [[nodiscard]] T& operator[](std::size_t i) { return items_[i]; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return items_[i]; }
  [[nodiscard]] T& at(std::size_t i) { return items_[checked(i)]; }
  [[nodiscard]] const T& at(std::size_t i) const { return items_[checked(i)]; }
  [[nodiscard]] T& front() { return items_.front(); }
  [[nodiscard]] const T& front() const { return items_.front(); }
  [[nodiscard]] T& back() { return items_[size_ - 1]; }
  [[nodiscard]] const T& back() const { return items_[size_ - 1]; }

  /// Removes the items for which `leaves` is true; the others keep their order.
  template <class Leaves>
  void erase_if(const Leaves& leaves) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      if (leaves(std::as_const(items_[i]))) {
        continue;
      }
      if (kept != i) {
        std::swap(items_[kept], items_[i]);
      }
      ++kept;
    }
    shrink(kept);
  }

  friend bool operator==(const ItemList& a, const ItemList& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  void shrink(std::size_t size) {
    for (std::size_t i = size; i < size_; ++i) {
      renew(items_[i]);
    }
    size_ = size;
  }
  [[nodiscard]] std::size_t checked(std::size_t i) const {
    if (i >= size_) {
      throw std::out_of_range("ItemList::at");
    }
    return i;
  }

  std::vector<T> items_;  ///< beyond `size_`, renewed items wait
  std::size_t size_ = 0;
};

}  // namespace orthonav::render
