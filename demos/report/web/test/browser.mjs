// Starts Debian's Chromium without network, for the tests and the pictures of the page.
import { chromium } from "playwright-core";

export async function openReport(file, { width = 1280, height = 900, timeout = 240_000 } = {}) {
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    timeout,
    args: ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
      "--disable-quic", "--no-first-run", "--disable-background-networking"],
  });
  const context = await browser.newContext({ viewport: { width, height }, offline: true });
  const page = await context.newPage();
  page.setDefaultTimeout(timeout);
  const problems = [], requests = [];
  page.on("console", (message) => { if (message.type() === "error") problems.push(message.text()); });
  page.on("pageerror", (error) => problems.push(error.message));
  const own = new URL(`file://${file}`).href;
  page.on("request", (request) => { if (!/^(data|blob):/.test(request.url()) && request.url() !== own) requests.push(request.url()); });
  const begin = performance.now();
  await page.goto(own);
  await page.waitForSelector("body[data-ready]");
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return { browser, page, problems, requests, seconds: (performance.now() - begin) / 1000 };
}
