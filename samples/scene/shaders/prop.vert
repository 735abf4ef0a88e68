#version 460
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

struct Prop {
    mat4 transform;
    vec4 color; // w: what is painted on it
    vec4 size;  // w: a number that differs from prop to prop
};
layout(set = 0, binding = 2, std430) readonly buffer Props { Prop props[]; };

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec3 outLocal; // where on the shape, in units of the world
layout(location = 3) out vec3 outLocalNormal;
layout(location = 4) flat out vec4 outColor;
layout(location = 5) flat out vec4 outSize;

const float kTurn = 6.2831853;

struct Corner {
    vec3 position, normal;
};

// Of six vertices that make a quad.
vec2 quadCorner(uint vertex) {
    const uint corners[6] = uint[](0u, 1u, 2u, 2u, 1u, 3u);
    uint corner = corners[vertex % 6u];
    return vec2(corner & 1u, corner >> 1u);
}

Corner box(uint vertex) {
    uint side = vertex / 6u, axis = side % 3u;
    vec2 at = quadCorner(vertex) - 0.5;
    float out_ = side < 3u ? 0.5 : -0.5;
    vec3 p = vec3(out_, at), n = vec3(sign(out_), 0.0, 0.0);
    return axis == 0u ? Corner(p, n) : axis == 1u ? Corner(p.zxy, n.zxy) : Corner(p.yzx, n.yzx);
}

Corner cylinder(uint vertex) {
    if (vertex < 144u) {
        vec2 at = quadCorner(vertex);
        float a = kTurn * (float(vertex / 6u) + at.x) / 24.0;
        vec3 n = vec3(cos(a), 0.0, sin(a));
        return Corner(0.5 * n + vec3(0.0, at.y - 0.5, 0.0), n);
    }
    uint v = vertex - 144u;
    float top = v < 72u ? 0.5 : -0.5;
    uint corner = v % 3u, piece = (v % 72u) / 3u;
    float a = kTurn * (float(piece) + (corner == 2u ? 1.0 : 0.0)) / 24.0;
    vec2 rim = corner == 0u ? vec2(0.0) : 0.5 * vec2(cos(a), sin(a));
    return Corner(vec3(rim.x, top, rim.y), vec3(0.0, sign(top), 0.0));
}

Corner ball(uint vertex) {
    vec2 at = quadCorner(vertex);
    uint quad = vertex / 6u;
    float a = kTurn * (float(quad % 16u) + at.x) / 16.0, b = 0.5 * kTurn * (float(quad / 16u) + at.y) / 10.0;
    vec3 n = vec3(sin(b) * cos(a), cos(b), sin(b) * sin(a));
    return Corner(0.5 * n, n);
}

// A triangle towards +Z and -Z, and the slopes between them.
Corner gable(uint vertex) {
    const vec2 triangle[3] = vec2[](vec2(-0.5, -0.5), vec2(0.5, -0.5), vec2(0.0, 0.5));
    if (vertex < 6u) {
        float z = vertex < 3u ? 0.5 : -0.5;
        return Corner(vec3(triangle[vertex % 3u], z), vec3(0.0, 0.0, sign(z)));
    }
    uint side = (vertex - 6u) / 6u; // 0: right, 1: left, 2: below
    vec2 at = quadCorner(vertex - 6u);
    vec2 from = side == 1u ? triangle[2] : triangle[side == 0u ? 1u : 0u], to = side == 0u ? triangle[2] : triangle[side == 1u ? 0u : 1u];
    vec2 along = to - from;
    return Corner(vec3(mix(from, to, at.x), at.y - 0.5), normalize(vec3(along.y, -along.x, 0.0)));
}

void main() {
    Prop prop = props[gl_InstanceIndex];
    uint v = gl_VertexIndex;
    Corner corner = push.first == 0u ? box(v) : push.first == 1u ? cylinder(v) : push.first == 2u ? ball(v) : gable(v);
    outPosition = (prop.transform * vec4(corner.position, 1.0)).xyz;
    // Scales are along the shape's own axes, so that normals shrink where places grow.
    mat3 turn = mat3(prop.transform);
    outNormal = normalize(turn * (corner.normal / (prop.size.xyz * prop.size.xyz)));
    outLocal = corner.position * prop.size.xyz;
    outLocalNormal = corner.normal;
    outColor = prop.color;
    outSize = prop.size;
    gl_Position = (push.sun != 0u ? scene.sunViewProjection : scene.viewProjection) * vec4(outPosition, 1.0);
}
