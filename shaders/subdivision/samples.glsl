// Limit samples of fragments, all kinds. Needs fragment.glsl.
// Of a sample's two limit row elements. The normal is not of unit length.
void limitSample(uvec4 around, uvec4 place, uint header, uint fragments, uint fragment, uint step, out vec3 position,
                 out vec3 normal) {
    uvec4 head = tableElement(header), lists = tableElement(header + 1u);
    uint sector = place.z & ~kRightSide;
    float sharpness = 0.0;
    if (place.y != 0u && (head.y & kSharpClass) != 0u)
        sharpness = spokeSharpness(head.w, place.y - 1u, fragments, fragment, step);
    limitPoint(point(place.x), pointsOf(unpackSources(around)), sharpness, (place.z & kRightSide) != 0u, position, normal);
    if (place.x == 0u && lists.y != 0u) // facets have no centre
        centreLimit(tableWord(lists.y + sector * fragments + fragment), position, normal);
}
