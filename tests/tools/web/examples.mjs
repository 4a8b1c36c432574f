// examples.mjs BUILD PAGE: the examples in JavaScript of a page of docs run in Chromium.

import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

import { withBrowser } from "../../../tools/web/chromium/browser.mjs";
import { chromium, skip } from "../../../tools/web/chromium/machine.mjs";

const [build, page] = process.argv.slice(2);
if (!chromium) skip("no Chromium: tools/install_packages.sh web");
const examples = [...readFileSync(page, "utf-8").matchAll(/^```js\n(.*?)^```$/gms)].map(([, code]) => code);
if (examples.length === 0) throw new Error(`${page} has no examples`);
const bench = fileURLToPath(new URL("../../../tools/web/bench", import.meta.url));
await withBrowser({ build, bench }, async (browser) => {
  await browser.open("/bench/index.html"); // It says where modules are.
  for (const code of examples)
    await browser.evaluate(`import(URL.createObjectURL(new Blob([${JSON.stringify(code)}], { type: "text/javascript" })))`);
  if (browser.problems.length > 0) throw new Error(browser.problems.join("\n"));
});
console.log(`${examples.length} examples ran`);
