// An edge of the cage as a strip of constant width in pixels: six vertices an edge, drawn a little nearer to the eye than
// the faces it lies on.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "cage_input.glsl"

layout(set = 1, binding = kCageEdgeBinding, std430) readonly buffer CageEdges { uvec2 cageEdges[]; };

layout(location = 0) noperspective out float outAcross; // pixels from the middle of the line

const float kHalfWidth = 2.0; // room for the soft rim

vec4 nearer(vec3 position) {
    vec3 toEye = frame.eye.xyz - position;
    return frame.viewProjection * vec4(position + toEye * 0.0015, 1.0);
}

void main() {
    uvec2 edge = cageEdges[push.primitive + gl_VertexIndex / 6u];
    uint corner = gl_VertexIndex % 6u;
    bool atEnd = corner == 1u || corner == 2u || corner == 4u;
    float side = corner == 2u || corner == 4u || corner == 5u ? 1.0 : -1.0;
    vec4 a = nearer(cagePosition(edge.x)), b = nearer(cagePosition(edge.y));
    // Ends behind the eye cannot be projected: such edges are left out.
    if (min(a.w, b.w) <= 1e-6) {
        outAcross = 0.0;
        gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
        return;
    }
    vec2 along = (b.xy / b.w - a.xy / a.w) * frame.viewport.xy;
    along = dot(along, along) > 1e-8 ? normalize(along) : vec2(1.0, 0.0);
    float reach = kHalfWidth * frame.pixelScale;
    vec2 offset = vec2(-along.y, along.x) * side * reach + along * (atEnd ? 0.5 : -0.5) * frame.pixelScale;
    vec4 end = atEnd ? b : a;
    end.xy += offset * 2.0 * frame.viewport.zw * end.w;
    outAcross = side * reach;
    gl_Position = end;
}
