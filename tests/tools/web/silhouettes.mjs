// silhouettes.mjs BUILD REFERENCE FOLDER: compares the package in Chromium with the native library (reference.cpp), on
// built-in shapes and the models of RIMLINE_MODELS. Writes files to FOLDER.

import { execFileSync } from "node:child_process";
import { mkdirSync, rmSync } from "node:fs";
import { basename, join } from "node:path";
import { fileURLToPath } from "node:url";

import { withBrowser } from "../../../tools/web/chromium/browser.mjs";
import { chromium, models, skip } from "../../../tools/web/chromium/machine.mjs";

const [build, reference, folder] = process.argv.slice(2);
if (!chromium) skip("no Chromium: tools/install_packages.sh web");
const shapes = ["sphere:2000", "torus:3000", "knot:20000", "box", "spring:5000", "terrain:5000", "scene:20000"];
const all = [...shapes.map((shape) => `shape:${shape}`), ...models()];

const written = join(folder, "references");
mkdirSync(written, { recursive: true });
await withBrowser({ build, written, tests: fileURLToPath(new URL(".", import.meta.url)) }, async (browser) => {
  await browser.open("/");
  for (const model of all) {
    const name = basename(model).replaceAll(":", "_");
    execFileSync(reference, [model, join(written, name)]);
    const counts = await browser.evaluate(
      `import("/tests/comparison.mjs").then(({ compare }) => compare("/written/${name}"))`);
    rmSync(join(written, name));
    console.log(`${basename(model)}: ${counts.points} points, ${counts.found} edges, ${counts.changes} changes`);
  }
});
