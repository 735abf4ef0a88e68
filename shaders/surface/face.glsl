// (4 p0 + 2 (spoke + nextSpoke) + diagonal) / 9, relative to p0.
vec3 faceCoefficient(vec3 spoke, vec3 nextSpoke, vec3 diagonal) {
    precise vec3 r = (2.0 * (spoke + nextSpoke) + diagonal) * (1.0 / 9.0);
    return r;
}
