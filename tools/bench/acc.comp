// supple bench: ACC's patches, as Supple evaluates its own: positions and octahedral normals in 16 bytes. On CPU devices a lane takes
// a whole patch, on others a sample.
#version 460
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) restrict readonly buffer Patches { vec4 coefficients[]; }; // 40 a patch
layout(set = 0, binding = 1, std430) restrict writeonly buffer Vertices { uvec4 vertices[]; };
layout(push_constant) uniform Push {
    uint patchCount;
    uint rate;
    uint samplesPerLane;
};

const uint kStride = 40u;

void weights(float t, out vec4 cubic, out vec3 quadratic) {
    float s = 1.0 - t;
    quadratic = vec3(s * s, 2.0 * s * t, t * t);
    cubic = vec4(quadratic.x * s, 3.0 * quadratic.x * t, 3.0 * s * quadratic.z, quadratic.z * t);
}

uint octahedral(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    if (n.z < 0.0) p = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    return packSnorm2x16(p);
}

void main() {
    uint samples = (rate + 1u) * (rate + 1u);
    uint lanes = (samples + samplesPerLane - 1u) / samplesPerLane; // of a patch
    uint patchIndex = gl_GlobalInvocationID.x / lanes, lane = gl_GlobalInvocationID.x % lanes;
    if (patchIndex >= patchCount) return;
    uint first = patchIndex * kStride;
    vec3 b[16], du[12], dv[12];
    for (uint i = 0u; i < 16u; ++i) b[i] = coefficients[first + i].xyz;
    for (uint i = 0u; i < 12u; ++i) du[i] = coefficients[first + 16u + i].xyz;
    for (uint i = 0u; i < 12u; ++i) dv[i] = coefficients[first + 28u + i].xyz;
    uint end = min((lane + 1u) * samplesPerLane, samples);
    for (uint s = lane * samplesPerLane; s < end; ++s) {
        vec4 cu, cv;
        vec3 qu, qv;
        weights(float(s % (rate + 1u)) / float(rate), cu, qu);
        weights(float(s / (rate + 1u)) / float(rate), cv, qv);
        vec3 position = vec3(0.0), alongU = vec3(0.0), alongV = vec3(0.0);
        for (uint j = 0u; j < 4u; ++j) {
            position += cv[j] * (cu.x * b[4u * j] + cu.y * b[4u * j + 1u] + cu.z * b[4u * j + 2u] + cu.w * b[4u * j + 3u]);
            alongU += cv[j] * (qu.x * du[3u * j] + qu.y * du[3u * j + 1u] + qu.z * du[3u * j + 2u]);
        }
        for (uint j = 0u; j < 3u; ++j)
            alongV += qv[j] * (cu.x * dv[4u * j] + cu.y * dv[4u * j + 1u] + cu.z * dv[4u * j + 2u] + cu.w * dv[4u * j + 3u]);
        uvec3 bits = floatBitsToUint(position);
        vertices[patchIndex * samples + s] = uvec4(bits, octahedral(normalize(cross(alongU, alongV))));
    }
}
