// What every pass of a frame sees: FrameUniforms of passes.h.
layout(set = 0, binding = 0, std140) uniform Frame {
    mat4 viewProjection;         // without jitter
    mat4 jitteredViewProjection; // what is rasterized
    mat4 previousViewProjection; // of the frame before, without jitter
    mat4 sunViewProjection;
    vec4 eye;
    vec4 sunDirection; // towards the sun; w: its angular radius, as a tangent
    vec4 viewport;     // width, height, and their reciprocals
    vec4 feet[4];      // where somebody stands; w: radius, 0 for nobody
    vec4 noise;        // x: turns every frame; y: the sun map's texel in the world; z: its depth in the world
} frame;
