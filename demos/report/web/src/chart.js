// Draws numbers over the path and marks poses with interference; a click jumps to a pose.
import uPlot from "uplot";
import { drawSign, kColors, kSigns } from "./signs.js";

const kStyles = [{ stroke: "#0a5c9e", width: 2 }, { stroke: "#7a3e9d", width: 2, dash: [7, 3] }, { stroke: "#00694a", width: 2, dash: [2, 3] }];
const kLimit = { stroke: "#21262e", width: 1, dash: [8, 4] };
const kOther = { stroke: "#8a93a0", width: 1.2, dash: [4, 4] };

export class Chart {
  constructor(element, run, player) {
    this.element = element;
    this.run = run;
    this.player = player;
    this.chart = 0;
    this.stretched = true;
    this.plot = null;
    new ResizeObserver(() => this.plot?.setSize(this.size())).observe(element);
    this.rebuild();
  }

  size() { return { width: Math.max(200, this.element.clientWidth), height: this.element.clientHeight }; }

  seriesShown() {
    const shown = this.player.track.series.filter((series) => series.chart === this.chart)
      .map((series, i) => ({ ...series, ...kStyles[i % kStyles.length] }));
    for (const track of this.run.tracks) {
      if (track === this.player.track) continue;
      const first = track.series.find((series) => series.chart === this.chart);
      if (first) shown.push({ ...first, ...kOther, name: `${first.name}, ${track.name}` });
    }
    return shown;
  }

  rebuild() {
    const { run, player } = this;
    const chart = run.charts[this.chart];
    const shown = this.seriesShown();
    this.track = player.track;
    this.plot?.destroy();
    const length = Math.max(...shown.map((series) => series.values.length), player.last + 1);
    const xs = Float64Array.from({ length }, (_, i) => i);
    const data = [xs, ...shown.map((series) => Array.from(series.values, (value) => (Number.isNaN(value) ? null : value)))];
    const stretched = this.stretched && chart.stretch;
    const y = stretched ? { distr: 4, asinh: chart.stretch, range: (plot, low, high) => [
      4 * Math.min(low, -chart.stretch), 1.3 * Math.max(high, chart.stretch)] } : { range: (plot, low, high) => {
      const room = 0.06 * (high - low || 1);
      return [low - 2.5 * room, high + room]; // leaves room for the signs
    } };
    const axis = { stroke: "#21262e", font: "12px system-ui, sans-serif", labelFont: "12px system-ui, sans-serif",
      grid: { stroke: "#dfe4ea", width: 1 }, ticks: { stroke: "#8a93a0", width: 1 } };
    this.plot = new uPlot({
      ...this.size(),
      padding: [8, 12, 0, 0],
      legend: { show: false },
      cursor: { points: { show: false }, drag: { x: true, y: false } },
      scales: { x: { time: false }, y },
      axes: [{ ...axis, label: run.step.one, labelSize: 18, size: 34 },
        { ...axis, label: chart.unit, labelSize: 20, size: 52,
          ...(stretched ? { splits: (plot, axisIndex, low, high) => splitsOf(low, high, chart.stretch),
            values: labelsOf, filter: (plot, splits) => splits } : {}) }],
      series: [{}, ...shown.map(({ name, stroke, width, dash }) => ({ label: name, stroke, width, dash, points: { show: false } }))],
      hooks: {
        drawClear: [(plot) => this.drawBands(plot)],
        draw: [(plot) => { this.drawLimits(plot, chart); this.drawSigns(plot); this.drawPlace(plot); }],
        ready: [(plot) => this.listen(plot)],
      },
    }, data, this.element);
    this.shown = shown;
  }

  listen(plot) {
    let down = 0;
    plot.over.addEventListener("mousedown", (event) => { down = event.clientX; });
    plot.over.addEventListener("click", (event) => {
      if (Math.abs(event.clientX - down) > 3) return;
      this.player.pause();
      this.player.jump(Math.round(plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x")));
    });
  }

  /** Hatches the poses with interference. */
  drawBands(plot) {
    const { ctx, bbox } = plot;
    const { verdict } = this.player.track;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    const bad = (i) => this.run.verdicts[verdict[i]].tone === "interference";
    for (let first = 0; first < verdict.length; ++first) {
      if (!bad(first)) continue;
      let last = first;
      while (last + 1 < verdict.length && bad(last + 1)) ++last;
      const left = plot.valToPos(first - 0.5, "x", true), right = plot.valToPos(last + 0.5, "x", true);
      const width = Math.max(2, right - left);
      ctx.fillStyle = "#fbe3db";
      ctx.fillRect(left, bbox.top, width, bbox.height);
      ctx.save();
      ctx.beginPath();
      ctx.rect(left, bbox.top, width, bbox.height);
      ctx.clip();
      ctx.strokeStyle = "#e9b5a4";
      ctx.lineWidth = 1;
      ctx.beginPath();
      for (let x = left - bbox.height - ((left - bbox.height) % 10); x < left + width; x += 10) {
        ctx.moveTo(x, bbox.top + bbox.height);
        ctx.lineTo(x + bbox.height, bbox.top);
      }
      ctx.stroke();
      ctx.restore();
      first = last;
    }
    ctx.restore();
  }

  drawLimits(plot, chart) {
    const { ctx, bbox } = plot;
    const ratio = devicePixelRatio;
    ctx.save();
    for (const { value } of chart.limits) {
      const y = plot.valToPos(value, "y", true);
      if (y < bbox.top || y > bbox.top + bbox.height) continue;
      ctx.strokeStyle = kLimit.stroke;
      ctx.setLineDash([8 * ratio, 4 * ratio]);
      ctx.lineWidth = ratio;
      ctx.beginPath();
      ctx.moveTo(bbox.left, y);
      ctx.lineTo(bbox.left + bbox.width, y);
      ctx.stroke();
    }
    ctx.restore();
  }

  /** Draws the signs of the findings at the bottom of the chart, as many as there is room for. */
  drawSigns(plot) {
    const { ctx, bbox } = plot;
    const size = 9 * devicePixelRatio, y = bbox.top + bbox.height - size;
    const reached = { interference: -1e9, near: -1e9, open: -1e9 };
    for (const [at, verdict] of this.player.track.findings) {
      const { tone } = this.run.verdicts[verdict];
      const x = plot.valToPos(at, "x", true);
      if (x < bbox.left || x > bbox.left + bbox.width || x < reached[tone] + 0.9 * size) continue;
      drawSign(ctx, tone, x, y - (tone === "interference" ? 0 : 1.2 * size), size);
      reached[tone] = x;
    }
  }

  drawPlace(plot) {
    const { ctx, bbox } = plot;
    const x = plot.valToPos(this.player.at, "x", true);
    if (x < bbox.left || x > bbox.left + bbox.width) return;
    const ratio = devicePixelRatio;
    ctx.save();
    ctx.fillStyle = ctx.strokeStyle = "#000";
    ctx.lineWidth = 2 * ratio;
    ctx.setLineDash([]);
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.beginPath();
    ctx.moveTo(x - 6 * ratio, bbox.top - 6 * ratio);
    ctx.lineTo(x + 6 * ratio, bbox.top - 6 * ratio);
    ctx.lineTo(x, bbox.top + 3 * ratio);
    ctx.fill();
    ctx.restore();
  }

  update() {
    if (this.track !== this.player.track) this.rebuild();
    else this.plot.redraw(false);
  }

  /** The legend, as elements. */
  key() {
    const line = ({ name, stroke, width, dash }) => `<svg width="26" height="10" aria-hidden="true"><line x1="0" x2="26" y1="5" y2="5" stroke="${stroke}" stroke-width="${width}" stroke-dasharray="${(dash ?? []).join(" ")}"/></svg>`;
    const { limits } = this.run.charts[this.chart];
    const lines = limits.length ? [...this.shown, { ...kLimit, name: limits.map(({ name }) => name).join("; ") }] : this.shown;
    const spans = lines.map((series) => {
      const span = document.createElement("span");
      span.innerHTML = line(series);
      span.append(series.name);
      return span;
    });
    const bad = document.createElement("span");
    bad.innerHTML = `<b style="color:${kColors.interference}" aria-hidden="true">${kSigns.interference}</b> hatched: `;
    bad.append(this.run.verdicts.find((verdict) => verdict.tone === "interference").name);
    return [...spans, bad];
  }
}

/** Labels 0 and, going outward, every split that has room beside the previous label. */
function labelsOf(plot, splits) {
  const room = 13; // pixels
  const labels = splits.map(() => "");
  const zero = splits.indexOf(0);
  for (const direction of [1, -1]) {
    let taken = null;
    for (let i = zero; i >= 0 && i < splits.length; i += direction) {
      const place = plot.valToPos(splits[i], "y");
      if (taken !== null && Math.abs(place - taken) < room) continue;
      taken = place;
      labels[i] = String(Number(splits[i].toPrecision(3))).replace("-", "−");
    }
  }
  return labels;
}

/** Round numbers on a scale that is linear below `linear` and logarithmic beyond. */
function splitsOf(low, high, linear) {
  const steps = [0];
  for (let value = linear; value <= Math.max(Math.abs(low), Math.abs(high)); value *= 10) {
    if (value <= high) steps.push(value);
    if (-value >= low) steps.unshift(-value);
  }
  return steps;
}
