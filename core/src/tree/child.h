// The content of a box of a tree's node.
#pragma once

#include <cstdint>

namespace octoblisk::detail {

/// The content of a box of a node: another node, a leaf of 1..8 triangles, or nothing.
class Child {
 public:
  Child() = default;
  static Child node(std::uint32_t index) { return Child(index); }
  static Child leaf(std::uint32_t first, std::uint32_t count) {
    return Child(kLeafBit | first << 3 | (count - 1));
  }

  bool isLeaf() const { return (bits_ & kLeafBit) != 0; }
  bool isEmpty() const { return bits_ == 0; }
  std::uint32_t node() const { return bits_; }
  std::uint32_t first() const { return (bits_ & ~kLeafBit) >> 3; }  ///< of a leaf, in triangleOrder()
  std::uint32_t count() const { return (bits_ & 7u) + 1; }          ///< of a leaf

 private:
  explicit Child(std::uint32_t bits) : bits_(bits) {}
  static constexpr std::uint32_t kLeafBit = 0x80000000u;
  std::uint32_t bits_ = 0;
};

/// One box of one node.
struct Slot {
  std::uint32_t node : 29, lane : 3;
};

}  // namespace octoblisk::detail
