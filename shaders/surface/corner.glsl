// The point of a bicubic patch's corner, and the offsets from it to the three coefficients round it: on the way to the next corner, to
// the last one, and of the face.
struct Corner {
    vec3 point, next, last, face;
};
