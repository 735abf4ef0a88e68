// Rotations as quaternions (x, y, z, w). Angles and sines are computed here: what GLSL's own functions promise is far less
// than float has.

// Of x in [0, 1]; Abramowitz and Stegun 4.4.46, error 2e-8.
float arcCosine(float x) {
    precise float series =
        1.5707963050 +
        x * (-0.2145988016 +
             x * (0.0889789874 +
                  x * (-0.0501743046 +
                       x * (0.0308918810 + x * (-0.0170881256 + x * (0.0066700901 + x * -0.0012624911))))));
    precise float angle = sqrt(1.0 - x) * series;
    return angle;
}

// Of any moderate x: the Taylor series about the nearest zero.
float sine(float x) {
    precise float zero = floor(x * 0.31830988618 + 0.5);
    precise float r = (x - zero * 3.140625) - zero * 9.67653589793e-4;
    precise float q = r * r;
    precise float series =
        1.0 + q * (-1.6666666667e-1 +
                   q * (8.3333333333e-3 + q * (-1.9841269841e-4 + q * (2.7557319224e-6 + q * -2.5052108385e-8))));
    precise float value = r * series;
    return SELECT(zero - 2.0 * floor(0.5 * zero) == 0.0, value, -value);
}
float cosine(float x) {
    precise float shifted = x + 1.57079632679;
    return sine(shifted);
}

float dot4(vec4 a, vec4 b) {
    precise float d = (a.x * b.x + a.y * b.y) + (a.z * b.z + a.w * b.w);
    return d;
}
float dot3(vec3 a, vec3 b) {
    precise float d = (a.x * b.x + a.y * b.y) + a.z * b.z;
    return d;
}
vec3 crossed(vec3 a, vec3 b) {
    precise vec3 c = a.yzx * b.zxy - a.zxy * b.yzx;
    return c;
}

// Of unit length; a zero quaternion counts as no rotation.
vec4 unit(vec4 q) {
    precise float size = max(max(abs(q.x), abs(q.y)), max(abs(q.z), abs(q.w)));
    precise vec4 result = vec4(0.0, 0.0, 0.0, 1.0);
    if (size > 0.0) {
        precise vec4 scaled = q / size;
        precise float squared = dot4(scaled, scaled);
        result = scaled / sqrt(squared);
    }
    return result;
}

vec4 conjugated(vec4 q) { return vec4(-q.xyz, q.w); }

// b, then a.
vec4 turned(vec4 a, vec4 b) {
    precise vec3 across = crossed(a.xyz, b.xyz);
    precise vec3 xyz = (a.w * b.xyz + b.w * a.xyz) + across;
    precise float w = a.w * b.w - dot3(a.xyz, b.xyz);
    return vec4(xyz, w);
}

// Along the shorter way, straight where the arc is too short to divide by its sine; t may leave [0, 1].
vec4 slerp(vec4 a, vec4 b, float t) {
    precise float d = dot4(a, b);
    precise float angle = arcCosine(min(abs(d), 1.0));
    precise float s = sine(angle);
    precise float from = 1.0 - t, to = t;
    if (s > 1e-6) {
        from = sine(from * angle) / s;
        to = sine(t * angle) / s;
    }
    precise float side = d < 0.0 ? -to : to;
    precise vec4 q = from * a + side * b;
    return q;
}

// One Jacobi rotation of the symmetric m, and of the eigenvectors gathered in v.
bool annihilate(precise inout mat4 m, precise inout mat4 v, const int p, const int q) {
    bool apply = abs(m[p][q]) > 1e-8 * (abs(m[p][p]) + abs(m[q][q]));
    if (apply) {
        precise float theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
        precise float t = (theta < 0.0 ? -1.0 : 1.0) / (abs(theta) + sqrt(theta * theta + 1.0));
        precise float c = 1.0 / sqrt(t * t + 1.0);
        precise float s = t * c;
        // Columns stand for rows and back: m is symmetric.
        precise vec4 mp = c * m[p] - s * m[q], mq = s * m[p] + c * m[q];
        m[p] = mp;
        m[q] = mq;
        for (int k = 0; k < 4; ++k) {
            precise float a = m[k][p], b = m[k][q];
            m[k][p] = c * a - s * b;
            m[k][q] = s * a + c * b;
        }
        precise vec4 vp = c * v[p] - s * v[q], vq = s * v[p] + c * v[q];
        v[p] = vp;
        v[q] = vq;
    }
    return apply;
}

// The column with the largest diagonal entry of `by`.
vec4 largestColumn(mat4 columns, mat4 by) {
    vec4 column = columns[0];
    float largest = by[0][0];
    if (by[1][1] > largest) {
        largest = by[1][1];
        column = columns[1];
    }
    if (by[2][2] > largest) {
        largest = by[2][2];
        column = columns[2];
    }
    if (by[3][3] > largest) {
        column = columns[3];
    }
    return column;
}

// The polar factor of the matrix with these columns, that is, the nearest rotation; as skinning/rotation.h has it.
vec4 nearestRotation(vec3 x, vec3 y, vec3 z) {
    precise vec3 sizes = max(max(abs(x), abs(y)), abs(z));
    precise float size = max(max(sizes.x, sizes.y), sizes.z);
    precise vec4 result = vec4(0.0, 0.0, 0.0, 1.0);
    if (size > 0.0) {
        precise vec3 a = x / size, b = y / size, c = z / size;
        precise vec3 ab = crossed(a, b);
        precise float determinant = dot3(ab, c);
        if (determinant < 0.0) { // a mirroring matrix: all of a mirrored skeleton turns alike
            a = -a;
            b = -b;
            c = -c;
        }
        // Davenport's form (x, y, z, w): trace(R(q)^T m).
        precise mat4 form = mat4(a.x - b.y - c.z, b.x + a.y, c.x + a.z, b.z - c.y,  // x
                                 b.x + a.y, b.y - a.x - c.z, c.y + b.z, c.x - a.z,  // y
                                 c.x + a.z, c.y + b.z, c.z - b.y - a.x, a.y - b.x,  // z
                                 b.z - c.y, c.x - a.z, a.y - b.x, a.x + b.y + c.z); // w
        precise float aa = dot3(a, a), bb = dot3(b, b), cc = dot3(c, c);
        precise float bend = max(abs(dot3(a, b)), max(abs(dot3(a, c)), abs(dot3(b, c))));
        precise float skew = max(bend, max(abs(bb - aa), abs(cc - aa)));
        if (determinant != 0.0 && skew <= 1e-3 * aa) {
            // Nearly a rotation times a factor f: the other three eigenvalues lie near -f. Two multiplications by form + f
            // leave less of their vectors than float shows.
            precise float factor = sqrt((aa + bb + cc) / 3.0);
            form[0][0] = form[0][0] + factor;
            form[1][1] = form[1][1] + factor;
            form[2][2] = form[2][2] + factor;
            form[3][3] = form[3][3] + factor;
            precise vec4 q = unit(largestColumn(form, form));
            precise vec4 sharper = (form[0] * q.x + form[1] * q.y) + (form[2] * q.z + form[3] * q.w);
            result = unit(sharper);
        } else {
            // Three rounds make all six pairs: the first column stays, the others change places. In rounds, not pair by pair,
            // there is less code to compile.
            precise mat4 vectors = mat4(1.0);
            int still = 0;
            for (int round = 0; round < 24 && still < 3; ++round) {
                bool any = annihilate(form, vectors, 0, 1);
                any = annihilate(form, vectors, 2, 3) || any;
                still = any ? 0 : still + 1;
                form = mat4(form[0].xzwy, form[2].xzwy, form[3].xzwy, form[1].xzwy);
                vectors = mat4(vectors[0], vectors[2], vectors[3], vectors[1]);
            }
            result = unit(largestColumn(vectors, form));
        }
    }
    return result;
}
