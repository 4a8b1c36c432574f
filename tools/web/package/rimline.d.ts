/** Three finite numbers within 2^60. They are rounded to 32 bits. */
export type Vector = ArrayLike<number> | { x: number; y: number; z: number };

/** A viewpoint, or the direction towards a viewer at infinity, which is not zero. */
export type Point = Vector | { direction: Vector };

/**
 * A triangle mesh. Edges have the numbers 0 to `edgeCount - 1`; borders, which have one face, are the last of them
 * and in no silhouette.
 */
export interface Mesh {
  /** Used vertices; equal positions are one. */
  readonly vertexCount: number;
  readonly faceCount: number;
  readonly edgeCount: number;
  readonly borderCount: number;
  /** Whether every edge has an even number of faces. */
  readonly isClosed: boolean;
  /** Whether no edge has two faces that traverse it in the same direction. */
  readonly isOriented: boolean;
  /** The center of the bounding box. */
  readonly center: [number, number, number];
  /** The greatest distance from there to a vertex. */
  readonly radius: number;
  /** The two vertices of each edge, by the numbers of `positions`. Of equal positions the first stands for all. */
  readonly edges: Uint32Array;
  /** The edges of the silhouette from a point, ascending. Tests all faces until there is a tracker of this mesh. */
  silhouette(point: Point): Uint32Array;
  /** Frees the memory. Every later use throws. Trackers of the mesh stay whole. */
  dispose(): void;
}

export interface MeshConstructor {
  /**
   * @param positions three coordinates for each vertex, finite and within 2^60
   * @param indices three vertices for each triangle, counter-clockwise from outside; none: vertices 0, 1, 2 are the
   *   first triangle, and so on
   * @param options `weld`: equal positions are one vertex, so that seams make no borders; true by default
   */
  new (
    positions: Float32Array | Float64Array | readonly number[],
    indices?: Uint32Array | Uint16Array | Uint8Array | Int32Array | Int16Array | Int8Array | readonly number[] | null,
    options?: { weld?: boolean },
  ): Mesh;
}

/**
 * What a move changed. The arrays are views of Rimline's memory: valid until the tracker moves again or is disposed
 * of, and until any other call makes that memory grow. Read them from the change when you need them, or copy them.
 */
export interface Change {
  /** Edges that joined the silhouette. */
  readonly added: Uint32Array;
  /** Edges that left it. */
  readonly removed: Uint32Array;
  /** Pairs: a slot, and its new edge. Slots are the places of `Tracker.silhouette`. */
  readonly slots: Uint32Array;
  /** Faces that turned. */
  readonly flipped: Uint32Array;
  /** Pairs: a word of face bits, and its new bits. Face f is bit f % 32 of word f >> 5. A set bit faces the point. */
  readonly words: Uint32Array;
}

/** The silhouette of a mesh from a point that moves. */
export interface Tracker {
  /** Takes time for what changes, not for the whole mesh, and allocates nothing in Rimline's memory. */
  moveTo(point: Point): Change;
  /** The edges of the silhouette, unordered and without gaps: a view, as those of a change. */
  readonly silhouette: Uint32Array;
  /** Frees the memory. Every later use throws. */
  dispose(): void;
}

export interface TrackerConstructor {
  /** The first tracker of a mesh builds its index. The mesh may be disposed of before the tracker. */
  new (mesh: Mesh, point: Point): Tracker;
}

export interface Rimline {
  readonly Mesh: MeshConstructor;
  readonly Tracker: TrackerConstructor;
}

/**
 * Loads `rimline.wasm`. Objects of different calls do not know each other.
 *
 * @param options `wasm`: where the module is (a URL relative to the page, in a worker to its script; in Node a path or a
 *   URL), its bytes, or the module; by default the file beside this one
 */
export function createRimline(options?: {
  wasm?: URL | string | ArrayBuffer | ArrayBufferView | WebAssembly.Module;
}): Promise<Rimline>;
