#version 460

// Nothing: the geometry stage reads the edge itself.

void main() {}
