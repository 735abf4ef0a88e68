// The point of a piece that is nearest to a place. Needs queries.glsl and piece.glsl.

const uint kNearRounds = 10u;
const float kLongestNearStep = 0.25;

struct Place {
    vec3 position;
    float most; // nothing farther is found
    bool sound; // else nothing is
};
Place placeOf(uint number) {
    vec4 own = rays.at[number];
    bool sound = finite(own.xyz) && isNumber(own.w) && own.w >= 0.0 && all(lessThan(abs(own.xyz), vec3(kFarthest)));
    return Place(own.xyz, own.w, sound);
}

// What rounding leaves of a distance between the place and a point of a box.
float roundingOf(vec3 place, vec3 low, vec3 high) {
    vec3 farthest = max(max(abs(low), abs(high)), abs(place));
    return 5e-7 * max(farthest.x, max(farthest.y, farthest.z));
}
// Distances that differ by less are equal: then the first face has the point. `low`, `high`: of the instance.
float tieOf(vec3 low, vec3 high) { return 1e-6 * length(high - low); }

// No point of a box is nearer than that, and none is farther than that.
float leastDistance(vec3 place, vec3 low, vec3 high) {
    return max(length(max(max(low - place, place - high), vec3(0.0))) * 0.999999 - roundingOf(place, low, high), 0.0);
}
float mostDistance(vec3 place, vec3 low, vec3 high) {
    return length(max(abs(low - place), abs(high - place))) * 1.00001 + roundingOf(place, low, high);
}

// A point of a piece with its first and second derivatives.
struct Bend {
    vec3 position, du, dv, duu, duv, dvv;
};
Bend bendOfSquare(vec3 c[kPieceCoefficients], vec2 at) {
    float u[4], v[4], du[4], dv[4];
    basisOf(at.x, u, du);
    basisOf(at.y, v, dv);
    vec2 x = at, y = 1.0 - at;
    float duu[4] = float[4](6.0 * y.x, 6.0 * (x.x - 2.0 * y.x), 6.0 * (y.x - 2.0 * x.x), 6.0 * x.x);
    float dvv[4] = float[4](6.0 * y.y, 6.0 * (x.y - 2.0 * y.y), 6.0 * (y.y - 2.0 * x.y), 6.0 * x.y);
    Bend bend = Bend(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    for (uint j = 0u; j < 4u; ++j) {
        vec3 row = vec3(0.0), slope = vec3(0.0), curve = vec3(0.0);
        for (uint i = 0u; i < 4u; ++i) {
            row += u[i] * c[4u * j + i];
            slope += du[i] * c[4u * j + i];
            curve += duu[i] * c[4u * j + i];
        }
        bend.position += v[j] * row;
        bend.du += v[j] * slope;
        bend.dv += dv[j] * row;
        bend.duu += v[j] * curve;
        bend.duv += dv[j] * slope;
        bend.dvv += dvv[j] * row;
    }
    return bend;
}
// A quartic is a quadratic whose coefficients are quadratics: of these the values and the differences are needed.
Bend bendOfTriangle(vec3 c[kPieceCoefficients], vec2 at) {
    float u = at.x, v = at.y, w = 1.0 - u - v;
    Bend bend = Bend(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    for (uint j = 0u; j < 3u; ++j) {
        for (uint i = 0u; i + j < 3u; ++i) {
            uint k = 2u - i - j, row = rowOfQuartic(j) + i, next = rowOfQuartic(j + 1u) + i;
            float weight = (i == 1u ? 2.0 * u : i == 2u ? u * u : 1.0) * (j == 1u ? v : j == 2u ? v * v : 1.0) *
                           (k == 1u ? (i == 0u ? 2.0 : 1.0) * w : k == 2u ? w * w : 1.0);
            vec3 c00 = c[row], c10 = c[row + 1u], c20 = c[row + 2u], c01 = c[next], c11 = c[next + 1u], c02 = c[rowOfQuartic(j + 2u) + i];
            vec3 a = w * c00 + u * c10 + v * c01, b = w * c10 + u * c20 + v * c11, d = w * c01 + u * c11 + v * c02;
            bend.position += weight * (w * a + u * b + v * d);
            bend.du += 4.0 * weight * (b - a);
            bend.dv += 4.0 * weight * (d - a);
            bend.duu += 12.0 * weight * (c20 - 2.0 * c10 + c00);
            bend.duv += 12.0 * weight * ((c11 - c10) - (c01 - c00));
            bend.dvv += 12.0 * weight * (c02 - 2.0 * c01 + c00);
        }
    }
    return bend;
}
Bend bendAt(uint kind, vec3 c[kPieceCoefficients], vec2 at) {
    if (kind == kSquarePiece) return bendOfSquare(c, at);
    return bendOfTriangle(c, at);
}

// A step of Newton's method. Where the second derivatives would lead to a saddle, it is that of Gauss and Newton. On a border that
// the gradient pushes against, only the way along it is left.
vec2 stepTo(uint kind, const Bend bend, vec2 at) {
    vec3 e = bend.position;
    vec2 g = vec2(dot(bend.du, e), dot(bend.dv, e));
    vec3 h = vec3(dot(bend.du, bend.du), dot(bend.du, bend.dv), dot(bend.dv, bend.dv)); // by u, by both, by v
    vec3 full = h + vec3(dot(bend.duu, e), dot(bend.duv, e), dot(bend.dvv, e));
    if (full.x > 0.0 && full.x * full.z > full.y * full.y) h = full;
    bool isSquare = kind == kSquarePiece;
    bool holdsU = (at.x <= 0.0 && g.x > 0.0) || (isSquare && at.x >= 1.0 && g.x < 0.0);
    bool holdsV = (at.y <= 0.0 && g.y > 0.0) || (isSquare && at.y >= 1.0 && g.y < 0.0);
    bool onSlant = !isSquare && at.x + at.y >= 1.0 && g.x + g.y < 0.0;
    vec2 step = vec2(0.0);
    if (holdsU || holdsV || onSlant) {
        vec2 way = holdsU ? vec2(0.0, 1.0) : holdsV ? vec2(1.0, 0.0) : vec2(1.0, -1.0);
        float curve = way.x * (h.x * way.x + h.y * way.y) + way.y * (h.y * way.x + h.z * way.y);
        if (!(holdsU && holdsV) && curve > 0.0) step = -(dot(g, way) / curve) * way;
    } else {
        float area = h.x * h.z - h.y * h.y;
        if (area > 0.0) step = vec2(h.y * g.y - h.z * g.x, h.y * g.x - h.x * g.y) / area;
    }
    float longest = max(abs(step.x), abs(step.y));
    if (!(longest < 1e30)) return vec2(0.0);
    return longest > kLongestNearStep ? step * (kLongestNearStep / longest) : step;
}

struct Near {
    float square; // of the distance
    vec2 at;
};

// From a point on. `c`: less the place. A round that leads farther away is tried again with a part of its step.
Near approached(uint kind, vec3 c[kPieceCoefficients], vec2 at) {
    Near best = Near(3e38, at);
    vec2 step = vec2(0.0);
    for (uint round = 0u; round <= kNearRounds; ++round) {
        Bend bend = bendAt(kind, c, at);
        float square = dot(bend.position, bend.position);
        if (square < best.square) {
            best = Near(square, at);
            step = stepTo(kind, bend, at);
        } else {
            step *= 0.25;
        }
        at = held(kind, best.at + step);
        if (all(lessThan(abs(at - best.at), vec2(kShortestStep)))) break;
    }
    return best;
}

// It begins at the nearest sample of each quarter: a bent piece may come near twice. `c`: less the place.
Near nearestOf(uint kind, vec3 c[kPieceCoefficients]) {
    Near best = Near(3e38, vec2(0.0));
    for (uint quarter = 0u; quarter < 4u; ++quarter) {
        vec2 from = vec2(0.0);
        float least = 3e38;
        for (uint k = 0u; k < 9u; ++k) {
            uvec2 cell = 3u * uvec2(quarter & 1u, quarter >> 1u) + uvec2(k % 3u, k / 3u);
            if (cell.x > kCells || cell.y > kCells || (kind == kTrianglePiece && cell.x + cell.y > kCells)) continue;
            vec2 at = vec2(cell) / float(kCells);
            vec3 p = jetAt(kind, c, at).position;
            float square = dot(p, p);
            if (square < least) {
                least = square;
                from = at;
            }
        }
        if (!(least < 3e38)) continue;
        Near found = approached(kind, c, from);
        if (found.square < best.square) best = found;
    }
    return best;
}

// The coefficients of a piece, less the place.
void loadFrom(const Piece own, vec3 place, out vec3 c[kPieceCoefficients]) {
    loadCoefficients(own, c);
    for (uint i = 0u; i < kPieceCoefficients; ++i) c[i] += own.first - place;
}
