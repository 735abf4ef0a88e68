// What pose drivers add to morph weights: radial basis functions of how joints are turned, which pass through the artist's
// poses (docs/pose_drivers.md). Needs table(), tableFloats() and nodeRotation(place, number): GLSL has them from
// drivers.comp; in C++ this is the inside of a class (skinning/driver_twin.cpp). By additions, multiplications and bits alone.

// The twist of a unit rotation about a unit axis: rotation = swing * twist. Of half a turn across the axis, none.
vec4 twistAbout(vec4 q, vec3 axis) {
    SUPPLE_PRECISE float along = dot3(vec3(q), axis);
    SUPPLE_PRECISE float squares = q.w * q.w + along * along;
    SUPPLE_PRECISE float scale = rsqrt(max(squares, 1e-20f));
    SUPPLE_PRECISE vec3 turn = axis * (along * scale);
    SUPPLE_PRECISE vec4 twist = vec4(turn, q.w * scale);
    if (squares < 1e-12f) twist = noTurn();
    return twist;
}

// The square of the sine of half the angle between two rotations, by their difference: close ones keep their digits.
float squaredSine(vec4 a, vec4 b) {
    float side = dot4(a, b) < 0.0f ? -1.0f : 1.0f;
    SUPPLE_PRECISE vec4 apart = a - b * side;
    SUPPLE_PRECISE float e = dot4(apart, apart);
    SUPPLE_PRECISE float result = e * (1.0f - 0.25f * e);
    return result;
}

// What an input, by its element, looks at of its joint's rotation from the rest pose.
vec4 driverTurn(uint element) {
    uvec4 head = table(element);
    SUPPLE_PRECISE vec4 q = turned(tableFloats(element + 1u), unit(nodeRotation(head.x, head.y)));
    if (head.z != kTurnWhole) {
        vec4 twist = twistAbout(q, vec3(tableFloats(element + 2u)));
        q = head.z == kTurnTwist ? twist : turned(q, conjugated(twist));
    }
    return q;
}

// What a driver's share of four weights is.
vec4 drivenShare(uint share) {
    uvec4 head = table(share), tail = table(share + 3u);
    uint inputs = min(head.x, kMaxDriverInputs);
    vec4 turns[kMaxDriverInputs];
    float weights[kMaxDriverInputs];
    for (uint i = 0u; i < inputs; ++i) {
        uint element = head.y + kDriverInputElements * i;
        turns[i] = driverTurn(element);
        weights[i] = uintBitsToFloat(table(element).w);
    }
    float inverseSigma2 = uintBitsToFloat(tail.y);
    SUPPLE_PRECISE vec4 sum = vec4(0.0f);
    for (uint pose = 0u; pose < head.z; ++pose) {
        SUPPLE_PRECISE float squares = 0.0f;
        for (uint i = 0u; i < inputs; ++i) {
            squares = squares + weights[i] * squaredSine(turns[i], tableFloats(head.w + inputs * pose + i));
        }
        SUPPLE_PRECISE float root = recip(1.0f + squares * inverseSigma2);
        SUPPLE_PRECISE float kernel = root * root;
        sum = sum + tableFloats(tail.x + pose) * kernel;
    }
    return min(max(sum, tableFloats(share + 1u)), tableFloats(share + 2u));
}

// What all drivers together add to the weights of a quad.
vec4 drivenWeights(uvec4 quad) {
    SUPPLE_PRECISE vec4 sum = vec4(0.0f);
    for (uint share = quad.y; share < quad.z; share += kShareElements) sum = sum + drivenShare(share);
    return sum;
}
