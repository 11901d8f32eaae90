// Draws the blisk, the tool at the player's position, contacts, path and boxes.
import {
  AmbientLight, BufferAttribute, BufferGeometry, CanvasTexture, Color, DirectionalLight, DoubleSide, Group, Line,
  LineBasicMaterial, LineSegments, Mesh, MeshStandardMaterial, PerspectiveCamera, Points, PointsMaterial,
  Quaternion, Scene, Sprite, SpriteMaterial, SRGBColorSpace, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Boxes } from "./boxes.js";
import { drawSign, kColors } from "./signs.js";
import { geometryOf } from "./surface.js";
import { bladeText, isObstacle } from "./run.js";

const kHub = "#aeb7c2", kBlades = ["#c3ccd6", "#94a6ba"], kGround = "#e3a9c4", kObstacle = "#a08c72", kHit = "#c9370c";
const kNormal = 8; // mm

/** The colours of the picture's legend. */
export const kBladeColors = { hub: kHub, blades: kBlades, ground: kGround, obstacle: kObstacle };

function signTexture(tone) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const context = canvas.getContext("2d");
  // A white outline separates the sign from the background.
  context.shadowColor = "#fff";
  context.shadowBlur = 6;
  for (let i = 0; i < 3; ++i) drawSign(context, tone, 32, 32, 44);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}

function label(text, emphasized) {
  const canvas = document.createElement("canvas");
  canvas.width = 256; canvas.height = 64;
  const context = canvas.getContext("2d");
  context.font = `${emphasized ? "bold " : ""}44px system-ui, sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineWidth = 8;
  context.strokeStyle = "#fff";
  context.strokeText(text, 128, 32);
  context.fillStyle = "#21262e";
  context.fillText(text, 128, 32);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  const sprite = new Sprite(new SpriteMaterial({ map: texture, sizeAttenuation: false, depthTest: false }));
  return sprite;
}

function linesOf(points, material) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(points, 3));
  return new LineSegments(geometry, material);
}

export class ReplayScene {
  /** Throws if WebGL is missing. */
  constructor(canvas, run, player) {
    this.canvas = canvas;
    this.run = run;
    this.player = player;
    this.shown = { blisk: true, glass: false, tool: true, contacts: true, side: true, everywhere: run.everywhere, numbers: true, boxes: false, near: true, level: 3 };
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(32, 1, 1, 5000);
    this.camera.up.set(0, 0, 1);
    this.scene.add(new AmbientLight("#ffffff", 1.1), this.camera);
    for (const [x, y, z, strength] of [[0.6, 0.8, 1, 1.8], [-1, 0.2, 0.4, 0.8]]) {
      const lamp = new DirectionalLight("#ffffff", strength);
      lamp.position.set(x, y, z);
      this.camera.add(lamp, lamp.target);
      lamp.target.position.set(0, 0, -1);
    }
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.draw());
    canvas.addEventListener("keydown", (event) => this.turnByKey(event));
    // Software renderers may lose the context, or may not show a first frame drawn before the layout.
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => this.draw());
    for (const delay of [100, 1000]) setTimeout(() => this.draw(), delay);

    this.addBlisk();
    this.addSide();
    this.addTool();
    this.addContacts();
    this.addPath();
    this.boxes = new Boxes(run.boxes);
    this.shown.level = Math.min(4, run.boxes.deepest);
    this.scene.add(this.boxes.object);
    this.follow = false;
    this.aim = new Vector3();
    this.pose = { origin: new Vector3(), turn: new Quaternion() };
    this.place();
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
    this.look("whole");
  }

  addBlisk() {
    const { blisk, ground_blade: ground } = this.run;
    const geometry = geometryOf(blisk.mesh);
    this.blades = new Map();
    const materials = [];
    this.numbers = new Group();
    for (const [blade, first, count] of blisk.groups) {
      const fixed = isObstacle(this.run, blade);
      const color = fixed ? kObstacle : blade === 0 ? kHub : blade === ground ? kGround : kBlades[blade % 2];
      const material = new MeshStandardMaterial({ color, roughness: 0.55, metalness: 0.15, side: DoubleSide });
      geometry.addGroup(3 * first, 3 * count, materials.length);
      materials.push(material);
      this.blades.set(blade, material);
      if (blade === 0) continue;
      // The blade's number is placed outside its point farthest from the axis.
      const { vertices, triangles } = blisk.mesh;
      let farthest = 0, tip = 0;
      for (let i = 3 * first; i < 3 * (first + count); ++i) {
        const radius = Math.hypot(vertices[3 * triangles[i]], vertices[3 * triangles[i] + 1]);
        if (radius > farthest) { farthest = radius; tip = triangles[i]; }
      }
      const name = fixed ? bladeText(this.run, blade) : blade === ground ? `${blade} ground` : String(blade);
      const sprite = label(name, blade === ground);
      sprite.position.set(vertices[3 * tip] * 1.05, vertices[3 * tip + 1] * 1.05, vertices[3 * tip + 2]);
      this.numbers.add(sprite);
    }
    for (const sprite of this.numbers.children) sprite.scale.set(0.15, 0.0375, 1);
    this.blisk = new Mesh(geometry, materials);
    this.scene.add(this.blisk, this.numbers);
    geometry.computeBoundingSphere();
    this.sphere = geometry.boundingSphere;
  }

  /** The cells of a blade's side, if the run has any. */
  addSide() {
    const { side } = this.run;
    if (!side) return;
    const geometry = geometryOf(side.mesh);
    const colors = new Float32Array(geometry.getAttribute("position").count * 3);
    const palette = side.colors.map(({ color }) => new Color(color));
    for (let i = 0; i < colors.length / 3; ++i) palette[side.colorOfCell[(i / 6) | 0]].toArray(colors, 3 * i);
    geometry.setAttribute("color", new BufferAttribute(colors, 3));
    const material = new MeshStandardMaterial({ vertexColors: true, roughness: 0.8, metalness: 0, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1 });
    this.side = new Mesh(geometry, material);
    this.scene.add(this.side);
  }

  addTool() {
    this.tool = new Group();
    for (const part of this.run.parts) {
      const material = new MeshStandardMaterial({ color: part.color, roughness: 0.7, metalness: 0.05, side: DoubleSide });
      this.tool.add(new Mesh(geometryOf(part.mesh), material));
    }
    this.scene.add(this.tool);
  }

  addContacts() {
    this.marks = new Map();
    this.contactLines = linesOf(new Float32Array(0), new LineBasicMaterial({ color: "#21262e", depthTest: false, transparent: true }));
    this.contactLines.renderOrder = 2;
    this.scene.add(this.contactLines);
    for (const tone of Object.keys(kColors)) {
      const material = new PointsMaterial({ map: signTexture(tone), size: 17, sizeAttenuation: false, transparent: true, depthTest: false, depthWrite: false });
      const points = new Points(new BufferGeometry(), material);
      points.frustumCulled = false;
      points.renderOrder = 3;
      this.marks.set(tone, points);
      this.scene.add(points);
    }
  }

  /** The path of the tool's origin, with a sign at each pose with interference; the other paths in grey. */
  addPath() {
    this.path = new Group();
    this.scene.add(this.path);
    this.pathOf = null;
  }

  updatePath() {
    const { track } = this.player;
    if (this.pathOf === track) return;
    this.pathOf = track;
    for (const object of this.path.children) object.geometry.dispose();
    this.path.clear();
    for (const each of this.run.tracks) {
      const points = new Float32Array((each.poses.length / 7) * 3), hits = [];
      for (let i = 0; 7 * i < each.poses.length; ++i) {
        const place = each.poses.subarray(7 * i, 7 * i + 3);
        points.set(place, 3 * i);
        if (each === track && this.run.verdicts[each.verdict[i]].tone === "interference") hits.push(...place);
      }
      if (this.run.everywhere) continue;
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(points, 3));
      const color = each === track ? "#6b3fa0" : "#8a93a0";
      this.path.add(new Line(geometry, new LineBasicMaterial({ color })));
      if (!hits.length) continue;
      const marked = new BufferGeometry();
      marked.setAttribute("position", new BufferAttribute(new Float32Array(hits), 3));
      this.path.add(new Points(marked, new PointsMaterial({ map: this.marks.get("interference").material.map, size: 7, sizeAttenuation: false, transparent: true, depthWrite: false })));
    }
  }

  /** Places the tool at the player's position; between two poses it moves straight and turns evenly. */
  place() {
    const { track, at } = this.player;
    const from = Math.floor(at), to = Math.min(from + 1, this.player.last), part = at - from;
    const read = (i) => {
      const [x, y, z, qw, qx, qy, qz] = track.poses.subarray(7 * i, 7 * i + 7);
      return [new Vector3(x, y, z), new Quaternion(qx, qy, qz, qw)];
    };
    const [origin, turn] = read(from);
    if (part > 0) {
      const [next, nextTurn] = read(to);
      origin.lerp(next, part);
      turn.slerp(nextTurn, part);
    }
    const shift = origin.clone().sub(this.pose.origin);
    this.pose = { origin, turn };
    this.tool.position.copy(origin);
    this.tool.quaternion.copy(turn);
    if (this.follow) {
      // Follows the tool while playing; when paused, turns to the problem.
      const aim = this.player.playing ? null : this.problem();
      if (aim) shift.copy(aim).sub(this.aim);
      this.aim.add(shift);
      this.camera.position.add(shift);
      this.controls.target.add(shift);
      this.controls.update();
    }
  }

  /** The middle one of the pose's contacts with interference; null if there is none. */
  problem() {
    const { track, index } = this.player;
    const { first, verdict, points } = track.contacts;
    const places = [];
    for (let c = first[index]; c < first[index + 1]; ++c) {
      if (this.run.verdicts[verdict[c]].tone === "interference") places.push(new Vector3().fromArray(points, 3 * c));
    }
    if (!places.length) return null;
    const mean = places.reduce((sum, place) => sum.add(place), new Vector3()).divideScalar(places.length);
    return places.reduce((best, place) => (place.distanceTo(mean) < best.distanceTo(mean) ? place : best));
  }

  /** The contacts of the pose, or of all poses. */
  updateContacts() {
    const { track, index } = this.player;
    const { first, verdict, points, normals } = track.contacts;
    const { contacts, everywhere } = this.shown;
    const [begin, end] = !contacts ? [0, 0] : everywhere ? [0, verdict.length] : [first[index], first[index + 1]];
    const key = `${this.run.tracks.indexOf(track)} ${begin} ${end} ${everywhere && index}`;
    if (key === this.contactsShown) return;
    this.contactsShown = key;
    const byTone = new Map([...this.marks.keys()].map((tone) => [tone, []]));
    for (let c = begin; c < end; ++c) {
      byTone.get(this.run.verdicts[verdict[c]].tone).push(points[3 * c], points[3 * c + 1], points[3 * c + 2]);
    }
    byTone.set("clear", []); // apart and allowed: not drawn
    for (const [tone, places] of byTone) {
      const marks = this.marks.get(tone);
      marks.geometry.dispose();
      marks.geometry = new BufferGeometry();
      marks.geometry.setAttribute("position", new BufferAttribute(new Float32Array(places), 3));
      marks.material.size = everywhere ? 9 : 17;
      marks.visible = places.length > 0;
    }
    // Normals start on the part's side and end at the point.
    const lines = [];
    const [here, beyond] = contacts ? [first[index], first[index + 1]] : [0, 0];
    for (let c = here; c < beyond; ++c) {
      if (this.run.verdicts[verdict[c]].tone === "clear") continue;
      const at = [0, 1, 2].map((k) => points[3 * c + k]);
      lines.push(...at, ...at.map((value, k) => value - kNormal * normals[3 * c + k]));
    }
    this.contactLines.geometry.dispose();
    this.contactLines.geometry = new BufferGeometry();
    this.contactLines.geometry.setAttribute("position", new BufferAttribute(new Float32Array(lines), 3));
    this.contactLines.visible = lines.length > 0;
  }

  /** Highlights the blade that the pose must not touch but does. */
  updateBlades() {
    const { track, index, at } = this.player;
    if (!track.bladesHit) {
      track.bladesHit = new Map();
      for (const [place, verdict, , blade] of track.findings) {
        if (this.run.verdicts[verdict].tone !== "interference") continue;
        track.bladesHit.set(place, [...(track.bladesHit.get(place) ?? []), blade]);
      }
    }
    const hit = new Set([...(track.bladesHit.get(at) ?? []), ...(track.bladesHit.get(index) ?? [])]);
    for (const [blade, material] of this.blades) {
      material.emissive = new Color(hit.has(blade) && blade !== 0 ? kHit : "#000000");
      material.emissiveIntensity = hit.has(blade) ? 0.45 : 0;
      material.transparent = this.shown.glass;
      material.opacity = this.shown.glass ? 0.28 : 1;
      material.depthWrite = !this.shown.glass;
      if (material.wasGlass !== this.shown.glass) { material.needsUpdate = true; material.wasGlass = this.shown.glass; }
    }
  }

  updateBoxes() {
    const { boxes, near, level } = this.shown;
    this.boxCount = 0;
    if (boxes) this.boxCount = this.boxes.show(level, near ? this.pose.origin : null);
    else this.boxes.hide();
  }

  update() {
    this.place();
    this.blisk.visible = this.shown.blisk;
    this.tool.visible = this.shown.tool;
    if (this.side) this.side.visible = this.shown.side;
    this.numbers.visible = this.shown.numbers;
    this.updatePath();
    this.updateContacts();
    this.updateBlades();
    this.updateBoxes();
    this.draw();
  }

  /** "whole": the whole blisk; "tool": the working place, followed as the tool moves. */
  look(view) {
    this.follow = view !== "whole";
    const { origin, turn } = this.pose;
    const radial = new Vector3(origin.x, origin.y, 0).normalize();
    if (radial.lengthSq() === 0) radial.set(1, 0, 0);
    const up = new Vector3(0, 0, 1);
    if (view === "whole") {
      const sideways = up.clone().cross(radial);
      const direction = radial.clone().multiplyScalar(0.75).add(sideways.multiplyScalar(0.5)).addScaledVector(up, 0.85).normalize();
      const target = this.sphere.center.clone().addScaledVector(radial, 0.28 * this.sphere.radius);
      this.controls.target.copy(target);
      const narrow = Math.min(1, this.camera.aspect);
      this.camera.position.copy(target).addScaledVector(direction, (3.05 * this.sphere.radius) / narrow);
    } else {
      // From above, along the wheel's axis, leaning outward.
      this.aim = this.problem() ?? origin.clone();
      const axis = new Vector3(0, 0, 1).applyQuaternion(turn);
      if (axis.z < 0) axis.negate();
      const direction = axis.addScaledVector(radial, 0.55).normalize();
      this.controls.target.copy(this.aim);
      this.camera.position.copy(this.aim).addScaledVector(direction, 130);
    }
    this.controls.update();
    this.draw();
  }

  turnByKey(event) {
    const turns = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const zooms = { "+": 0.88, "=": 0.88, "-": 1.14 };
    const arm = this.camera.position.clone().sub(this.controls.target);
    if (turns[event.key]) {
      const [about, over] = turns[event.key];
      arm.applyAxisAngle(new Vector3(0, 0, 1), -0.08 * about);
      const side = new Vector3(0, 0, 1).cross(arm).normalize();
      const tilted = arm.clone().applyAxisAngle(side, -0.08 * over);
      if (Math.hypot(tilted.x, tilted.y) > 0.05 * tilted.length()) arm.copy(tilted);
    } else if (zooms[event.key]) {
      arm.multiplyScalar(zooms[event.key]);
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
    this.camera.position.copy(this.controls.target).add(arm);
    this.controls.update();
    this.draw();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Draws the numbers over the blades, those of the far side faintly. */
  fadeNumbers() {
    const { center } = this.sphere, towards = this.camera.position.clone().sub(center);
    for (const { position, material } of this.numbers.children) {
      material.opacity = position.clone().sub(center).dot(towards) < 0 ? 0.6 : 1;
    }
  }

  draw() {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.fadeNumbers();
      this.renderer.render(this.scene, this.camera);
    });
  }
}

