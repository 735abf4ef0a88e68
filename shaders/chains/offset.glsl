// A function, because loops that are unrolled when the library is built must not hold precise arithmetic themselves
// (cmake/supple_shaders.cmake).
vec3 offsetFrom(vec3 origin, vec3 p) {
    precise vec3 d = p - origin;
    return d;
}
