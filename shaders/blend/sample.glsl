// The sample of a face of the blending surface, with its derivatives (docs/blend.md): at a rate, by tables, and at levels. Needs
// tables.glsl, frame.glsl, kSharp and kVertexFormat.
#include "shaders/blend/blend.glsl"

uint coordinateCount() { return dispatchRate() + 3u; }
uint mirrored(uint i) { return i <= dispatchRate() ? dispatchRate() - i : 2u * dispatchRate() + 3u - i; }

// The entry of a fixed rate's tables at coordinates x and y.
ChartPoint tablePoint(Corner corner, uint x, uint y) {
    uint at = y * coordinateCount() + x;
    vec4 entry = uintBitsToFloat(tableElement(corner.where.x + at));
    vec2 direction = corner.directions.xy;
    vec2 toward = x == 0u && y > 0u ? corner.directions.zw : direction;
    vec2 zeta = product(entry.xy, toward), slope = product(entry.zw, direction);
    ChartPoint point = ChartPoint(zeta, slope, zeta.x, slope.x, -slope.y);
    if (isCreased(corner)) {
        vec4 crease = uintBitsToFloat(tableElement(corner.where.y + 2u * at));
        point.t = product(crease.xy, toward).x;
        point.tx = product(crease.zw, direction).x;
        point.ty = product(uintBitsToFloat(tableElement(corner.where.y + 2u * at + 1u).xy), direction).x;
    }
    return point;
}

void blendOfTables(Corner corners[4], uint i, uint j, out vec3 position, out vec3 du, out vec3 dv) {
    uint iBack = mirrored(i), jBack = mirrored(j);
    uvec2 at[4] = uvec2[4](uvec2(i, j), uvec2(j, iBack), uvec2(iBack, jBack), uvec2(jBack, i));
    CornerPlace places[4];
    for (uint k = 0u; k < 4u; ++k) {
        vec2 x = uintBitsToFloat(tableElement(header.coordinates + at[k].x).yz);
        vec2 y = uintBitsToFloat(tableElement(header.coordinates + at[k].y).yz);
        places[k] = CornerPlace(tablePoint(corners[k], at[k].x, at[k].y), x, y);
    }
    blend(corners, places, position, du, dv);
}

const float kTinyNormal = 1e-12; // against the face's diagonals, squared

// Whether the surface has no derivative at a sample, by connectivity alone.
bool liesStill(Corner corners[4], uint i, uint j) {
    bool onEdge[4] = bool[4](j == 0u, i == dispatchRate(), j == dispatchRate(), i == 0u);
    bool still = false;
    for (uint k = 0u; k < 4u; ++k) {
        still = still || (onEdge[k] && (corners[k].flags & kStillEdge) != 0u);
        still = still || (onEdge[k] && onEdge[(k + 3u) & 3u] && (corners[k].flags & kStillCorner) != 0u);
    }
    return still;
}

// Where even the face has a longer normal, that. `diagonal`, `other`: those of the face.
Frame checkedFrame(vec3 diagonal, vec3 other, Frame f) {
    vec3 a = diagonal * evenScale(diagonal), b = other * evenScale(other);
    vec3 n = (f.normal * evenScale(diagonal)) * evenScale(other);
    if (!(dot(n, n) > kTinyNormal * (dot(a, a) * dot(b, b))))
        f = withNormal(f, cross(diagonal, other));
    return f;
}
Frame checkedFrame(Corner corners[4], Frame f) {
    return checkedFrame(corners[2].c[0] - corners[0].c[0], corners[3].c[0] - corners[1].c[0], f);
}

// At corner k from its chart, where the blend's derivatives have a limit: along the two edges the powers of z that they have in
// common are left out. Beside a crease the two have different powers; then the edges themselves say where tangents point.
Frame cornerFrame(Corner corners[4], uint k) {
    Corner own = corners[k];
    vec3 normal = cross(own.c[3], own.c[1]);
    if (!kTangents) return Frame(vec3(0.0), vec3(0.0), normal);
    vec3 along = own.directions.x * own.c[3] + own.directions.y * own.c[1];
    vec3 across = own.directions.z * own.c[3] + own.directions.w * own.c[1];
    if (hasChords(own)) {
        along = corners[(k + 1u) & 3u].c[0] - own.c[0];
        across = corners[(k + 3u) & 3u].c[0] - own.c[0];
    }
    // The corner's own coordinates are the patch's, turned by k quarters.
    Frame f = Frame(along, across, normal);
    if (k == 1u) f = Frame(-across, along, normal);
    if (k == 2u) f = Frame(-along, -across, normal);
    if (k == 3u) f = Frame(across, -along, normal);
    if (hasChords(own)) f = withNormal(f, normal);
    return f;
}

// Half a step inside, for samples on a border.
uint inside(uint i) { return i == 0u ? dispatchRate() + 1u : i == dispatchRate() ? dispatchRate() + 2u : i; }

void evaluateAtRate(Corner corners[4], uint i, uint j, bool still, out vec3 position, out Frame frame) {
    vec3 du, dv;
    blendOfTables(corners, i, j, position, du, dv);
    if (kSharp && still) {
        vec3 unused;
        blendOfTables(corners, inside(i), inside(j), unused, du, dv);
    }
    frame = frameOf(du, dv);
    bool onEdge[4] = bool[4](j == 0u, i == dispatchRate(), j == dispatchRate(), i == 0u);
    for (uint k = 0u; k < 4u; ++k) {
        if (!still && onEdge[k] && onEdge[(k + 3u) & 3u]) frame = cornerFrame(corners, k);
    }
    frame = checkedFrame(corners, frame);
}

// At levels: where the normal of a sample is taken, a step inside where the surface lies still. Beside single faces cut off
// by a crease as well, where both derivatives run along it.
bool moveInside(Corner corners[4], inout vec2 u, inout vec2 v) {
    const float kStep = 1.0 / float(kStillSteps);
    bool moved = false;
    for (uint k = 0u; k < 4u; ++k) {
        float from = k == 0u ? v.x : k == 1u ? u.y : k == 2u ? v.y : u.x;
        if (!(from < kStep && (corners[k].flags & kStillEdge) != 0u)) continue;
        if (k == 0u) v = vec2(kStep, 1.0 - kStep);
        if (k == 1u) u = vec2(1.0 - kStep, kStep);
        if (k == 2u) v = vec2(1.0 - kStep, kStep);
        if (k == 3u) u = vec2(kStep, 1.0 - kStep);
        moved = true;
    }
    for (uint k = 0u; k < 4u; ++k) {
        bool right = k == 1u || k == 2u, top = k >= 2u;
        precise float along = right ? u.y : u.x, across = top ? v.y : v.x;
        float distance = max(along, across);
        bool still = (corners[k].flags & kStillCorner) != 0u;
        bool single = isCreased(corners[k]) && uintBitsToFloat(corners[k].where.x) > 1.0 && distance > 0.0;
        if (!(distance < kStep && (still || single))) continue;
        along = distance > 0.0 ? along * (kStep / distance) : kStep;
        across = distance > 0.0 ? across * (kStep / distance) : kStep;
        precise vec2 rest = 1.0 - vec2(along, across);
        u = right ? vec2(rest.x, along) : vec2(along, rest.x);
        v = top ? vec2(rest.y, across) : vec2(across, rest.y);
        moved = true;
    }
    return moved;
}

void evaluateLevels(Corner corners[4], vec2 u, vec2 v, out vec3 position, out Frame frame) {
    vec3 du, dv;
    blendAt(corners, u, v, position, du, dv);
    frame = frameOf(du, dv);
    if (kVertexFormat == kVertexPosition) return;
    bool moved = false;
    if (kSharp) {
        vec2 insideU = u, insideV = v;
        moved = moveInside(corners, insideU, insideV);
        if (moved) {
            vec3 unused;
            blendAt(corners, insideU, insideV, unused, du, dv);
            frame = frameOf(du, dv);
        }
    }
    for (uint k = 0u; k < 4u; ++k) {
        bool right = k == 1u || k == 2u, top = k >= 2u;
        if (!moved && (right ? u.y : u.x) == 0.0 && (top ? v.y : v.x) == 0.0) frame = cornerFrame(corners, k);
    }
    frame = checkedFrame(corners, frame);
}
