// What the shaders know of a frame: FrameUniforms of camera.h.
layout(set = 0, binding = 0, std140) uniform Frame {
    mat4 viewProjection;
    mat4 sunViewProjection;
    vec4 eye;
    vec4 sun;      // towards it
    vec4 viewport; // one over width and height; the number of feet; the middle, across
    vec4 feet[19]; // where somebody stands; w: how wide
} frame;
