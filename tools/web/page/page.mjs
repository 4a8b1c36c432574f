// The page: a model, shaded, with silhouette lines that follow the camera.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { createRimline } from "rimline";
import { meshOf } from "rimline/three";
import { WideSilhouetteLines } from "rimline/three_wide";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { SHAPES, readModel } from "./models.mjs";

const element = (id) => document.getElementById(id);

function showError(message) {
  element("error").textContent = message;
  element("error").hidden = false;
}

// What the page cannot do without.
async function orSayWhyNot(start) {
  try {
    return await start();
  } catch (error) {
    element("name").textContent = "";
    showError(`This browser cannot show the page: ${error.message}`);
    throw error;
  }
}

const rimline = await orSayWhyNot(createRimline);
const renderer = await orSayWhyNot(() => new THREE.WebGLRenderer({ canvas: element("canvas"), antialias: true }));
const scene = new THREE.Scene();
scene.background = new THREE.Color(getComputedStyle(document.documentElement).getPropertyValue("--paper"));
const perspective = new THREE.PerspectiveCamera(32);
const orthographic = new THREE.OrthographicCamera();
let camera = perspective;
const controls = new OrbitControls(camera, renderer.domElement);
controls.enableDamping = true;
controls.autoRotateSpeed = 1.2;

// Light from the sky, and a lamp that the viewer carries.
scene.add(new THREE.HemisphereLight(0xffffff, 0xb9a98f, 2.1));
const lamp = new THREE.DirectionalLight(0xfff4e2, 1.5);
scene.add(lamp, lamp.target);

// The surface lies a little behind its edges, so that it does not cover their lines.
const surface = { color: 0xe6dcc8, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
const smooth = new THREE.MeshLambertMaterial(surface);
const flat = new THREE.MeshLambertMaterial({ ...surface, flatShading: true });
const ink = new LineMaterial({ color: 0x211d19 });

let model = new THREE.Group();
let shown = ""; // Its name.
let parts = []; // { geometry, mesh, surface, lines }
let radius = 1;
let moves = { count: 0, time_ms: 0 }; // Since the counts were shown.

/** Replaces the model that is shown. Throws what meshOf() does, and an Error if there are no faces: then the old one stays. */
function show(name, loaded) {
  const begin = performance.now();
  const made = [];
  try {
    for (const part of loaded) made.push({ ...part, mesh: meshOf(rimline, part.geometry) });
    if (!made.some(({ mesh }) => mesh.faceCount > 0)) throw new Error("no triangles here");
    for (const part of made) {
      part.lines = makeLines(part);
      part.lines.update(camera); // Its first call makes the index.
    }
  } catch (error) {
    for (const { lines, mesh } of made) {
      lines?.dispose();
      mesh.dispose();
    }
    for (const { geometry } of loaded) geometry.dispose();
    throw error;
  }
  for (const part of parts) {
    part.lines.dispose();
    part.mesh.dispose();
    part.geometry.dispose();
  }
  scene.remove(model);
  model = new THREE.Group();
  scene.add(model);
  parts = made.map(({ geometry, matrix, mesh, lines }) => {
    const surface = new THREE.Mesh(geometry, geometry.getAttribute("normal") ? smooth : flat);
    surface.matrixAutoUpdate = false;
    surface.matrix.copy(matrix);
    model.add(surface.add(lines));
    return { geometry, mesh, surface, lines };
  });
  shown = name;
  element("name").textContent = name;
  element("faces").textContent = count(sum((part) => part.mesh.faceCount));
  element("edges").textContent = count(sum((part) => part.mesh.edgeCount));
  element("error").hidden = true;
  frameModel();
  updateLines();
  element("built").textContent = `${(performance.now() - begin).toFixed(0)} ms`;
}

// Borders are chosen when lines are made.
function makeLines({ geometry, mesh }) {
  return new WideSilhouetteLines(rimline, geometry, { mesh, borders: element("borders").checked, material: ink });
}

function remakeLines() {
  for (const part of parts) {
    const lines = makeLines(part);
    part.surface.remove(part.lines);
    part.lines.dispose();
    part.surface.add((part.lines = lines));
  }
  updateLines();
}

// An error of one model must not end the loop that draws.
function updateLines() {
  try {
    for (const { lines } of parts) lines.update(camera);
  } catch (error) {
    showError(`${shown}: ${error.message}`);
  }
}

function frameModel() {
  model.rotation.x = element("z_up").checked ? -Math.PI / 2 : 0;
  model.updateMatrixWorld(true);
  const sphere = new THREE.Box3().setFromObject(model).getBoundingSphere(new THREE.Sphere());
  radius = sphere.radius || 1;
  controls.target.copy(sphere.center);
  const direction = new THREE.Vector3(0.45, 0.28, 1).normalize();
  for (const each of [perspective, orthographic]) {
    each.position.copy(sphere.center).addScaledVector(direction, 3.8 * radius * narrowness());
    each.near = radius / 50;
    each.far = 40 * radius;
  }
  orthographic.zoom = 1;
  controls.minDistance = 1.05 * radius;
  controls.maxDistance = 20 * radius;
  resize();
  controls.update();
}

// By how much farther away the whole model is seen in an upright window.
const narrowness = () => Math.max(1, innerHeight / innerWidth);

function resize() {
  const { innerWidth: width, innerHeight: height } = window;
  renderer.setPixelRatio(devicePixelRatio);
  renderer.setSize(width, height, false);
  perspective.aspect = width / height;
  const half = 1.1 * radius * narrowness();
  Object.assign(orthographic, { left: (-half * width) / height, right: (half * width) / height, top: half, bottom: -half });
  // The middle of what the panel leaves free.
  const shift = width > 800 ? -element("panel").offsetWidth / 2 : 0;
  for (const each of [perspective, orthographic]) each.setViewOffset(width, height, shift, 0, width, height);
}

function draw() {
  controls.update();
  lamp.position.copy(camera.position).add(new THREE.Vector3(-radius, 2 * radius, 0).applyQuaternion(camera.quaternion));
  lamp.target.position.copy(controls.target);
  lamp.target.updateMatrixWorld();
  ink.linewidth = Number(element("width").value);
  if (!element("freeze").checked) {
    const begin = performance.now();
    updateLines();
    moves.time_ms += performance.now() - begin;
    ++moves.count;
  }
  renderer.render(scene, camera);
}

function showCounts() {
  element("silhouette").textContent = count(sum(({ lines }) => lines.lineCount));
  element("written").textContent = count(sum(({ lines }) => lines.writtenCount));
  if (moves.count > 0) element("time").textContent = `${(moves.time_ms / moves.count).toFixed(2)} ms`;
  moves = { count: 0, time_ms: 0 };
}

const sum = (numberOf) => parts.reduce((total, part) => total + numberOf(part), 0);
const count = (number) => number.toLocaleString("en-US");

let requests = 0; // What was chosen last is shown, not what was read last.

async function openFile(file) {
  const request = ++requests;
  element("name").textContent = `Reading ${file.name}…`;
  try {
    const loaded = await readModel(file);
    if (request === requests) {
      show(file.name, loaded);
      element("shape").selectedIndex = -1;
    } else {
      for (const { geometry } of loaded) geometry.dispose();
    }
  } catch (error) {
    if (request !== requests) return;
    element("name").textContent = shown;
    showError(error.message.startsWith(file.name) ? error.message : `${file.name}: ${error.message}`);
  }
}

function openShape() {
  ++requests;
  const name = element("shape").value;
  show(name, [{ geometry: SHAPES[name](), matrix: new THREE.Matrix4() }]);
}

for (const name of Object.keys(SHAPES)) element("shape").add(new Option(name));
element("shape").addEventListener("change", openShape);
element("file").addEventListener("change", ({ target }) => {
  if (target.files[0]) openFile(target.files[0]);
  target.value = ""; // The same file can be chosen again.
});
element("borders").addEventListener("change", remakeLines);
element("z_up").addEventListener("change", frameModel);
element("turn").addEventListener("change", ({ target }) => (controls.autoRotate = target.checked));
element("orthographic").addEventListener("change", ({ target }) => {
  const other = target.checked ? orthographic : perspective;
  other.position.copy(camera.position);
  camera = controls.object = other;
});
addEventListener("resize", resize);
// Another screen, or a zoom that leaves the size as it is.
function watchPixelRatio() {
  matchMedia(`(resolution: ${devicePixelRatio}dppx)`).addEventListener("change", () => {
    resize();
    watchPixelRatio();
  }, { once: true });
}
watchPixelRatio();
if (innerWidth <= 800) element("fold").open = false;
element("fold").addEventListener("toggle", resize);
for (const type of ["dragenter", "dragover"])
  addEventListener(type, (event) => {
    event.preventDefault();
    document.body.classList.add("dragged");
  });
for (const type of ["dragleave", "drop"]) addEventListener(type, () => document.body.classList.remove("dragged"));
addEventListener("drop", (event) => {
  event.preventDefault();
  if (event.dataTransfer.files[0]) openFile(event.dataTransfer.files[0]);
});

controls.autoRotate = element("turn").checked;
openShape();
renderer.setAnimationLoop(draw);
setInterval(showCounts, 250);
