// Silhouettes in three.js: objects whose lines follow a camera by change sets.
//
// A silhouette does not change under an affine map of model and viewpoint together. So the camera is taken into the
// space of the object, and the object may be moved, scaled, sheared and mirrored without a new mesh.
//
// Lines have places: those of the borders first, then the slots of the tracker. All places up to `lineCount` are in
// use, so the draw range is the silhouette exactly.

import { BufferAttribute, BufferGeometry, DynamicDrawUsage, LineBasicMaterial, LineSegments, Matrix4, Object3D, Vector3 } from "three";

/** What clone() of objects that draw lines returns: other lines of the same geometry. */
export function clonedLines(lines, made, recursive) {
  return Object3D.prototype.copy.call(made, lines, recursive);
}

/** The lines of a mesh for the camera that they were updated for. Objects that draw lines own one. */
export class FollowedLines {
  #mesh;
  #ownsMesh;
  #edges;
  #borderCount;
  #tracker = null;
  #isDisposed = false;

  constructor(rimline, geometry, options) {
    const { mesh = null, borders = false } = lineOptions(options);
    this.rimline = rimline;
    this.#ownsMesh = mesh === null;
    this.#mesh = mesh ?? meshOf(rimline, geometry);
    this.#edges = this.#mesh.edges;
    this.#borderCount = borders ? this.#mesh.borderCount : 0;
    this.capacity = this.#mesh.edgeCount - this.#mesh.borderCount + this.#borderCount;
    this.lineCount = 0;
    this.writtenCount = 0; // By the last call of follow().
    if (geometry.boundingBox === null) geometry.computeBoundingBox();
    if (geometry.boundingSphere === null) geometry.computeBoundingSphere();
  }

  /**
   * Moves to a camera. Calls `write(place, from, to)` for each line that changed, with its two vertices, and marks their
   * range in `attribute`, which has `size` numbers for each line.
   */
  follow(camera, object, attribute, size, write) {
    if (this.#isDisposed) throw new Error("these lines were disposed of");
    const worldFromObject = worldMatrixOf(object);
    if (!hasVolume(worldFromObject)) return; // Flat as a sheet, it has no silhouette: the lines stay as they are.
    const point = pointOf(camera, worldFromObject.invert());
    if (point === null) return;
    let [first, end] = pendingRange(attribute, size);
    this.writtenCount = 0;
    const place = (line, edge) => {
      write(line, this.#edges[2 * edge], this.#edges[2 * edge + 1]);
      first = Math.min(first, line);
      end = Math.max(end, line + 1);
      ++this.writtenCount;
    };
    if (this.#tracker === null) {
      this.#tracker = new this.rimline.Tracker(this.#mesh, point);
      const firstBorder = this.#mesh.edgeCount - this.#mesh.borderCount;
      for (let i = 0; i < this.#borderCount; ++i) place(i, firstBorder + i);
      this.#tracker.silhouette.forEach((edge, slot) => place(this.#borderCount + slot, edge));
    } else {
      const { slots } = this.#tracker.moveTo(point);
      for (let i = 0; i < slots.length; i += 2) place(this.#borderCount + slots[i], slots[i + 1]);
    }
    this.lineCount = this.#borderCount + this.#tracker.silhouette.length;
    if (this.writtenCount === 0) return;
    // One range: slots that change lie anywhere, and calls for each of them take longer than the copy of those between.
    attribute.clearUpdateRanges();
    attribute.addUpdateRange(size * first, size * (end - first));
    attribute.needsUpdate = true;
  }

  dispose() {
    this.#isDisposed = true;
    this.#tracker?.dispose();
    if (this.#ownsMesh) this.#mesh.dispose();
  }
}

const LINE_OPTIONS = ["material", "mesh", "borders"];

/** The options of lines, none of them unknown. */
export function lineOptions(options = {}) {
  if (typeof options !== "object" || options === null)
    throw new TypeError(`lines: expected an object of options, not ${options}`);
  for (const option of Object.keys(options))
    if (!LINE_OPTIONS.includes(option)) throw new TypeError(`lines: there is no option ${option}`);
  return options;
}

/** Lines one pixel wide, as WebGL has them, whose only numbers are pairs of vertices. */
export class SilhouetteLines extends LineSegments {
  #lines;
  #source;
  #ownMaterial = null;

  constructor(rimline, geometry, allOptions) {
    const { material = null, ...options } = lineOptions(allOptions);
    const lines = new FollowedLines(rimline, geometry, options);
    const index = new BufferAttribute(new Uint32Array(2 * lines.capacity), 1).setUsage(DynamicDrawUsage);
    const drawn = new BufferGeometry().setAttribute("position", geometry.getAttribute("position")).setIndex(index);
    drawn.boundingBox = geometry.boundingBox;
    drawn.boundingSphere = geometry.boundingSphere;
    drawn.setDrawRange(0, 0);
    super(drawn, material ?? new LineBasicMaterial({ color: 0x000000 }));
    if (material === null) this.#ownMaterial = this.material;
    this.#source = { rimline, geometry, options };
    this.#lines = lines;
  }

  /** The number of lines that are drawn: borders, if there are any, and the silhouette. */
  get lineCount() {
    return this.#lines.lineCount;
  }

  /** The number of lines that the last update wrote. */
  get writtenCount() {
    return this.#lines.writtenCount;
  }

  update(camera) {
    const { index } = this.geometry;
    this.#lines.follow(camera, this, index, 2, (line, from, to) => {
      index.array[2 * line] = from;
      index.array[2 * line + 1] = to;
    });
    this.geometry.setDrawRange(0, 2 * this.lineCount);
  }

  clone(recursive) {
    const { rimline, geometry, options } = this.#source;
    return clonedLines(this, new this.constructor(rimline, geometry, { ...options, material: this.material }), recursive);
  }

  copy() {
    throw new Error("copy() of silhouette lines would share their buffers: use clone()");
  }

  dispose() {
    this.#lines.dispose();
    this.geometry.deleteAttribute("position"); // The renderer's buffer of it is the model's too.
    this.geometry.dispose();
    this.#ownMaterial?.dispose();
  }
}

/** The mesh of what a geometry draws, with or without index, for several lines to share. */
export function meshOf(rimline, geometry) {
  const position = geometry.getAttribute("position");
  if (position === undefined || position.itemSize !== 3)
    throw new TypeError("geometry: expected the attribute position, with three numbers for each vertex");
  let positions = position.array;
  if (!(position.isBufferAttribute && positions instanceof Float32Array)) {
    positions = new Float32Array(3 * position.count);
    for (let i = 0; i < position.count; ++i)
      positions.set([position.getX(i), position.getY(i), position.getZ(i)], 3 * i);
  }
  const { index, drawRange } = geometry;
  const last = Math.min(index?.count ?? position.count, drawRange.start + drawRange.count);
  const count = 3 * Math.floor(Math.max(0, last - drawRange.start) / 3);
  if (count === (index?.count ?? position.count)) return new rimline.Mesh(positions, index?.array);
  // Buffers that are larger than what they draw may hold anything beyond it.
  const corners = new Uint32Array(count);
  const drawn = new Float32Array(positions.length);
  for (let i = 0; i < count; ++i) {
    const vertex = index?.getX(drawRange.start + i) ?? drawRange.start + i;
    corners[i] = vertex;
    drawn.set(positions.subarray(3 * vertex, 3 * vertex + 3), 3 * vertex);
  }
  return new rimline.Mesh(drawn, corners);
}

// The lines that the last updates marked and the renderer has not written yet: first, and one past the last.
function pendingRange({ updateRanges }, size) {
  if (updateRanges.length === 0) return [Infinity, 0];
  const [{ start, count }] = updateRanges;
  return [start / size, (start + count) / size];
}

// Whether a matrix makes solids of solids, but for rounding.
function hasVolume(matrix) {
  const axis = (column) => new Vector3().setFromMatrixColumn(matrix, column).length();
  return Math.abs(matrix.determinant()) > 1e-12 * axis(0) * axis(1) * axis(2);
}

// The camera in the space of an object: its eye, or for a parallel projection, and an eye beyond all numbers, the
// direction towards it. Null where the object is too small for either.
function pointOf(camera, objectFromWorld) {
  const objectFromCamera = objectFromWorld.multiply(worldMatrixOf(camera));
  const eye = new Vector3().setFromMatrixPosition(objectFromCamera);
  // The viewer is where all rays meet: what the projection maps to (0, 0, 1, 0).
  const [x, y, z, w] = camera.projectionMatrixInverse.elements.slice(8, 12);
  if (w !== 0 && Math.max(Math.abs(eye.x), Math.abs(eye.y), Math.abs(eye.z)) < 2 ** 59) return eye;
  const ray = new Vector3(x, y, z);
  if (ray.z < 0) ray.negate(); // Towards the viewer, whichever end of depth is near.
  const direction = w !== 0 ? eye : ray.transformDirection(objectFromCamera);
  direction.normalize();
  return Math.abs(direction.length() - 1) < 0.1 ? { direction } : null;
}

// What a renderer would use now. `matrixWorld` is older where something moved since the last frame.
function worldMatrixOf(object) {
  let root = object;
  while (root.parent !== null) root = root.parent;
  // Renderers leave these as they are: of several eyes, and in a scene that is not updated.
  if (object.isArrayCamera || (root.isScene && !root.matrixWorldAutoUpdate)) return object.matrixWorld.clone();
  const matrix = new Matrix4();
  for (let part = object; part !== null; part = part.parent) {
    if (!part.matrixWorldAutoUpdate) return matrix.premultiply(part.matrixWorld);
    if (part.matrixAutoUpdate) part.updateMatrix();
    matrix.premultiply(part.matrix);
  }
  return matrix;
}
