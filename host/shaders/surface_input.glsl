// Vertex pulling: draw instance i is patch firstPatch + i % patchCount of character instance i / patchCount, and the vertex
// index is the sample within the patch.
layout(set = 1, binding = kSurfaceVertexBinding, std430) readonly buffer SurfaceVertices { uint surfaceWords[]; };

uint drawnPatch() { return push.firstPatch + gl_InstanceIndex % push.patchCount; }

// Counted within a character instance.
uint surfaceVertex() {
    return push.firstVertex + (gl_InstanceIndex % push.patchCount) * push.samplesPerPatch + gl_VertexIndex;
}

uint surfaceWord() {
    uint vertex = (gl_InstanceIndex / push.patchCount) * push.verticesPerInstance + surfaceVertex();
    return vertex * ((push.flags & kDrawVertex24) != 0u ? 6u : 4u);
}

vec3 surfacePosition(uint word) {
    return uintBitsToFloat(uvec3(surfaceWords[word], surfaceWords[word + 1u], surfaceWords[word + 2u]));
}

vec3 surfaceNormal(uint word) {
    if ((push.flags & kDrawVertex24) != 0u)
        return uintBitsToFloat(uvec3(surfaceWords[word + 3u], surfaceWords[word + 4u], surfaceWords[word + 5u]));
    vec2 p = unpackSnorm2x16(surfaceWords[word + 3u]);
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0)
        n.xy = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
    return normalize(n);
}
