// Silhouettes of triangle meshes, found by rimline.wasm. rimline.d.ts describes the interface.
//
// A pointer of the module is a number here, unsigned by `>>> 0`. Views of its memory are made anew whenever they
// are needed, because memory that grows takes all older views away.

const MAX_COORDINATE = 2 ** 60;
const MIN_COMPONENT = 2 ** -60; // Smaller components of a point are zero to the library.

export async function createRimline(options) {
  const { wasm = new URL("./rimline.wasm", import.meta.url) } = optionsOf("createRimline", ["wasm"], options);
  let memory;
  const imports = {
    rimline: {
      fail(message) {
        const bytes = new Uint8Array(memory.buffer, message >>> 0);
        throw new Error(new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0))));
      },
    },
    env: { emscripten_notify_memory_growth() {} },
    // The library prints one thing, the line of a check that failed, and then ends in a trap.
    wasi_snapshot_preview1: { proc_exit() {}, fd_close: () => 0, fd_write: () => 0, fd_seek: () => 0 },
  };
  const module = wasm instanceof WebAssembly.Module ? wasm : await compile(wasm);
  if (!WebAssembly.Module.exports(module).some(({ name }) => name === "mesh_silhouette"))
    throw new Error("wasm: this is another module than Rimline's");
  const { exports } = await WebAssembly.instantiate(module, imports);
  memory = exports.memory;
  exports._initialize();
  return makeClasses(unwinding(exports));
}

// An error leaves the module's functions without giving back their part of its stack.
function unwinding(exports) {
  const top = exports.stackSave();
  const guarded = (call) => (...values) => {
    try {
      return call(...values);
    } catch (error) {
      exports.stackRestore(top);
      throw error;
    }
  };
  const isFunction = ([, value]) => typeof value === "function";
  const functions = Object.entries(exports).filter(isFunction).map(([name, call]) => [name, guarded(call)]);
  return { ...Object.fromEntries(functions), memory: exports.memory };
}

async function compile(wasm) {
  if (wasm instanceof ArrayBuffer) return WebAssembly.compile(wasm);
  if (ArrayBuffer.isView(wasm))
    return WebAssembly.compile(new Uint8Array(wasm.buffer, wasm.byteOffset, wasm.byteLength));
  if (typeof wasm !== "string" && !(wasm instanceof URL))
    throw new TypeError(`wasm: expected a URL, a path, bytes or a module, not ${wasm}`);
  const url = await urlOf(wasm);
  if (url.protocol === "file:") {
    const { readFile } = await nodeModule("fs/promises");
    return compileBytes(url, await readFile(url));
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
  return compileBytes(url, new Uint8Array(await response.arrayBuffer()));
}

// Servers of single-page applications answer every address with their page.
function compileBytes(url, bytes) {
  if (String.fromCharCode(...bytes.subarray(0, 4)) !== "\0asm")
    throw new Error(`${url}: this is no WebAssembly; createRimline({ wasm }) says where rimline.wasm is`);
  return WebAssembly.compile(bytes);
}

// By a name that bundlers for browsers do not look for.
const nodeModule = (name) => import(/* webpackIgnore: true */ /* @vite-ignore */ `node:${name}`);

// An object of options, or none, with these names alone.
function optionsOf(name, known, options = {}) {
  if (typeof options !== "object" || options === null)
    throw new TypeError(`${name}: expected an object of options, not ${options}`);
  for (const option of Object.keys(options))
    if (!known.includes(option)) throw new TypeError(`${name}: there is no option ${option}`);
  return options;
}

// Relative to the page, or in a worker to its script. Without either it is a path, or a URL.
async function urlOf(wasm) {
  if (wasm instanceof URL) return wasm;
  if (globalThis.location !== undefined) return new URL(wasm, globalThis.location.href);
  if (/^[a-z][a-z0-9+.-]+:/i.test(wasm)) return new URL(wasm); // One letter is a drive.
  const { pathToFileURL } = await nodeModule("url");
  return pathToFileURL(wasm);
}

// The classes of one instance of the module.
function makeClasses(wasm) {
  let meshPointer; // Of a Mesh.
  let stateOf; // A view of an array of a Tracker, by its place in TrackerState (tools/web/exports.cpp).
  const numbers = (Type, pointer, count) => new Type(wasm.memory.buffer, pointer >>> 0, count);

  // Objects of the module that are not disposed of are freed some time after nobody can reach them.
  const registry = new FinalizationRegistry(({ free, pointer }) => free(pointer));
  const owners = new WeakMap(); // Views of a tracker's memory keep it alive.

  class Handle {
    #pointer;
    #free;

    constructor(pointer, free) {
      this.#pointer = pointer;
      this.#free = free;
      registry.register(this, { free, pointer }, this);
    }
    get pointer() {
      if (this.#pointer === 0) throw new Error("this object was disposed of");
      return this.#pointer;
    }
    dispose() {
      if (this.#pointer === 0) return;
      registry.unregister(this);
      this.#free(this.#pointer);
      this.#pointer = 0;
    }
  }

  class Mesh {
    #handle;
    #edges;

    constructor(positions, indices = null, options) {
      const { weld = true } = optionsOf("Mesh", ["weld"], options);
      if (typeof weld !== "boolean") throw new TypeError(`weld: expected true or false, not ${weld}`);
      const coordinates = numbersOf("positions", positions, FLOATS);
      const corners = indices == null ? null : numbersOf("indices", indices, INTEGERS);
      expectTriples("positions", coordinates.length);
      if (corners !== null) expectTriples("indices", corners.length);
      const vertexCount = coordinates.length / 3;
      const cornerCount = corners?.length ?? vertexCount;
      if (cornerCount % 3 !== 0)
        throw new RangeError(`positions: without indices, expected three vertices for each triangle, not ${vertexCount}`);

      const source = wasm.source_create(vertexCount, cornerCount / 3);
      numbers(Float32Array, wasm.source_positions(source), coordinates.length).set(coordinates);
      const written = numbers(Uint32Array, wasm.source_corners(source), cornerCount);
      if (corners !== null) written.set(corners);
      else for (let i = 0; i < cornerCount; ++i) written[i] = i;
      this.#handle = new Handle(wasm.mesh_create(source, weld), wasm.mesh_free);
    }

    get vertexCount() {
      return wasm.mesh_vertex_count(this.#handle.pointer) >>> 0;
    }
    get faceCount() {
      return wasm.mesh_face_count(this.#handle.pointer) >>> 0;
    }
    get edgeCount() {
      return wasm.mesh_edge_count(this.#handle.pointer) >>> 0;
    }
    get borderCount() {
      return wasm.mesh_border_count(this.#handle.pointer) >>> 0;
    }
    get isClosed() {
      return wasm.mesh_is_closed(this.#handle.pointer) !== 0;
    }
    get isOriented() {
      return wasm.mesh_is_oriented(this.#handle.pointer) !== 0;
    }
    get center() {
      const pointer = this.#handle.pointer;
      return [0, 1, 2].map((axis) => wasm.mesh_center(pointer, axis));
    }
    get radius() {
      return wasm.mesh_radius(this.#handle.pointer);
    }

    get edges() {
      const pointer = this.#handle.pointer;
      if (this.#edges === undefined) {
        const count = 2 * this.edgeCount;
        const written = wasm.malloc(4 * count);
        if (written === 0) throw new Error("out of memory");
        wasm.mesh_write_edges(pointer, written);
        this.#edges = numbers(Uint32Array, written, count).slice();
        wasm.free(written);
      }
      return this.#edges;
    }

    silhouette(point) {
      const pointer = this.#handle.pointer;
      const count = wasm.mesh_silhouette(pointer, ...pointOf(point)) >>> 0;
      return numbers(Uint32Array, wasm.mesh_found(pointer), count).slice();
    }

    dispose() {
      this.#handle.dispose();
    }

    static {
      meshPointer = (mesh) => {
        if (typeof mesh !== "object" || mesh === null || !(#handle in mesh))
          throw new TypeError("mesh: expected a Mesh of the same createRimline()");
        return mesh.#handle.pointer;
      };
    }
  }

  // The arrays of the last move. Each is a view that is made when it is asked for.
  class Change {
    #tracker;
    #moves;

    constructor(tracker, moves) {
      this.#tracker = tracker;
      this.#moves = moves;
    }
    get added() {
      return stateOf(this.#tracker, 1, this.#moves);
    }
    get removed() {
      return stateOf(this.#tracker, 2, this.#moves);
    }
    get flipped() {
      return stateOf(this.#tracker, 3, this.#moves);
    }
    get slots() {
      return stateOf(this.#tracker, 4, this.#moves);
    }
    get words() {
      return stateOf(this.#tracker, 5, this.#moves);
    }
  }

  class Tracker {
    #handle;
    #moves = 0;

    constructor(mesh, point) {
      const pointer = wasm.tracker_create(meshPointer(mesh), ...pointOf(point));
      this.#handle = new Handle(pointer, wasm.tracker_free);
    }

    moveTo(point) {
      const pointer = this.#handle.pointer;
      wasm.tracker_move(pointer, ...pointOf(point));
      return new Change(this, ++this.#moves);
    }
    get silhouette() {
      return stateOf(this, 0, this.#moves);
    }
    dispose() {
      this.#handle.dispose();
    }

    static {
      stateOf = (tracker, place, moves) => {
        const pointer = tracker.#handle.pointer;
        if (moves !== tracker.#moves) throw new Error("this change ended when its tracker moved again");
        const [data, count] = numbers(Uint32Array, wasm.tracker_state(pointer) + 8 * place, 2);
        const view = numbers(Uint32Array, data, count);
        owners.set(view, tracker);
        return view;
      };
    }
  }

  return { Mesh, Tracker };
}

const FLOATS = {
  types: [Float32Array, Float64Array],
  checkedTypes: [],
  words: "a Float32Array, a Float64Array or an array of numbers",
  isValid: (value) => typeof value === "number", // The module finds those that are not finite.
};
const INTEGERS = {
  types: [Uint32Array, Uint16Array, Uint8Array],
  checkedTypes: [Int32Array, Int16Array, Int8Array],
  words: "an array of the numbers of vertices",
  isValid: (value) => Number.isInteger(value) && value >= 0 && value <= 0xffffffff,
};

function numbersOf(name, values, { types, checkedTypes, words, isValid }) {
  if (types.some((Type) => values instanceof Type)) return values;
  if (!Array.isArray(values) && !checkedTypes.some((Type) => values instanceof Type)) throw new TypeError(`${name}: expected ${words}`);
  for (let i = 0; i < values.length; ++i)
    if (!isValid(values[i])) throw new TypeError(`${name}[${i}]: expected ${words}, not ${values[i]}`);
  return values;
}

function expectTriples(name, length) {
  if (length % 3 !== 0) throw new RangeError(`${name}: expected a multiple of three numbers, not ${length}`);
}

// The arguments of the module for an eye, or for { direction }.
function pointOf(point) {
  const isDirection = point?.direction !== undefined;
  const name = isDirection ? "direction" : "eye";
  const vector = vectorOf(name, isDirection ? point.direction : point);
  if (isDirection && vector.every((component) => Math.abs(component) < MIN_COMPONENT))
    throw new RangeError("direction: expected a vector that is not zero");
  return [...vector, isDirection];
}

function vectorOf(name, value) {
  const isList = typeof value?.length === "number";
  if (isList && value.length !== 3) throw new RangeError(`${name}: expected three numbers, not ${value.length}`);
  const vector = isList ? [value[0], value[1], value[2]] : [value?.x, value?.y, value?.z];
  for (const component of vector) {
    if (typeof component !== "number") throw new TypeError(`${name}: expected three numbers, or x, y and z`);
    if (!(Math.abs(component) <= MAX_COORDINATE))
      throw new RangeError(`${name}: expected finite numbers within 2^60, not ${component}`);
  }
  return vector;
}
