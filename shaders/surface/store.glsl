// With a -0 a border sample could differ in the sign of zero between a patch that adds a zero perturbation to it and one that
// adds none.
void storePool(uint i, vec3 v) {
    precise vec3 canonical = withPositiveZeros(v);
    pool.at[i] = vec4(canonical, 0.0);
}
