// Builds the page of the replay, one file, from src/: node build.mjs [OUT]. The page is checked in as
// ../replay_page.html, so that building the program needs no npm; octoblisk inserts a run.
import { build } from "esbuild";
import { readFile, writeFile } from "node:fs/promises";

const here = (name) => new URL(name, import.meta.url);
const text = (name) => readFile(here(name), "utf8");
const version = async (library) => JSON.parse(await text(`node_modules/${library}/package.json`)).version;

const versions = { three: await version("three"), uplot: await version("uplot") };
const bundled = await build({
  entryPoints: [here("src/main.js").pathname],
  bundle: true, minify: true, write: false, format: "iife", target: "es2021", legalComments: "none", charset: "utf8",
  define: { THREE_VERSION: JSON.stringify(versions.three), UPLOT_VERSION: JSON.stringify(versions.uplot) },
});
const script = bundled.outputFiles[0].text.trim().replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
const style = (await text("src/style.css")).replace("@@UPLOT@@", await text("node_modules/uplot/dist/uPlot.min.css"));

const licences = [];
for (const library of ["three", "uplot"]) {
  const licence = (await text(`node_modules/${library}/LICENSE`)).trim().replaceAll("--", "- -");
  licences.push(`${library} ${versions[library]}\n\n${licence}`);
}
const notice = `<!-- Made by demos/report/web/build.mjs (./dev web); do not edit. It contains:\n\n${licences.join("\n\n")}\n-->`;
const page = (await text("src/index.html"))
  .replace("<!DOCTYPE html>", () => `<!DOCTYPE html>\n${notice}`)
  .replace("@@STYLE@@", () => style.trim())
  .replace("@@SCRIPT@@", () => script);
if (page.split("@@RUN@@").length !== 2) throw new Error("the page must have exactly one placeholder for the run");
await writeFile(process.argv[2] ?? here("../replay_page.html"), page);
