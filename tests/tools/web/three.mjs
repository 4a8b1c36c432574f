// three.mjs BUILD THREE: the lines for three.js in Node. THREE is the name that npm installed it by.

import assert from "node:assert/strict";
import { cpSync, mkdirSync, mkdtempSync, rmSync, symlinkSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import test, { after } from "node:test";
import { pathToFileURL } from "node:url";

const [build, three] = process.argv.slice(2);
const installed = resolve(build, "package", "node_modules", three);

// The package beside the three.js that it is to find.
const folder = mkdtempSync(join(tmpdir(), "rimline-three-"));
after(() => rmSync(folder, { recursive: true }));
for (const file of ["package.json", "rimline.mjs", "rimline.wasm", "three.mjs", "three_wide.mjs"])
  cpSync(join(build, "package", file), join(folder, file));
mkdirSync(join(folder, "node_modules"));
symlinkSync(installed, join(folder, "node_modules", "three"));
const load = (file) => import(pathToFileURL(join(folder, file)));

const THREE = await import(pathToFileURL(join(installed, "build", "three.module.js")));
const { createRimline } = await load("rimline.mjs");
const { SilhouetteLines, meshOf } = await load("three.mjs");
const { WideSilhouetteLines } = await load("three_wide.mjs");
const rimline = await createRimline();

const knot = () => new THREE.TorusKnotGeometry(1, 0.3, 90, 12);

// What the GPU holds of each kind of lines: the renderer's part, which copies ranges and clears them.
class Copy {
  constructor(lines) {
    this.lines = lines;
    this.attribute = lines.isLineSegments2 ? lines.geometry.getAttribute("instanceStart").data : lines.geometry.index;
    this.array = this.attribute.array.slice();
    this.version = this.attribute.version;
  }
  render() {
    const { version, updateRanges, array } = this.attribute;
    if (version !== this.version) {
      assert.ok(updateRanges.length > 0);
      for (const { start, count } of updateRanges) this.array.set(array.subarray(start, start + count), start);
      this.attribute.clearUpdateRanges();
      this.version = version;
    }
    const { isLineSegments2, geometry } = this.lines;
    const size = isLineSegments2 ? 6 : 2;
    const drawn = isLineSegments2 ? geometry.instanceCount : geometry.drawRange.count / 2;
    assert.equal(drawn, this.lines.lineCount);
    return Array.from({ length: drawn }, (_, i) => this.array.slice(size * i, size * (i + 1)).join()).sort();
  }
}

// The same lines by the definition: mesh.silhouette() from a point in the space of the object.
function expected(geometry, mesh, point, lines, withBorders = false) {
  const edges = Array.from(mesh.silhouette(point));
  for (let edge = mesh.edgeCount - mesh.borderCount; withBorders && edge < mesh.edgeCount; ++edge) edges.push(edge);
  const position = geometry.getAttribute("position");
  const text = (vertex) => [position.getX(vertex), position.getY(vertex), position.getZ(vertex)];
  return edges.map((edge) => {
    const ends = [...mesh.edges.subarray(2 * edge, 2 * edge + 2)];
    return (lines.isLineSegments2 ? ends.flatMap(text) : ends).join();
  }).sort();
}

const perspective = (x, y, z) => {
  const camera = new THREE.PerspectiveCamera();
  camera.position.set(x, y, z);
  camera.lookAt(0, 0, 0);
  return camera;
};

const worldMatrix = (object) => {
  object.updateWorldMatrix(true, false);
  return object.matrixWorld;
};

for (const Lines of [SilhouetteLines, WideSilhouetteLines]) {
  test(`${Lines.name} hold the silhouette exactly after every move`, () => {
    const geometry = knot();
    const lines = new Lines(rimline, geometry);
    const mesh = meshOf(rimline, geometry);
    const copy = new Copy(lines);
    for (let i = 0; i < 300; ++i) {
      const jump = i % 50 === 49 ? 40 : 1;
      const camera = perspective(5 * Math.cos(0.01 * i * jump), 0.02 * i - 3, 5 * Math.sin(0.01 * i * jump));
      lines.update(camera);
      assert.deepEqual(copy.render(), expected(geometry, mesh, camera.position, lines));
    }
  });

  test(`clones of ${Lines.name} and of what holds them are lines of their own`, () => {
    const geometry = knot();
    const mesh = meshOf(rimline, geometry);
    const model = new THREE.Mesh(geometry).add(new Lines(rimline, geometry));
    const [lines] = model.children;
    lines.name = "ink";
    lines.update(perspective(5, 0, 0));
    const [clone] = model.clone().children;
    assert.deepEqual([clone.constructor, clone.name, clone.material, clone.lineCount], [Lines, "ink", lines.material, 0]);
    assert.notEqual(clone.geometry, lines.geometry);
    const camera = perspective(0, 5, 1);
    clone.update(camera);
    assert.deepEqual(new Copy(clone).render(), expected(geometry, mesh, camera.position, clone));
    lines.dispose();
    clone.update(perspective(1, 2, 3));
    clone.dispose();
  });

  test(`${Lines.name} dispose of the material that they made, and of no other`, () => {
    const disposals = (lines) => {
      let count = 0;
      lines.material.addEventListener("dispose", () => ++count);
      lines.dispose();
      return count;
    };
    const made = new Lines(rimline, knot());
    assert.equal(disposals(new Lines(rimline, knot(), { material: made.material })), 0);
    assert.equal(disposals(made), 1);
  });

  test(`${Lines.name} follow an orthographic camera, whose place does not matter`, () => {
    const geometry = knot();
    const lines = new Lines(rimline, geometry);
    const mesh = meshOf(rimline, geometry);
    const copy = new Copy(lines);
    for (const distance of [1, 5, 1000]) {
      const camera = new THREE.OrthographicCamera();
      camera.position.set(distance, 2 * distance, 3 * distance);
      camera.lookAt(0, 0, 0);
      lines.update(camera);
      const direction = camera.getWorldDirection(new THREE.Vector3()).negate();
      const close = expected(geometry, mesh, { direction }, lines);
      const drawn = copy.render();
      assert.ok(drawn.length > 100 && drawn.filter((line) => !close.includes(line)).length <= 2);
    }
  });

  test(`${Lines.name} draw borders where they are asked for`, () => {
    const geometry = new THREE.PlaneGeometry(2, 2, 8, 8);
    const position = geometry.getAttribute("position");
    for (let i = 0; i < position.count; ++i) position.setZ(i, Math.sin(3 * position.getX(i)) * Math.cos(2 * position.getY(i)));
    const mesh = meshOf(rimline, geometry);
    assert.equal(mesh.borderCount, 32);
    const without = new Lines(rimline, geometry, { mesh });
    const withBorders = new Lines(rimline, geometry, { mesh, borders: true });
    const copies = [new Copy(without), new Copy(withBorders)];
    for (let i = 0; i < 20; ++i) {
      const camera = perspective(4, i - 10, 2);
      without.update(camera);
      withBorders.update(camera);
      assert.deepEqual(copies[0].render(), expected(geometry, mesh, camera.position, without));
      assert.deepEqual(copies[1].render(), expected(geometry, mesh, camera.position, withBorders, true));
    }
    without.dispose();
    withBorders.dispose();
    assert.equal(mesh.borderCount, 32);
  });

  test(`${Lines.name} that nobody draws for long keep one range`, () => {
    const lines = new Lines(rimline, knot());
    const copy = new Copy(lines);
    for (let i = 0; i < 500; ++i) lines.update(perspective(5 * Math.cos(0.05 * i), 1, 5 * Math.sin(0.05 * i)));
    assert.equal(copy.attribute.updateRanges.length, 1);
    const geometry = knot();
    const camera = perspective(3, 4, 5);
    lines.update(camera);
    assert.deepEqual(copy.render(), expected(geometry, meshOf(rimline, geometry), camera.position, lines));
  });
}

test("moved, sheared and mirrored objects have the silhouette of the mesh that lies where they are", () => {
  const geometry = new THREE.IcosahedronGeometry(1, 6);
  const scales = [[1, 1, 1], [3, 0.5, 1], [-1, 1, 1], [1, -2, -0.1], [-1, -1, -3]];
  for (const [i, scale] of scales.entries()) {
    const parent = new THREE.Group();
    parent.position.set(3, -i, 2);
    parent.rotation.set(0.3, i, -1);
    parent.scale.set(1, 2, 0.7); // With the rotation below it, a shear.
    const lines = new SilhouetteLines(rimline, geometry);
    lines.rotation.set(i, 0.2, 0.5);
    lines.scale.set(...scale);
    parent.add(lines);
    const copy = new Copy(lines);
    for (const orthographic of [false, true]) {
      const camera = orthographic ? new THREE.OrthographicCamera() : new THREE.PerspectiveCamera();
      const rig = new THREE.Group().add(camera);
      rig.position.set(11, 5, -7);
      camera.position.set(1, 2, 3);
      camera.rotation.set(0.4, 0.5, 0.6);
      lines.update(camera);
      const moved = meshOf(rimline, geometry.clone().applyMatrix4(worldMatrix(lines)));
      const eye = camera.getWorldPosition(new THREE.Vector3());
      const towards = camera.getWorldDirection(new THREE.Vector3()).negate();
      const unmoved = meshOf(rimline, geometry);
      const drawn = copy.render();
      const baked = expected(geometry, moved, orthographic ? { direction: towards } : eye, lines);
      assert.ok(drawn.length > 20);
      assert.equal(unmoved.edgeCount, moved.edgeCount);
      assert.deepEqual(drawn, baked, `scale ${scale}, ${orthographic ? "orthographic" : "perspective"}`);
    }
  }
});

test("lines follow groups that move without matrixAutoUpdate", () => {
  const geometry = knot();
  const mesh = meshOf(rimline, geometry);
  const group = new THREE.Group();
  const fixed = new THREE.Group();
  fixed.matrixAutoUpdate = false;
  const lines = new SilhouetteLines(rimline, geometry, { mesh });
  group.add(fixed.add(lines));
  const copy = new Copy(lines);
  for (const x of [0, 1, 2]) {
    group.position.x = x;
    fixed.matrix.makeTranslation(0, 0, x);
    lines.update(perspective(5, 1, 2));
    assert.deepEqual(copy.render(), expected(geometry, mesh, [5 - x, 1, 2 - x], lines));
  }
});

test("an object without volume keeps its lines, and wrong geometries are errors", () => {
  const lines = new SilhouetteLines(rimline, knot());
  lines.scale.set(1, 0, 1);
  lines.update(perspective(5, 1, 0));
  assert.equal(lines.lineCount, 0);
  lines.scale.set(1, 1, 1);
  lines.update(perspective(5, 1, 0));
  const { lineCount } = lines;
  assert.ok(lineCount > 0);
  lines.scale.set(0, 0, 0);
  lines.update(perspective(0, 5, 1));
  assert.equal(lines.lineCount, lineCount);
  lines.dispose();
  lines.scale.set(1, 1, 1);
  assert.throws(() => lines.update(perspective(5, 1, 0)), /disposed of/);
  assert.throws(() => new SilhouetteLines(rimline, new THREE.BufferGeometry()), /^TypeError: geometry: expected the attribute position/);
});

test("objects that are nearly flat or tiny keep or find their lines, and nothing throws", () => {
  const geometry = knot();
  const mesh = meshOf(rimline, geometry);
  const lines = new SilhouetteLines(rimline, geometry, { mesh });
  const copy = new Copy(lines);
  for (let i = 0; i < 3000; ++i) {
    lines.scale.multiplyScalar(0.9);
    lines.update(perspective(5, 1, 2));
    if (i < 300) assert.deepEqual(copy.render(), expected(geometry, mesh, new THREE.Vector3(5, 1, 2).divideScalar(lines.scale.x), lines));
  }
  const { lineCount } = lines;
  const parent = new THREE.Group().add(lines);
  parent.scale.set(1, 0, 1);
  for (let i = 0; i < 500; ++i) {
    lines.scale.set(1, 1, 1);
    lines.rotation.set(0.01 * i, 0.02 * i, 0.03 * i);
    lines.update(perspective(5, 1, 2));
    assert.equal(lines.lineCount, lineCount);
  }
  parent.scale.set(1, 1e-19, 1);
  lines.update(perspective(5, 1, 2));
});

test("any projection is followed: oblique, of a plain camera, of several eyes, of a scene that is not updated", () => {
  const geometry = new THREE.SphereGeometry(1, 24, 16);
  const mesh = meshOf(rimline, geometry);
  const lines = new SilhouetteLines(rimline, geometry, { mesh });
  const copy = new Copy(lines);
  const oblique = new THREE.OrthographicCamera(-2, 2, 2, -2, 0.1, 20);
  oblique.position.set(0, 0, 5);
  oblique.projectionMatrix.multiply(new THREE.Matrix4().set(1, 0, 0.5, 0, 0, 1, 0.25, 0, 0, 0, 1, 0, 0, 0, 0, 1));
  oblique.projectionMatrixInverse.copy(oblique.projectionMatrix).invert();
  lines.update(oblique);
  assert.deepEqual(copy.render(), expected(geometry, mesh, { direction: [-0.5, -0.25, 1] }, lines));
  const parallel = new THREE.OrthographicCamera(-2, 2, 2, -2, 0.1, 20);
  for (const near of [0.1, 20]) { // And with depth the other way round.
    const plain = new THREE.Camera();
    plain.position.set(3, 1, 5);
    plain.lookAt(0, 0, 0);
    Object.assign(parallel, { near, far: 20.1 - near });
    parallel.updateProjectionMatrix();
    plain.projectionMatrix.copy(parallel.projectionMatrix);
    plain.projectionMatrixInverse.copy(parallel.projectionMatrixInverse);
    lines.update(plain);
    assert.deepEqual(copy.render(), expected(geometry, mesh, { direction: [3, 1, 5] }, lines));
  }
  const eyes = new THREE.ArrayCamera([]);
  eyes.matrixWorld.makeTranslation(4, 2, 1); // As a rig sets it.
  lines.update(eyes);
  assert.deepEqual(copy.render(), expected(geometry, mesh, [4, 2, 1], lines));
  const scene = new THREE.Scene().add(lines);
  scene.updateMatrixWorld();
  scene.matrixWorldAutoUpdate = false;
  lines.position.x = 2; // Which the renderer does not draw.
  lines.update(perspective(5, 1, 2));
  assert.deepEqual(copy.render(), expected(geometry, mesh, [5, 1, 2], lines));
});

test("the draw range of a geometry says what its mesh is", () => {
  const indexed = new THREE.BoxGeometry();
  indexed.setDrawRange(0, 7); // The last one is no triangle.
  assert.deepEqual([meshOf(rimline, indexed).faceCount, meshOf(rimline, indexed).borderCount], [2, 4]);
  const { array } = new THREE.BoxGeometry().toNonIndexed().getAttribute("position");
  const roomy = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(new Float32Array(300).fill(NaN), 3));
  roomy.getAttribute("position").array.set(array, 9);
  roomy.setDrawRange(3, 36);
  const lines = new SilhouetteLines(rimline, roomy);
  lines.update(perspective(4, 5, 6));
  assert.equal(lines.lineCount, 6);
  const ten = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(array.slice(0, 30), 3));
  assert.equal(meshOf(rimline, ten).faceCount, 3);
});

test("lines that go leave the positions of the model, and options that are none are errors", () => {
  for (const Lines of [SilhouetteLines, WideSilhouetteLines]) {
    const geometry = knot();
    const lines = new Lines(rimline, geometry, { material: null, mesh: null });
    const [position] = [geometry.getAttribute("position")];
    lines.geometry.addEventListener("dispose", ({ target }) =>
      assert.ok(!Object.values(target.attributes).includes(position)));
    lines.dispose();
    const mesh = meshOf(rimline, geometry);
    const shared = new Lines(rimline, geometry, { mesh });
    shared.dispose(); // Before its first update.
    assert.throws(() => shared.update(perspective(1, 2, 3)), /disposed of/);
    assert.throws(() => new Lines(rimline, geometry, { border: true }), /^TypeError: lines: there is no option border/);
    assert.throws(() => new Lines(rimline, geometry, null), /^TypeError: lines: expected an object/);
    assert.throws(() => new Lines(rimline, geometry).copy(new Lines(rimline, geometry)), /use clone/);
  }
});

test("positions may be normalized integers or interleaved", () => {
  const geometry = new THREE.BoxGeometry(2, 2, 2).toNonIndexed();
  const { array } = geometry.getAttribute("position");
  const bytes = new THREE.BufferGeometry();
  bytes.setAttribute("position", new THREE.BufferAttribute(Int8Array.from(array, (c) => 127 * c), 3, true));
  const interleaved = new THREE.BufferGeometry();
  const wide = new THREE.InterleavedBuffer(Float32Array.from({ length: 2 * array.length }, (_, i) => (i % 6 < 3 ? array[3 * Math.floor(i / 6) + (i % 6)] : 7)), 6);
  interleaved.setAttribute("position", new THREE.InterleavedBufferAttribute(wide, 3, 0));
  for (const other of [geometry, bytes, interleaved]) {
    const lines = new SilhouetteLines(rimline, other);
    lines.update(perspective(4, 5, 6));
    assert.equal(lines.lineCount, 6);
  }
});
