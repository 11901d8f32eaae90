// Eight floats side by side, with named operations over Google Highway. The arithmetic of the queries is
// written once and compiled for every instruction set below; the best one that the machine supports is chosen
// at run time.
//
// A query's .cpp file is compiled once for each target, and this header is included as often. Headers that
// include it must therefore be per target as well. Products and sums are rounded separately (no fused
// multiply-add), so that every target computes the same bits.
#if defined(OCTOBLISK_SIMD_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_SIMD_SIMD_INL_H
#undef OCTOBLISK_SIMD_SIMD_INL_H
#else
#define OCTOBLISK_SIMD_SIMD_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

// With one lane at a time, inlining these operations would create functions of tens of thousands of
// instructions.
#undef OCTOBLISK_EIGHT
#if HWY_TARGET == HWY_SCALAR
#define OCTOBLISK_EIGHT HWY_NOINLINE
#else
#define OCTOBLISK_EIGHT HWY_INLINE
#endif

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// Eight floats in as many registers as they need.
class Float8 {
 public:
  static constexpr std::size_t kSize = 8;

  Float8() = default;
  OCTOBLISK_EIGHT explicit Float8(float all) {
    for (auto& part : part_) part = hwy::HWY_NAMESPACE::Set(Tag(), all);
  }
  /// Eight floats from memory, aligned or not.
  static OCTOBLISK_EIGHT Float8 load(const float* from) {
    Float8 result;
    for (std::size_t p = 0; p < kParts; ++p) {
      result.part_[p] = hwy::HWY_NAMESPACE::LoadU(Tag(), from + p * kWidth);
    }
    return result;
  }
  /// Eight integers from memory.
  static OCTOBLISK_EIGHT Float8 load(const std::int16_t* from) { return converted(from); }
  static OCTOBLISK_EIGHT Float8 load(const std::uint16_t* from) { return converted(from); }
  OCTOBLISK_EIGHT void store(float* to) const {
    for (std::size_t p = 0; p < kParts; ++p) hwy::HWY_NAMESPACE::StoreU(part_[p], Tag(), to + p * kWidth);
  }

  friend OCTOBLISK_EIGHT Float8 operator+(const Float8& a, const Float8& b) {
    return combined(a, b, [](auto x, auto y) HWY_ATTR { return hwy::HWY_NAMESPACE::Add(x, y); });
  }
  friend OCTOBLISK_EIGHT Float8 operator-(const Float8& a, const Float8& b) {
    return combined(a, b, [](auto x, auto y) HWY_ATTR { return hwy::HWY_NAMESPACE::Sub(x, y); });
  }
  friend OCTOBLISK_EIGHT Float8 operator*(const Float8& a, const Float8& b) {
    return combined(a, b, [](auto x, auto y) HWY_ATTR { return hwy::HWY_NAMESPACE::Mul(x, y); });
  }
  friend OCTOBLISK_EIGHT Float8 operator/(const Float8& a, const Float8& b) {
    return combined(a, b, [](auto x, auto y) HWY_ATTR { return hwy::HWY_NAMESPACE::Div(x, y); });
  }
  friend OCTOBLISK_EIGHT Float8 min(const Float8& a, const Float8& b) {
    return combined(a, b, [](auto x, auto y) HWY_ATTR { return hwy::HWY_NAMESPACE::Min(x, y); });
  }
  friend OCTOBLISK_EIGHT Float8 max(const Float8& a, const Float8& b) {
    return combined(a, b, [](auto x, auto y) HWY_ATTR { return hwy::HWY_NAMESPACE::Max(x, y); });
  }
  friend OCTOBLISK_EIGHT Float8 abs(const Float8& a) {
    return combined(a, a, [](auto x, auto) HWY_ATTR { return hwy::HWY_NAMESPACE::Abs(x); });
  }
  friend OCTOBLISK_EIGHT Float8 sqrt(const Float8& a) {
    return combined(a, a, [](auto x, auto) HWY_ATTR { return hwy::HWY_NAMESPACE::Sqrt(x); });
  }
  /// `yes` in the lanes where a < b, otherwise `no`.
  friend OCTOBLISK_EIGHT Float8 select(const Float8& a, const Float8& b, const Float8& yes,
                                       const Float8& no) {
    Float8 result;
    for (std::size_t p = 0; p < kParts; ++p) {
      result.part_[p] = hwy::HWY_NAMESPACE::IfThenElse(hwy::HWY_NAMESPACE::Lt(a.part_[p], b.part_[p]),
                                                       yes.part_[p], no.part_[p]);
    }
    return result;
  }

  /// The sum of all eight: ((0+4) + (1+5)) + ((2+6) + (3+7)), on every target.
  friend OCTOBLISK_EIGHT float sum(const Float8& a) {
    float of[kSize];
    a.store(of);
    return ((of[0] + of[4]) + (of[1] + of[5])) + ((of[2] + of[6]) + (of[3] + of[7]));
  }

  /// Bit i: a[i] < b[i]; bits beyond the eighth are 0.
  friend OCTOBLISK_EIGHT unsigned less(const Float8& a, const Float8& b) {
    unsigned bits = 0;
    for (std::size_t p = 0; p < kParts; ++p) {
      std::uint8_t part_bits[8] = {};
      hwy::HWY_NAMESPACE::StoreMaskBits(Tag(), hwy::HWY_NAMESPACE::Lt(a.part_[p], b.part_[p]), part_bits);
      bits |= static_cast<unsigned>(part_bits[0]) << (p * kWidth);
    }
    return bits;
  }

 private:
  using Tag = hwy::HWY_NAMESPACE::CappedTag<float, kSize>;
  static constexpr std::size_t kWidth = hwy::HWY_NAMESPACE::MaxLanes(Tag());
  static constexpr std::size_t kParts = kSize / kWidth;

  template <typename Integer>
  static HWY_INLINE Float8 converted(const Integer* from) {
    const hwy::HWY_NAMESPACE::Rebind<Integer, Tag> narrow;
    const hwy::HWY_NAMESPACE::RebindToSigned<Tag> wide;
    Float8 result;
    for (std::size_t p = 0; p < kParts; ++p) {
      const auto integers = hwy::HWY_NAMESPACE::LoadU(narrow, from + p * kWidth);
      result.part_[p] = hwy::HWY_NAMESPACE::ConvertTo(Tag(), hwy::HWY_NAMESPACE::PromoteTo(wide, integers));
    }
    return result;
  }
  template <typename Operation>
  static HWY_INLINE Float8 combined(const Float8& a, const Float8& b, Operation operation) {
    Float8 result;
    for (std::size_t p = 0; p < kParts; ++p) result.part_[p] = operation(a.part_[p], b.part_[p]);
    return result;
  }

  hwy::HWY_NAMESPACE::Vec<Tag> part_[kParts];
};

/// Three coordinates of eight points or vectors.
struct Vec8 {
  Float8 x, y, z;

  Vec8() = default;
  HWY_INLINE Vec8(const Float8& all_x, const Float8& all_y, const Float8& all_z)
      : x(all_x), y(all_y), z(all_z) {}
  /// Three numbers in all lanes, in single precision.
  template <typename Vector>
  static HWY_INLINE Vec8 all(const Vector& vector) {
    return {Float8(static_cast<float>(vector[0])), Float8(static_cast<float>(vector[1])),
            Float8(static_cast<float>(vector[2]))};
  }
  /// Three rows of eight numbers that begin `stride` numbers apart.
  static HWY_INLINE Vec8 load(const float* x, std::size_t stride) {
    return {Float8::load(x), Float8::load(x + stride), Float8::load(x + 2 * stride)};
  }

  friend HWY_INLINE Vec8 operator+(const Vec8& a, const Vec8& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend HWY_INLINE Vec8 operator-(const Vec8& a, const Vec8& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend HWY_INLINE Vec8 operator*(const Vec8& a, const Float8& s) { return {a.x * s, a.y * s, a.z * s}; }
  friend HWY_INLINE Float8 dot(const Vec8& a, const Vec8& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend HWY_INLINE Vec8 cross(const Vec8& a, const Vec8& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend HWY_INLINE Vec8 min(const Vec8& a, const Vec8& b) {
    return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)};
  }
  friend HWY_INLINE Vec8 max(const Vec8& a, const Vec8& b) {
    return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)};
  }
  /// |x| + |y| + |z|
  friend HWY_INLINE Float8 sumOfMagnitudes(const Vec8& a) { return abs(a.x) + abs(a.y) + abs(a.z); }
};

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
