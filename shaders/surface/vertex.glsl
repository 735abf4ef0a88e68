// The vertex stage, as far as schemes share it: limit point, tangent points and face coefficients of a fan whose weights
// depend on connectivity alone. Needs tables.glsl, pool.glsl, store.glsl, ring.glsl, and from the scheme
//   vec3 ringDiagonal(uint word, uint cageBase, vec3 p0)   opposite corner of a spoke's facet, relative to p0
// Everything is summed over differences to the vertex: far from the origin that keeps the tangents, and with them the
// normals, several times more exact. The weights of a point sum to 1 and those of a vector to 0, so that the centre's own
// weight never appears.

// (4 p0 + 2 (spoke + nextSpoke) + diagonal) / 9, relative to p0.
vec3 faceCoefficient(vec3 spoke, vec3 nextSpoke, vec3 diagonal) {
    precise vec3 r = (2.0 * (spoke + nextSpoke) + diagonal) * (1.0 / 9.0);
    return r;
}

void storeLimit(uint i, vec3 p0, vec3 relative) {
    precise vec3 p = p0 + relative;
    storePool(i, p);
}

// An offset from the limit point, of a point given relative to p0 as the limit point is.
void storeOffset(uint i, vec3 point, vec3 limit) {
    precise vec3 offset = point - limit;
    storePool(i, offset);
}

// A closed fan of four: the uniform bicubic B-spline.
void regularFan(uint limit, uint tangent, uint face, uvec4 words, uint cageBase, vec3 p0) {
    precise vec3 e[4], d[4];
    for (uint k = 0u; k < 4u; ++k) {
        e[k] = ringSpoke(words[k], cageBase) - p0;
        d[k] = ringDiagonal(words[k], cageBase, p0);
    }
    precise vec3 x = (4.0 * ((e[0] + e[2]) + (e[1] + e[3])) + ((d[0] + d[2]) + (d[1] + d[3]))) * (1.0 / 36.0);
    precise vec3 e1 = (4.0 * (e[0] - e[2]) + ((d[0] - d[2]) + (d[3] - d[1]))) * (1.0 / 36.0);
    precise vec3 e2 = (4.0 * (e[1] - e[3]) + ((d[0] - d[2]) + (d[1] - d[3]))) * (1.0 / 36.0);
    storeLimit(limit, p0, x);
    storePool(tangent, e1);
    storePool(tangent + 1u, e2);
    storePool(tangent + 2u, -e1);
    storePool(tangent + 3u, -e2);
    for (uint k = 0u; k < 4u; ++k) storeOffset(face + k, faceCoefficient(e[k], e[(k + 1u) & 3u], d[k]), x);
}

// Any fan, with the weights of its class (two elements a spoke from `weights` on). Gives e1 x e2.
vec3 weightedFan(uint limit, uint tangent, uint face, uint words, uint cageBase, vec3 p0, uint weights, uint sectors,
                 bool open) {
    uint spokes = open ? sectors + 1u : sectors;
    precise vec3 x = vec3(0.0), e1 = vec3(0.0), e2 = vec3(0.0);
    vec3 firstSpoke = vec3(0.0), lastSpoke = vec3(0.0);
    for (uint k = 0u; k < spokes; ++k) {
        uint word = tableWord(words + k);
        precise vec3 spoke = ringSpoke(word, cageBase) - p0;
        precise vec3 diagonal = ringDiagonal(word, cageBase, p0);
        vec4 a = uintBitsToFloat(tableElement(weights + 2u * k));
        vec4 b = uintBitsToFloat(tableElement(weights + 1u + 2u * k));
        x = x + (a.x * spoke + a.y * diagonal);
        e1 = e1 + (a.z * spoke + a.w * diagonal);
        e2 = e2 + (b.x * spoke + b.y * diagonal);
        if (k == 0u) firstSpoke = spoke;
        lastSpoke = spoke;
    }
    storeLimit(limit, p0, x);
    vec3 near = firstSpoke;
    for (uint k = 0u; k < spokes; ++k) {
        vec4 b = uintBitsToFloat(tableElement(weights + 1u + 2u * k));
        precise vec3 t = e1 * b.z + e2 * b.w;
        storePool(tangent + k, t);
        if (k < sectors) {
            uint next = tableWord(words + (k + 1u == spokes ? 0u : k + 1u));
            precise vec3 far = ringSpoke(next, cageBase) - p0;
            storeOffset(face + k, faceCoefficient(near, far, ringDiagonal(tableWord(words + k), cageBase, p0)), x);
            near = far;
        }
    }
    if (open) {
        // The curve at its end is the cubic B-spline of the control polygon, whatever the inside does.
        precise vec3 first = firstSpoke * (1.0 / 3.0);
        precise vec3 last = lastSpoke * (1.0 / 3.0);
        storeOffset(tangent, first, x);
        storeOffset(tangent + sectors, last, x);
    }
    return cross(e1, e2);
}
