#pragma once

#include <cstddef>
#include <new>
#include <utility>

namespace hoplab {

/// Room for one object of any class derived from Base, up to kBytes: a choice made while the
/// program runs, without heap.
template <class Base, std::size_t kBytes>
class InPlace {
 public:
  InPlace() = default;
  InPlace(const InPlace&) = delete;
  InPlace& operator=(const InPlace&) = delete;
  ~InPlace() { Clear(); }

  template <class Derived, class... Args>
  Derived& Emplace(Args&&... args) {
    static_assert(sizeof(Derived) <= kBytes && alignof(Derived) <= kAlignment);
    Clear();
    auto* made = new (room_) Derived(std::forward<Args>(args)...);
    object_ = made;
    return *made;
  }
  Base* operator->() { return object_; }
  const Base* operator->() const { return object_; }
  Base& operator*() { return *object_; }
  const Base& operator*() const { return *object_; }

 private:
  static constexpr std::size_t kAlignment = 32;
  void Clear() {
    if (object_) object_->~Base();
    object_ = nullptr;
  }

  alignas(kAlignment) std::byte room_[kBytes];
  Base* object_ = nullptr;
};

}  // namespace hoplab
