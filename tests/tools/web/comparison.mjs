// In the browser: compares the package with a file of reference.cpp.

import { createRimline } from "/build/package/rimline.mjs";

/** Returns the numbers of points, edges and changes that were compared. Throws at the first difference. */
export async function compare(url) {
  const bytes = await (await fetch(url)).arrayBuffer();
  const whole = new Uint32Array(bytes);
  const floats = new Float32Array(bytes);
  const [vertices, triangles, edges, points] = whole;
  let place = 4;
  const take = (count, from = whole) => from.subarray(place, (place += count));

  const { Mesh, Tracker } = await createRimline();
  const mesh = new Mesh(take(3 * vertices, floats), take(3 * triangles));
  expectEqual("edges", mesh.edges, take(2 * edges));
  let tracker;
  let changes = 0;
  let found = 0;
  const current = new Set();
  for (let i = 0; i < points; ++i) {
    const vector = Array.from(take(3, floats));
    const [isDirection, size] = take(2);
    const point = isDirection ? { direction: vector } : vector;
    const where = `point ${i}, ${isDirection ? "direction" : "eye"} ${vector}`;
    const expected = take(size);
    const sorted = expected.slice().sort();
    if (tracker === undefined) {
      expectEqual(`${where}: all faces`, mesh.silhouette(point), sorted);
      tracker = new Tracker(mesh, point);
      for (const edge of tracker.silhouette) current.add(edge);
    }
    expectEqual(`${where}: extraction`, mesh.silhouette(point), sorted);
    const change = tracker.moveTo(point);
    expectEqual(`${where}: tracker, by slot`, tracker.silhouette, expected);
    for (const edge of change.removed) expect(`${where}: edge ${edge} left`, current.delete(edge));
    for (const edge of change.added) expect(`${where}: edge ${edge} joined`, !current.has(edge) && current.add(edge));
    expectEqual(`${where}: changes`, Uint32Array.from(current).sort(), sorted);
    changes += change.added.length + change.removed.length;
    found += size;
  }
  // All faces once more, for a mesh without an index.
  const other = new Mesh(floats.subarray(4, 4 + 3 * vertices), whole.subarray(4 + 3 * vertices, 4 + 3 * vertices + 3 * triangles));
  expectEqual("all faces", other.silhouette({ direction: [1, 2, 3] }), mesh.silhouette({ direction: [1, 2, 3] }));
  return { points, found, changes };
}

function expect(what, holds) {
  if (!holds) throw new Error(`${what}: does not hold`);
}

function expectEqual(what, actual, expected) {
  if (actual.length !== expected.length) throw new Error(`${what}: ${actual.length} edges, expected ${expected.length}`);
  const i = expected.findIndex((edge, i) => edge !== actual[i]);
  if (i >= 0) throw new Error(`${what}: ${actual[i]} at ${i}, expected ${expected[i]}`);
}
