// In the browser: reads back what the GPU holds of the lines, and compares it with the silhouette.

import * as THREE from "three";
import { createRimline } from "rimline";
import { SilhouetteLines, meshOf } from "rimline/three";
import { WideSilhouetteLines } from "rimline/three_wide";

/** Returns the number of lines that were compared. Throws at the first difference. */
export async function compareBuffers() {
  const rimline = await createRimline();
  const renderer = new THREE.WebGLRenderer();
  const buffers = followBuffers(renderer.getContext());
  const geometry = new THREE.TorusKnotGeometry(1, 0.3, 120, 16);
  const mesh = meshOf(rimline, geometry);
  const scene = new THREE.Scene();
  const all = [new SilhouetteLines(rimline, geometry, { mesh }), new WideSilhouetteLines(rimline, geometry, { mesh })];
  scene.add(...all);
  const camera = new THREE.PerspectiveCamera();
  let compared = 0;
  for (let i = 0; i < 120; ++i) {
    const angle = 0.01 * i * (i % 40 === 39 ? 30 : 1);
    camera.position.set(5 * Math.cos(angle), 1, 5 * Math.sin(angle));
    camera.lookAt(0, 0, 0);
    for (const lines of all) lines.update(camera);
    renderer.render(scene, camera);
    if (i % 10 !== 9) continue;
    const edges = mesh.silhouette(camera.position);
    for (const lines of all) {
      const ends = readLines(renderer, buffers, lines);
      const expected = Array.from(edges, (edge) => textOf(lines, geometry, mesh.edges.subarray(2 * edge, 2 * edge + 2)));
      if (expected.sort().join(";") !== ends.sort().join(";")) throw new Error(`${lines.constructor.name}, frame ${i}: the buffer is not the silhouette`);
      compared += ends.length;
    }
  }
  renderer.dispose();
  return compared;
}

function textOf(lines, geometry, vertices) {
  if (!lines.isLineSegments2) return vertices.join();
  const { array } = geometry.getAttribute("position");
  return Array.from(vertices, (vertex) => array.slice(3 * vertex, 3 * vertex + 3).join()).join();
}

// The lines in the draw range, as text.
function readLines(renderer, buffers, { isLineSegments2, geometry }) {
  const gl = renderer.getContext();
  const array = isLineSegments2 ? geometry.getAttribute("instanceStart").data.array : geometry.index.array;
  const held = new array.constructor(array.length);
  const target = isLineSegments2 ? gl.ARRAY_BUFFER : gl.ELEMENT_ARRAY_BUFFER;
  gl.bindVertexArray(null);
  gl.bindBuffer(target, buffers.get(array));
  gl.getBufferSubData(target, 0, held);
  renderer.resetState();
  const size = isLineSegments2 ? 6 : 2;
  const count = isLineSegments2 ? geometry.instanceCount : geometry.drawRange.count / 2;
  return Array.from({ length: count }, (_, i) => held.subarray(size * i, size * (i + 1)).join());
}

// The buffers of the context by the array that they were made from.
function followBuffers(gl) {
  const bound = new Map();
  const buffers = new Map();
  const { bindBuffer, bufferData } = gl;
  gl.bindBuffer = (target, buffer) => {
    bound.set(target, buffer);
    bindBuffer.call(gl, target, buffer);
  };
  gl.bufferData = (target, data, usage) => {
    buffers.set(data, bound.get(target));
    bufferData.call(gl, target, data, usage);
  };
  return buffers;
}
