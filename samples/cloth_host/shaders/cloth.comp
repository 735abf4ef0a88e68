// A sheet of cloth by position-based dynamics (Mueller et al. 2007), in small steps (Macklin et al. 2019): one workgroup a
// sheet, its points in shared memory. Springs run along rows, columns and diagonals, and over two for bending. Each of these
// six directions falls in two halves that share no point, so that a half is relaxed at once, and the result is the same
// every time.
#version 460
layout(local_size_x = 128) in;

const uint kPointsPerLane = 4u; // 128 * 4 points at the most

layout(push_constant) uniform Push {
    uint columns; // points along a row: u
    uint rows;    // and down a column: v
    uint steps;
    uint begin; // 1: lay the sheets out flat first
    float seconds;
    float step;    // seconds of one of the steps
    float spacing; // of points at rest
    uint cageVerticesPerInstance;
};

struct Sheet {
    vec4 origin; // point (0, 0); w: pinned spacing, as a share of that at rest
    vec4 along;  // the direction of u at the beginning; w: how light it is in the wind
    vec4 down;   // the direction of v
    uvec4 slot;  // x: of the Supple instance
};
struct Point {
    vec4 position;
    vec4 velocity;
};

layout(set = 0, binding = 0, std430) readonly buffer Sheets { Sheet sheets[]; };
layout(set = 0, binding = 1, std430) buffer Points { Point points[]; };
/// SuppleGroupInfo.deformedCage
layout(set = 0, binding = 2, std430) writeonly buffer DeformedCage { vec4 deformedCage[]; };

shared vec4 place[128u * kPointsPerLane]; // w: 1 / mass, 0 where pinned

uint pointOf(uint i, uint j) { return j * columns + i; }

/// A breeze with gusts that travel with it.
vec3 windAt(vec3 p) {
    float t = seconds;
    float gust = 0.75 + 0.25 * sin(0.9 * t - 0.7 * p.x) * sin(0.53 * t + 1.3);
    vec3 swirl = vec3(0.0, 0.35 * sin(2.1 * t - 1.9 * p.x + 0.8 * p.y),
                      sin(1.7 * t - 2.3 * p.x + 0.6 * p.y) + 0.6 * sin(3.1 * t - 4.1 * p.x - 1.7 * p.y));
    return vec3(8.0, 0.3, 1.6) * gust + 2.0 * swirl;
}

/// Air pushes where the cloth stands across it.
vec3 airForce(uint i, uint j, vec3 velocity, float lightness) {
    vec3 du = place[pointOf(min(i + 1u, columns - 1u), j)].xyz - place[pointOf(max(i, 1u) - 1u, j)].xyz;
    vec3 dv = place[pointOf(i, min(j + 1u, rows - 1u))].xyz - place[pointOf(i, max(j, 1u) - 1u)].xyz;
    vec3 n = cross(du, dv);
    n *= inversesqrt(max(dot(n, n), 1e-12));
    vec3 wind = windAt(place[pointOf(i, j)].xyz) - velocity;
    return (n * (dot(n, wind) * 7.0) + wind * 0.9) * lightness;
}

void relax(uint a, uint b, float rest, float stiffness) {
    float weights = place[a].w + place[b].w;
    vec3 apart = place[b].xyz - place[a].xyz;
    float now = length(apart);
    if (weights == 0.0 || now < 1e-6)
        return;
    vec3 shift = apart * (stiffness * (now - rest) / (now * weights));
    place[a].xyz += shift * place[a].w;
    place[b].xyz -= shift * place[b].w;
}

/// Springs from (i, j) to (i + di, j + dj), dj perhaps -1: two halves by the parity of what moves on.
void relaxDirection(uint di, int dj, float rest, float stiffness) {
    for (uint half_ = 0u; half_ < 2u; ++half_) {
        for (uint at = gl_LocalInvocationIndex; at < columns * rows; at += gl_WorkGroupSize.x) {
            uint i = at % columns, j = at / columns;
            int toJ = int(j) + dj;
            uint turn = di != 0u ? i / di : j / uint(dj);
            if (i + di < columns && toJ >= 0 && toJ < int(rows) && (turn & 1u) == half_)
                relax(at, pointOf(i + di, uint(toJ)), rest, stiffness);
        }
        barrier();
    }
}

void main() {
    uint sheet = gl_WorkGroupID.x, count = columns * rows, first = sheet * count;
    vec3 velocities[kPointsPerLane], before[kPointsPerLane];
    for (uint k = 0u; k < kPointsPerLane; ++k) {
        uint at = k * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
        if (at >= count)
            break;
        uint i = at % columns, j = at / columns;
        if (begin != 0u) {
            Sheet s = sheets[sheet];
            vec3 p = s.origin.xyz + spacing * (float(i) * s.along.xyz + float(j) * s.origin.w * s.down.xyz);
            place[at] = vec4(p, i == 0u ? 0.0 : 1.0);
            velocities[k] = vec3(0.0);
        } else {
            place[at] = points[first + at].position;
            velocities[k] = points[first + at].velocity.xyz;
        }
    }
    barrier();

    for (uint n = 0u; n < steps; ++n) {
        vec3 forces[kPointsPerLane];
        for (uint k = 0u; k < kPointsPerLane; ++k) {
            uint at = k * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
            if (at < count)
                forces[k] = airForce(at % columns, at / columns, velocities[k], sheets[sheet].along.w);
        }
        barrier();
        for (uint k = 0u; k < kPointsPerLane; ++k) {
            uint at = k * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
            if (at >= count)
                break;
            before[k] = place[at].xyz;
            velocities[k] += step * (vec3(0.0, -9.81, 0.0) + forces[k]);
            if (place[at].w > 0.0)
                place[at].xyz += step * velocities[k];
        }
        barrier();
        for (uint iteration = 0u; iteration < 2u; ++iteration) {
            relaxDirection(2u, 0, 2.0 * spacing, 0.15);
            relaxDirection(0u, 2, 2.0 * spacing, 0.15);
            relaxDirection(1u, 1, sqrt(2.0) * spacing, 0.25);
            relaxDirection(1u, -1, sqrt(2.0) * spacing, 0.25);
            relaxDirection(0u, 1, spacing, 1.0);
            relaxDirection(1u, 0, spacing, 1.0);
        }
        for (uint k = 0u; k < kPointsPerLane; ++k) {
            uint at = k * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
            if (at < count)
                velocities[k] = (place[at].xyz - before[k]) * (0.9985 / step);
        }
        barrier();
    }

    uint cage = sheets[sheet].slot.x * cageVerticesPerInstance;
    for (uint k = 0u; k < kPointsPerLane; ++k) {
        uint at = k * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
        if (at >= count)
            break;
        points[first + at] = Point(place[at], vec4(velocities[k], 0.0));
        deformedCage[cage + at] = vec4(place[at].xyz, 1.0);
    }
}
