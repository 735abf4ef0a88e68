// The deformed cage: one float4 a cage vertex, instance-major.
layout(set = 1, binding = kDeformedCageBinding, std430) readonly buffer DeformedCage { vec4 deformedCage[]; };

vec3 cagePosition(uint vertex) { return deformedCage[gl_InstanceIndex * push.cageVerticesPerInstance + vertex].xyz; }
