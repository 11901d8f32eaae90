// XXH64, a 64-bit checksum that is about as fast as reading memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace octoblisk::detail {

/// XXH64 by Y. Collet, according to its specification
/// (github.com/Cyan4973/xxHash/blob/dev/doc/xxhash_spec.md). Detects accidents, but not forgeries.
std::uint64_t xxh64(std::span<const std::byte> bytes, std::uint64_t seed = 0);

}  // namespace octoblisk::detail
