// Where previous positions are evaluated in a view: this frame's coefficients, which instances without a past take in the place of the
// frame's before. Needs pool.glsl.
LOADED_BUFFER(vec4, todaysCoefficient, TodaysPool, kTodaysPoolBinding, samplerBuffer, kTodaysPoolTexelBinding, xyzw)
vec3 todaysVector(uint i) { return todaysCoefficient(i).xyz; }
