// Changes bytes of a tree's blob, and usually corrects its checksum. The blob is refused, or queries on it
// terminate.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "base/checksum.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/collide.h"
#include "octoblisk/contacts.h"
#include "octoblisk/distance.h"
#include "octoblisk/raycast.h"
#include "octoblisk/tree_blob.h"

namespace {

using namespace octoblisk;
using octoblisk::detail::xxh64;

/// A wavy sheet.
std::shared_ptr<const TriangleMesh> makeMesh() {
  constexpr std::uint32_t kSide = 9;
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  for (std::uint32_t i = 0; i < kSide; ++i) {
    for (std::uint32_t j = 0; j < kSide; ++j) {
      vertices.emplace_back(0.1 * i, 0.1 * j, 0.05 * ((i * 7 + j * 3) % 5));
      if (i + 1 == kSide || j + 1 == kSide) continue;
      const std::uint32_t v = i * kSide + j;
      triangles.push_back({v, v + kSide, v + 1});
      triangles.push_back({v + 1, v + kSide, v + kSide + 1});
    }
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

struct Seed {
  std::shared_ptr<const TriangleMesh> mesh = makeMesh();
  ClusteredOctree other = ClusteredOctree::build(mesh, {.threads = 1});
  std::array<std::vector<std::byte>, 2> blobs = {
      toBlob(other), toBlob(ClusteredOctree::build(mesh, {.threads = 1, .storage = Storage::compact}))};
};

/// The fuzzer's bytes: a header, then changes of six bytes each (where, how, what).
std::vector<std::byte> mutated(const Seed& seed, const std::uint8_t* data, std::size_t size) {
  const std::uint8_t kind = data[0];
  std::vector<std::byte> blob = seed.blobs[kind & 1];
  for (std::size_t at = 1; at + 6 <= size; at += 6) {
    const std::size_t place = (data[at] | data[at + 1] << 8) % blob.size();
    std::uint8_t what[4];
    std::memcpy(what, data + at + 2, 4);
    const bool whole_word = (data[at + 1] & 0x80) != 0;
    if (whole_word) {
      std::memcpy(blob.data() + place / 4 * 4, what, std::min<std::size_t>(4, blob.size() - place / 4 * 4));
    } else {
      blob[place] ^= static_cast<std::byte>(what[0]);
    }
  }
  if ((kind & 6) == 6) blob.resize(blob.size() - std::min<std::size_t>(blob.size(), data[size - 1]));
  if ((kind & 24) != 24 && blob.size() > 24) {
    const std::uint64_t sum = xxh64(std::span(blob).subspan(24));
    std::memcpy(blob.data() + 16, &sum, sizeof(sum));
  }
  return blob;
}

void query(const ClusteredOctree& tree, const ClusteredOctree& other) {
  std::vector<TrianglePair> pairs;
  std::vector<Contact> found;
  for (const double angle : {0.0, 0.3, 2.0}) {
    const Pose pose{Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()).toRotationMatrix(),
                    Vec3(0.1 * angle, 0.05, 0.07)};
    collide(tree, other, pose);
    touchingPairs(other, tree, pose, pairs);
    contacts(tree, tree, pose, 0.01, found);
    distance(tree, other, Pose{pose.rotation, Vec3(0, 0, 1)});
    closestPoint(tree, Vec3(angle, 0.4, 0.2));
    const Ray ray{.origin = Vec3(0.3, 0.4, 1), .direction = Vec3(0.2 * angle, 0.1, -1)};
    closestHit(tree, ray);
  }
  for (const TrianglePair& pair : pairs) {
    if (pair.b >= tree.mesh().triangleCount()) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Seed seed;
  if (size == 0) return 0;
  try {
    const ClusteredOctree tree = fromBlob(mutated(seed, data, size), seed.mesh);
    try {
      tree.validate();
    } catch (const std::logic_error&) {  // a tree with wrong boxes
    }
    query(tree, seed.other);
    query(tree.refitted(seed.mesh, 1), seed.other);
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
