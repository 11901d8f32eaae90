// Takes pictures of a report at two window sizes: node test/shoot.mjs REPORT.html FOLDER
import { mkdir } from "node:fs/promises";
import { join, resolve } from "node:path";
import { openReport } from "./browser.mjs";

const [file, folder] = process.argv.slice(2).map((name) => resolve(name));
await mkdir(folder, { recursive: true });
for (const [name, width, height] of [["wide", 1440, 900], ["narrow", 820, 1180]]) {
  const { browser, page, problems } = await openReport(file, { width, height });
  await page.screenshot({ path: join(folder, `${name}.png`) });
  await page.click("#look-tool");
  await page.check("#boxes");
  await page.waitForTimeout(500);
  await page.screenshot({ path: join(folder, `${name}-close.png`), fullPage: true });
  if (problems.length) console.log(name, problems);
  await browser.close();
}
