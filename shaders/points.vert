#version 460

// One point per vertex, without a position. The geometry stage reads the edge with the point's
// number.

void main() {}
