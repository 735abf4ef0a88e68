// A leaf of an irregular quad: uniform bicubic B-splines, where creases are other weights (docs/catmull_clark.md, (1) and (2)).
//
// Leaves come as the cells of nets. A net has 5 x 5 points and 2 x 2 cells, and a cell has 4 x 4 of the points. The four cells of a
// quad's own net, points of level 1, are its quarters; each is seen from its corner. Three cells of a chain's net are the leaves of a level; the fourth, next
// to the vertex, belongs to the levels that follow.
#include "shaders/chains/chain_level.glsl"
#include "shaders/subdivision/sharpness.glsl"

// The weights of the four points in one direction, and their derivatives.
struct LeafWeights {
    vec4 w, d;
};

// (1): the weight that a point across a crease of this sharpness keeps, and its derivative.
vec2 sharpWeight(float sharpness, float x) {
    precise float n = floor(min(sharpness, kEndlessSharpness)), f = sharpness - n, scale = powerOfTwo(n);
    precise float a = max(0.0, 1.0 - x * scale), b = max(0.0, 1.0 - x * (2.0 * scale));
    precise float value = ((1.0 - f) * (a * a * a) + 0.5 * f * (b * b * b)) / (6.0 * scale);
    precise float slope = -0.5 * ((1.0 - f) * (a * a) + f * (b * b));
    return SELECT2(sharpness < kEndlessSharpness, vec2(value, slope), vec2(0.0)); // of an endless one `scale` is none
}

// (2), at x of 0..1; the crease lies at 0.
LeafWeights leafWeights(float x, float sharpness) {
    precise float t = x, s = 1.0 - x;
    precise float tt = t * t, ss = s * s;
    precise vec4 w = vec4(ss * s * (1.0 / 6.0), (1.0 + 3.0 * (s + ss * t)) * (1.0 / 6.0),
                          (1.0 + 3.0 * (t + tt * s)) * (1.0 / 6.0), tt * t * (1.0 / 6.0));
    vec4 d = vec4(-0.5 * ss, 1.5 * tt - 2.0 * t, 2.0 * s - 1.5 * ss, 0.5 * tt);
    vec2 kept = sharpWeight(sharpness, x);
    precise float value = w.x - kept.x;
    float slope = d.x - kept.y;
    precise vec4 creased = vec4(kept.x, w.y + 2.0 * value, w.z - value, w.w);
    vec4 creasedSlopes = vec4(kept.y, d.y + 2.0 * slope, d.z - slope, d.w);
    bool sharp = sharpness > 0.0;
    return LeafWeights(sharp ? creased : w, sharp ? creasedSlopes : d);
}
// In a quarter without a chain, at a distance of 0..1/2 from its corner.
LeafWeights quarterWeights(float distance, float sharpness) {
    precise float x = 2.0 * distance;
    return leafWeights(x, sharpness);
}
// Along one parameter of a chain's net, at x of 0..2. What happens on the corner's edges does not reach its second cell.
LeafWeights chainWeights(bool second, float x, float sharpness) {
    precise float inside = SELECT(second, x - 1.0, x);
    return leafWeights(inside, second ? 0.0 : sharpness);
}

// On the line itself: the share of a point beside it. The point on it has what is left.
float besideLine(float sharpness) {
    return SELECT(sharpness > 0.0, sharpWeight(sharpness, 0.0).x, 1.0 / 6.0);
}
vec3 onLine(vec3 line, vec3 one, vec3 other, float share) {
    precise vec3 p = line + share * ((one + other) - 2.0 * line);
    return p;
}
// The middle of a side, of three such points of level 1 that lie round it.
vec3 middleOfLine(vec3 one, vec3 own, vec3 other) {
    precise vec3 p = ((one + other) + 4.0 * own) * (1.0 / 6.0);
    return p;
}
