#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "studio.glsl"
#include "surface_input.glsl"
#include "material.glsl"
#include "surface_attributes.glsl"

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec4 outUv; // of the base color; of metallic and roughness
layout(location = 3) out vec4 outColor;
layout(location = 4) out vec3 outGrid; // in segments: see gridPosition
layout(location = 5) flat out uint outPatch;
layout(location = 6) out vec3 outSky;
layout(location = 7) out vec3 outKeyRimOpen;
layout(location = 8) out vec3 outTrim; // see surfaceTrim

// Where triangles are hardly larger than pixels the light is looked up once a vertex instead of once a pixel: a device
// that shades in blocks would do it many times over.
layout(constant_id = 0) const bool kLightPerVertex = false;

// Where a sample lies, in segments. Cells' sides are whole numbers of one coordinate; the patch's border is where a
// coordinate is 0, on quads also where it is the rate. Quads and polar patches have two coordinates, triangles three.
// Pentagons: the third counts from the border to the centre, the others from the two rays of the sector, the nearer first,
// so that all three are continuous over the rays.
vec3 gridPosition(uint index) {
    if (push.domain == kDrawMesh) return vec3(0.0); // a vertex is of many patches: no lines are drawn
    uint side = push.rate + 1u;
    if (push.domain <= kDrawPolar) return vec3(index % side, index / side, 0.5);
    uint perSector = push.rate * side / 2u;
    bool pentagon = push.domain == kDrawPentagon;
    if (pentagon && index == 5u * perSector) return vec3(0.0, 0.0, push.rate);
    uint rest = pentagon ? index % perSector : index, row = pentagon ? push.rate : side, j = 0u;
    for (; rest >= row; --row, ++j) rest -= row;
    float i = float(rest), k = float(push.rate - rest - j);
    return pentagon ? vec3(min(i, k), max(i, k), j) : vec3(i, k, j);
}

void main() {
    uint word = surfaceWord();
    vec3 position = surfacePosition(word);
    outPosition = position;
    outNormal = surfaceNormal(word);
    outPatch = drawnPatch();
    outGrid = gridPosition(gl_VertexIndex);
    outUv = vec4(0.0);
    outColor = vec4(1.0);
    if ((push.flags & kDrawAttributes) != 0u) {
        outUv.xy = placed(materialData.baseColorPlace, surfaceUv(materialHas(kMaterialUv1)));
        if (materialHas(kMaterialMetallicRoughness))
            outUv.zw = placed(materialData.metallicRoughnessPlace, surfaceUv(materialHas(kMaterialMetallicRoughnessUv1)));
        outColor = surfaceColor();
    }
    outTrim = surfaceTrim();
    outSky = vec3(0.0);
    outKeyRimOpen = vec3(0.0);
    if (kLightPerVertex) {
        bool away = dot(outNormal, frame.eye.xyz - position) < 0.0; // its other side is seen
        Incident light = gatherLight(position, away ? -outNormal : outNormal);
        outSky = light.sky;
        outKeyRimOpen = vec3(light.key, light.rim, light.open);
    }
    gl_Position = frame.viewProjection * vec4(position, 1.0);
}
