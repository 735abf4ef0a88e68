// The deformed cage, read.
LOADED_BUFFER(vec4, cage, Cage, kCageBinding, samplerBuffer, kCageTexelBinding, xyzw)
vec3 cageVertex(uint i) { return cage(i).xyz; }
