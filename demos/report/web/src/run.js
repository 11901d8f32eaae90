// Reads the run that octoblisk wrote into the page, with typed arrays.

function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64).buffer;
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}
const floats = (base64) => new Float32Array(bytesOf(base64));
const words = (base64) => new Uint32Array(bytesOf(base64));
const halves = (base64) => new Uint16Array(bytesOf(base64));
const octets = (base64) => new Uint8Array(bytesOf(base64));

/** A mesh: Float32 vertices (mm), decoded from 16-bit fractions of its box, and Uint32 corners. */
function meshOf({ box, vertices, triangles }) {
  return { vertices: positionsOf(box, vertices), triangles: words(triangles) };
}

function positionsOf(box, vertices) {
  const steps = halves(vertices);
  const positions = new Float32Array(steps.length);
  for (let axis = 0; axis < 3; ++axis) {
    const low = box[axis], step = (box[axis + 3] - low) / 65535;
    for (let i = axis; i < steps.length; i += 3) positions[i] = low + steps[i] * step;
  }
  return positions;
}

/** The cells of a blade's side as a mesh, with one colour per cell. */
function sideOf({ box, vertices, columns, color_of_cell, ...rest }) {
  const rows = octets(color_of_cell).length / columns;
  const corners = new Uint32Array(6 * rows * columns);
  for (let row = 0, i = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      const a = row * (columns + 1) + column, b = a + 1, d = a + columns + 1, c = d + 1;
      for (const corner of [a, b, c, a, c, d]) corners[i++] = corner;
    }
  }
  return { ...rest, columns, mesh: { vertices: positionsOf(box, vertices), triangles: corners }, colorOfCell: octets(color_of_cell) };
}

function boxesOf({ depths, places, box, half, whole, deepest }) {
  const raw = new Int16Array(bytesOf(places)); // centre (unsigned), half extents (unsigned), quaternion x y z w
  const unsigned = new Uint16Array(raw.buffer);
  const count = raw.length / 10;
  const centers = new Float32Array(3 * count), halfExtents = new Float32Array(3 * count), turns = new Float32Array(4 * count);
  for (let i = 0; i < count; ++i) {
    for (let k = 0; k < 3; ++k) {
      centers[3 * i + k] = box[k] + (unsigned[10 * i + k] / 65535) * (box[k + 3] - box[k]);
      halfExtents[3 * i + k] = (unsigned[10 * i + 3 + k] / 65535) * half;
    }
    for (let k = 0; k < 4; ++k) turns[4 * i + k] = raw[10 * i + 6 + k] / 32767;
  }
  return { depths: octets(depths), centers, halfExtents, turns, whole, deepest };
}

function trackOf(track) {
  const contacts = track.contacts;
  return {
    ...track,
    poses: floats(track.poses),
    verdict: octets(track.verdict),
    nearest: track.nearest && {
      part: octets(track.nearest.part), blade: halves(track.nearest.blade), side: octets(track.nearest.side),
      depth: floats(track.nearest.depth), clearance: floats(track.nearest.clearance),
      clearancePart: octets(track.nearest.clearance_part), clearanceBlade: halves(track.nearest.clearance_blade),
    },
    series: track.series.map((series) => ({ ...series, values: floats(series.values) })),
    contacts: {
      first: words(contacts.first), verdict: octets(contacts.verdict),
      points: floats(contacts.points), normals: floats(contacts.normals),
    },
  };
}

export function readRun() {
  const run = JSON.parse(document.getElementById("run").textContent);
  run.blisk.mesh = meshOf(run.blisk.mesh);
  for (const part of run.parts) part.mesh = meshOf(part.mesh);
  run.boxes = boxesOf(run.boxes);
  if (run.side) run.side = sideOf(run.side);
  run.tracks = run.tracks.map(trackOf);
  return run;
}

const kNone = 255;
const kSides = ["", "forward", "backward", "convex", "concave"];

/** Numbers above those of the blades are obstacles. */
export const isObstacle = (run, blade) => run.obstacles.length > 0 && blade > run.blade_count;

export const bladeText = (run, blade) => {
  if (isObstacle(run, blade)) return run.obstacles[blade - run.blade_count - 1];
  return blade === 0 ? "hub or shroud" : `blade ${blade}`;
};

export const millimetres = (value) => {
  if (value === 0) return "0";
  const size = Math.abs(value);
  return value.toFixed(size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3).replace("-", "−");
};

/** The findings at a pose, in a sentence. */
export function sentenceOf(run, track, index) {
  const verdict = run.verdicts[track.verdict[index]].name;
  if (track.texts) return `${verdict}${track.texts[index] ? `: ${track.texts[index]}` : ""}`;
  const { part, blade, side, depth, clearance, clearancePart, clearanceBlade } = track.nearest;
  const pieces = [];
  if (part[index] !== kNone && depth[index] >= 0) {
    const where = kSides[side[index]] ? `, ${kSides[side[index]]} side` : "";
    pieces.push(`${run.parts[part[index]].name} on ${bladeText(run, blade[index])}${where}, ${millimetres(depth[index])} mm deep`);
  }
  if (clearancePart[index] !== kNone && clearance[index] > 0) {
    pieces.push(`clearance from forbidden surfaces ${millimetres(clearance[index])} mm, ${run.parts[clearancePart[index]].name} `
      + `from ${bladeText(run, clearanceBlade[index])}`);
  }
  const changes = track.series.filter((series) => series.in_status && series.values[index] !== 0)
    .map((series) => `${series.name} ${Number(series.values[index].toFixed(3))} ${series.unit}`);
  if (changes.length) pieces.push(`changed by ${changes.join(", ")}`);
  return verdict + (pieces.length ? `: ${pieces.join("; ")}` : "");
}
