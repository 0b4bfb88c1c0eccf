#pragma once

#include <cstdint>
#include <utility>

namespace tenon::lang {

/// An object that its references own together. Counted without atomics: an evaluation runs on one thread.
class RefCounted {
 public:
  RefCounted() = default;
  RefCounted(const RefCounted&) = delete;
  RefCounted& operator=(const RefCounted&) = delete;

  void retain() { ++count_; }
  void release() {
    if (--count_ == 0) bury(this);
  }

 protected:
  virtual ~RefCounted() = default;

 private:
  // Deletes without recursion: what the object releases in its destructor waits in a list, so that a million nested
  // lists need no deep stack.
  static void bury(RefCounted* object);

  std::uint32_t count_ = 0;
};

/// A shared reference to a RefCounted object, or nothing.
template <class T>
class Ref {
 public:
  Ref() = default;
  explicit Ref(T* object) : object_(object) {
    if (object_) object_->retain();
  }
  Ref(const Ref& other) : Ref(other.object_) {}
  Ref(Ref&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Ref& operator=(Ref other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Ref() {
    if (object_) object_->release();
  }

  T* get() const { return object_; }
  T& operator*() const { return *object_; }
  T* operator->() const { return object_; }
  explicit operator bool() const { return object_ != nullptr; }

 private:
  T* object_ = nullptr;
};

template <class T, class... Args>
Ref<T> make_ref(Args&&... args) {
  return Ref<T>(new T(std::forward<Args>(args)...));
}

}  // namespace tenon::lang
