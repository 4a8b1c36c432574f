// api.mjs BUILD: the package in Node, with --expose-gc.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join, relative } from "node:path";
import test from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";

const [build] = process.argv.slice(2);
const folder = pathToFileURL(join(build, "package/"));
const { createRimline } = await import(new URL("rimline.mjs", folder));
const { Mesh, Tracker } = await createRimline();

// The box [-1, 1]^3. Corner i has the signs of the bits of i.
const CORNERS = Array.from({ length: 8 }, (_, i) => [i & 1, i & 2, i & 4].map((bit) => (bit ? 1 : -1))).flat();
const QUADS = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
const TRIANGLES = QUADS.flatMap(([a, b, c, d]) => [a, b, c, a, c, d]);
const box = () => new Mesh(new Float32Array(CORNERS), new Uint32Array(TRIANGLES));

const ends = (mesh, edges) =>
  Array.from(edges, (edge) => [...mesh.edges.subarray(2 * edge, 2 * edge + 2)].sort((a, b) => a - b).join("-")).sort();

test("a box has the hexagon of its corner as silhouette, and the square of its side", () => {
  const mesh = box();
  assert.deepEqual([mesh.vertexCount, mesh.faceCount, mesh.edgeCount, mesh.borderCount], [8, 12, 18, 0]);
  assert.deepEqual([mesh.isClosed, mesh.isOriented, mesh.center], [true, true, [0, 0, 0]]);
  assert.ok(Math.abs(mesh.radius - Math.sqrt(3)) < 1e-12);
  const hexagon = ["1-3", "1-5", "2-3", "2-6", "4-5", "4-6"];
  assert.deepEqual(ends(mesh, mesh.silhouette([4, 5, 6])), hexagon);
  assert.deepEqual(ends(mesh, mesh.silhouette({ x: 4, y: 5, z: 6 })), hexagon);
  assert.deepEqual(ends(mesh, mesh.silhouette({ direction: [4, 5, 6] })), hexagon);
  assert.deepEqual(ends(mesh, mesh.silhouette({ length: 3, 0: 4, 1: 5, 2: 6 })), hexagon);
  assert.deepEqual(ends(mesh, mesh.silhouette([9, 0, 0])), ["1-3", "1-5", "3-7", "5-7"]);
  assert.equal(mesh.silhouette([0, 0, 0]).length, 0);
});

test("a tracker goes from one silhouette to the next by its changes", () => {
  const mesh = box();
  const tracker = new Tracker(mesh, [4, 5, 6]);
  const slots = Array.from(tracker.silhouette);
  const edges = new Set(slots);
  for (const eye of [[4, 5, -6], { direction: [-1, 2, -3] }, [0.5, 0.5, 0.5], [4, -5, 6], [9, 0, 0]]) {
    const change = tracker.moveTo(eye);
    change.removed.forEach((edge) => assert.ok(edges.delete(edge)));
    change.added.forEach((edge) => edges.add(edge));
    for (let i = 0; i < change.slots.length; i += 2) slots[change.slots[i]] = change.slots[i + 1];
    slots.length = tracker.silhouette.length;
    assert.deepEqual(slots, Array.from(tracker.silhouette));
    assert.deepEqual(Uint32Array.from(slots).sort(), mesh.silhouette(eye));
    assert.deepEqual(edges, new Set(slots));
  }
});

test("any number of errors leaves the module as it was", () => {
  const mesh = box();
  const expected = Array.from(mesh.silhouette([4, 5, 6]));
  for (let i = 0; i < 20000; ++i) {
    assert.throws(() => new Mesh([NaN, 0, 0], []), /positions: a coordinate of vertex 0/);
    if (i % 1000 === 0) assert.deepEqual(Array.from(mesh.silhouette([4, 5, 6])), expected);
  }
  assert.deepEqual(Array.from(new Tracker(box(), [4, 5, 6]).silhouette).sort(), expected.sort());
});

test("split vertices are one, unless welding is off", () => {
  const soup = new Float32Array(TRIANGLES.flatMap((corner) => CORNERS.slice(3 * corner, 3 * corner + 3)));
  const welded = new Mesh(soup);
  assert.deepEqual([welded.vertexCount, welded.edgeCount, welded.borderCount], [8, 18, 0]);
  assert.ok(welded.edges.every((vertex) => vertex < 36));
  const split = new Mesh(soup, null, { weld: false });
  assert.deepEqual([split.vertexCount, split.edgeCount, split.borderCount, split.isClosed], [36, 36, 36, false]);
});

test("positions and indices may be any arrays of numbers", () => {
  const expected = box().silhouette([4, 5, 6]);
  for (const positions of [CORNERS, new Float32Array(CORNERS), new Float64Array(CORNERS)])
    for (const indices of [TRIANGLES, ...[Uint8Array, Uint16Array, Uint32Array, Int32Array].map((Type) => new Type(TRIANGLES))])
      assert.deepEqual(new Mesh(positions, indices).silhouette([4, 5, 6]), expected);
});

test("meshes without faces, and of faces without a plane, have no silhouette", () => {
  for (const mesh of [new Mesh([]), new Mesh([1, 2, 3], []), new Mesh([0, 0, 0, 1, 1, 1, 2, 2, 2], [0, 1, 2, 0, 0, 1])]) {
    assert.equal(mesh.silhouette([4, 5, 6]).length, 0);
    const tracker = new Tracker(mesh, [4, 5, 6]);
    assert.equal(tracker.moveTo({ direction: [0, 0, 1] }).added.length, 0);
  }
});

test("wrong input is an error that says what is wrong", () => {
  const mesh = box();
  const tracker = new Tracker(mesh, [4, 5, 6]);
  const wrong = [
    [() => new Mesh(), /^TypeError: positions: expected a Float32Array/],
    [() => new Mesh("1,2,3"), /^TypeError: positions: expected a Float32Array/],
    [() => new Mesh(new Uint8Array(3)), /^TypeError: positions: expected a Float32Array/],
    [() => new Mesh([1, 2, "3"]), /^TypeError: positions\[2\]: expected .*, not 3$/],
    [() => new Mesh([1, , 3]), /^TypeError: positions\[1\]: expected .*, not undefined$/],
    [() => new Mesh([1, 2]), /^RangeError: positions: expected a multiple of three numbers, not 2$/],
    [() => new Mesh([1, 2, 3]), /^RangeError: positions: without indices, expected three vertices/],
    [() => new Mesh([1, 2, NaN], [0, 0, 0]), /^Error: positions: a coordinate of vertex 0 is not a finite number/],
    [() => new Mesh([...CORNERS, 0, Infinity, 0], TRIANGLES), /^Error: positions: a coordinate of vertex 8 /],
    [() => new Mesh(new Float64Array([1e300, 0, 0]), []), /^Error: positions: a coordinate of vertex 0 /],
    [() => new Mesh(CORNERS, [0, 1]), /^RangeError: indices: expected a multiple of three numbers, not 2$/],
    [() => new Mesh(CORNERS, new Float32Array(3)), /^TypeError: indices: expected an array of the numbers of vertices/],
    [() => new Mesh(CORNERS, [0, 1, 1.5]), /^TypeError: indices\[2\]: .*, not 1.5$/],
    [() => new Mesh(CORNERS, [0, 1, -1]), /^TypeError: indices\[2\]: .*, not -1$/],
    [() => new Mesh(CORNERS, [0, 1, 2, 0, 1, 8]), /^Error: indices: triangle 1 has vertex 8 of 8$/],
    [() => new Mesh(CORNERS, new Int8Array([0, 1, -1])), /^TypeError: indices\[2\]: .*, not -1$/],
    [() => new Mesh(CORNERS.map((c) => c * 2 ** -60), TRIANGLES), /^Error: the mesh is too small/],
    [() => mesh.silhouette(), /^TypeError: eye: expected three numbers, or x, y and z$/],
    [() => mesh.silhouette([1, 2]), /^RangeError: eye: expected three numbers, not 2$/],
    [() => mesh.silhouette(["1", 2, 3]), /^TypeError: eye: expected three numbers/],
    [() => mesh.silhouette([1, 2, NaN]), /^RangeError: eye: expected finite numbers within 2\^60, not NaN$/],
    [() => mesh.silhouette({ direction: [0, 0, 0] }), /^RangeError: direction: expected a vector that is not zero$/],
    [() => mesh.silhouette({ direction: [0, 1e-30, 0] }), /^RangeError: direction: expected a vector that is not zero$/],
    [() => tracker.moveTo([0, 2 ** 61, 0]), /^RangeError: eye: expected finite numbers within 2\^60/],
    [() => tracker.moveTo(null), /^TypeError: eye: expected three numbers/],
    [() => new Tracker(mesh), /^TypeError: eye: expected three numbers/],
    [() => new Tracker({}, [1, 2, 3]), /^TypeError: mesh: expected a Mesh of the same createRimline\(\)$/],
    [() => new Tracker(null, [1, 2, 3]), /^TypeError: mesh: expected a Mesh/],
  ];
  for (const [call, message] of wrong) assert.throws(call, message);
  assert.deepEqual(ends(mesh, tracker.moveTo([4, 5, 6]) && tracker.silhouette), ends(mesh, mesh.silhouette([4, 5, 6])));
});

test("meshes of other instances are refused", async () => {
  const other = await createRimline();
  assert.throws(() => new other.Tracker(box(), [1, 2, 3]), /^TypeError: mesh: expected a Mesh of the same/);
});

test("use after dispose() throws, and a tracker keeps what it needs of its mesh", () => {
  const mesh = box();
  const tracker = new Tracker(mesh, [4, 5, 6]);
  mesh.dispose();
  mesh.dispose();
  for (const use of [() => mesh.edges, () => mesh.radius, () => mesh.silhouette([1, 2, 3]), () => new Tracker(mesh, [1, 2, 3])])
    assert.throws(use, /^Error: this object was disposed of$/);
  const change = tracker.moveTo([-4, 5, 6]);
  assert.equal(change.added.length, change.removed.length);
  tracker.dispose();
  tracker.dispose();
  for (const use of [() => tracker.moveTo([1, 2, 3]), () => tracker.silhouette, () => change.added])
    assert.throws(use, /^Error: this object was disposed of$/);
});

test("arrays of a change are read whole after the memory grew, and not after the next move", () => {
  const tracker = new Tracker(box(), [4, 5, 6]);
  const change = tracker.moveTo([-4, 5, 6]);
  const before = change.added;
  const added = Array.from(before);
  assert.ok(added.length > 0);
  const big = [];
  while (before.buffer.byteLength > 0) big.push(new Mesh(new Float32Array(3_000_000), []));
  assert.deepEqual(Array.from(change.added), added);
  tracker.moveTo([4, 5, 6]);
  assert.throws(() => change.added, /^Error: this change ended when its tracker moved again$/);
  big.forEach((mesh) => mesh.dispose());
});

test("memory that does not suffice is an error, after which all goes on", () => {
  assert.throws(() => new Mesh(CORNERS, new Uint32Array(2 ** 30 - 1)), /^Error: out of memory$/);
  assert.equal(box().silhouette([4, 5, 6]).length, 6);
});

test("what nobody holds is freed", async () => {
  const rimline = await createRimline();
  const memory = () => new rimline.Tracker(new rimline.Mesh(CORNERS, TRIANGLES), [4, 5, 6]).silhouette.buffer.byteLength;
  const first = memory();
  for (let round = 0; round < 40; ++round) {
    for (let i = 0; i < 5; ++i) new rimline.Mesh(new Float32Array(150_000), Array(50_000 * 3).fill(0));
    globalThis.gc();
    await new Promise((resolve) => setTimeout(resolve));
  }
  assert.ok(memory() < first + 40e6, `${first} bytes became ${memory()}`);
});

test("arrays of a tracker that nobody holds stay whole", async () => {
  const rimline = await createRimline();
  const mesh = new rimline.Mesh(CORNERS, TRIANGLES);
  const views = [];
  for (let i = 0; i < 200; ++i) {
    const tracker = new rimline.Tracker(mesh, [9, 0, 0]);
    views.push(tracker.moveTo([4, 5, 6]).added, tracker.silhouette);
  }
  const copies = views.map((view) => view.slice());
  for (let round = 0; round < 5; ++round) {
    globalThis.gc();
    await new Promise((resolve) => setTimeout(resolve));
  }
  for (let i = 0; i < 50; ++i) new rimline.Tracker(mesh, [-9, 1, 0]); // They would take freed memory.
  assert.deepEqual(views, copies);
});

test("random arguments never end in a trap", () => {
  let seed = 7;
  const random = (count) => (seed = (seed * 48271) % 2147483647) % count;
  const numbers = [0, 1, -1, 0.5, 3, 7, 8, 1e-40, 1e20, -1e18, 2 ** 60, NaN, Infinity, 2 ** 32, "1", null, undefined, {}];
  const wild = (count) => Array.from({ length: count }, () => numbers[random(numbers.length)]);
  const tame = (count) => Array.from({ length: count }, () => random(9) - 1);
  const list = (count) => (random(4) ? tame(count) : wild(count));
  const vector = () => [list(3), { direction: list(3) }, { x: 1, y: list(1)[0], z: 2 }, list(random(5))][random(random(9) ? 3 : 4)];
  let succeeded = 0;
  for (let i = 0; i < 20_000; ++i) {
    try {
      const mesh = new Mesh(list(3 * random(9) + 18), random(4) ? list(3 * random(5)) : null);
      const tracker = new Tracker(mesh, vector());
      for (let move = 0; move < 4; ++move) {
        const point = vector();
        tracker.moveTo(point);
        assert.deepEqual(tracker.silhouette.slice().sort(), mesh.silhouette(point));
      }
      ++succeeded;
    } catch (error) {
      assert.ok(!(error instanceof WebAssembly.RuntimeError) && error.name !== "AssertionError", error.stack);
    }
  }
  assert.ok(succeeded > 100, `only ${succeeded} succeeded`);
});

test("the module is taken as bytes, compiled, or from its place, and one that is missing is an error", async () => {
  const bytes = readFileSync(new URL("rimline.wasm", folder));
  for (const wasm of [bytes, await WebAssembly.compile(bytes), new URL("rimline.wasm", folder), new URL("rimline.wasm", folder).href,
    relative(process.cwd(), fileURLToPath(new URL("rimline.wasm", folder))), fileURLToPath(new URL("rimline.wasm", folder))]) {
    const rimline = await createRimline({ wasm });
    assert.equal(new rimline.Mesh(CORNERS, TRIANGLES).edgeCount, 18);
  }
  await assert.rejects(createRimline({ wasm: new URL("missing.wasm", folder) }), /missing.wasm/);
  await assert.rejects(createRimline({ wasm: new Uint8Array(8) }), WebAssembly.CompileError);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  assert.ok(new (await createRimline({ wasm: view })).Mesh(CORNERS, TRIANGLES));
  const empty = new Uint8Array([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0]);
  await assert.rejects(createRimline({ wasm: empty }), /another module than Rimline's/);
  for (const wrong of [null, 5]) await assert.rejects(createRimline({ wasm: wrong }), /^TypeError: wasm: expected /);
  await assert.rejects(createRimline(null), /^TypeError: createRimline: expected an object of options, not null/);
  for (const wrong of [null, 5]) assert.throws(() => new Mesh(CORNERS, TRIANGLES, wrong), /^TypeError: Mesh: expected /);
  assert.throws(() => new Mesh(CORNERS, TRIANGLES, { wled: false }), /^TypeError: Mesh: there is no option wled/);
  assert.throws(() => new Mesh(CORNERS, TRIANGLES, { weld: "x" }), /^TypeError: weld: expected true or false/);
});
