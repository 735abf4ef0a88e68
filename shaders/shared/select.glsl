// `c ? a : b` without a branch, of scalars and of vectors of 2 to 4. glslang makes branches of it unless a and b are names or
// constants, and drivers have to undo each of them.
#define SELECT(c, a, b) mix(b, a, c)
#define SELECT2(c, a, b) mix(b, a, bvec2(c))
#define SELECT3(c, a, b) mix(b, a, bvec3(c))
#define SELECT4(c, a, b) mix(b, a, bvec4(c))
