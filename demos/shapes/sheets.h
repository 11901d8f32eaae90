// Floors: open surfaces that face up. Closed forms.
#pragma once

#include "shapes/bodies.h"

namespace octoblisk::shapes {

/// z = height · sin(x) · cos(y) over ±half_size.
SharedMesh waveSheet(double half_size, double height, int segments);

/// A wavy floor with a raised rim, so that nothing rolls off.
double trayHeight(double x, double y);
SharedMesh tray(double half_size, int segments);

/// The solid between a sheet that faces up and the plane z = bottom below it.
SharedMesh solidBelow(const TriangleMesh& sheet, double bottom);

}  // namespace octoblisk::shapes
