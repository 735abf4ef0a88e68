// The surface vertex: 16 bytes (position, octahedral normal in 2 x snorm16), 24 (position, normal) or 12 (position).
layout(constant_id = 4) const uint kVertexFormat = kVertex16;

layout(set = 0, binding = kSurfaceBinding, std430) writeonly buffer Surface16 { uvec4 surface16[]; };
layout(set = 0, binding = kSurfaceBinding, scalar) writeonly buffer SurfaceVectors { vec3 surfaceVectors[]; };

const float kTiny = 1e-37; // above the denormals, which devices may flush

// Cigolle, Donow, Evangelakos, Mara, McGuire, Meyer, "A Survey of Efficient Representations for Independent Unit
// Vectors" (JCGT 2014): octahedral mapping.
uint encodeOctahedral(vec3 n) {
    vec2 p = n.xy / max(abs(n.x) + abs(n.y) + abs(n.z), kTiny);
    vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    return packSnorm2x16(n.z < 0.0 ? folded : p);
}

void storeSurfaceVertex(uint vertex, vec3 position, vec3 normal) {
    if (kVertexFormat == kVertexPosition) {
        surfaceVectors[vertex] = position;
    } else if (kVertexFormat == kVertex24) {
        surfaceVectors[2u * vertex] = position;
        surfaceVectors[2u * vertex + 1u] = normal;
    } else {
        surface16[vertex] = uvec4(floatBitsToUint(position), encodeOctahedral(normal));
    }
}

// unit(n); a vanishing n stays zero instead of becoming NaN (and is +z in the 16-byte form).
vec3 unitNormal(vec3 n) { return n * inversesqrt(max(dot(n, n), kTiny)); }
