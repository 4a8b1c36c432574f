// page.mjs BUILD PROGRAM FOLDER: the page in Chromium. Writes pictures of it to FOLDER.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import test from "node:test";
import { setTimeout } from "node:timers/promises";
import { fileURLToPath } from "node:url";

import { withBrowser } from "../../../tools/web/chromium/browser.mjs";
import { chromium, models, skip } from "../../../tools/web/chromium/machine.mjs";

const [build, program, folder] = process.argv.slice(2);
if (!chromium) skip("no Chromium: tools/install_packages.sh web");
const made = join(folder, "page");
mkdirSync(made, { recursive: true });

const CORNERS = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
const FACES = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
const FILES = {
  "tetrahedron.obj": [...CORNERS.map((c) => `v ${c.join(" ")}`), ...FACES.map((f) => `f ${f.map((v) => v + 1).join(" ")}`)],
  "tetrahedron.ply": ["ply", "format ascii 1.0", "element vertex 4", "property float x", "property float y", "property float z",
    "element face 4", "property list uchar int vertex_indices", "end_header", ...CORNERS.map((c) => c.join(" ")), ...FACES.map((f) => `3 ${f.join(" ")}`)],
  "tetrahedron.stl": ["solid s", ...FACES.flatMap((f) => ["facet normal 0 0 0", "outer loop", ...f.map((v) => `vertex ${CORNERS[v].join(" ")}`), "endloop", "endfacet"]), "endsolid s"],
  "strips.ply": ["ply", "format ascii 1.0", "element vertex 3", "property float x", "property float y", "property float z",
    "element tristrips 1", "property list int int vertex_indices", "end_header", "0 0 0", "1 0 0", "0 1 0", "3 0 1 2"],
  "text.txt": ["v 0 0 0"],
  "broken.glb": ["glTF, but not really"],
  "text.glb": ["not a GLB"],
  "text.ply": ["not a PLY"],
  "nan.obj": ["v 0 0 0", "v nan 0 0", "v 0 1 0", "f 1 2 3"],
  "empty.obj": ["v 0 0 0"],
  // Too far out for a camera around it.
  "huge.obj": ["v 1e18 1e18 1e18", "v 1e18 -1e18 -1e18", "v -1e18 1e18 -1e18", "v -1e18 -1e18 1e18", ...FACES.map((f) => `f ${f.map((v) => v + 1).join(" ")}`)],
};
FILES["slow.obj"] = FILES["tetrahedron.obj"];
for (const [name, lines] of Object.entries(FILES)) writeFileSync(join(made, name), `${lines.join("\n")}\n`);
execFileSync(program, ["convert", "shape:knot:20000", "-o", join(made, "knot.glb")]);

await withBrowser({ build, made, tests: fileURLToPath(new URL(".", import.meta.url)), ...Object.fromEntries(models().map((model) => [`of_${basename(model)}`, dirname(model)])) }, async (browser) => {
  await browser.open("/build/page/index.html");
  const numberOf = async (id) => Number((await browser.evaluate(`document.getElementById("${id}").textContent`)).replaceAll(",", ""));
  const until = async (condition) => {
    for (let i = 0; i < 2400; ++i, await setTimeout(50)) if (await browser.evaluate(condition)) return;
    throw new Error(`${condition} did not come true: ${browser.problems.join("\n")}`);
  };
  const drop = (url) => browser.evaluate(`(async () => {
    document.getElementById("silhouette").textContent = "";
    const files = new DataTransfer();
    files.items.add(new File([await (await fetch("${url}")).arrayBuffer()], "${basename(url)}"));
    dispatchEvent(new DragEvent("drop", { dataTransfer: files, cancelable: true }));
  })()`);
  const shown = (name) => until(`document.getElementById("name").textContent === "${name}" && document.getElementById("silhouette").textContent !== ""`);
  // Pixels as dark as the lines, right of the panel.
  const darkPixels = async (name) => {
    const picture = await browser.screenshot({ x: 340, y: 0, width: 940, height: 740, scale: 1 });
    writeFileSync(join(made, `${name}.png`), await browser.screenshot());
    return browser.evaluate(`(async () => {
      const bitmap = await createImageBitmap(await (await fetch("data:image/png;base64,${picture.toString("base64")}")).blob());
      const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
      context.drawImage(bitmap, 0, 0);
      const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
      let dark = 0;
      for (let i = 0; i < data.length; i += 4) dark += data[i] < 60;
      return dark;
    })()`);
  };

  await test("it starts with a shape whose lines follow the camera", async () => {
    await shown("knot");
    await until(`Number(document.getElementById("written").textContent) > 0`);
    const edges = await numberOf("silhouette");
    assert.ok(edges > 500 && edges < 3000, `${edges} edges`);
    assert.ok((await darkPixels("start")) > 1500);
    await browser.evaluate(`document.getElementById("turn").click()`);
  });

  await test("it shows files of every kind that are dropped", async () => {
    for (const name of ["tetrahedron.obj", "tetrahedron.ply", "tetrahedron.stl", "knot.glb"]) {
      await drop(`/made/${name}`);
      await shown(name);
      const [faces, edges] = name.startsWith("knot") ? [await numberOf("faces"), await numberOf("silhouette")] : [4, 4];
      assert.equal(await numberOf("faces"), faces);
      assert.ok((await numberOf("silhouette")) <= edges && edges > 2, name);
      assert.ok((await darkPixels(name)) > 500, name);
    }
  });

  await test("a drag of the mouse turns the model, and the silhouette changes", async () => {
    const before = await numberOf("silhouette");
    for (const [type, x] of [["mousePressed", 700], ["mouseMoved", 760], ["mouseMoved", 900], ["mouseReleased", 900]])
      await browser.call("Input.dispatchMouseEvent", { type, x, y: 400, button: "left", buttons: 1, clickCount: 1 });
    await until(`document.getElementById("silhouette").textContent.replace(",", "") !== "${before}"`);
    await browser.evaluate(`document.getElementById("orthographic").click()`);
    // A busy machine draws the next frame later.
    for (let i = 0; i < 20 && (await darkPixels("orthographic")) <= 500; ++i) await setTimeout(500);
    assert.ok((await darkPixels("orthographic")) > 500);
    await browser.evaluate(`document.getElementById("orthographic").click()`);
  });

  await test("a file that cannot be shown is an error on the page", async () => {
    const before = await browser.evaluate(`document.getElementById("name").textContent`);
    const faces = await numberOf("faces");
    for (const [name, message] of [["text.txt", "expected a name that ends in"], ["strips.ply", "no triangles here but strips"], ["broken.glb", ""],
      ["text.glb", "not a GLB file"], ["nan.obj", "finite"], ["empty.obj", "no triangles here"], ["text.ply", ""]]) {
      await drop(`/made/${name}`);
      await until(`!document.getElementById("error").hidden && document.getElementById("error").textContent.includes("${name}")`);
      const said = await browser.evaluate(`document.getElementById("error").textContent`);
      assert.ok(said.includes(message), said);
      // The model before it stays, and is drawn.
      assert.equal(await browser.evaluate(`document.getElementById("name").textContent`), before);
      await setTimeout(300);
      assert.equal(await numberOf("faces"), faces);
      await until(`Number(document.getElementById("silhouette").textContent.replaceAll(",", "")) > 0`);
      assert.deepEqual(browser.problems, [], name);
    }
  });

  await test("of several files the one chosen last is shown, whichever is read last", async () => {
    await browser.evaluate(`{
      const read = Blob.prototype.arrayBuffer;
      Blob.prototype.arrayBuffer = async function () {
        if (this.name === "slow.obj") await new Promise((then) => setTimeout(then, 1000));
        return read.call(this);
      };
    }`);
    await drop("/made/slow.obj");
    await drop("/made/knot.glb");
    await shown("knot.glb");
    await setTimeout(1500);
    assert.equal(await browser.evaluate(`document.getElementById("name").textContent`), "knot.glb");
  });

  await test("the page goes on with a model that is too large to be looked at", async () => {
    await drop("/made/huge.obj");
    await setTimeout(1000);
    await drop("/made/tetrahedron.obj");
    await shown("tetrahedron.obj");
    assert.ok((await darkPixels("after_huge")) > 500);
    assert.deepEqual(browser.problems, []);
  });

  await test("every control can be reached by the keyboard", async () => {
    const order = await browser.evaluate(`[...document.querySelectorAll("#panel select, #panel input")]
      .map((control) => [control.id, control.offsetParent !== null || control === document.activeElement, control.tabIndex])`);
    for (const [id, isLaidOut, tabIndex] of order) assert.ok(isLaidOut && tabIndex === 0, id);
    assert.ok(order.some(([id]) => id === "file"));
  });

  for (const model of models().filter((model) => /\.(obj|ply|stl|glb)$/.test(model) && basename(model) !== "igea.ply"))
    await test(`it shows ${basename(model)}`, async () => {
      await drop(`/of_${basename(model)}/${basename(model)}`);
      await shown(basename(model));
      assert.ok((await darkPixels(basename(model))) > 500);
    });

  await test("the GPU holds the silhouette exactly", async () => {
    const compared = await browser.evaluate(`import("/tests/gpu_lines.mjs").then(({ compareBuffers }) => compareBuffers())`);
    assert.ok(compared > 5000, `${compared} lines`);
  });

  await test("the page warns of nothing", () => assert.deepEqual(browser.problems, []));
});
