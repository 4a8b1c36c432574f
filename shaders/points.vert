#version 460

// One point a vertex, without a place: the geometry stage that follows reads the edge of its number.

void main() {}
