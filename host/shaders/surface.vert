#version 460
#extension GL_GOOGLE_include_directive : require
// Where triangles are hardly larger than pixels the light is looked up once a vertex instead of once a pixel: a device
// that shades in blocks would do it many times over.
layout(constant_id = 0) const bool kLightPerVertex = false;
layout(constant_id = 1) const bool kMaps = false; // see material_textures.glsl
#define LEVELS_POSSIBLE !kLightPerVertex // surfaces with levels are lit pixel by pixel

#include "frame.glsl"
#include "studio.glsl"
#include "surface_input.glsl"
#include "cage_buffers.glsl"
#include "material.glsl"
#include "surface_attributes.glsl"

layout(set = 1, binding = kPatchBinding, std430) readonly buffer Patches { uint patchWords[]; };

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec4 outUvs; // the first and the second
layout(location = 3) out vec4 outColor;
layout(location = 4) out vec3 outGrid; // in segments: see gridPosition
layout(location = 5) flat out uint outPatch; // with kPatchIsMirrored
layout(location = 6) out vec3 outSky;
layout(location = 7) out vec3 outKeyRimOpen;
layout(location = 8) out vec3 outTrim;    // see surfaceTrim
layout(location = 9) out vec4 outTangent; // glTF's TANGENT; views of values: x is the value
layout(location = 10) out vec3 outSquares; // of outKeyRimOpen

// Which ring a sample lies in, counted from the border.
uint ringOf(uint index) {
    uint ring = 0u;
    for (uint along = push.rate; along > 1u && index >= push.patchCount * along; ++ring, along -= 2u)
        index -= push.patchCount * along;
    return ring;
}

// Where a sample lies, in segments. Cells' sides are whole numbers of one coordinate; the patch's border is where a
// coordinate is 0, on quads also where it is the rate. Quads and polar patches have two coordinates, triangles three.
// Pentagons: the third counts from the border to the centre, the others from the two rays of the sector, the nearer first,
// so that all three are continuous over the rays.
vec3 gridPosition(uint index) {
    if (push.domain == kDrawMesh) return vec3(0.0); // a vertex is of many patches: no lines are drawn
    if (hasLevels()) {
        index = levelVertex() % push.samplesPerPatch;
        if (push.domain == kDrawRings) return vec3(0.5, 0.5, ringOf(index));
    }
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

// The value that the view shows.
float shownValue() {
    if (kView != kViewLevels) return surfaceValue();
    if (push.domain == kDrawMesh) return -1.0; // as the file has it
    return log2(hasLevels() ? largestLevel() : float(push.rate)) / log2(kScaledLevel);
}

// A vertex of a mesh is of many faces: there a vertex of its part tells.
bool isPatchMirrored(uint patchNumber) {
    if (push.domain == kDrawMesh) {
        uint vertex = drawnSlot() * push.cageVerticesPerInstance + push.primitive;
        return (push.flags & kDrawMayMirror) != 0u && isMirrored(deformedCage[vertex].w);
    }
    uint word = kPatchWords * patchNumber;
    return isFaceMirrored(drawnSlot(), patchWords[word + 1u], patchWords[word + 2u]);
}

void main() {
    uint word = surfaceWord();
    vec3 position = surfacePosition(word);
    outPosition = position;
    outNormal = surfaceNormal(word);
    outPatch = drawnPatch();
    bool mirrored = isPatchMirrored(outPatch);
    if (mirrored) {
        outNormal = -outNormal;
        outPatch |= kPatchIsMirrored;
    }
    outGrid = gridPosition(gl_VertexIndex);
    outUvs = vec4(0.0);
    outColor = vec4(1.0);
    outTangent = vec4(0.0);
    if ((push.flags & kDrawAttributes) != 0u) {
        outUvs = surfaceUvs();
        outColor = surfaceColor();
    }
    if (kMaps && kView >= kViewWeights)
        outTangent.x = shownValue();
    else if (kMaps && (push.flags & kDrawTangents) != 0u)
        outTangent = surfaceTangent() * vec4(1.0, 1.0, 1.0, mirrored ? -1.0 : 1.0);
    outTrim = surfaceTrim();
    outSky = vec3(0.0);
    outKeyRimOpen = outSquares = vec3(0.0);
    if (kLightPerVertex) {
        bool away = dot(outNormal, frame.eye.xyz - position) < 0.0; // its other side is seen
        Incident light = gatherLight(position, away ? -outNormal : outNormal, kLookAlongAxes, vec3(0.0));
        outSky = light.sky;
        outKeyRimOpen = vec3(light.key, light.rim, light.open);
        outSquares = outKeyRimOpen * outKeyRimOpen;
    }
    gl_Position = frame.viewProjection * vec4(position, 1.0);
}
