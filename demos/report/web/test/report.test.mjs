// Tests a report in a real browser without network: REPORT=…/report.html [BIG_REPORT=…] node --test test/
import assert from "node:assert/strict";
import { resolve } from "node:path";
import { after, before, test } from "node:test";
import { openReport } from "./browser.mjs";

const kOpensWithin = Number(process.env.OPENS_WITHIN ?? 5); // seconds
let report;
before(async () => { report = await openReport(resolve(process.env.REPORT)); });
after(async () => { await report?.browser.close(); });

const at = () => report.page.evaluate(() => window.octoblisk.player.at);
const rows = () => report.page.locator("#table tbody tr").count();
const jump = (to) => report.page.evaluate((place) => window.octoblisk.player.jump(place), to);
/** The picture, as numbers that differ where it does. */
const picture = () => report.page.evaluate(() => new Promise((done) => {
  requestAnimationFrame(() => requestAnimationFrame(() => {
    const canvas = document.getElementById("view"), small = document.createElement("canvas");
    small.width = small.height = 96;
    const context = small.getContext("2d", { willReadFrequently: true });
    context.drawImage(canvas, 0, 0, 96, 96);
    done([...context.getImageData(0, 0, 96, 96).data]);
  }));
}));
const differing = (a, b) => a.filter((value, i) => Math.abs(value - b[i]) > 12).length;

test("opens without an error and without a request", async () => {
  assert.deepEqual(report.problems, []);
  assert.deepEqual(report.requests, []);
  assert.ok(report.seconds < kOpensWithin, `${report.seconds} s`);
  assert.notEqual(await report.page.title(), "");
  console.log(`opened in ${report.seconds.toFixed(2)} s`);
});

test("the counts in the header match the poses", async () => {
  const [counts, verdicts] = await report.page.evaluate(() => {
    const { run } = window.octoblisk;
    return [run.counts.map((each) => [each.name, each.count]), run.verdicts.map((each, i) => [each.name,
      run.tracks[0].verdict.filter((verdict) => verdict === i).length])];
  });
  const found = new Map(verdicts);
  for (const [name, count] of counts) if (found.get(name)) assert.equal(count, found.get(name), name);
});

test("the scene is drawn, and the replay changes it", async () => {
  await jump(0);
  const first = await picture();
  assert.ok(first.some((value) => value !== first[0]), "a blank picture");
  await report.page.selectOption("#speed", "5");
  await report.page.click("#play");
  await report.page.waitForFunction(() => window.octoblisk.player.at > 10);
  await report.page.click("#play", { delay: 300 }); // held as by a hand, over many frames
  const reached = await at();
  assert.ok(reached > 10);
  assert.ok(differing(first, await picture()) > 20, "the picture does not change");
  await report.page.waitForTimeout(200);
  assert.equal(await at(), reached, "it continues when paused");
});

test("the first view shows the coverage", async () => {
  assert.match(await report.page.textContent("#title"), /Ground: [\d.]+ % of the convex side of blade 1/);
  const shares = await report.page.locator("#shares b").allTextContents();
  assert.equal(shares.length, 4);
  const sum = shares.reduce((all, text) => all + Number(text.match(/[\d.]+/)[0]), 0);
  assert.ok(Math.abs(sum - 100) < 1e-9, `${sum}`);
  const map = await report.page.locator("#map").boundingBox();
  assert.ok(map.width > 20 && map.height > 20 && map.y + map.height < 900, JSON.stringify(map));
});

test("a click on a row jumps to its pose", async () => {
  const row = report.page.locator("#table tbody tr").nth(3);
  const place = Number(await row.getAttribute("data-at"));
  await jump(0);
  await row.click();
  assert.equal(await at(), place);
  assert.equal(await row.getAttribute("aria-current"), "true");
  assert.match(await report.page.textContent("#status"), new RegExp(`${Math.round(place)}`));
});

test("a row is reached and pressed by keyboard", async () => {
  await jump(0);
  const button = report.page.locator("#table tbody tr button").nth(1);
  await button.focus();
  await report.page.keyboard.press("Enter");
  const place = await report.page.locator("#table tbody tr").nth(1).getAttribute("data-at");
  assert.equal(await at(), Number(place));
});

test("a click on the chart jumps", async () => {
  await jump(0);
  await report.page.locator("#chart").scrollIntoViewIfNeeded();
  const over = await report.page.locator("#chart .u-over").boundingBox();
  await report.page.mouse.click(over.x + 0.75 * over.width, over.y + 0.5 * over.height);
  const last = await report.page.evaluate(() => window.octoblisk.player.last);
  assert.ok(Math.abs((await at()) - 0.75 * last) < 0.02 * last + 1);
});

test("the filters and the sorting work", async () => {
  const all = await report.page.evaluate(() => window.octoblisk.player.track.findings.length);
  const choices = await report.page.locator("#filter-verdict option").allTextContents();
  assert.ok(choices.length > 2, "only one verdict");
  let sum = 0;
  for (const choice of choices.slice(1)) {
    await report.page.selectOption("#filter-verdict", choice);
    const shown = await report.page.evaluate(() => window.octoblisk.table.rows.length);
    assert.ok(shown > 0 && shown < all);
    assert.equal(await rows(), Math.min(100, shown));
    for (const text of await report.page.locator("#table tbody tr td:nth-child(2)").allTextContents()) assert.ok(text.includes(choice));
    sum += shown;
  }
  assert.equal(sum, all);
  await report.page.selectOption("#filter-verdict", "");
  await report.page.locator("#table thead th button").last().click();
  const values = (await report.page.locator("#table tbody tr td:last-child").allTextContents()).filter((text) => text !== "–").map((text) => Number(text.replace("−", "-")));
  assert.deepEqual(values, [...values].sort((a, b) => a - b));
  await report.page.locator("#table thead th button").last().click();
  assert.equal(await report.page.locator("#table thead th").last().getAttribute("aria-sort"), "descending");
  await report.page.locator("#table thead th button").first().click();
});

test("problems are stepped through, by button and by key", async () => {
  await jump(0);
  const problems = await report.page.evaluate(() => window.octoblisk.player.problems());
  await report.page.click("#problem-on");
  assert.equal(await at(), problems.find((place) => place > 0));
  await report.page.evaluate(() => document.activeElement.blur());
  await report.page.keyboard.press("Shift+ArrowRight");
  assert.equal(await at(), problems.filter((place) => place > 0)[1]);
  await report.page.keyboard.press("ArrowRight");
  await report.page.keyboard.press("Home");
  assert.equal(await at(), 0);
});

test("the boxes of every level can be shown", async () => {
  await report.page.check("#boxes");
  const levels = await report.page.locator("#level option").count();
  assert.ok(levels > 3);
  let before = 0;
  const near = report.page.getByLabel("near the tool");
  await near.uncheck();
  for (let level = 0; level < Math.min(4, levels); ++level) {
    await report.page.selectOption("#level", String(level));
    const shown = await report.page.evaluate(() => window.octoblisk.scene.boxCount);
    assert.ok(shown > before, `level ${level} has ${shown} boxes, but the level above has ${before}`);
    before = shown;
  }
  await near.check();
  assert.ok((await report.page.evaluate(() => window.octoblisk.scene.boxCount)) < before);
  await report.page.uncheck("#boxes");
});

test("every control has a name, and no text is faint", async () => {
  const nameless = await report.page.evaluate(() => [...document.querySelectorAll("button, input, select, canvas:not(#chart canvas)")]
    .filter((each) => each.offsetParent && !each.textContent.trim() && !each.ariaLabel && !each.labels?.length).map((each) => each.outerHTML));
  assert.deepEqual(nameless, []);
  const faint = await report.page.evaluate(() => {
    const light = (color) => {
      const [r, g, b] = color.match(/[\d.]+/g).map((value) => {
        const part = value / 255;
        return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
      });
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const behind = (element) => {
      for (let each = element; each; each = each.parentElement) {
        const color = getComputedStyle(each).backgroundColor;
        if (!/, 0\)$/.test(color)) return color;
      }
      return "rgb(255, 255, 255)";
    };
    const found = [];
    for (const element of document.querySelectorAll("body *:not(script):not(style):not(noscript)")) {
      const own = [...element.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
      if (!own || !element.offsetParent || element.closest(":disabled")) continue;
      const [a, b] = [light(getComputedStyle(element).color), light(behind(element))];
      const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
      if (ratio < 4.5) found.push(`${element.tagName} ${element.textContent.trim().slice(0, 30)} ${ratio.toFixed(2)}`);
    }
    return found;
  });
  assert.deepEqual(faint, []);
});

test("no error was logged", () => {
  assert.deepEqual(report.problems, []);
  assert.deepEqual(report.requests, []);
});

test("a blisk of 1.5 million triangles opens as fast", { skip: !process.env.BIG_REPORT }, async () => {
  const big = await openReport(resolve(process.env.BIG_REPORT));
  try {
    assert.deepEqual(big.problems, []);
    assert.deepEqual(big.requests, []);
    assert.match(await big.page.textContent("#notes"), /Simplified for display/);
    console.log(`the big one opened in ${big.seconds.toFixed(2)} s`);
    assert.ok(big.seconds < kOpensWithin, `${big.seconds} s`);
  } finally {
    await big.browser.close();
  }
});
