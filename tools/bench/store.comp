// supple bench: 16 bytes an invocation and nothing computed, as surface vertices are stored.
#version 460
layout(local_size_x = 256) in;
layout(set = 0, binding = 0, std430) restrict writeonly buffer Target { uvec4 target[]; };
layout(push_constant) uniform Push { uint value; };

void main() {
    target[(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x] = uvec4(value);
}
