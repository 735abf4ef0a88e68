// What the CPU computes of files, in words: tools/compilers.sh compares those that several compilers make.
//   supple_cpu_words FILE...
// A line for each file and scheme: what a cooked file of it holds, and positions and normals of a grid and jets of
// points, each as a hash. A scheme that a file cannot have, or that has no evaluator for it, says so.
#include <supple/supple_cpu.h>
#include <supple/supple_prepare.h>

#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

constexpr uint32_t kRate = 4;

/// FNV-1a of bytes, which runs on.
class Hash {
public:
    template <class T>
    void add(const std::vector<T>& values) {
        const auto* const bytes = reinterpret_cast<const unsigned char*>(values.data());
        for (size_t i = 0; i < values.size() * sizeof(T); ++i) {
            state_ = (state_ ^ bytes[i]) * 0x100000001b3u;
        }
    }
    [[nodiscard]] uint64_t value() const { return state_; }

private:
    uint64_t state_ = 0xcbf29ce484222325u;
};

struct Evaluated {
    Hash grids, jets;
    uint32_t vertexCount = 0;
};

/// Every vertex is moved by a number that floats hold exactly, and three sums of products round.
std::vector<float> moved(uint32_t vertexCount) {
    std::vector<float> cage;
    for (uint32_t v = 0; v < vertexCount; ++v) {
        cage.push_back(static_cast<float>(v % 17) + 0.125f);
        cage.push_back(static_cast<float>(v % 5) * 0.375f);
        cage.push_back(static_cast<float>(v % 11) - 3.0f);
    }
    return cage;
}

bool evaluateJets(SuppleCpuPose pose, uint32_t surface, SuppleCpuGroup group, Hash& hash) {
    uint32_t count = 0;
    if (suppleCpuGetPatches(group, surface, nullptr, &count) != SUPPLE_OK && count == 0) {
        return false;
    }
    std::vector<SupplePatchInfo> patches(count);
    if (suppleCpuGetPatches(group, surface, patches.data(), &count) != SUPPLE_OK) {
        return false;
    }
    std::vector<SuppleSurfacePoint> points;
    for (const SupplePatchInfo& patch : patches) {
        points.push_back({patch.face, 0, 0.3f, 0.1f});
    }
    std::vector<SuppleSurfaceJet> jets(points.size());
    if (suppleCpuEvaluatePoints(pose, points.data(), count, jets.data(), nullptr) != SUPPLE_OK) {
        return false;
    }
    hash.add(jets);
    return true;
}

bool evaluate(SuppleCpuGroup group, SuppleCpuPose pose, Evaluated& out) {
    SuppleCpuGroupInfo info{};
    info.structSize = sizeof(info);
    if (suppleCpuGetGroupInfo(group, &info) != SUPPLE_OK) {
        return false;
    }
    const std::vector<float> cage = moved(info.cageVertexCount);
    if (suppleCpuBuildPose(pose, cage.data(), 3 * sizeof(float), info.cageVertexCount, nullptr) != SUPPLE_OK) {
        return false;
    }
    for (uint32_t surface = 0; surface < info.surfaceCount; ++surface) {
        SuppleCpuGridInfo grid{};
        grid.structSize = sizeof(grid);
        if (suppleCpuGetGridInfo(group, surface, kRate, &grid) != SUPPLE_OK) {
            return false;
        }
        std::vector<float> positions(size_t{3} * grid.vertexCount), normals(positions.size());
        if (suppleCpuEvaluateGrid(pose, surface, kRate, positions.data(), normals.data(), grid.vertexCount, nullptr) !=
                SUPPLE_OK ||
            !evaluateJets(pose, surface, group, out.jets)) {
            return false;
        }
        out.grids.add(positions);
        out.grids.add(normals);
        out.vertexCount += grid.vertexCount;
    }
    return true;
}

/// Prints "no surface" in place of hashes where there is no evaluator.
bool printSurface(SupplePrepared prepared, const SuppleGroupDesc& planned) {
    SuppleCpuGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.prepared = prepared;
    desc.group = &planned;
    SuppleCpuGroup group = nullptr;
    SuppleCpuPose pose = nullptr;
    if (suppleCpuCreateGroup(&desc, &group) != SUPPLE_OK) {
        std::printf("no surface\n");
        return true;
    }
    Evaluated evaluated;
    const bool ok = suppleCpuCreatePose(group, &pose) == SUPPLE_OK && evaluate(group, pose, evaluated);
    std::printf("%" PRIu32 " vertices %016" PRIx64 ", jets %016" PRIx64 "\n", evaluated.vertexCount,
                evaluated.grids.value(), evaluated.jets.value());
    suppleCpuDestroyPose(pose);
    suppleCpuDestroyGroup(group);
    return ok;
}

bool printScheme(const std::string& name, const std::vector<char>& bytes, SuppleScheme scheme) {
    SuppleGroupDesc group{};
    group.structSize = sizeof(group);
    group.scheme = scheme;
    group.rate = kRate;
    SuppleAssetDesc asset{};
    asset.structSize = sizeof(asset);
    asset.name = name.c_str();
    asset.bytes = bytes.data();
    asset.byteCount = bytes.size();
    const SupplePlannedGroup planned{&group, 0, 0};
    SupplePrepareDesc desc{};
    desc.structSize = sizeof(desc);
    desc.asset = &asset;
    desc.groups = &planned;
    desc.groupCount = 1;
    std::printf("%s %d: ", name.c_str(), static_cast<int>(scheme));
    SupplePrepared prepared = nullptr;
    if (supplePrepare(&desc, &prepared) != SUPPLE_OK) {
        std::printf("refused\n");
        return true;
    }
    size_t size = 0;
    bool ok = suppleSavePrepared(prepared, nullptr, nullptr, &size) == SUPPLE_OK;
    std::vector<char> cooked(size);
    ok = ok && suppleSavePrepared(prepared, nullptr, cooked.data(), &size) == SUPPLE_OK;
    Hash hash;
    hash.add(cooked);
    std::printf("cooked %zu bytes %016" PRIx64 ", ", size, hash.value());
    ok = printSurface(prepared, group) && ok;
    suppleDestroyPrepared(prepared);
    return ok;
}

} // namespace

int main(int argc, char** argv) {
    bool ok = argc > 1;
    for (int i = 1; i < argc; ++i) {
        std::ifstream file(argv[i], std::ios::binary);
        const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        const std::string path = argv[i];
        for (int scheme = SUPPLE_SCHEME_PREP; scheme <= SUPPLE_SCHEME_FRAGMENTS; ++scheme) {
            ok = !bytes.empty() &&
                 printScheme(path.substr(path.find_last_of('/') + 1), bytes, static_cast<SuppleScheme>(scheme)) && ok;
        }
    }
    return ok ? 0 : 1;
}
