// Prepares a mesh for three.js: smooth on its surfaces, sharp at its creases.
import { BufferAttribute, BufferGeometry } from "three";

const kCrease = Math.cos((32 * Math.PI) / 180);

/** One vertex per corner, with the mean of those normals around the vertex that differ by at most the crease angle. */
export function geometryOf({ vertices, triangles }) {
  const count = triangles.length / 3;
  const areas = new Float32Array(3 * count), units = new Float32Array(3 * count);
  for (let t = 0; t < count; ++t) {
    const a = 3 * triangles[3 * t], b = 3 * triangles[3 * t + 1], c = 3 * triangles[3 * t + 2];
    const ux = vertices[b] - vertices[a], uy = vertices[b + 1] - vertices[a + 1], uz = vertices[b + 2] - vertices[a + 2];
    const vx = vertices[c] - vertices[a], vy = vertices[c + 1] - vertices[a + 1], vz = vertices[c + 2] - vertices[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    const length = Math.sqrt(x * x + y * y + z * z) || 1;
    areas[3 * t] = x; areas[3 * t + 1] = y; areas[3 * t + 2] = z;
    units[3 * t] = x / length; units[3 * t + 1] = y / length; units[3 * t + 2] = z / length;
  }
  // The triangles around each vertex, in one array.
  const first = new Uint32Array(vertices.length / 3 + 1);
  for (const vertex of triangles) ++first[vertex + 1];
  for (let v = 1; v < first.length; ++v) first[v] += first[v - 1];
  const round = new Uint32Array(triangles.length), filled = first.slice();
  for (let i = 0; i < triangles.length; ++i) round[filled[triangles[i]]++] = (i / 3) | 0;

  const positions = new Float32Array(3 * triangles.length);
  const normals = new Int8Array(3 * triangles.length);
  for (let i = 0; i < triangles.length; ++i) {
    const vertex = triangles[i], own = 3 * ((i / 3) | 0);
    const nx = units[own], ny = units[own + 1], nz = units[own + 2];
    let x = 0, y = 0, z = 0;
    for (let k = first[vertex]; k < first[vertex + 1]; ++k) {
      const t = 3 * round[k];
      if (units[t] * nx + units[t + 1] * ny + units[t + 2] * nz < kCrease) continue;
      x += areas[t]; y += areas[t + 1]; z += areas[t + 2];
    }
    const scale = 127 / (Math.sqrt(x * x + y * y + z * z) || 1);
    normals[3 * i] = x * scale; normals[3 * i + 1] = y * scale; normals[3 * i + 2] = z * scale;
    for (let k = 0; k < 3; ++k) positions[3 * i + k] = vertices[3 * vertex + k];
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setAttribute("normal", new BufferAttribute(normals, 3, true));
  return geometry;
}
