// What the clip table says of nodes. Needs table(), tableFloats() and `push`.

uint parentOf(uint node) { return table(kNodeElements * node).x; }
bool hangsOn(uint node, uint above) {
    bool found = node == above;
    for (uint n = parentOf(node), k = 0u; n != kNoNode && k < push.nodeCount; n = parentOf(n), ++k) {
        if (n == above) found = true;
    }
    return found;
}
bool isFixed(uint node) { return (table(kNodeElements * node).y & kNodeFixed) != 0u; }

Transform restTransform(uint node) {
    uint first = kNodeElements * node;
    Transform t;
    t.translation = vec3(tableFloats(first + 1u));
    t.rotation = tableFloats(first + 2u);
    t.scale = vec3(tableFloats(first + 3u));
    return t;
}

Affine localMatrix(uint node, Transform t) {
    SUPPLE_PRECISE Affine m = composed(t);
    if (isFixed(node)) {
        uint first = kNodeElements * node;
        m = rowsOf(tableFloats(first + 1u), tableFloats(first + 2u), tableFloats(first + 3u));
    }
    return m;
}
