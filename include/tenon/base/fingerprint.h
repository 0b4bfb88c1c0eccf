#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace tenon {

/// Tells things apart that are bytes in the end, but not in the face of somebody who wants to deceive: the 64-bit
/// FNV-1a hash (Fowler, Noll, Vo).
class Fingerprint {
 public:
  void add(std::string_view bytes);
  /// Numbers, or structs of numbers of one type, as they lie in memory.
  template <class T>
  void add(std::span<const T> numbers) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(std::string_view(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()));
  }
  /// 16 hexadecimal digits.
  std::string text() const;

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace tenon
