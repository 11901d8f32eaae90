// Checks the glTF file with Khronos' validator: RUN_GLB=…/run.glb node --test test/
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import validator from "gltf-validator";

test("run.glb is valid glTF 2.0, without a warning", async () => {
  const { issues, info } = await validator.validateBytes(new Uint8Array(await readFile(process.env.RUN_GLB)));
  assert.equal(issues.numErrors, 0, JSON.stringify(issues.messages.slice(0, 5)));
  assert.equal(issues.numWarnings, 0, JSON.stringify(issues.messages.slice(0, 5)));
  assert.ok(info.animationCount > 0);
  console.log(`${info.totalTriangleCount} triangles, ${info.drawCallCount} draw calls, ${info.animationCount} animation(s), `
    + `${info.materialCount} materials; errors ${issues.numErrors}, warnings ${issues.numWarnings}, infos ${issues.numInfos}`);
});
