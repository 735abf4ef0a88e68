// The blend of four local geometries (docs/blend.md): positions and derivatives of a face. Where a sample lies in the
// charts is told from its parameters here, with level of detail; shaders/blend/evaluate.comp reads it from tables at a
// fixed rate. Needs tables.glsl and `const bool kSharp`: whether charts may be creased.
#include "shaders/shared/blend.h"
#include "shaders/shared/elementary.h"

struct Corner {
    uint flags;
    uvec2 where;     // at levels (4 / k, 0); else chart samples, crease samples
    vec4 directions; // of its spoke, of the next
    vec3 c[9];
};

// A place in a chart.
struct ChartPoint {
    vec2 zeta, slope; // U + iV, and its derivative by z
    float t, tx, ty;  // T, which takes U's place where V has no part: U itself, or the parameter of the crease
};

// A sample as a corner sees it: its place in the chart, and eta and its slope at x and y.
struct CornerPlace {
    ChartPoint point;
    vec2 x, y;
};

vec2 product(vec2 a, vec2 b) {
    precise vec2 p = vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
    return p;
}

bool isCreased(Corner corner) { return kSharp && (corner.flags & kCreasedChart) != 0u; }
// Tangents at the corner are told from the edges there.
bool hasChords(Corner corner) { return kSharp && (corner.flags & (kCreasedChart | kChordCorner)) != 0u; }

// Of z = x + iy. Beyond the diagonal it is told from the next spoke backwards, so that both faces at a spoke multiply the
// same two numbers, which take no division. cpu/chart_point.h has the same operations.
ChartPoint chartPoint(vec2 z, float power, bool creased, vec4 directions) {
    bool back = z.y > z.x;
    float high = back ? z.y : z.x, low = back ? z.x : z.y;
    vec2 toward = back ? directions.zw : directions.xy;
    precise float square = high * high + low * low;
    precise float octaves = 0.5 * log2Of(square);
    precise float tangent = low / max(high, 1e-9);
    precise float angle = power * angleOf(tangent);
    float radius = exp2Of(power * octaves);
    vec2 unit = product(vec2(cosineOf(angle), back ? -sineOf(angle) : sineOf(angle)), toward);
    precise vec2 zeta = radius * unit;
    precise vec2 slope = power / max(square, 1e-18) * product(zeta, vec2(z.x, -z.y));
    if (power == 1.0) { // all but extraordinary vertices: z itself, turned
        zeta = product(vec2(high, back ? -low : low), toward);
        slope = directions.xy;
    }
    if (high == 0.0) zeta = slope = vec2(0.0);
    ChartPoint at = ChartPoint(zeta, slope, zeta.x, slope.x, -slope.y);
    if (creased && power != 1.0) {
        float distance = low == 0.0 ? high : exp2Of(octaves);
        precise vec2 arm = z / max(distance, 1e-9);
        precise vec3 t = vec3(distance * unit.x, arm.x * unit.x + power * (arm.y * unit.y),
                              arm.y * unit.x - power * (arm.x * unit.y));
        at.t = t.x;
        at.tx = t.y;
        at.ty = t.z;
    }
    return at;
}

// eta and its slope.
vec2 hermite(float t) {
    precise vec2 h = vec2((2.0 * t - 3.0) * t * t + 1.0, 6.0 * t * (t - 1.0));
    return h;
}

// The local geometry's offset from c_00 and its derivatives by the corner's coordinates.
void localGeometry(vec3 c[9], ChartPoint at, out vec3 offset, out vec3 dx, out vec3 dy) {
    float u = at.zeta.x, v = at.zeta.y, t = at.t;
    precise vec3 c0 = c[1] + u * (c[4] + u * c[7]); // of V, and of V^2
    precise vec3 c1 = c[2] + u * (c[5] + u * c[8]);
    precise vec3 value = t * (c[3] + t * c[6]) + v * (c0 + v * c1);
    vec3 dt = c[3] + 2.0 * (t * c[6]);
    vec3 du = v * ((c[4] + 2.0 * (u * c[7])) + v * (c[5] + 2.0 * (u * c[8])));
    vec3 dv = c0 + 2.0 * (v * c1);
    offset = value;
    dx = at.tx * dt + (at.slope.x * du + at.slope.y * dv);
    dy = at.ty * dt + (at.slope.x * dv - at.slope.y * du);
}

void blend(Corner corners[4], CornerPlace places[4], out vec3 position, out vec3 du, out vec3 dv) {
    precise vec3 points[4];
    vec3 dx[4], dy[4];
    for (uint k = 0u; k < 4u; ++k) {
        vec3 offset, localX, localY;
        localGeometry(corners[k].c, places[k].point, offset, localX, localY);
        vec2 x = places[k].x, y = places[k].y;
        precise float weight = x.x * y.x;
        precise vec3 p = weight * (corners[k].c[0] + offset);
        points[k] = p;
        // The slopes of the four weights add up to nothing, so that derivatives need not see coordinates.
        precise vec3 relative = (corners[k].c[0] - corners[0].c[0]) + offset;
        dx[k] = (x.y * y.x) * relative + weight * localX;
        dy[k] = (x.x * y.y) * relative + weight * localY;
    }
    // Opposite corners together: on an edge one of the two is zero, and the sum reads the same from both faces.
    precise vec3 sum = (points[0] + points[2]) + (points[1] + points[3]);
    position = withPositiveZeros(sum);
    du = (dx[0] - dx[2]) + (dy[3] - dy[1]);
    dv = (dy[0] - dy[2]) + (dx[1] - dx[3]);
}

// At levels: u and v with their complements.
void blendAt(Corner corners[4], vec2 u, vec2 v, out vec3 position, out vec3 du, out vec3 dv) {
    vec2 at[4] = vec2[4](vec2(u.x, v.x), vec2(v.x, u.y), vec2(u.y, v.y), vec2(v.y, u.x));
    CornerPlace places[4];
    for (uint k = 0u; k < 4u; ++k) {
        ChartPoint point =
            chartPoint(at[k], uintBitsToFloat(corners[k].where.x), isCreased(corners[k]), corners[k].directions);
        places[k] = CornerPlace(point, hermite(at[k].x), hermite(at[k].y));
    }
    blend(corners, places, position, du, dv);
}

// All of a patch's corner but its coefficients.
Corner cornerOf(uint record, out uint poolIndex) {
    uvec4 words = tableElement(record);
    Corner corner;
    corner.flags = words.x & ~kPoolIndexMask;
    corner.where = words.zw;
    corner.directions = uintBitsToFloat(tableElement(words.y));
    poolIndex = words.x & kPoolIndexMask;
    return corner;
}
