// Bytes that several owners may read.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <span>

namespace octoblisk::demos {

/// Bytes whose address is a multiple of 64, as tree_blob.h needs it, and their owner.
struct SharedBytes {
  std::span<const std::byte> bytes;
  std::shared_ptr<const void> owner;
};

inline constexpr std::size_t kSharedAlignment = 64;

inline SharedBytes alignedCopy(std::span<const std::byte> bytes) {
  constexpr std::align_val_t kAligned{kSharedAlignment};
  const std::shared_ptr<std::byte> copy(static_cast<std::byte*>(::operator new(bytes.size() + 1, kAligned)),
                                        [](std::byte* memory) { ::operator delete(memory, kAligned); });
  if (!bytes.empty()) std::memcpy(copy.get(), bytes.data(), bytes.size());
  return {{copy.get(), bytes.size()}, copy};
}

}  // namespace octoblisk::demos
