// XXH64, a checksum of 64 bits that runs about as fast as memory is read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace octoblisk::detail {

/// XXH64 by Y. Collet, as its specification tells (github.com/Cyan4973/xxHash/blob/dev/doc/xxhash_spec.md).
/// Finds accidents, not forgeries.
std::uint64_t xxh64(std::span<const std::byte> bytes, std::uint64_t seed = 0);

}  // namespace octoblisk::detail
