// The rules of Catmull-Clark and Loop on a fragment, and their limits (docs/kernel.md). From the includer: `point(i)`,
// the fragment's point of spiral index i on the level that is read.
//
// Every operand is added to its mirror image before anything is scaled, so that all fragments that have a point compute
// the same bits for it.

layout(constant_id = 3) const bool kLoop = false;

struct Sources {
    uint s[8];
};

Sources unpackSources(uvec4 row) {
    return Sources(uint[8](row.x & 0xFFFFu, row.x >> 16, row.y & 0xFFFFu, row.y >> 16, row.z & 0xFFFFu, row.z >> 16,
                           row.w & 0xFFFFu, row.w >> 16));
}

// Sharpness of a spoke after `steps` steps; infinite sharpness stays.
float softened(float sharpness, uint steps) {
    precise float left = sharpness - float(steps);
    return sharpness >= 1e9 ? sharpness : left > 0.0 ? left : 0.0;
}

vec3 blended(float sharpness, vec3 smoothPoint, vec3 creasePoint) {
    precise vec3 mixed = smoothPoint + sharpness * (creasePoint - smoothPoint);
    if (sharpness >= 1.0) return creasePoint;
    return sharpness > 0.0 ? mixed : smoothPoint;
}

vec3 facePoint(Sources row) {
    precise vec3 p = ((point(row.s[0]) + point(row.s[1])) + (point(row.s[2]) + point(row.s[3]))) * 0.25;
    return p;
}

vec3 edgePoint(Sources row, float sharpness) {
    precise vec3 ends = point(row.s[0]) + point(row.s[1]);
    precise vec3 p;
    if (kLoop) {
        p = (3.0 * ends + (point(row.s[2]) + point(row.s[3]))) * 0.125;
    } else {
        p = (6.0 * ends + ((point(row.s[2]) + point(row.s[3])) + (point(row.s[4]) + point(row.s[5])))) * 0.0625;
    }
    precise vec3 crease = ends * 0.5;
    return blended(sharpness, p, crease);
}

// `around`: the neighbours of the row's first source, which Loop does not need.
vec3 vertexPoint(Sources row, Sources around, float sharpness) {
    vec3 c = point(row.s[0]);
    precise vec3 axis, p;
    if (kLoop) {
        axis = point(row.s[1]) + point(row.s[2]);
        precise vec3 sides = (point(row.s[3]) + point(row.s[4])) + (point(row.s[5]) + point(row.s[6]));
        p = (10.0 * c + (sides + axis)) * 0.0625;
    } else {
        axis = point(around.s[0]) + point(around.s[4]);
        precise vec3 edges = axis + (point(around.s[2]) + point(around.s[6]));
        precise vec3 diagonals = (point(around.s[1]) + point(around.s[5])) + (point(around.s[3]) + point(around.s[7]));
        p = (36.0 * c + (6.0 * edges + diagonals)) * 0.015625;
    }
    precise vec3 crease = 0.75 * c + axis * 0.125;
    return blended(sharpness, p, crease);
}

// The centre, by the weights of its spoke and face points and its step (smooth, crease, first and second spoke).
vec3 centrePoint(uint spokes, vec2 weights, float smoothShare, float creaseShare, uint first, uint second) {
    const uint stride = kLoop ? 1u : 2u;
    vec3 c = point(0u);
    precise vec3 spokeSum = vec3(0.0), faceSum = vec3(0.0);
    for (uint k = 0u; k < spokes; ++k) {
        precise vec3 spoke = point(1u + stride * k) - c;
        spokeSum = spokeSum + spoke;
        if (!kLoop) {
            precise vec3 face = point(2u + stride * k) - c;
            faceSum = faceSum + face;
        }
    }
    precise vec3 p = c;
    precise vec3 offset = vec3(0.0);
    if (smoothShare > 0.0) offset = smoothShare * (weights.x * spokeSum + weights.y * faceSum);
    if (creaseShare > 0.0) {
        precise vec3 ends = (point(1u + stride * first) - c) + (point(1u + stride * second) - c);
        offset = offset + creaseShare * (0.125 * ends);
    }
    p = c + offset;
    return p;
}

vec3 crossProduct(vec3 a, vec3 b) {
    precise vec3 n = vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    return n;
}

// Limit position and normal (not of unit length) of a point off the centre. `right`: the sector lies right of its axis.
void limitPoint(uint index, Sources n, float sharpness, bool right, out vec3 position, out vec3 normal) {
    vec3 c = point(index);
    vec3 p[8];
    for (uint k = 0u; k < (kLoop ? 6u : 8u); ++k) p[k] = point(n.s[k]);
    precise vec3 limit, along, across, axis;
    bool sharp = sharpness > 0.0;
    if (kLoop) {
        axis = p[0] + p[3];
        precise vec3 left = p[1] + p[2], rights = p[4] + p[5];
        precise vec3 difference = p[0] - p[3];
        limit = (6.0 * c + ((left + rights) + axis)) * (1.0 / 12.0);
        along = 2.0 * difference + ((p[1] - p[2]) + (p[5] - p[4]));
        across = left - rights;
        if (sharp) {
            along = difference;
            precise vec3 side = right ? rights : left;
            across = 2.0 * (side - c) - axis;
        }
    } else {
        axis = p[0] + p[4];
        precise vec3 edges = axis + (p[2] + p[6]);
        precise vec3 diagonals = (p[1] + p[5]) + (p[3] + p[7]);
        limit = (16.0 * c + (4.0 * edges + diagonals)) * (1.0 / 36.0);
        along = (4.0 * p[0] + (p[1] + p[7])) - (4.0 * p[4] + (p[3] + p[5]));
        across = (4.0 * p[2] + (p[1] + p[3])) - (4.0 * p[6] + (p[5] + p[7]));
        if (sharp) {
            along = p[0] - p[4];
            precise vec3 corners = right ? p[7] + p[5] : p[1] + p[3];
            vec3 edge = right ? p[6] : p[2];
            across = 4.0 * (edge - c) + (corners - axis);
        }
    }
    precise vec3 crease = (4.0 * c + axis) * (1.0 / 6.0);
    precise vec3 p0 = (sharp ? crease : limit) + 0.0; // no -0: sides of a border may come to different zeros
    position = p0;
    normal = sharp && right ? crossProduct(across, along) : crossProduct(along, across);
}
