// Makes a dispatcher know our shape: one line in a user's program.
#pragma once

class btCollisionDispatcher;

namespace octoblisk {

/// Registers the algorithms of ClusteredOctreeShape with every convex shape and with itself, in both orders,
/// for contacts and for closest points (contactTest, contactPairTest). Leaves all other pairs as they are.
/// Compounds work through their children.
void registerAlgorithm(btCollisionDispatcher* dispatcher);

}  // namespace octoblisk
