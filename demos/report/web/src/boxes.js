// Draws the cluster boxes of the blisk's tree, one level at a time.
import { BufferAttribute, InstancedBufferAttribute, InstancedBufferGeometry, LineSegments, ShaderMaterial, Color } from "three";

const kLeaf = 128; // bit of a box's depth
const kNear = 60; // mm around the tool

export class Boxes {
  constructor(boxes) {
    this.boxes = boxes;
    const edges = [];
    for (let corner = 0; corner < 8; ++corner) {
      for (let axis = 0; axis < 3; ++axis) {
        const across = corner | (1 << axis);
        if (across === corner) continue;
        for (const end of [corner, across]) edges.push(end & 1 ? 1 : -1, end & 2 ? 1 : -1, end & 4 ? 1 : -1);
      }
    }
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(edges), 3));
    const most = boxes.depths.length;
    for (const [name, size] of [["center", 3], ["extent", 3], ["turn", 4]]) {
      geometry.setAttribute(name, new InstancedBufferAttribute(new Float32Array(size * most), size));
    }
    this.object = new LineSegments(geometry, new ShaderMaterial({
      uniforms: { color: { value: new Color("#0a5c9e") } },
      vertexShader: `attribute vec3 center, extent; attribute vec4 turn;
        void main() {
          vec3 p = position * extent;
          p += 2.0 * cross(turn.xyz, cross(turn.xyz, p) + turn.w * p);
          gl_Position = projectionMatrix * modelViewMatrix * vec4(p + center, 1.0);
        }`,
      fragmentShader: "uniform vec3 color; void main() { gl_FragColor = vec4(color, 0.75); }",
      transparent: true, depthWrite: false,
    }));
    this.object.frustumCulled = false;
    this.object.visible = false;
  }

  /** Shows the boxes of a level and the leaves above it; only those near `place` if it is not null. */
  show(level, place) {
    const { depths, centers, halfExtents, turns } = this.boxes;
    const { center, extent, turn } = this.object.geometry.attributes;
    let shown = 0;
    for (let i = 0; i < depths.length; ++i) {
      const depth = depths[i] & ~kLeaf;
      if (depth !== level && !(depths[i] & kLeaf && depth < level)) continue;
      if (place) {
        const reach = kNear + Math.hypot(halfExtents[3 * i], halfExtents[3 * i + 1], halfExtents[3 * i + 2]);
        const distance = Math.hypot(centers[3 * i] - place.x, centers[3 * i + 1] - place.y, centers[3 * i + 2] - place.z);
        if (distance > reach) continue;
      }
      center.array.set(centers.subarray(3 * i, 3 * i + 3), 3 * shown);
      extent.array.set(halfExtents.subarray(3 * i, 3 * i + 3), 3 * shown);
      turn.array.set(turns.subarray(4 * i, 4 * i + 4), 4 * shown);
      ++shown;
    }
    for (const attribute of [center, extent, turn]) attribute.needsUpdate = true;
    this.object.geometry.instanceCount = shown;
    this.object.visible = shown > 0;
    return shown;
  }

  hide() { this.object.visible = false; }
}
