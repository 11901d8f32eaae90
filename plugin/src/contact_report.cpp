#include "octoblisk_bullet/contact_report.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/clustered_octree_shape.h"

namespace octoblisk {

namespace {

void check(const BladeTable& table, std::size_t number) {
  const std::string name = "blade table " + std::to_string(number);
  if (!table.object) throw std::invalid_argument(name + " has no body: set BladeTable::object");
  const auto* shape = dynamic_cast<const ClusteredOctreeShape*>(table.object->getCollisionShape());
  if (!shape) throw std::invalid_argument(name + ": the shape of its body is not a ClusteredOctreeShape");
  const std::size_t triangles = shape->tree().mesh().triangleCount();
  if (table.blade_of_triangle.size() == triangles) return;
  throw std::invalid_argument(name + " has " + std::to_string(table.blade_of_triangle.size()) +
                              " numbers for " + std::to_string(triangles) + " triangles");
}

/// 0 if the point belongs to another shape or has numbers from elsewhere.
int bladeOf(const btCollisionObject* object, TriangleId triangle, std::span<const BladeTable> blades) {
  const auto table = std::ranges::find(blades, object, &BladeTable::object);
  if (table == blades.end()) return 0;
  const auto& shape = static_cast<const ClusteredOctreeShape&>(*object->getCollisionShape());
  const auto part = static_cast<std::size_t>(triangle.part);
  if (triangle.part < 0 || triangle.index < 0 || part >= shape.parts().count()) return 0;
  const std::size_t number = shape.parts().begin(part) + static_cast<std::size_t>(triangle.index);
  return number < table->blade_of_triangle.size() ? table->blade_of_triangle[number] : 0;
}

/// The broadphase id.
int order(const btCollisionObject* object) { return object->getBroadphaseHandle()->getUid(); }

auto sortedBy(const ReportedContact& contact) {
  const auto of = [](const ContactBody& body) { return std::tuple(body.triangle.part, body.triangle.index); };
  const auto place = [](const btVector3& v) { return std::tuple(v.x(), v.y(), v.z()); };
  return std::tuple(order(contact.a.object), order(contact.b.object), of(contact.a), of(contact.b),
                    contact.distance, place(contact.a.point), place(contact.b.point), place(contact.normal));
}

}  // namespace

void reportContacts(btDispatcher& dispatcher, std::vector<ReportedContact>& found,
                    std::span<const BladeTable> blades, btScalar up_to) {
  found.clear();
  for (std::size_t table = 0; table < blades.size(); ++table) check(blades[table], table);
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      const btManifoldPoint& point = manifold.getContactPoint(p);
      // correctForStep may have overwritten point.getDistance().
      const btVector3 between = point.getPositionWorldOnA() - point.getPositionWorldOnB();
      const btScalar distance = between.dot(point.m_normalWorldOnB);
      if (!(distance <= up_to)) continue;  // or NaN
      const auto body = [&](const btCollisionObject* object, int part, int index, const btVector3& on) {
        return ContactBody{object, {part, index}, bladeOf(object, {part, index}, blades), on};
      };
      ReportedContact contact{
          body(manifold.getBody0(), point.m_partId0, point.m_index0, point.getPositionWorldOnA()),
          body(manifold.getBody1(), point.m_partId1, point.m_index1, point.getPositionWorldOnB()),
          point.m_normalWorldOnB, distance};
      if (order(contact.b.object) < order(contact.a.object)) {
        std::swap(contact.a, contact.b);
        contact.normal = -contact.normal;
      }
      found.push_back(contact);
    }
  }
  std::ranges::sort(found, {}, sortedBy);
}

}  // namespace octoblisk
