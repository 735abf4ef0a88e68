// Limit samples of fragments, all kinds. Needs fragment.glsl and frame.glsl.

// Derivatives along the grid of a sector, from the one along an axis and the one a quarter turn further (Loop: what the derivative
// a sixth of a turn further has beyond half of the axis'). `turns`: from the axis to the sector's first edge.
vec3 derivativeTowards(uint turns, vec3 axis, vec3 beside) {
    if (kLoop) {
        vec3 d = turns % 3u == 0u ? axis : turns % 3u == 1u ? 0.5 * axis + beside : beside - 0.5 * axis;
        return turns % 6u < 3u ? d : -d;
    }
    vec3 d = (turns & 1u) == 0u ? axis : beside;
    return (turns & 2u) == 0u ? d : -d;
}

// Limit position and frame of a point off the centre, from its neighbors counter-clockwise from its axis on. `right`: the sector
// lies right of the axis.
void limitPoint(vec3 c, vec3 p[8], float sharpness, bool right, uint turns, out vec3 position, out Frame frame) {
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
    precise vec3 p0 = sharp ? crease : limit;
    position = withPositiveZeros(p0);
    frame.normal = sharp && right ? crossProduct(across, along) : crossProduct(along, across);
    frame.du = frame.dv = vec3(0.0);
    if (kTangents) {
        // Twelve times the derivatives of a step of the grid: along and across have lost different factors.
        float side = right ? -1.0 : 1.0;
        vec3 first = (sharp ? 6.0 : kLoop ? 2.0 : 1.0) * along, second = (kLoop ? 3.0 : sharp ? 2.0 : 1.0) * across;
        if (sharp) second *= side;
        frame.du = derivativeTowards(turns, first, second);
        frame.dv = derivativeTowards(turns + 1u, first, second);
    }
}

// Limit position and frame of the centre in one of its sectors, by the mask of the sector's run.
const float kPi = 3.14159265;
void centreLimit(uint mask, uint sector, out vec3 position, out Frame frame) {
    const uint stride = kLoop ? 1u : 2u;
    uvec4 head = tableElement(mask);
    vec3 c = point(0u);
    precise vec3 sum = vec3(0.0), first = vec3(0.0), second = vec3(0.0);
    for (uint i = 1u; i <= head.w; ++i) {
        vec4 w = uintBitsToFloat(tableElement(mask + i));
        precise vec3 d = point(i) - c;
        sum = sum + w.x * d;
        first = first + w.y * d;
        second = second + w.z * d;
    }
    precise vec3 n = crossProduct(first, second);
    uint spokes = head.w / stride; // an open fan's last spoke has no face point
    spokes += head.w - stride * spokes;
    for (uint h = head.y; h < ((head.x & kCornerMask) != 0u ? head.y + head.z : 0u); ++h) {
        precise vec3 a = point(1u + stride * (h % spokes)) - c, b = point(1u + stride * ((h + 1u) % spokes)) - c;
        n = n + crossProduct(a, b);
    }
    precise vec3 p = c + sum;
    position = withPositiveZeros(p);
    frame = Frame(vec3(0.0), vec3(0.0), n);
    if (kTangents) {
        // Along the two spokes of the sector.
        uint h = sector + (sector < head.y ? spokes : 0u) - head.y;
        bool whole = (head.x & kWholeMask) != 0u;
        float turn = (whole ? 2.0 : 1.0) * kPi / float(head.z), angle = turn * float(h);
        vec3 across = second;
        if (!whole) across *= kLoop ? inversesqrt(3.0) : 1.0 / 3.0; // per length of the one along the crease
        frame.du = cos(angle) * first + sin(angle) * across;
        frame.dv = cos(angle + turn) * first + sin(angle + turn) * across;
        if ((head.x & kCornerMask) != 0u) {
            frame.du = point(1u + stride * sector) - c;
            frame.dv = point(1u + stride * ((sector + 1u) % spokes)) - c;
            frame = withNormal(frame, n);
        }
    }
}

// The sample of two elements of a limit row.
void limitSample(uvec4 around, uvec4 place, uint classHeader, uint fragments, uint fragment, uint step, out vec3 position,
                 out Frame frame) {
    uvec4 head = tableElement(classHeader), lists = tableElement(classHeader + 1u);
    uint sector = place.z & kSectorMask, turns = (place.z & ~kRightSide) >> kTurnShift;
    float sharpness = 0.0;
    if (place.y != 0u && (head.y & kSharpClass) != 0u)
        sharpness = spokeSharpness(head.w, place.y - 1u, fragments, fragment, step);
    limitPoint(point(place.x), pointsOf(unpackSources(around)), sharpness, (place.z & kRightSide) != 0u, turns, position, frame);
    if (place.x == 0u && lists.y != 0u) // facets have no centre
        centreLimit(tableWord(lists.y + sector * fragments + fragment), sector, position, frame);
}
