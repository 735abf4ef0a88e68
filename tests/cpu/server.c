/* A dedicated server's program: C, the library and nothing of Vulkan. */
#include <supple/supple_cpu.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static void tell(SuppleSeverity severity, SuppleMessage message, const char* text, void* user) {
    (void)severity, (void)message, (void)user;
    fprintf(stderr, "%s\n", text);
}

/* The corners of a cube, and its faces seen from outside. */
static const float kCorners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                     {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
static const uint32_t kSides[6] = {4, 4, 4, 4, 4, 4};
static const uint32_t kFaces[24] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 2, 3, 7, 6, 1, 2, 6, 5, 0, 4, 7, 3};

static SupplePrepared prepareCube(void) {
    SuppleCageDesc cage = {sizeof(cage)};
    cage.vertexCount = 8;
    cage.faceCount = 6;
    cage.positions = &kCorners[0][0];
    cage.faceVertexCounts = kSides;
    cage.faceVertexIndices = kFaces;
    SuppleAssetDesc asset = {sizeof(asset)};
    asset.name = "cube";
    asset.cage = &cage;
    SupplePrepareDesc desc = {sizeof(desc)};
    desc.asset = &asset;
    desc.log = tell;
    SupplePrepared prepared = NULL;
    supplePrepare(&desc, &prepared);
    return prepared;
}

/* Whether a Vulkan loader or driver is in the process, where the system tells. */
static int hasVulkan(void) {
    FILE* const maps = fopen("/proc/self/maps", "r");
    char line[1024];
    int found = 0;
    while (maps != NULL && fgets(line, sizeof(line), maps) != NULL) {
        if (strstr(line, "libvulkan") != NULL) {
            fprintf(stderr, "%s", line);
            found = 1;
        }
    }
    if (maps != NULL) {
        fclose(maps);
    }
    return found;
}

int main(void) {
    SupplePrepared prepared = prepareCube();
    SuppleGroupDesc group = {sizeof(group)};
    group.scheme = SUPPLE_SCHEME_CATMULL_CLARK;
    SuppleCpuGroupDesc desc = {sizeof(desc)};
    desc.prepared = prepared;
    desc.group = &group;
    desc.log = tell;
    SuppleCpuGroup surfaces = NULL;
    SuppleCpuPose pose = NULL;
    SuppleSurfaceJet jet;
    const SuppleSurfacePoint top = {1, 0, 0.5f, 0.5f};
    int ok = suppleCpuCreateGroup(&desc, &surfaces) == SUPPLE_OK && suppleCpuCreatePose(surfaces, &pose) == SUPPLE_OK &&
             suppleCpuBuildPose(pose, &kCorners[0][0], sizeof(kCorners[0]), 8, NULL) == SUPPLE_OK &&
             suppleCpuEvaluatePoints(pose, &top, 1, &jet, NULL) == SUPPLE_OK;
    /* The middle of a face lies on its axis, between the middle of the cube and the cage. */
    ok = ok && fabsf(jet.position[0]) < 1e-6f && fabsf(jet.position[1]) < 1e-6f && jet.position[2] > 0.5f &&
         jet.position[2] < 1.0f;
    suppleCpuDestroyPose(pose);
    suppleCpuDestroyGroup(surfaces);
    suppleDestroyPrepared(prepared);
    return ok && !hasVulkan() ? 0 : 1;
}
