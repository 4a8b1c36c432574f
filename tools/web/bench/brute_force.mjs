// The silhouette by its definition in JavaScript, for comparison: tests every face, then every edge. Typed arrays that
// are made once, no allocation in a frame. Planes are rounded, so single edges may differ from the exact silhouette.

export class BruteForce {
  /** `index`: three welded vertices for each face of a closed mesh. */
  constructor(positions, index) {
    const faceCount = index.length / 3;
    this.planes = new Float32Array(4 * faceCount);
    this.front = new Uint8Array(faceCount);
    const faces = new Map(); // By the two vertices of an edge, the lesser times 2^26 and the greater.
    const edgeFaces = [];
    const edgeVertices = [];
    for (let face = 0; face < faceCount; ++face) {
      const corners = index.subarray(3 * face, 3 * face + 3);
      this.planes.set(planeOf(positions, corners), 4 * face);
      for (let i = 0; i < 3; ++i) {
        const [from, to] = [corners[i], corners[(i + 1) % 3]];
        const edge = Math.min(from, to) * 2 ** 26 + Math.max(from, to);
        const other = faces.get(edge);
        faces.set(edge, face);
        if (other === undefined) continue;
        edgeFaces.push(other, face);
        edgeVertices.push(from, to);
      }
    }
    this.edgeFaces = Uint32Array.from(edgeFaces);
    this.edgeVertices = Uint32Array.from(edgeVertices);
  }

  get sizeBytes() {
    return [this.planes, this.front, this.edgeFaces, this.edgeVertices].reduce((sum, array) => sum + array.byteLength, 0);
  }

  /** Writes the two vertices of each edge of the silhouette to `lines`, and returns the number of edges. */
  write(x, y, z, lines) {
    const { planes, front, edgeFaces, edgeVertices } = this;
    for (let face = 0, i = 0; face < front.length; ++face, i += 4)
      front[face] = planes[i] * x + planes[i + 1] * y + planes[i + 2] * z + planes[i + 3] > 0 ? 1 : 0;
    let count = 0;
    for (let i = 0; i < edgeFaces.length; i += 2)
      if (front[edgeFaces[i]] !== front[edgeFaces[i + 1]]) {
        lines[count++] = edgeVertices[i];
        lines[count++] = edgeVertices[i + 1];
      }
    return count / 2;
  }
}

function planeOf(positions, [a, b, c]) {
  const edge = (to) => [0, 1, 2].map((axis) => positions[3 * to + axis] - positions[3 * a + axis]);
  const [u, v] = [edge(b), edge(c)];
  const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  return [...normal, -normal.reduce((sum, component, axis) => sum + component * positions[3 * a + axis], 0)];
}
