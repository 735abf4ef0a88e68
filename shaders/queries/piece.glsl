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
    for (uint i = 0u; i < kPieceCoefficients; ++i) c[i] = vec3(0.0);
    for (uint k = 1u; k < p.vertexCount; ++k) {
        vec3 offset = vertexOf(p, k).xyz - p.first;
        for (uint r = 0u; r < 4u; ++r) {
            vec4 shares = uintBitsToFloat(piece(p.shares + 4u * k + r));
            for (uint i = 0u; i < 4u; ++i) c[4u * r + i] += shares[i] * offset;
        }
    }
}

struct Jet {
    vec3 position, du, dv;
};
void basisOf(float x, out float b[4], out float d[4]) {
    float y = 1.0 - x;
    b = float[4](y * y * y, 3.0 * y * y * x, 3.0 * y * x * x, x * x * x);
    d = float[4](-3.0 * y * y, 3.0 * y * (y - 2.0 * x), 3.0 * x * (2.0 * y - x), 3.0 * x * x);
}
// Where row j of a triangle's coefficients begins.
uint rowOfQuartic(uint j) { return j * 5u - j * (j - 1u) / 2u; }
Jet jetAt(uint kind, vec3 c[kPieceCoefficients], vec2 at) {
    Jet jet = Jet(vec3(0.0), vec3(0.0), vec3(0.0));
    if (kind == kSquarePiece) {
        float u[4], v[4], du[4], dv[4];
        basisOf(at.x, u, du);
        basisOf(at.y, v, dv);
        for (uint j = 0u; j < 4u; ++j) {
            vec3 row = vec3(0.0), slope = vec3(0.0);
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
    float w = 1.0 - at.x - at.y;
    float u[4] = float[4](1.0, at.x, at.x * at.x, at.x * at.x * at.x), v[4] = float[4](1.0, at.y, at.y * at.y, at.y * at.y * at.y);
    float z[4] = float[4](1.0, w, w * w, w * w * w);
    const float kFactorials[4] = float[4](1.0, 1.0, 2.0, 6.0);
    for (uint j = 0u; j < 4u; ++j) {
        for (uint i = 0u; i + j < 4u; ++i) {
            uint k = 3u - i - j, low = rowOfQuartic(j) + i;
            float weight = 6.0 / (kFactorials[i] * kFactorials[j] * kFactorials[k]) * u[i] * v[j] * z[k];
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
    at = clamp(at, vec2(0.0), vec2(1.0));
    float over = at.x + at.y - 1.0;
    if (kind == kTrianglePiece && over > 0.0) {
        at.x = clamp(at.x - 0.5 * over, 0.0, 1.0);
        at.y = 1.0 - at.x;
    }
    return at;
}

// A triangle between samples is taken for a beginning if the ray passes it by so many of its widths: with less, of two points of a
// bent piece the farther may be found.
const float kSlack = 1.0;
const uint kRounds = 6u;
const float kLongestStep = 0.3, kShortestStep = 1e-7;
const uint kCells = 4u; // between samples, along a side

struct Met {
    float distance; // along the ray; below 0: it meets nothing
    vec2 at;
    float across; // beside the ray, squared
};

// Newton's method for where the ray comes nearest. `c`: x and y across the ray, z along it.
Met refined(uint kind, vec3 c[kPieceCoefficients], vec2 at) {
    Met met = Met(-1.0, at, 3e38);
    at = held(kind, at);
    for (uint round = 0u; round < kRounds; ++round) {
        Jet jet = jetAt(kind, c, at);
        float off = dot(jet.position.xy, jet.position.xy);
        if (off < met.across) met = Met(jet.position.z, at, off);
        float area = jet.du.x * jet.dv.y - jet.du.y * jet.dv.x;
        vec2 step = vec2(jet.dv.x * jet.position.y - jet.dv.y * jet.position.x, jet.du.y * jet.position.x - jet.du.x * jet.position.y) / area;
        float longest = max(abs(step.x), abs(step.y));
        if (!(longest < 1e30)) break; // seen edge on
        if (longest > kLongestStep) step *= kLongestStep / longest;
        vec2 next = held(kind, at + step);
        if (all(lessThan(abs(next - at), vec2(kShortestStep)))) break;
        at = next;
    }
    return met;
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
    Met best = Met(-1.0, vec2(0.0), 0.0);
    float least = 3e38;
    if (any(greaterThan(low.xy, vec2(tolerance))) || any(lessThan(high.xy, vec2(-tolerance))) || high.z < from || low.z > to) return best;
    vec2 before[kCells + 1u], row[kCells + 1u];
    for (uint j = 0u; j <= kCells; ++j) {
        for (uint i = 0u; i <= kCells; ++i) {
            // Samples beyond the slant of a triangle are those of no cell.
            row[i] = jetAt(kind, c, vec2(i, j) / float(kCells)).position.xy;
        }
        for (uint cell = 0u; j > 0u && cell < 2u * kCells; ++cell) {
            uint i = cell / 2u;
            bool far = (cell & 1u) != 0u;
            if (kind == kTrianglePiece && i + j + (far ? 1u : 0u) > kCells) continue;
            vec2 corner = far ? row[i + 1u] : before[i], e = (far ? row[i] : before[i + 1u]) - corner, f = (far ? before[i + 1u] : row[i]) - corner;
            float area = e.x * f.y - e.y * f.x;
            vec2 weights = vec2(f.x * corner.y - f.y * corner.x, e.y * corner.x - e.x * corner.y) / area;
            if (!(weights.x >= -kSlack && weights.y >= -kSlack && weights.x + weights.y <= 1.0 + kSlack)) continue;
            vec2 at = far ? vec2(i + 1u, j) - weights : vec2(i, j - 1u) + weights;
            Met met = refined(kind, c, at / float(kCells));
            float cost = abs(met.distance - near) + weight * sqrt(met.across);
            if (!(met.across <= tolerance * tolerance && met.distance >= from && met.distance <= to && cost < least)) continue;
            least = cost;
            best = met;
        }
        before = row;
    }
    return best;
}

// By how much a hit may lie beside its ray: a part of the instance's size, and what rounding leaves far from the origin.
float toleranceFor(vec3 low, vec3 high, vec3 origin) {
    vec3 farthest = max(max(abs(low), abs(high)), abs(origin));
    return 2e-6 * length(high - low) + 5e-7 * max(farthest.x, max(farthest.y, farthest.z));
}

// The coefficients as refined() has them.
void turnTo(Ray ray, vec3 first, inout vec3 c[kPieceCoefficients]) {
    vec3 offset = first - ray.origin;
    for (uint i = 0u; i < kPieceCoefficients; ++i) {
        vec3 p = c[i] + offset;
        c[i] = vec3(dot(ray.x, p), dot(ray.y, p), dot(ray.along, p));
    }
}
