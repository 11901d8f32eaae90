// Saved trees give the same queries to the last bit. Any other data is refused.
#include "octoblisk/tree_blob.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/checksum.h"
#include "octoblisk/collide.h"
#include "octoblisk/distance.h"
#include "octoblisk/raycast.h"
#include "shared/meshes.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::SharedMesh;
using Blob = std::vector<std::byte>;

constexpr Storage kStorages[] = {Storage::full, Storage::compact};

TEST(Checksum, xxh64_vs_publishedValues) {
  const auto sum = [](std::string_view text) { return xxh64(std::as_bytes(std::span(text))); };
  EXPECT_EQ(sum(""), 0xEF46DB3751D8E999u);
  EXPECT_EQ(sum("a"), 0xD24EC4F1A98C6E5Bu);
  EXPECT_EQ(sum("abc"), 0x44BC2CF5AD770999u);
  EXPECT_EQ(sum("Nobody inspects the spammish repetition"), 0xFBCEA83C8A378BF1u);
}

/// A folder of its own, removed at the end.
class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("octoblisk_tree_blob_" + std::to_string(std::random_device()()))) {
    if (!std::filesystem::create_directory(path_)) throw std::runtime_error("no folder " + path_.string());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path operator/(const char* name) const { return path_ / name; }
  std::ptrdiff_t files() const { return std::distance(std::filesystem::directory_iterator(path_), {}); }

 private:
  std::filesystem::path path_;
};

void write(const std::filesystem::path& file, const Blob& blob) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(blob.data()), static_cast<std::streamsize>(blob.size()));
}

/// The message that refuses a blob, or "" if it is accepted.
std::string refusal(const std::function<void()>& load) {
  try {
    load();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}
std::string refusal(const Blob& blob, const SharedMesh& mesh) {
  return refusal([&] { fromBlob(blob, mesh); });
}

void setChecksum(Blob& blob) {
  const std::uint64_t sum = xxh64(std::span(blob).subspan(24));
  std::memcpy(blob.data() + 16, &sum, sizeof(sum));
}

template <typename Number>
Blob patched(Blob blob, std::size_t at, Number number) {
  std::memcpy(blob.data() + at, &number, sizeof(number));
  setChecksum(blob);
  return blob;
}

void expectTheSame(const ClusteredOctree& one, const ClusteredOctree& other) {
  EXPECT_NO_THROW(other.validate());
  const BuildStats &a = one.stats(), &b = other.stats();
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.leaves, b.leaves);
  EXPECT_EQ(a.depth, b.depth);
  EXPECT_EQ(a.root_volume, b.root_volume);
  EXPECT_EQ(a.leaf_volume, b.leaf_volume);
  EXPECT_EQ(a.bytes, b.bytes);
  const ClusteredOctree ring = ClusteredOctree::build(testing::torus(0.5, 0.15, 20, 12));
  std::mt19937_64 random(81);
  int hits = 0;
  constexpr int kPoses = 200;
  for (int i = 0; i < kPoses; ++i) {
    const Pose pose = testing::randomPose(random, 1.3);
    const auto pair = collide(one, ring, pose);
    hits += pair.has_value();
    ASSERT_EQ(pair, collide(other, ring, pose)) << "pose " << i;
    const Clearance clearance = distance(one, ring, pose), same = distance(other, ring, pose);
    ASSERT_EQ(std::memcmp(&clearance.distance, &same.distance, sizeof(double)), 0) << "pose " << i;
    ASSERT_EQ(clearance.point_on_a, same.point_on_a) << "pose " << i;
    ASSERT_EQ(clearance.triangle_a, same.triangle_a) << "pose " << i;
    const Ray ray{.origin = pose.translation, .direction = pose.rotation.col(0)};
    const auto hit = closestHit(one, ray), same_hit = closestHit(other, ray);
    ASSERT_EQ(hit.has_value(), same_hit.has_value()) << "pose " << i;
    if (hit) {
      ASSERT_EQ(hit->t, same_hit->t);
    }
  }
  EXPECT_GE(hits, kPoses * 3 / 10);
  EXPECT_LE(hits, kPoses * 7 / 10);
}

TEST(TreeBlob, roundTripGivesTheSameTree) {
  const SharedMesh mesh = testing::fan(9, 10);
  const auto copy_of_mesh = std::make_shared<const TriangleMesh>(*mesh);
  const std::vector<int> parts(mesh->triangleCount(), 3);
  for (const Storage storage : kStorages) {
    for (const BuildOptions& options :
         {BuildOptions{.leaf_capacity = 5, .quality = BuildQuality::low, .storage = storage},
          BuildOptions{.partition = PartitionKind::paper,
          .storage = storage,
          .clusters = 3,
          .seed = 7,
          .part_of_triangle = parts}}) {
      const ClusteredOctree tree = ClusteredOctree::build(mesh, options);
      const Blob blob = toBlob(tree);
      const ClusteredOctree read = fromBlob(blob, copy_of_mesh);
      expectTheSame(tree, read);
      EXPECT_EQ(read.options().partition, options.partition);
      EXPECT_EQ(read.options().quality, options.quality);
      EXPECT_EQ(read.options().storage, options.storage);
      EXPECT_EQ(read.options().leaf_capacity, options.leaf_capacity);
      EXPECT_EQ(read.options().clusters, options.clusters);
      EXPECT_EQ(read.options().seed, options.seed);
      EXPECT_EQ(read.options().part_of_triangle, options.part_of_triangle);
      EXPECT_EQ(toBlob(read), blob);

      const Folder folder;
      const auto file = folder / "tree.octoblisk";
      saveTree(tree, file);
      EXPECT_EQ(std::filesystem::file_size(file), blob.size());
      EXPECT_EQ(folder.files(), 1);
      const ClusteredOctree mapped = mapTree(file, copy_of_mesh);
      expectTheSame(tree, mapped);
      EXPECT_EQ(toBlob(mapped), blob);

      // The mapping stays valid while any tree uses it, even if the file is replaced or deleted.
      const ClusteredOctree kept = mapped;
#ifdef _WIN32  // a mapped file can be neither
      EXPECT_THROW(saveTree(ClusteredOctree::build(mesh), file), std::runtime_error);
      EXPECT_EQ(folder.files(), 1);
#else
      saveTree(ClusteredOctree::build(mesh), file);
      std::filesystem::remove(file);
#endif
      expectTheSame(tree, kept);
      EXPECT_NO_THROW(ClusteredOctree(kept).refitted(mesh).refitted(mesh).validate());
    }
  }
}

TEST(TreeBlob, usesTheOwnersBytesWhereTheyAre) {
  const SharedMesh mesh = testing::fan(9, 10);
  const ClusteredOctree tree = ClusteredOctree::build(mesh);
  const Blob blob = toBlob(tree);
  const auto owner = std::make_shared<std::vector<TreeNode>>(blob.size() / 512 + 2);  // is aligned
  const auto bytes = std::as_writable_bytes(std::span(*owner));
  std::ranges::copy(blob, bytes.begin());
  const std::weak_ptr<const void> watched = owner;
  {
    const ClusteredOctree over = fromBlob(bytes.first(blob.size()), mesh, owner);
    EXPECT_EQ(static_cast<const void*>(treeOf(over).nodes().data()),
              static_cast<const void*>(bytes.data() + 128));
    EXPECT_EQ(owner.use_count(), 2);
    expectTheSame(tree, over);
  }
  EXPECT_EQ(owner.use_count(), 1);
  std::ranges::copy(blob, bytes.begin() + 4);
  EXPECT_NE(refusal([&] { fromBlob(bytes.subspan(4, blob.size()), mesh, owner); }).find("multiple of 64"),
            std::string::npos);
}

TEST(TreeBlob, bytesDependOnTheTreeAlone) {
  const SharedMesh mesh = testing::torus(3, 1, 150, 50);
  for (const Storage storage : kStorages) {
    const Blob blob = toBlob(ClusteredOctree::build(mesh, {.threads = 1, .storage = storage}));
    for (const int threads : {2, 4, 0})
      EXPECT_EQ(toBlob(ClusteredOctree::build(mesh, {.threads = threads, .storage = storage})), blob);
  }
}

TEST(TreeBlob, refusesEveryFlippedByteAndEveryTruncation) {
  std::mt19937_64 random(82);
  const SharedMesh mesh = testing::soup(random, 20, 1, 0.5);
  for (const Storage storage : kStorages) {
    const Blob blob = toBlob(ClusteredOctree::build(mesh, {.storage = storage}));
    EXPECT_EQ(refusal(blob, mesh), "");
    for (std::size_t at = 0; at < blob.size(); ++at) {
      Blob flipped = blob;
      flipped[at] ^= static_cast<std::byte>(1 + random() % 255);
      EXPECT_NE(refusal(flipped, mesh), "") << "byte " << at;
    }
    for (std::size_t size = 0; size < blob.size(); ++size)
      EXPECT_NE(refusal(Blob(blob.begin(), blob.begin() + static_cast<std::ptrdiff_t>(size)), mesh), "")
          << size;
    Blob longer = blob;
    longer.resize(blob.size() + 64);
    EXPECT_NE(refusal(longer, mesh).find("cut off or padded"), std::string::npos);
  }
}

TEST(TreeBlob, saysWhatIsWrong) {
  const SharedMesh mesh = testing::torus(3, 1, 20, 10);
  const Blob blob = toBlob(ClusteredOctree::build(mesh));
  const auto expect = [&](const Blob& bad, const SharedMesh& of, const char* what) {
    const std::string said = refusal(bad, of);
    EXPECT_NE(said.find(what), std::string::npos) << said;
    EXPECT_EQ(said.rfind("the tree blob ", 0), 0u) << said;
  };
  expect({}, mesh, "less than a header");
  expect(patched(blob, 0, 'x'), mesh, "magic");
  expect(patched(blob, 8, std::uint32_t{1}), mesh, "format version 1");
  expect(patched(blob, 12, std::uint32_t{0x04030201}), mesh, "byte order");
  expect(patched(blob, 24, std::uint64_t{1} << 40), mesh, "cut off");
  expect(patched(blob, 56, std::uint64_t{0}), mesh, "has 0 nodes");
  expect(patched(blob, 56, ~std::uint64_t{0}), mesh, "nodes for 400 triangles");
  expect(patched(blob, 56, std::uint64_t{5}), mesh, "its arrays need");
  expect(patched(blob, 64, std::uint64_t{5}), mesh, "5 parts");
  expect(patched(blob, 80, std::uint32_t{2}), mesh, "unknown storage 2");
  expect(patched(blob, 84, std::uint32_t{3}), mesh, "unknown partition 3");
  expect(patched(blob, 88, std::uint32_t{4}), mesh, "unknown quality 4");
  expect(patched(blob, 92, std::int32_t{-1}), mesh, "leaf_capacity is -1");
  Blob damaged = blob;
  damaged[300] ^= std::byte{1};
  expect(damaged, mesh, "checksum");
  expect(blob, testing::torus(3, 1, 20, 11), "belongs to another mesh, of 400 triangles");
  std::vector<Vec3> vertices = mesh->vertices();
  vertices[7].x() = std::nextafter(vertices[7].x(), 9.0);
  expect(blob, std::make_shared<const TriangleMesh>(vertices, mesh->triangles()),
         "belongs to another mesh, with as many triangles");
  expect(blob, nullptr, "needs the mesh");
}

TEST(TreeBlob, refusesForgedTreesWithARightChecksum) {
  const SharedMesh mesh = testing::torus(3, 1, 20, 10);
  const ClusteredOctree fast = ClusteredOctree::build(mesh);
  const Blob blob = toBlob(fast);
  const std::size_t nodes = 128, order = nodes + sizeof(TreeNode) * treeOf(fast).nodeCount();
  const auto childAt = [&](std::size_t node, std::size_t lane) {
    return nodes + node * sizeof(TreeNode) + offsetof(TreeNode, children) + lane * sizeof(Child);
  };
  const auto floatAt = [&](std::size_t node, std::size_t place) {
    return nodes + node * sizeof(TreeNode) + place * sizeof(float);
  };
  const auto expect = [&](const Blob& bad, const char* what) {
    const std::string said = refusal(bad, mesh);
    EXPECT_NE(said.find(what), std::string::npos) << said;
  };
  ASSERT_GT(treeOf(fast).nodeCount(), 3u);
  ASSERT_FALSE(treeOf(fast).child({1, 0}).isLeaf());
  expect(patched(blob, 124, std::uint32_t{1}), "reserved words");
  expect(patched(blob, childAt(0, 0), std::uint32_t{0}), "node 0 is empty");
  expect(patched(blob, childAt(0, 1), Child::leaf(0, 1)), "more than one box");
  expect(patched(blob, childAt(1, 0), std::uint32_t{1}), "not the next node");  // a cycle
  expect(patched(blob, childAt(1, 0), std::uint32_t{0x7fffffff}), "not the next node");
  expect(patched(blob, childAt(1, 0), Child::leaf(0, 8)), "next node");
  std::size_t leaf_node = 1;
  while (!treeOf(fast).child({static_cast<std::uint32_t>(leaf_node), 0}).isLeaf()) ++leaf_node;
  expect(patched(blob, childAt(leaf_node, 0), Child::leaf(399, 8)), "ends beyond");
  expect(patched(blob, childAt(leaf_node, 0), std::uint32_t{0xffffffff}), "ends beyond");
  const Child leaf = treeOf(fast).child({static_cast<std::uint32_t>(leaf_node), 0});
  const Child longer = Child::leaf(leaf.first(), leaf.count() % 8 + 1);
  EXPECT_NE(refusal(patched(blob, childAt(leaf_node, 0), longer), mesh), "");
  expect(patched(blob, order, std::uint32_t{400}), "triangle 400");
  expect(patched(blob, order, treeOf(fast).triangleOrder()[1]), "entry 1 of the triangle order");
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30f}) {
    for (std::size_t place = 0; place < 15 * kLanes; place += kLanes)
      expect(patched(blob, floatAt(1, place), bad), "box 0 of node 1 ");
    const std::size_t leaf_vertices = (order + mesh->triangleCount() * sizeof(std::uint32_t) + 63) / 64 * 64;
    expect(patched(blob, leaf_vertices, bad), "coordinate 0 in the leaves");
    expect(patched(blob, leaf_vertices + 1000 * sizeof(float), -bad), "coordinate 1000 in the leaves");
  }
  expect(patched(blob, floatAt(0, 3 * kLanes + 5), 1.0f), "box 5 of node 0 ");  // an empty one must stay so
  for (std::size_t k = 0; k < 3; ++k) {
    expect(patched(blob, floatAt(0, k * kLanes + 5), std::numeric_limits<float>::quiet_NaN()),
           "box 5 of node 0 ");
  }

  const ClusteredOctree compact = ClusteredOctree::build(mesh, {.storage = Storage::compact});
  const Blob small = toBlob(compact);
  expect(patched(small, nodes + sizeof(CompactNode) + offsetof(CompactNode, scale),
                 std::numeric_limits<float>::infinity()),
         "of node 1 ");
  expect(patched(small, nodes + sizeof(CompactNode) + offsetof(CompactNode, origin), 1e20f), "of node 1 ");
  Blob no_rotation = small;
  std::memset(no_rotation.data() + nodes + offsetof(CompactNode, rotation), 0, 64);
  setChecksum(no_rotation);
  expect(no_rotation, "of node 0 ");
}

TEST(TreeBlob, tooDeepTreesAreRefused) {
  // A chain: each node holds one triangle and the next node.
  const SharedMesh mesh = testing::torus(3, 1, 10, 10);
  const auto triangles = static_cast<std::uint32_t>(mesh->triangleCount());
  for (const std::uint32_t depth : {64u, 65u}) {
    const ClusteredOctree tree = ClusteredOctree::build(mesh);
    OwnedArrays arrays;
    const BoxF root = treeOf(tree).arrays().box(Tree::kRoot);
    std::uint32_t held = 0;
    for (std::uint32_t n = 0; n < depth; ++n) {
      TreeNode node;
      const bool last = n + 1 == depth;
      std::uint32_t lane = 0;
      const auto put = [&](Child child) {
        node.boxes.set(lane, root);
        node.children[lane++] = child;
      };
      if (n > 0) put(Child::leaf(held++, 1));
      if (!last) put(Child::node(n + 1));
      for (; last && held < triangles && lane < kLanes; held += std::min(8u, triangles - held))
        put(Child::leaf(held, std::min(8u, triangles - held)));
      arrays.nodes.push_back(node);
    }
    const SharedMesh part = std::make_shared<const TriangleMesh>(
        mesh->vertices(), std::vector(mesh->triangles().begin(), mesh->triangles().begin() + held));
    for (std::uint32_t t = 0; t < held; ++t) arrays.triangle_order.push_back(t);
    arrays.leaf_vertices.resize(9 * held + kLanes);
    const std::string said = refusal([&] { octreeOver(part, arrays.view(), nullptr, {}); });
    EXPECT_EQ(said, depth == 64 ? "" : "the tree is deeper than 64");
  }
}

TEST(TreeBlob, filesThatCannotBeReadOrWrittenAreNamed) {
  const Folder folder;
  const SharedMesh mesh = testing::boxMesh({1, 2, 3});
  const ClusteredOctree tree = ClusteredOctree::build(mesh);
  const auto said = [](const std::function<void()>& act) -> std::string {
    try {
      act();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(said([&] { mapTree(folder / "none", mesh); }).find("none"), std::string::npos);
  EXPECT_NE(said([&] { mapTree(folder / ".", mesh); }), "");
  EXPECT_NE(said([&] { saveTree(tree, folder / "no/folder/tree"); }).find("no/folder/tree"),
            std::string::npos);
  std::filesystem::create_directory(folder / "a_folder");
  EXPECT_NE(said([&] { saveTree(tree, folder / "a_folder"); }).find("a_folder"), std::string::npos);
  EXPECT_EQ(folder.files(), 1);  // the failed save leaves no file
  write(folder / "empty", {});
  EXPECT_NE(refusal([&] { mapTree(folder / "empty", mesh); }).find("empty is cut off"), std::string::npos);
  Blob cut = toBlob(tree);
  cut.pop_back();
  write(folder / "cut", cut);
  EXPECT_NE(refusal([&] { mapTree(folder / "cut", mesh); }).find("cut is cut off"), std::string::npos);
}

}  // namespace
}  // namespace octoblisk
