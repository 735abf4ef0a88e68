// A stage that tests put between deform and the surfaces: vertices follow the deformed cage with a delay. State per
// vertex: where it was, and in how many frames it was there; 0 if the instance is new.
#version 460

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer List { uint list[]; };
layout(set = 0, binding = 1, std430) readonly buffer From { vec4 from[]; };
layout(set = 0, binding = 2, std430) writeonly buffer To { vec4 to[]; };
layout(set = 0, binding = 3, std430) buffer State { vec4 state[]; };
layout(push_constant) uniform Push {
    uint vertexCount;
    uint firstEntry; // of the list
    uint instanceCount;
    uint stride; // vertices from one instance to the next
    uint ahead;  // which vertex follows which: 0 itself, 1 the next one
    float blend; // how far it gets in this frame
};

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (id >= vertexCount * instanceCount)
        return;
    uint first = (list[firstEntry + id / vertexCount] & 0x0FFFFFFFu) * stride, v = id % vertexCount;
    vec3 now = from[first + (v + ahead) % vertexCount].xyz;
    vec4 last = state[first + v];
    vec3 p = last.w == 0.0 ? now : mix(last.xyz, now, blend);
    state[first + v] = vec4(p, last.w + 1.0);
    to[first + v] = vec4(p, 1.0);
}
