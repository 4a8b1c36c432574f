// In the browser: times of one frame of an orbit by half degrees, by several methods.

import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { createRimline } from "rimline";
import { SilhouetteLines } from "rimline/three";
import { WideSilhouetteLines } from "rimline/three_wide";
import { BruteForce } from "./brute_force.mjs";

const FRAMES = 720;
const WARM_UP = 180;

/** Rows of { name, value }: times in microseconds and milliseconds, counts, bytes. */
export async function measure(url) {
  const geometry = await readGeometry(url);
  const positions = geometry.getAttribute("position").array;
  const index = Uint32Array.from(geometry.index.array);
  const rows = [];
  const add = (name, value) => rows.push({ name, value });

  const rimline = await createRimline();
  let begin = performance.now();
  const mesh = new rimline.Mesh(positions, index);
  add("weld", milliseconds(begin));
  begin = performance.now();
  const tracker = new rimline.Tracker(mesh, [1, 2, 3]);
  add("build the index, with the first tracker", milliseconds(begin));
  add("WebAssembly memory", `${(tracker.silhouette.buffer.byteLength / 2 ** 20).toFixed(0)} MiB`);
  begin = performance.now();
  const brute = new BruteForce(positions, index);
  add("build the arrays of the brute force", milliseconds(begin));
  add("arrays of the brute force", `${(brute.sizeBytes / 2 ** 20).toFixed(0)} MiB`);

  const eyes = orbit(mesh);
  let edges = 0;
  let joined = 0;
  const lines = new Uint32Array(2 * mesh.edgeCount);
  // Edges that rounding changes. Both numbers count edges, so this finds at least half of them.
  let different = 0;
  for (const eye of eyes) {
    joined += tracker.moveTo(eye).added.length;
    edges += tracker.silhouette.length;
    different += Math.abs(brute.write(...eye, lines) - tracker.silhouette.length);
  }
  add("edges of a silhouette", (edges / eyes.length).toFixed(0));
  add("edges that join it in a frame", (joined / eyes.length).toFixed(0));
  add("frames' edges that the brute force rounds differently", `${different} of ${edges}`);

  add("Tracker.moveTo", microseconds(eyes, (eye) => tracker.moveTo(eye)));
  for (const Lines of [SilhouetteLines, WideSilhouetteLines]) {
    const object = new Lines(rimline, geometry, { mesh });
    const camera = new THREE.PerspectiveCamera();
    const attribute = object.isLineSegments2 ? object.geometry.getAttribute("instanceStart").data : object.geometry.index;
    let numbers = 0;
    let written = 0;
    const time = microseconds(eyes, (eye) => {
      camera.position.set(...eye);
      object.update(camera);
      written += object.writtenCount;
      for (const { count } of attribute.updateRanges) numbers += count;
      attribute.clearUpdateRanges(); // As the renderer does.
    });
    const frames = FRAMES + WARM_UP;
    add(`${Lines.name}.update`, `${time}, ${(written / frames).toFixed(0)} lines, ${(4 * numbers / frames).toFixed(0)} bytes for the GPU`);
    object.dispose();
  }
  add("Mesh.silhouette, extracted anew and sorted", microseconds(eyes, (eye) => mesh.silhouette(eye)));
  const other = new rimline.Mesh(positions, index);
  add("Mesh.silhouette before there is a tracker: all faces", microseconds(eyes, (eye) => other.silhouette(eye)));
  add("brute force in JavaScript", microseconds(eyes, (eye) => brute.write(...eye, lines)));
  add("three's EdgesGeometry, for no view in particular", milliseconds(performance.now(), () => new THREE.EdgesGeometry(geometry)));
  return rows;
}

async function readGeometry(url) {
  const { scene } = await new GLTFLoader().loadAsync(url);
  let found;
  scene.traverse((object) => (found ??= object.geometry));
  return found;
}

function orbit(mesh) {
  const [x, y, z] = mesh.center;
  return Array.from({ length: FRAMES }, (_, i) => {
    const angle = (i * Math.PI) / 360;
    return [x + 2.5 * mesh.radius * Math.cos(angle), y + 0.3 * mesh.radius, z + 2.5 * mesh.radius * Math.sin(angle)];
  });
}

const median = (times) => times.sort((a, b) => a - b)[times.length >> 1];

function microseconds(eyes, frame) {
  for (let i = 0; i < WARM_UP; ++i) frame(eyes[i]);
  const times = eyes.map((eye) => {
    const begin = performance.now();
    frame(eye);
    return performance.now() - begin;
  });
  return `${(1000 * median(times)).toFixed(0)} µs`;
}

function milliseconds(begin, work = () => {}) {
  work();
  return `${(performance.now() - begin).toFixed(0)} ms`;
}
