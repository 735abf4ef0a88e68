// Limit samples of fragments. Needs fragment.glsl and surface_vertex.glsl.
// Of a sample's two limit row elements; gives the surface vertex it belongs to, kNoPatch where nothing is drawn.
uint limitSample(uvec4 around, uvec4 place, uint header, uint fragments, uint fragment, uint step, out vec3 position,
                 out vec3 normal) {
    uvec4 head = tableElement(header), lists = tableElement(header + 1u);
    uint sector = place.z & ~kRightSide;
    uint patchIndex = tableWord(lists.x + sector * fragments + fragment);
    float sharpness = 0.0;
    if (place.y != 0u && (head.y & kSharpClass) != 0u)
        sharpness = spokeSharpness(head.w, place.y - 1u, fragments, fragment, step);
    limitPoint(place.x, unpackSources(around), sharpness, (place.z & kRightSide) != 0u, position, normal);
    bool centre = place.x == 0u && lists.y != 0u; // facets have none
    for (uint once = centre ? 1u : 0u; once != 0u; --once)
        centreLimit(tableWord(lists.y + sector * fragments + fragment), position, normal);
    normal = unitNormal(normal);
    return patchIndex == kNoPatch ? kNoPatch : patchIndex * push.samples + place.w;
}
