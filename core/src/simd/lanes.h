// The lanes that a comparison of eight at a time selects.
#pragma once

#include <bit>
#include <cstdint>

namespace octoblisk::detail {

/// The numbers of the bits that are set, in ascending order: for (const std::uint32_t lane : Lanes(bits)).
class Lanes {
 public:
  explicit Lanes(unsigned bits) : bits_(bits) {}

  struct Iterator {
    unsigned left;

    std::uint32_t operator*() const { return static_cast<std::uint32_t>(std::countr_zero(left)); }
    Iterator& operator++() {
      left &= left - 1;
      return *this;
    }
    bool operator==(const Iterator&) const = default;
  };

  Iterator begin() const { return {bits_}; }
  Iterator end() const { return {0}; }

 private:
  unsigned bits_;
};

}  // namespace octoblisk::detail
