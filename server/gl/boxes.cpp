#include "server/gl/boxes.h"

#include <embree3/rtcore.h>

#include <bit>
#include <memory>
#include <new>

namespace metamer::gl {
namespace {

constexpr unsigned max_leaf = 7;  // that three bits count
/// So many primitives to a leaf, at the least and at the most: the fewest that a walk likes, and
/// more where the nodes of ten million triangles would not fit into a buffer.
struct LeafSize {
  unsigned least, most;
};
LeafSize leaf_size(std::size_t primitives) {
  return primitives < 2'000'000 ? LeafSize{1, 4} : LeafSize{4, max_leaf};
}

/// A node as Embree builds it, in memory that ends with the hierarchy.
struct Node {
  Eigen::AlignedBox3f box;
  std::array<Node*, 2> children{};  ///< Null in a leaf.
  unsigned count = 0;
  std::array<std::uint32_t, max_leaf> primitives{};  ///< Indices.
};

void* create_node(RTCThreadLocalAllocator allocator, unsigned, void*) {
  return new (rtcThreadLocalAlloc(allocator, sizeof(Node), 16)) Node;
}

void set_children(void* node, void** children, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i)
    static_cast<Node*>(node)->children[i] = static_cast<Node*>(children[i]);
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                  std::size_t count, void*) {
  Node* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(Node), 16)) Node;
  for (std::size_t i = 0; i < count; ++i) {
    const RTCBuildPrimitive& one = primitives[i];
    leaf->primitives[leaf->count++] = one.primID;
    leaf->box.extend(Eigen::Vector3f(one.lower_x, one.lower_y, one.lower_z));
    leaf->box.extend(Eigen::Vector3f(one.upper_x, one.upper_y, one.upper_z));
  }
  return leaf;
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) {
    const RTCBounds& one = *bounds[i];
    static_cast<Node*>(node)->box.extend(Eigen::Vector3f(one.lower_x, one.lower_y, one.lower_z));
    static_cast<Node*>(node)->box.extend(Eigen::Vector3f(one.upper_x, one.upper_y, one.upper_z));
  }
}

bool keep_building(void* cancelled, double) {
  return !static_cast<const std::atomic<bool>*>(cancelled)->load(std::memory_order_relaxed);
}

std::array<std::uint32_t, 4> words(const Eigen::Vector3f& v, std::uint32_t last) {
  return {std::bit_cast<std::uint32_t>(v.x()), std::bit_cast<std::uint32_t>(v.y()),
          std::bit_cast<std::uint32_t>(v.z()), last};
}

/// Appends a node and all below it. No deeper than Embree's largest depth.
void walk(const Node& node, const std::vector<BoxedPrimitive>& primitives, Boxes& to) {
  const std::size_t own = to.low.size();
  std::uint32_t holds = 0;
  if (node.count > 0) {
    holds = 1 + static_cast<std::uint32_t>(to.primitives.size()) * 8 + node.count;
    for (unsigned i = 0; i < node.count; ++i)
      to.primitives.push_back(primitives[node.primitives[i]].name);
  }
  to.low.push_back(words(node.box.min(), holds));
  to.high.push_back(words(node.box.max(), 0));
  for (const Node* child : node.children)
    if (child != nullptr) walk(*child, primitives, to);
  to.high[own][3] = static_cast<std::uint32_t>(to.low.size());
}

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseBvh {
  void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};

}  // namespace

std::optional<Boxes> build_boxes(const std::vector<BoxedPrimitive>& primitives,
                                 const std::atomic<bool>& cancelled) {
  Boxes boxes;
  if (primitives.empty()) return boxes;
  std::vector<RTCBuildPrimitive> list(primitives.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Eigen::Vector3f low = primitives[i].box.min(), high = primitives[i].box.max();
    list[i] = {low.x(),  low.y(),  low.z(),  0,
               high.x(), high.y(), high.z(), static_cast<unsigned>(i)};
  }

  const std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice> device(
      rtcNewDevice(nullptr));
  const std::unique_ptr<std::remove_pointer_t<RTCBVH>, ReleaseBvh> bvh(rtcNewBVH(device.get()));
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.byteSize = sizeof arguments;
  arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
  arguments.maxBranchingFactor = 2;
  arguments.maxDepth = 64;
  const LeafSize leaf = leaf_size(primitives.size());
  arguments.minLeafSize = leaf.least;
  arguments.maxLeafSize = leaf.most;
  arguments.bvh = bvh.get();
  arguments.primitives = list.data();
  arguments.primitiveCount = list.size();
  arguments.primitiveArrayCapacity = list.size();
  arguments.createNode = create_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = create_leaf;
  arguments.buildProgress = keep_building;
  arguments.userPtr = const_cast<std::atomic<bool>*>(&cancelled);
  const auto* root = static_cast<const Node*>(rtcBuildBVH(&arguments));
  if (root == nullptr || cancelled) return std::nullopt;
  walk(*root, primitives, boxes);
  return boxes;
}

}  // namespace metamer::gl
