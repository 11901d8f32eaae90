// Runs the README's example: a moving tetrahedron with the plugin's shape falls on a static one and stays
// above it.
#include "readme_example.h"

#include <cstdio>

int main() {
  btScalar vertices[12] = {-2, -2, 0, 2, -2, 0, 0, 3, 0, 0, 0, 2};
  int triangles[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  btTriangleIndexVertexArray mesh(4, triangles, 3 * sizeof(int), 4, vertices, 3 * sizeof(btScalar));

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, btScalar(-9.81)));
  btRigidBody* fixed = addMesh(world, mesh, 0);
  btRigidBody* falling = addMesh(world, mesh, 1);
  btTransform above = btTransform::getIdentity();
  above.setOrigin(btVector3(0, 0, btScalar(2.1)));
  falling->setWorldTransform(above);

  btScalar lowest = 10;
  bool touched = false;
  for (int step = 0; step < 60; ++step) {
    world.stepSimulation(btScalar(1) / 240, 0);
    touched |=
        dispatcher.getNumManifolds() > 0 && dispatcher.getManifoldByIndexInternal(0)->getNumContacts() > 0;
    lowest = btMin(lowest, falling->getWorldTransform().getOrigin().z());
  }
  for (btRigidBody* body : {falling, fixed}) {
    world.removeRigidBody(body);
    delete body->getCollisionShape();
    delete body;
  }
  const bool held = touched && lowest > btScalar(1.9);
  std::printf("touched %d, lowest %g\n", touched, double(lowest));
  return held ? 0 : 1;
}
