// Reads the fuzzer's bytes as numbers.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace octoblisk::fuzz {

/// Hands the bytes out in order, and then zeros.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  std::uint8_t byte() { return left_ == 0 ? 0 : (--left_, *data_++); }

  template <typename Number>
  Number any() {
    std::array<std::uint8_t, sizeof(Number)> bytes{};
    const std::size_t count = std::min(left_, bytes.size());
    std::copy_n(data_, count, bytes.begin());
    data_ += count;
    left_ -= count;
    return std::bit_cast<Number>(bytes);
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

}  // namespace octoblisk::fuzz
