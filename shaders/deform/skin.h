// What a vertex of the cage becomes: morph targets, then skinning. Needs table(), pose(), `push`, and `bool kMorphs`,
// `uint kSkinning`, `bool kMush`: whether that may be delta mush. GLSL has these three from kinds.glsl; in C++ this is the
// inside of a class (skinning/deform_twin.cpp).
// Whatever feeds the position is `precise`: both mappings and the CPU must give the same cage, bit for bit.

vec3 placeOf(uint x, uint y, uint z) { return vec3(uintBitsToFloat(x), uintBitsToFloat(y), uintBitsToFloat(z)); }

// The affine matrix with these rows, applied to a point.
vec3 applied(vec4 a, vec4 b, vec4 c, vec3 p) {
    SUPPLE_PRECISE vec3 q = vec3((a.x * p.x + a.y * p.y) + (a.z * p.z + a.w), (b.x * p.x + b.y * p.y) + (b.z * p.z + b.w),
                          (c.x * p.x + c.y * p.y) + (c.z * p.z + c.w));
    return q;
}
// That whose rows begin at pose element `i`.
vec3 transformed(uint i, vec3 p) { return applied(pose(i), pose(i + 1u), pose(i + 2u), p); }

vec3 weighted(uint i, float weight, vec3 p) {
    SUPPLE_PRECISE vec3 q = transformed(i, p);
    SUPPLE_PRECISE vec3 r = q * weight;
    return r;
}

// The rest position with the displacements of elements [first, end); `weights`: first element of the instance's weights.
// Weights of zero leave the bits but for the sign of a zero, which no sum of skinning keeps.
vec3 morphed(vec3 rest, uint first, uint end, uint weights) {
    SUPPLE_PRECISE vec3 p = rest;
    for (uint element = first; element < end; ++element) {
        uvec4 displacement = table(element);
        vec4 four = pose(weights + displacement.x / 4u);
        vec2 two = (displacement.x & 2u) == 0u ? vec2(four) : vec2(four.z, four.w);
        float weight = (displacement.x & 1u) == 0u ? two.x : two.y;
        p = p + placeOf(displacement.y, displacement.z, displacement.w) * weight;
    }
    return p;
}

// sum_j weight_j * matrix_j * rest
vec3 blendedLinearly(vec3 rest, uint first, uint end, uint joints) {
    SUPPLE_PRECISE vec3 p = vec3(0.0f);
    // Tested at the top: in a do-while, Mesa 22.3f's lavapipe goes on adding for lanes that have finished.
    for (uint element = first; element < end; ++element) {
        uvec4 pair = table(element);
        SUPPLE_PRECISE vec3 a = weighted(joints + kLinearElements * pair.x, uintBitsToFloat(pair.y), rest);
        SUPPLE_PRECISE vec3 b = weighted(joints + kLinearElements * pair.z, uintBitsToFloat(pair.w), rest);
        p = p + (a + b);
    }
    return p;
}

// What a joint adds: its rotation, and what it moves the vertex by from the anchor, times its rotation.
struct Influence {
    vec4 rotation;
    vec4 moved;
};
Influence influence(uint joint, float weight, vec3 rest, vec3 anchor, vec4 hemisphere) {
    vec4 rotation = pose(joint + 3u);
    // q and -q are one rotation; the one on the heaviest joint's side goes the short way.
    SUPPLE_PRECISE vec4 aligned = rotation * hemisphere;
    SUPPLE_PRECISE float signedWeight = sum4(aligned) < 0.0f ? -weight : weight;
    SUPPLE_PRECISE vec3 d = transformed(joint, rest) - anchor;
    SUPPLE_PRECISE vec3 across = crossed(d, vec3(rotation));
    SUPPLE_PRECISE vec3 products = d * vec3(rotation);
    SUPPLE_PRECISE vec4 moved = vec4(d * rotation.w + across, -((products.x + products.y) + products.z));
    SUPPLE_PRECISE Influence result;
    result.rotation = rotation * signedWeight;
    result.moved = moved * signedWeight;
    return result;
}

// Dual quaternion linear blending (Kavan, Collins, Zara, O'Sullivan: Geometric Skinning with Approximate Dual Quaternion
// Blending, ACM TOG 27(4), 2008), whose result does not depend on where the origin of the rest space lies: here it lies at
// the vertex, so that joint j takes the origin to y_j = matrix_j * rest and the blend's translation is the result,
// vec(sum_j w_j y_j q_j conj(q)) / |q|^2 with q = sum_j w_j q_j. Scale and shear move y_j and leave the rotation q_j alone:
// the paper's scaling phase with the vertex as the fixed point of every joint's scaling, as in Blender (issues 32022, 43188,
// 100373); scaled about any other point, neighbors of different scale and rotation pull the vertices between them away.
// Points are taken from an anchor, the heaviest joint's y: one joint alone gives its matrix times the vertex.
vec3 blendedAsDualQuaternions(vec3 rest, uint first, uint end, uint joints) {
    uint heaviest = joints + kRotationElements * table(first).x;
    SUPPLE_PRECISE vec3 anchor = transformed(heaviest, rest);
    vec4 hemisphere = pose(heaviest + 3u);
    SUPPLE_PRECISE vec4 q = vec4(0.0f);
    SUPPLE_PRECISE vec4 moved = vec4(0.0f);
    for (uint element = first; element < end; ++element) {
        uvec4 pair = table(element);
        SUPPLE_PRECISE Influence a =
            influence(joints + kRotationElements * pair.x, uintBitsToFloat(pair.y), rest, anchor, hemisphere);
        SUPPLE_PRECISE Influence b =
            influence(joints + kRotationElements * pair.z, uintBitsToFloat(pair.w), rest, anchor, hemisphere);
        q = q + (a.rotation + b.rotation);
        moved = moved + (a.moved + b.moved);
    }
    SUPPLE_PRECISE vec3 across = crossed(vec3(q), vec3(moved));
    SUPPLE_PRECISE vec3 turned = (vec3(moved) * q.w - vec3(q) * moved.w) + across;
    SUPPLE_PRECISE vec4 squares = q * q;
    SUPPLE_PRECISE vec3 p = anchor + turned * wideRecip(sum4(squares));
    return p;
}

// A vector, turned by a quaternion (x, y, z, w) and `twice`: 2 over its squared length.
vec3 turned(vec4 q, float twice, vec3 v) {
    SUPPLE_PRECISE vec3 once = crossed(vec3(q), v);
    SUPPLE_PRECISE vec3 change = once * q.w + crossed(vec3(q), once);
    SUPPLE_PRECISE vec3 r = v + change * twice;
    return r;
}

// What a joint makes of a vertex that turns about a center: where it takes the center, its rotation, and what it makes of
// the way from the center to the vertex but for the rotation.
struct Turn {
    vec4 rotation;
    vec3 center;
    vec3 way;
};
Turn turn(uint joint, vec3 center, vec3 way) {
    vec4 a = pose(joint), b = pose(joint + 1u), c = pose(joint + 2u), rotation = pose(joint + 3u);
    SUPPLE_PRECISE vec3 posed = vec3(dot3(vec3(a), way), dot3(vec3(b), way), dot3(vec3(c), way));
    SUPPLE_PRECISE Turn result;
    result.rotation = rotation;
    result.center = applied(a, b, c, center);
    result.way = turned(vec4(-vec3(rotation), rotation.w), 2.0f, posed); // back
    return result;
}

// By what it differs from another joint's, which has most weight.
Turn apart(Turn own, Turn base, float weight) {
    SUPPLE_PRECISE vec4 aligned = own.rotation * base.rotation;
    SUPPLE_PRECISE float signedWeight = sum4(aligned) < 0.0f ? -weight : weight;
    SUPPLE_PRECISE Turn result;
    result.rotation = own.rotation * signedWeight;
    result.center = (own.center - base.center) * weight;
    result.way = (own.way - base.way) * weight;
    return result;
}

// What a joint makes of a direction, less what another joint makes of it, whose rows are given.
vec3 slid(uint joint, vec3 a, vec3 b, vec3 c, vec3 direction) {
    SUPPLE_PRECISE vec3 x = vec3(pose(joint)) - a;
    SUPPLE_PRECISE vec3 y = vec3(pose(joint + 1u)) - b;
    SUPPLE_PRECISE vec3 z = vec3(pose(joint + 2u)) - c;
    return vec3(dot3(x, direction), dot3(y, direction), dot3(z, direction));
}

// Centers of rotation (Le, Hodgins: Real-time Skeletal Skinning with Optimized Centers of Rotation, ACM TOG 35(4), 2016):
// the center is blended linearly, and the vertex turns about it by the blend of the joints' rotations. Where joints scale
// or mirror, what is left of their matrices without the rotations is blended linearly, and acts before the turn. All is
// seen from where the heaviest joint alone takes it: so the bind pose is the cage, to the bit.
//
// Light delta mush turns the vertex about its smoothed place in the same way, with smoothed weights w_j. Joints move that
// place as they move the vertices whose mean it is: where those of joint j lie off it, by offset_j in all, joint j slides it.
vec3 blendedAboutCenter(vec3 center, vec3 rest, uint first, uint end, uint joints) {
    uint heaviest = joints + kRotationElements * table(first).x;
    SUPPLE_PRECISE vec3 way = rest - center;
    SUPPLE_PRECISE Turn base = turn(heaviest, center, way);
    SUPPLE_PRECISE vec3 anchor = transformed(heaviest, rest);
    SUPPLE_PRECISE vec4 q = vec4(0.0f);
    SUPPLE_PRECISE vec3 moved = vec3(0.0f);
    SUPPLE_PRECISE vec3 stretched = vec3(0.0f);
    vec3 ha = vec3(pose(heaviest)), hb = vec3(pose(heaviest + 1u)), hc = vec3(pose(heaviest + 2u));
    uint step = kMush && kSkinning == kLightMushSkinning ? kLightMushElements : 1u;
    for (uint element = first; element < end; element += step) {
        uvec4 pair = table(element);
        SUPPLE_PRECISE Turn a =
            apart(turn(joints + kRotationElements * pair.x, center, way), base, uintBitsToFloat(pair.y));
        SUPPLE_PRECISE Turn b =
            apart(turn(joints + kRotationElements * pair.z, center, way), base, uintBitsToFloat(pair.w));
        q = q + (a.rotation + b.rotation);
        moved = moved + (a.center + b.center);
        if (kMush && kSkinning == kLightMushSkinning) {
            uvec4 one = table(element + 1u), two = table(element + 2u);
            SUPPLE_PRECISE vec3 c = slid(joints + kRotationElements * pair.x, ha, hb, hc, placeOf(one.x, one.y, one.z));
            SUPPLE_PRECISE vec3 d = slid(joints + kRotationElements * pair.z, ha, hb, hc, placeOf(two.x, two.y, two.z));
            moved = moved + (c + d);
        }
        stretched = stretched + (a.way + b.way);
    }
    SUPPLE_PRECISE vec4 squares = q * q;
    SUPPLE_PRECISE float twice = 2.0f * wideRecip(sum4(squares));
    SUPPLE_PRECISE vec3 change = turned(q, twice, base.way + stretched) - (anchor - base.center);
    SUPPLE_PRECISE vec3 p = anchor + (moved + change);
    return p;
}

// What joints make of the neighborhood of a vertex: how each turns its part of it, and where that part goes. Rows of 3 x 3
// matrices.
struct Neighborhood {
    vec3 turnedX;
    vec3 turnedY;
    vec3 turnedZ;
    vec3 movedX;
    vec3 movedY;
    vec3 movedZ;
    float stretch; // three times the factor by which joints scale it; below 0: they mirror it
};
Neighborhood emptyNeighborhood() {
    Neighborhood none;
    none.turnedX = none.turnedY = none.turnedZ = none.movedX = none.movedY = none.movedZ = vec3(0.0f);
    none.stretch = 0.0f;
    return none;
}
// `spread`: xx, xy, xz and yy, yz, zz of the part's moments about the smoothed place; `moved`: where the joint takes that
// place, seen from where the heaviest joint does.
Neighborhood withPart(Neighborhood sum, uint joint, float weight, vec3 offset, vec3 spread, vec3 spread2, vec3 moved) {
    vec4 q = pose(joint + 3u);
    SUPPLE_PRECISE vec3 twice = vec3(q) * 2.0f;
    SUPPLE_PRECISE vec3 squares = twice * vec3(q);
    SUPPLE_PRECISE vec3 others = twice * vec3(q.y, q.z, q.x);
    SUPPLE_PRECISE vec3 turns = twice * q.w;
    SUPPLE_PRECISE vec3 x = vec3(1.0f - (squares.y + squares.z), others.x - turns.z, others.z + turns.y);
    SUPPLE_PRECISE vec3 y = vec3(others.x + turns.z, 1.0f - (squares.x + squares.z), others.y - turns.x);
    SUPPLE_PRECISE vec3 z = vec3(others.z - turns.y, others.y + turns.x, 1.0f - (squares.x + squares.y));
    vec3 s = vec3(spread.y, spread2.x, spread2.y), t = vec3(spread.z, spread2.y, spread2.z);
    SUPPLE_PRECISE Neighborhood result;
    result.turnedX = sum.turnedX + vec3(dot3(x, spread), dot3(x, s), dot3(x, t));
    result.turnedY = sum.turnedY + vec3(dot3(y, spread), dot3(y, s), dot3(y, t));
    result.turnedZ = sum.turnedZ + vec3(dot3(z, spread), dot3(z, s), dot3(z, t));
    result.movedX = sum.movedX + offset * moved.x;
    result.movedY = sum.movedY + offset * moved.y;
    result.movedZ = sum.movedZ + offset * moved.z;
    SUPPLE_PRECISE float own =
        (dot3(x, vec3(pose(joint))) + dot3(y, vec3(pose(joint + 1u)))) + dot3(z, vec3(pose(joint + 2u)));
    result.stretch = sum.stretch + own * weight;
    return result;
}
// The rotation that fits it best, behind `base`. So where the neighborhood is thin and leaves the rotation about its length
// open, that of the heaviest joint is taken.
vec4 rotationOf(Neighborhood of, vec4 base) {
    SUPPLE_PRECISE float size = abs(of.stretch) * 0.33333334f;
    float side = of.stretch < 0.0f ? -1.0f : 1.0f;
    SUPPLE_PRECISE vec3 x = of.turnedX * size + of.movedX * side;
    SUPPLE_PRECISE vec3 y = of.turnedY * size + of.movedY * side;
    SUPPLE_PRECISE vec3 z = of.turnedZ * size + of.movedZ * side;
    vec4 back = vec4(-vec3(base), base.w);
    return fittedRotation(turned(back, 2.0f, vec3(x.x, y.x, z.x)), turned(back, 2.0f, vec3(x.y, y.y, z.y)),
                          turned(back, 2.0f, vec3(x.z, y.z, z.z)), false);
}

// Direct delta mush (Le, Lewis: Direct Delta Mush Skinning and Variants, ACM TOG 38(4), 2019), with moments about the smoothed
// place of the vertex, so that floats subtract nothing large: joints move that place as they move the vertices whose mean it
// is, and the vertex turns about it as its neighborhood does. Where joints scale or mirror, what is left of their matrices
// without the rotations acts before the turn, as with centers of rotation; and so the bind pose is the cage, to the bit.
vec3 blendedByMush(vec3 place, vec3 rest, uint first, uint end, uint joints) {
    uint heaviest = joints + kRotationElements * table(first).x;
    SUPPLE_PRECISE vec3 way = rest - place;
    SUPPLE_PRECISE Turn base = turn(heaviest, place, way);
    SUPPLE_PRECISE vec3 anchor = transformed(heaviest, rest);
    vec3 ha = vec3(pose(heaviest)), hb = vec3(pose(heaviest + 1u)), hc = vec3(pose(heaviest + 2u));
    SUPPLE_PRECISE vec3 moved = vec3(0.0f);
    SUPPLE_PRECISE vec3 stretched = vec3(0.0f);
    SUPPLE_PRECISE Neighborhood around = emptyNeighborhood();
    for (uint element = first; element < end; element += kMushElements) {
        uvec4 a = table(element), b = table(element + 1u), c = table(element + 2u);
        uint joint = joints + kRotationElements * a.x;
        float weight = uintBitsToFloat(a.y);
        vec3 offset = placeOf(a.z, a.w, b.x);
        SUPPLE_PRECISE Turn own = turn(joint, place, way);
        SUPPLE_PRECISE vec3 from = own.center - base.center;
        moved = moved + (from * weight + slid(joint, ha, hb, hc, offset));
        stretched = stretched + (own.way - base.way) * weight;
        around = withPart(around, joint, weight, offset, placeOf(b.y, b.z, b.w), placeOf(c.x, c.y, c.z), from);
    }
    SUPPLE_PRECISE vec3 shaped = turned(rotationOf(around, base.rotation), 2.0f, base.way + stretched);
    SUPPLE_PRECISE vec3 change = turned(base.rotation, 2.0f, shaped) - (anchor - base.center);
    SUPPLE_PRECISE vec3 p = anchor + (moved + change);
    return p;
}

// Whether the matrix whose rows begin at pose element `i` mirrors: -1 if it does, else 1. A matrix that flattens does not.
float sideOf(uint i) {
    vec3 a = vec3(pose(i)), b = vec3(pose(i + 1u)), c = vec3(pose(i + 2u));
    vec3 sizes = max(max(abs(a), abs(b)), abs(c));
    float scale = broughtDown(largestOf(sizes)); // of one scale, so that tiny figures have a determinant
    SUPPLE_PRECISE vec3 across = crossed(a * scale, b * scale);
    SUPPLE_PRECISE vec3 products = across * (c * scale);
    SUPPLE_PRECISE float determinant = (products.x + products.y) + products.z;
    return determinant < 0.0f ? -1.0f : 1.0f;
}

// A cage vertex, of the instance whose pose begins at element `joints`; w is its side: -1 if the joint that moves it most
// mirrors, with the instance's transform, else 1.
vec4 deformedVertex(uint index, uint joints) {
    uvec4 vertex = table(index);
    vec3 rest = placeOf(vertex.x, vertex.y, vertex.z);
    uint first = vertex.w, end = table(index + 1u).w;

    if (kMorphs) {
        uint influences = table(push.firstInfluences + index / 4u)[index & 3u];
        rest = morphed(rest, first, influences, joints + push.morphWeights);
        first = influences;
    }
    uint heaviest = table(first).x;
    SUPPLE_PRECISE vec3 p;
    float side;
    if (kSkinning == kLinearSkinning) {
        side = sideOf(joints + kLinearElements * heaviest);
        p = blendedLinearly(rest, first, end, joints);
    } else {
        side = sideOf(joints) * sideOf(joints + kRotationTransform + kRotationElements * heaviest);
        if (kSkinning == kDualQuaternionSkinning) {
            p = blendedAsDualQuaternions(rest, first, end, joints + kRotationTransform);
        } else {
            // Without a center the way is 0: what is left is linear.
            uvec4 center = table(push.firstCenter + index);
            vec3 place = center.w == 0u ? rest : placeOf(center.x, center.y, center.z);
            if (kMush && kSkinning == kMushSkinning) {
                p = blendedByMush(place, rest, first, end, joints + kRotationTransform);
            } else {
                p = blendedAboutCenter(place, rest, first, end, joints + kRotationTransform);
            }
        }
        p = transformed(joints, p);
    }
    return vec4(p, side);
}
