// A piece of a surface, and where a ray meets it. Needs queries.glsl.

struct Piece {
    uint kind, vertexCount, vertices, shares, base;
    float reach; // how far coefficients may lie outside the vertices' box
    vec3 first;  // the first vertex: all others are taken from it
};
// `slot`: of the window.
Piece pieceOf(uint number, uint slot) {
    uvec4 head = piece(kPieceElements * number);
    Piece p;
    p.kind = head.y & ((1u << kPieceVerticesShift) - 1u);
    p.vertexCount = head.y >> kPieceVerticesShift;
    p.vertices = head.z;
    p.shares = head.w;
    p.base = slot * push.cageStride;
    p.reach = uintBitsToFloat(piece(kPieceElements * number + 1u).w);
    p.first = cage(p.base + piece(p.vertices).x).xyz;
    return p;
}
vec4 vertexOf(const Piece p, uint k) { return cage(p.base + piece(p.vertices + k / 4u)[k % 4u]); }

// A box that holds the piece.
void boxOf(const Piece p, out vec3 low, out vec3 high) {
    low = p.first;
    high = p.first;
    for (uint k = 1u; k < p.vertexCount; ++k) {
        vec3 v = vertexOf(p, k).xyz;
        low = min(low, v);
        high = max(high, v);
    }
    grow(low, high, p.reach);
}

// Bezier coefficients, less the first vertex.
void loadCoefficients(const Piece p, out vec3 c[kPieceCoefficients]) {
    precise vec3 sums[kPieceCoefficients];
    for (uint i = 0u; i < kPieceCoefficients; ++i) sums[i] = vec3(0.0);
    for (uint k = 1u; k < p.vertexCount; ++k) {
        precise vec3 offset = vertexOf(p, k).xyz - p.first;
        for (uint r = 0u; r < 4u; ++r) {
            vec4 shares = uintBitsToFloat(piece(p.shares + 4u * k + r));
            for (uint i = 0u; i < 4u; ++i) sums[4u * r + i] += shares[i] * offset;
        }
    }
    c = sums;
}

struct Jet {
    vec3 position, du, dv;
};
void basisOf(float x, out float b[4], out float d[4]) {
    precise float y = 1.0 - x;
    precise float values[4] = float[4](y * y * y, 3.0 * y * y * x, 3.0 * y * x * x, x * x * x);
    precise float slopes[4] = float[4](-3.0 * y * y, 3.0 * y * (y - 2.0 * x), 3.0 * x * (2.0 * y - x), 3.0 * x * x);
    b = values;
    d = slopes;
}
// Where row j of a triangle's coefficients begins.
uint rowOfQuartic(uint j) { return j * 5u - j * (j - 1u) / 2u; }
Jet jetAt(uint kind, vec3 c[kPieceCoefficients], vec2 at) {
    precise Jet jet = Jet(vec3(0.0), vec3(0.0), vec3(0.0));
    if (kind == kSquarePiece) {
        float u[4], v[4], du[4], dv[4];
        basisOf(at.x, u, du);
        basisOf(at.y, v, dv);
        for (uint j = 0u; j < 4u; ++j) {
            precise vec3 row = vec3(0.0), slope = vec3(0.0);
            for (uint i = 0u; i < 4u; ++i) {
                row += u[i] * c[4u * j + i];
                slope += du[i] * c[4u * j + i];
            }
            jet.position += v[j] * row;
            jet.du += v[j] * slope;
            jet.dv += dv[j] * row;
        }
        return jet;
    }
    precise float w = 1.0 - at.x - at.y;
    precise float u[4] = float[4](1.0, at.x, at.x * at.x, at.x * at.x * at.x), v[4] = float[4](1.0, at.y, at.y * at.y, at.y * at.y * at.y);
    precise float z[4] = float[4](1.0, w, w * w, w * w * w);
    const float kFactorials[4] = float[4](1.0, 1.0, 2.0, 6.0);
    for (uint j = 0u; j < 4u; ++j) {
        for (uint i = 0u; i + j < 4u; ++i) {
            uint k = 3u - i - j, low = rowOfQuartic(j) + i;
            precise float weight = 6.0 / (kFactorials[i] * kFactorials[j] * kFactorials[k]) * u[i] * v[j] * z[k];
            vec3 a = c[low], b = c[low + 1u], d = c[rowOfQuartic(j + 1u) + i];
            jet.position += weight * (w * a + at.x * b + at.y * d);
            jet.du += 4.0 * weight * (b - a);
            jet.dv += 4.0 * weight * (d - a);
        }
    }
    return jet;
}

// Brings a point back into the piece; one beyond a triangle's slant goes straight to the slant.
vec2 held(uint kind, vec2 at) {
    precise vec2 own = clamp(at, vec2(0.0), vec2(1.0));
    precise float over = own.x + own.y - 1.0;
    if (kind == kTrianglePiece && over > 0.0) {
        own.x = clamp(own.x - 0.5 * over, 0.0, 1.0);
        own.y = 1.0 - own.x;
    }
    return own;
}

// A triangle between samples is taken for a beginning if the ray passes it by so many of its widths: with less, of two points of a
// bent piece the farther may be found.
const float kSlack = 1.0;
const uint kRounds = 6u;
const float kLongestStep = 0.3, kShortestStep = 1e-7;
const uint kCells = 4u; // between samples, along a side: 2 kCells^2 triangles, a bit each

struct Met {
    float distance; // along the ray; below 0: it meets nothing
    vec2 at;
    float across; // beside the ray, squared
};

// Newton's method for where the ray comes nearest. `c`: x and y across the ray, z along it.
Met refined(uint kind, vec3 c[kPieceCoefficients], vec2 at) {
    precise vec2 place = held(kind, at);
    precise Met met = Met(-1.0, place, 3e38);
    for (uint round = 0u; round < kRounds; ++round) {
        Jet jet = jetAt(kind, c, place);
        precise float off = jet.position.x * jet.position.x + jet.position.y * jet.position.y;
        if (off < met.across) met = Met(jet.position.z, place, off);
        precise float area = jet.du.x * jet.dv.y - jet.du.y * jet.dv.x;
        precise vec2 step = vec2(jet.dv.x * jet.position.y - jet.dv.y * jet.position.x, jet.du.y * jet.position.x - jet.du.x * jet.position.y) / area;
        float longest = max(abs(step.x), abs(step.y));
        if (!(longest < 1e30)) break; // seen edge on
        if (longest > kLongestStep) step *= kLongestStep / longest;
        vec2 next = held(kind, place + step);
        precise vec2 moved = next - place;
        if (all(lessThan(abs(moved), vec2(kShortestStep)))) break;
        place = next;
    }
    return met;
}

// A triangle between samples that the ray may begin from: each cell has two of them.
struct Seed {
    bool isMet;
    vec2 at;
};
const uint kSamples = kCells + 1u;
vec2 samples[kSamples * kSamples]; // across the ray; those beyond the slant of a triangle are of no cell
// `bit`: 2 (kCells j + i) of cell (i, j), and 1 more for its triangle at (1, 1).
Seed seedOf(uint kind, uint bit) {
    uint i = bit / 2u % kCells, j = bit / (2u * kCells), far = bit & 1u, corner = kSamples * (j + far) + i + far;
    precise vec2 o = samples[corner], e = samples[kSamples * (j + far) + i + 1u - far] - o, f = samples[kSamples * (j + 1u - far) + i + far] - o;
    precise float area = e.x * f.y - e.y * f.x;
    precise vec2 weights = vec2(f.x * o.y - f.y * o.x, e.y * o.x - e.x * o.y) / area;
    precise float rest = 1.0 - weights.x - weights.y;
    precise vec2 at = (vec2(i + far, j + far) + (far != 0u ? -weights : weights)) / float(kCells);
    bool isThere = kind != kTrianglePiece || i + j + far < kCells;
    return Seed(isThere && weights.x >= -kSlack && weights.y >= -kSlack && rest >= -kSlack, at);
}

// The ray passes some points of a piece within the tolerance: this finds the one nearest to the distance `near`. How far a point lies
// beside the ray counts by a weight. `c`: as refined() has them.
Met meet(uint kind, vec3 c[kPieceCoefficients], float from, float to, float near, float tolerance, float weight) {
    vec3 low = c[0], high = c[0];
    uint count = kind == kSquarePiece ? 16u : 15u;
    for (uint i = 1u; i < count; ++i) {
        low = min(low, c[i]);
        high = max(high, c[i]);
    }
    precise Met best = Met(-1.0, vec2(0.0), 0.0);
    float least = 3e38;
    if (any(greaterThan(low.xy, vec2(tolerance))) || any(lessThan(high.xy, vec2(-tolerance))) || high.z < from || low.z > to) return best;
    for (uint k = 0u; k < kSamples * kSamples; ++k) samples[k] = jetAt(kind, c, vec2(k % kSamples, k / kSamples) / float(kCells)).position.xy;
    uint seeds = 0u;
    for (uint bit = 0u; bit < 2u * kCells * kCells; ++bit) {
        if (seedOf(kind, bit).isMet) seeds |= 1u << bit;
    }
    // All have been found before one is refined: so lanes of a CPU device refine side by side.
    for (; seeds != 0u; seeds &= seeds - 1u) {
        Met met = refined(kind, c, seedOf(kind, uint(findLSB(seeds))).at);
        precise float cost = abs(met.distance - near) + weight * sqrt(met.across);
        precise float most = tolerance * tolerance;
        if (!(met.across <= most && met.distance >= from && met.distance <= to && cost < least)) continue;
        least = cost;
        best = met;
    }
    return best;
}

// The coefficients as refined() has them.
void turnTo(Ray ray, vec3 first, inout vec3 c[kPieceCoefficients]) {
    precise vec3 offset = first - ray.origin;
    for (uint i = 0u; i < kPieceCoefficients; ++i) {
        precise vec3 p = c[i] + offset;
        c[i] = vec3(dot3(ray.x, p), dot3(ray.y, p), dot3(ray.along, p));
    }
}

// Bits of the least t at which the ray meets a piece, or kNothingMet. `c`: as loadCoefficients() gives them; `low`, `high`: the box of
// the instance.
uint firstMet(Ray ray, const Piece own, vec3 c[kPieceCoefficients], vec3 low, vec3 high) {
    vec3 turned[kPieceCoefficients] = c;
    turnTo(ray, own.first, turned);
    Met met = meet(own.kind, turned, ray.from, ray.to, ray.from, toleranceFor(low, high, ray.origin), 0.0);
    precise float t = met.distance / ray.unit;
    return met.distance < 0.0 ? kNothingMet : floatBitsToUint(t);
}
