// bench.mjs BUILD PROGRAM MODEL: prints times of a frame in headless Chromium. BUILD is the build folder of tools/web,
// PROGRAM the native rimline, which reads the model.

import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

import { withBrowser } from "../chromium/browser.mjs";

const [build, program, model] = process.argv.slice(2);
const written = mkdtempSync(join(tmpdir(), "rimline-bench-"));
try {
  execFileSync(program, ["convert", model, "-o", join(written, "model.glb")]);
  await withBrowser({ build, written, bench: fileURLToPath(new URL(".", import.meta.url)) }, async (browser) => {
    await browser.open("/bench/index.html");
    const rows = await browser.evaluate(`import("/bench/measure.mjs").then(({ measure }) => measure("/written/model.glb"))`);
    const width = Math.max(...rows.map(({ name }) => name.length));
    for (const { name, value } of rows) console.log(`${name.padEnd(width)}  ${value}`);
  });
} finally {
  rmSync(written, { recursive: true });
}
