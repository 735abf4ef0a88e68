#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "range.glsl"

void main() {
    SuppleVertex at = suppleVertex(range, gl_InstanceIndex, gl_VertexIndex);
    gl_Position = frame.sunViewProjection * vec4(supplePosition(at), 1.0);
}
