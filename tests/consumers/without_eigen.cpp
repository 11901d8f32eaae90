// The public headers that need no Eigen.
#include <octoblisk_bullet/clustered_octree_broadphase.h>
#include <octoblisk_bullet/clustered_octree_shape.h>
#include <octoblisk_bullet/register.h>

#ifdef EIGEN_WORLD_VERSION
#error "Eigen is included"
#endif
