// Points of a fragment by its class's tables (shared/subdivision.h), as both forms of the shader compute them. From
// the includer what rules.glsl asks for.
#include "shaders/subdivision/rules.glsl"

float spokeSharpness(uint sharpnessWords, uint spoke, uint fragments, uint fragment, uint steps) {
    return softened(uintBitsToFloat(tableWord(sharpnessWords + spoke * fragments + fragment)), steps);
}

// Point `row` of level `step`.
vec3 refinedPoint(uvec4 packedRow, uint neighbours, uint classHeader, uint fragments, uint fragment, uint step) {
    Sources row = unpackSources(packedRow);
    uint rule = row.s[7] & 3u, spoke = row.s[7] >> 2;
    uvec4 head = tableElement(classHeader);
    float sharpness = 0.0;
    if (spoke != 0u && (head.y & kSharpClass) != 0u)
        sharpness = spokeSharpness(head.w, spoke - 1u, fragments, fragment, step - 1u);
    vec3 p = vec3(0.0);
    if (rule == kVertexRule) {
        Sources around = unpackSources(tableElement(neighbours + row.s[0]));
        p = vertexPoint(point(row.s[0]), pointsOf(around), sharpness);
    }
    if (rule == kEdgeRule) {
        vec3 left0 = point(row.s[2]), left1 = point(row.s[3]);
        p = edgePoint(point(row.s[0]), point(row.s[1]), left0, left1, point(row.s[4]), point(row.s[5]), sharpness);
    }
    if (rule == kFaceRule)
        p = facePoint(point(row.s[0]), point(row.s[1]), point(row.s[2]), point(row.s[3]));
    if (rule == kCentreRule) {
        vec2 weights = uintBitsToFloat(tableElement(classHeader + 2u).xy);
        vec4 shares = vec4(1.0, 0.0, 0.0, 0.0);
        uvec4 centre = uvec4(0u);
        if ((head.y & kSharpClass) != 0u) {
            centre = tableElement(tableElement(classHeader + 1u).z + (step - 1u) * fragments + fragment);
            shares.xy = uintBitsToFloat(centre.xy);
        }
        p = centrePoint(head.y & ~kSharpClass, weights, shares.x, shares.y, centre.z, centre.w);
    }
    return p;
}
