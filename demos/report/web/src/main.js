// Assembles the page: header, replay, chart, table, facts.
import { Chart } from "./chart.js";
import { Player } from "./player.js";
import { bladeText, readRun, sentenceOf } from "./run.js";
import { kBladeColors, ReplayScene } from "./scene.js";
import { kSigns, signSpan } from "./signs.js";
import { FindingsTable } from "./table.js";

performance.mark("begun");
const run = readRun();
performance.mark("read");
const player = new Player(run);
const $ = (id) => document.getElementById(id);

function fillHeader() {
  document.title = run.title;
  $("title").textContent = run.title;
  $("subtitle").textContent = run.subtitle;
  const tile = (name, value, unit, tone) => {
    const item = document.createElement("li"), number = document.createElement("b"), text = document.createElement("span");
    item.className = `tone-${tone}${value === 0 ? " none" : ""}`;
    number.append(`${kSigns[tone]} ${value}${unit}`);
    text.textContent = name;
    item.append(number, text);
    return item;
  };
  $("counts").replaceChildren(...run.counts.map(({ name, count, tone }) => tile(name, count, "", tone)));
  if (run.side) fillCoverage(run.side, tile);
  $("findings-title").textContent = run.findings.title;
}

/** The shares of the blade's side, and its cells as a map: root below, tip above. */
function fillCoverage({ region, shares, mesh, columns, colorOfCell, colors }, tile) {
  $("shares").replaceChildren(...shares.map(({ name, percent, tone }) => tile(name, percent, " %", tone)));
  const map = $("map"), rows = colorOfCell.length / columns, { vertices } = mesh;
  const corner = (k) => vertices.subarray(3 * k, 3 * k + 3);
  const length = (a, b) => Math.hypot(...corner(a).map((value, axis) => value - corner(b)[axis]));
  const width = length(0, columns), height = length(0, rows * (columns + 1));
  map.width = columns;
  map.height = rows;
  map.style.aspectRatio = `${width} / ${height}`;
  map.setAttribute("aria-label", `Map of the ${region}: ${shares.map(({ name, percent }) => `${name} ${percent} %`).join(", ")}`);
  const context = map.getContext("2d");
  colorOfCell.forEach((color, cell) => {
    context.fillStyle = colors[color].color;
    context.fillRect(cell % columns, rows - 1 - Math.floor(cell / columns), 1, 1);
  });
  $("coverage").hidden = false;
}

function fillFacts() {
  $("facts").replaceChildren(...run.facts.map(({ title, columns, rows }) => {
    const table = document.createElement("table");
    table.createCaption().textContent = title;
    if (columns.length) {
      const head = table.createTHead().insertRow();
      for (const name of columns) {
        const cell = document.createElement("th");
        cell.scope = "col";
        cell.textContent = name;
        head.append(cell);
      }
    }
    const body = table.createTBody();
    for (const row of rows) {
      const line = body.insertRow();
      row.forEach((text, i) => {
        const cell = document.createElement(i === 0 ? "th" : "td");
        if (i === 0) cell.scope = "row";
        cell.textContent = text;
        line.append(cell);
      });
    }
    return table;
  }), versions());
  $("notes").replaceChildren(...run.notes.map((note) => {
    const paragraph = document.createElement("p");
    paragraph.textContent = note;
    return paragraph;
  }));
}

/** The libraries that draw this page; the facts list the software that made the run. */
function versions() {
  const paragraph = document.createElement("p");
  paragraph.style.flexBasis = "100%";
  paragraph.textContent = `Drawn by three.js r${THREE_VERSION.split(".")[1]} and uPlot ${UPLOT_VERSION}, both under the MIT licence; its text is at the beginning of this file.`;
  return paragraph;
}

function fillLegend() {
  const items = [];
  const add = (color, text) => {
    const item = document.createElement("li"), patch = document.createElement("i");
    patch.style.background = color;
    item.append(patch, text);
    items.push(item);
  };
  if (run.ground_blade > 0) add(kBladeColors.ground, `ground blade ${run.ground_blade}`);
  add(`linear-gradient(90deg, ${kBladeColors.blades[0]} 50%, ${kBladeColors.blades[1]} 50%)`, run.ground_blade > 0 ? "other blades, hub" : run.blade_count ? "blades, hub" : "blisk");
  if (run.obstacles.length > 0) add(kBladeColors.obstacle, run.obstacles.join(", "));
  const byColor = new Map();
  for (const { color, name } of run.parts) byColor.set(color, [...(byColor.get(color) ?? []), name]);
  for (const [color, names] of byColor) add(color, names.join(", "));
  add("#c9705e", "blade with the problem");
  for (const { color, name } of run.side?.colors ?? []) add(color, name);
  const tones = new Set(["clear"]);
  for (const { name, tone } of run.verdicts) {
    if (tones.has(tone) || tone === "open") continue;
    tones.add(tone);
    const item = document.createElement("li");
    item.append(signSpan(tone), name);
    items.push(item);
  }
  $("legend").replaceChildren(...items);
}

function checkbox(text, checked, change) {
  const label = document.createElement("label"), box = document.createElement("input");
  box.type = "checkbox";
  box.checked = checked;
  box.onchange = () => change(box.checked);
  label.append(box, ` ${text}`);
  return label;
}

function fillTools(scene) {
  const views = ["whole", "tool"].map((view) => {
    const button = document.createElement("button");
    button.id = `look-${view}`;
    button.textContent = view === "whole" ? "Whole blisk" : "Close-up";
    button.onclick = () => { scene.look(view); tell(); };
    return button;
  });
  const tell = () => views.forEach((button, i) => button.setAttribute("aria-pressed", String(scene.follow === (i === 1))));
  tell();
  const flag = (text, name) => checkbox(text, scene.shown[name], (on) => { scene.shown[name] = on; scene.update(); });
  const level = document.createElement("select");
  level.id = "level";
  level.setAttribute("aria-label", "Level of the tree");
  for (let k = 0; k <= run.boxes.deepest; ++k) {
    const whole = k <= run.boxes.whole ? "" : ", only near touches";
    level.add(new Option(k === run.boxes.deepest ? `${k} (leaves${whole})` : `${k}${whole}`, k));
  }
  level.value = scene.shown.level;
  level.onchange = () => { scene.shown.level = Number(level.value); scene.update(); };
  const boxes = flag("cluster boxes, level", "boxes");
  boxes.firstChild.id = "boxes";
  const group = document.createElement("span");
  group.className = "group";
  group.append(boxes, " ", level, " ", flag("near the tool", "near"));
  $("tools").replaceChildren(...views, flag("tool", "tool"), flag("transparent blisk", "glass"), flag("contacts", "contacts"),
    flag("contacts of all poses", "everywhere"), flag("blade numbers", "numbers"),
    ...(run.side ? [flag(run.side.name, "side")] : []), group);
}

function connectPlayer() {
  $("scrub").max = player.last;
  $("number").max = player.last;
  $("step-word").textContent = run.step.one;
  $("scrub").oninput = () => { player.pause(); player.jump(Number($("scrub").value)); };
  $("number").onchange = () => { player.pause(); player.jump(Math.round(Number($("number").value) || 0)); };
  $("play").onclick = () => player.toggle();
  $("step-back").onclick = () => player.step(-1);
  $("step-on").onclick = () => player.step(1);
  $("problem-back").onclick = () => player.stepToProblem(-1);
  $("problem-on").onclick = () => player.stepToProblem(1);
  $("speed").onchange = () => { player.speed = Number($("speed").value); };
  if (run.tracks.length > 1) {
    $("track-label").hidden = false;
    for (const [i, track] of run.tracks.entries()) $("track").add(new Option(track.name, i));
    $("track").value = run.start.track;
    $("track").onchange = () => player.choose(Number($("track").value));
  }
  document.addEventListener("keydown", (event) => {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    const { target } = event;
    if (target.matches("select, input[type=number]")) return;
    const keys = {
      ArrowLeft: () => (event.shiftKey ? player.stepToProblem(-1) : player.step(-1)),
      ArrowRight: () => (event.shiftKey ? player.stepToProblem(1) : player.step(1)),
      Home: () => player.jump(0), End: () => player.jump(player.last),
    };
    if (event.key === " " && !target.matches("button, input")) keys[" "] = () => player.toggle();
    if (!keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });
}

function tellStatus() {
  const { track, index, at, last } = player;
  const finding = Number.isInteger(at) ? null : track.findings.find((each) => Math.abs(each[0] - at) < 1e-4);
  const verdict = run.verdicts[finding ? finding[1] : track.verdict[index]];
  const text = document.createElement("span");
  const where = `${run.step.one[0].toUpperCase()}${run.step.one.slice(1)} ${index}`;
  if (finding) {
    const part = finding[2] < 0 ? "" : `: ${run.parts[finding[2]].name} on ${bladeText(run, finding[3])}`;
    text.textContent = `Between ${run.step.many} ${Math.floor(at)} and ${Math.floor(at) + 1}, after ${(100 * (at - Math.floor(at))).toFixed(0)} % of the motion: ${verdict.name}${part}`;
  } else {
    text.textContent = `${where} of 0–${last}: ${sentenceOf(run, track, index)}`;
  }
  const status = $("status");
  status.setAttribute("aria-live", player.playing ? "off" : "polite");
  status.replaceChildren(signSpan(verdict.tone), text);
  $("view").setAttribute("aria-label", `Blisk and tool, ${text.textContent}`);
  $("scrub").value = index;
  $("scrub").setAttribute("aria-valuetext", text.textContent);
  if (document.activeElement !== $("number")) $("number").value = index;
  tellPlaying();
  const problems = player.problems();
  $("problem-back").disabled = !problems.some((each) => each < at - 1e-4);
  $("problem-on").disabled = !problems.some((each) => each > at + 1e-4);
}

/** Updates the button only when it changes: a press is lost if its target is replaced before the release. */
function tellPlaying() {
  const [sign, word] = player.playing ? ["❚❚", "Pause"] : ["▶", "Play"];
  if ($("play").querySelector(".word").textContent === word) return;
  $("play").innerHTML = `<span aria-hidden="true">${sign}</span> <span class="word">${word}</span>`;
}

function fillChartHead(chart) {
  const { title, stretch } = run.charts[chart.chart];
  const head = $("chart-title");
  if (run.charts.length > 1) {
    let select = head.querySelector("select");
    if (!select) {
      select = document.createElement("select");
      select.setAttribute("aria-label", "Content of the chart");
      run.charts.forEach((each, i) => select.add(new Option(each.title, i)));
      select.onchange = () => { chart.chart = Number(select.value); chart.rebuild(); fillChartHead(chart); };
      head.replaceChildren(select);
    }
  } else {
    head.textContent = title;
  }
  $("chart-key").replaceChildren(...chart.key());
  $("widen").parentElement.hidden = !stretch;
  const bad = player.track.verdict.reduce((sum, verdict) => sum + (run.verdicts[verdict].tone === "interference"), 0);
  $("chart").setAttribute("aria-label", `${title}, over the ${run.step.many} 0 to ${player.last}; ${bad} of them have interference. The table has the numbers.`);
}

fillHeader();
fillFacts();
fillLegend();
connectPlayer();
let scene = null;
try {
  scene = new ReplayScene($("view"), run, player);
  fillTools(scene);
} catch (error) {
  console.info(`no 3-D view: ${error.message}`);
  $("no-view").hidden = false;
  $("tools").hidden = $("legend").hidden = $("view").hidden = true;
}
performance.mark("scene");
const chart = new Chart($("chart"), run, player);
fillChartHead(chart);
$("widen").onchange = () => { chart.stretched = $("widen").checked; chart.rebuild(); };
const table = new FindingsTable(run, player);
let track = player.track;
player.onChange(() => {
  scene?.update();
  tellStatus();
  chart.update();
  table.update();
  if (track === player.track) return;
  track = player.track;
  fillChartHead(chart);
});
player.tell();
performance.mark("all");
// For tests and for experiments in the console.
window.octoblisk = { run, player, scene, chart, table };
document.body.dataset.ready = "true";
