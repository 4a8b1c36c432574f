// Models of the page: shapes of three.js, and files that its loaders read.

import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { OBJLoader } from "three/addons/loaders/OBJLoader.js";
import { PLYLoader } from "three/addons/loaders/PLYLoader.js";
import { STLLoader } from "three/addons/loaders/STLLoader.js";

const READERS = {
  glb: async (bytes) => {
    if (new TextDecoder().decode(bytes.slice(0, 4)) !== "glTF") throw new Error("not a GLB file");
    return (await new GLTFLoader().parseAsync(bytes, "")).scene;
  },
  obj: (bytes) => new OBJLoader().parse(new TextDecoder().decode(bytes)),
  ply: (bytes) => new THREE.Mesh(new PLYLoader().parse(bytes)),
  stl: (bytes) => new THREE.Mesh(new STLLoader().parse(bytes)),
};

export const SHAPES = {
  knot: () => new THREE.TorusKnotGeometry(1, 0.27, 480, 48, 2, 3),
  "open shell": shell,
  torus: () => new THREE.TorusGeometry(1, 0.42, 64, 160),
  icosahedron: () => new THREE.IcosahedronGeometry(1, 0),
};

/** The geometries of a file, each with its place in the model. Throws an Error that says what is wrong. */
export async function readModel(file) {
  const reader = READERS[file.name.toLowerCase().split(".").pop()];
  if (reader === undefined) throw new Error(`${file.name}: expected a name that ends in .obj, .ply, .stl or .glb`);
  const bytes = await file.arrayBuffer();
  const root = await reader(bytes);
  root.updateMatrixWorld(true);
  const parts = [];
  root.traverse(({ isMesh, geometry, matrixWorld }) => {
    // A PLY file without faces that the loader knows is a set of points.
    const isSet = isMesh && geometry.index === null && READERS.ply === reader;
    if (isMesh && !isSet) parts.push({ geometry, matrix: matrixWorld });
  });
  const hasStrips = () => READERS.ply === reader && /^element tristrips/m.test(new TextDecoder().decode(bytes.slice(0, 4096)));
  if (parts.length === 0) throw new Error(`no triangles here${hasStrips() ? ' but strips: "rimline convert" makes triangles of them' : ""}`);
  return parts;
}

// A wavy shell: an open mesh, with a border.
function shell() {
  const geometry = new THREE.SphereGeometry(1.2, 192, 96, 0, 2 * Math.PI, 0, 0.62 * Math.PI);
  const position = geometry.getAttribute("position");
  const point = new THREE.Vector3();
  for (let i = 0; i < position.count; ++i) {
    point.fromBufferAttribute(position, i);
    const wave = 1 + 0.12 * Math.sin(7 * Math.atan2(point.z, point.x)) * Math.hypot(point.x, point.z);
    position.setXYZ(i, wave * point.x, point.y, wave * point.z);
  }
  geometry.computeVertexNormals();
  return geometry;
}
