// Compares Supple with what Blender evaluated: supple_blender_limit CASES.json, which limit_poses.py or uv_modes.py
// wrote.
#include "tools/common/character_file.h"
#include "tools/supple/evaluation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nanoflann.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace supple::tools {
namespace {

using Json = nlohmann::json;

/// As parts of the extent of what Blender shows, with the origin, from which floats are counted. A case may have its
/// own limit.
constexpr double kLargestDistance = 2e-6;
constexpr double kLargestUvDistance = 1e-6;
/// Samples so near to a point of Blender's, as a part of the extent, are samples of the same place.
constexpr double kSamePlace = 1e-5;

struct Points {
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec2> uvs; ///< one per position, or none

    // What nanoflann asks of a set of points.
    [[nodiscard]] size_t kdtree_get_point_count() const { return positions.size(); }
    [[nodiscard]] double kdtree_get_pt(size_t index, size_t axis) const {
        return positions[index][static_cast<glm::length_t>(axis)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box& /*box*/) const {
        return false;
    }
};
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points>, Points, 3, size_t>;

struct Distances {
    double positions = 0.0; ///< of the extent
    double uvs = 0.0;
};

double extentOf(const Points& points) {
    glm::dvec3 low(0.0), high(0.0);
    for (const glm::dvec3& p : points.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

/// Floats: three a point, or five with texture coordinates.
Points readPoints(const std::string& path, size_t width) {
    std::ifstream stream(path, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
    std::vector<float> values(bytes.size() / sizeof(float));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
    Points points;
    for (size_t i = 0; i + width <= values.size(); i += width) {
        points.positions.emplace_back(values[i], values[i + 1], values[i + 2]);
        if (width == 5) {
            points.uvs.emplace_back(values[i + 3], values[i + 4]);
        }
    }
    return points;
}

Points pointsOf(const Evaluation& evaluation, bool uvs) {
    Points points;
    for (const EvaluatedSurface& surface : evaluation.surfaces) {
        const SuppleVertexStreams& streams = surface.output.streams;
        for (const SuppleDrawRange& range :
             std::span(surface.output.grid.drawRanges, surface.output.grid.drawRangeCount)) {
            const size_t end = range.firstVertex + size_t{range.patchCount} * range.samplesPerPatch;
            for (size_t v = range.firstVertex; v < end; ++v) {
                points.positions.emplace_back(element<glm::vec3>(surface.vertices, streams.vertices, v));
                if (uvs) {
                    points.uvs.emplace_back(element<glm::vec2>(surface.attributes, streams.attributes, v));
                }
            }
        }
    }
    return points;
}

/// From every point of `from` to the nearest of `to`.
double largestDistance(const Points& from, const Points& to) {
    const Tree tree(3, to, nanoflann::KDTreeSingleIndexAdaptorParams(16));
    double largest = 0.0;
    for (const glm::dvec3& point : from.positions) {
        size_t index = 0;
        double squared = 0.0;
        tree.knnSearch(&point.x, 1, &index, &squared);
        largest = std::max(largest, squared);
    }
    return std::sqrt(largest);
}

/// Every corner of Blender's must have a sample in its place with its texture coordinates.
double largestUvDistance(const Points& blender, const Points& supple, double radius) {
    const Tree tree(3, supple, nanoflann::KDTreeSingleIndexAdaptorParams(16));
    double largest = 0.0;
    std::vector<std::pair<size_t, double>> found;
    for (size_t i = 0; i < blender.positions.size(); ++i) {
        tree.radiusSearch(&blender.positions[i].x, radius * radius, found, nanoflann::SearchParams());
        double nearest = 1e30;
        for (const auto& [index, squared] : found) {
            nearest = std::min(nearest, glm::distance(blender.uvs[i], supple.uvs[index]));
        }
        largest = std::max(largest, nearest);
    }
    return largest;
}

Result<Distances> compare(Session& session, SuppleAsset asset, const cage::Character& character, const Json& item,
                          const Json& pose) {
    const bool uvs = pose.contains("corners");
    SurfaceFlags flags;
    flags.scheme = "catmull-clark";
    flags.rate = item["rate"].get<uint32_t>();
    const Result<uint32_t> clip = host::findClip(character, pose.value("clip", ""));
    if (!clip) {
        return clip.error();
    }
    const Result<Evaluation> evaluation = evaluate(
        session, asset, character, flags, {*clip, pose.value("time", 0.0), {}}, uvs ? SUPPLE_GROUP_ATTRIBUTES : 0);
    if (!evaluation) {
        return evaluation.error();
    }
    const Points supple = pointsOf(*evaluation, uvs);
    const Points blender = uvs ? readPoints(pose["corners"], 5) : readPoints(pose["points"], 3);
    const double extent = extentOf(blender);
    Distances distances;
    distances.positions = std::max(largestDistance(blender, supple), largestDistance(supple, blender)) / extent;
    distances.uvs = uvs ? largestUvDistance(blender, supple, kSamePlace * extent) : 0.0;
    return distances;
}

/// False: a distance is too large.
Result<bool> compareCase(Session& session, const Json& item) {
    const std::string path = item["file"];
    const Result<host::CharacterFile> file = host::readCharacterFile(path, {.partsApart = true});
    if (!file) {
        return file.error();
    }
    const Result<SuppleAsset> asset = host::createAsset(*session.context, *file);
    if (!asset) {
        return asset.error();
    }
    Distances worst;
    for (const Json& pose : item["poses"]) {
        const Result<Distances> distances = compare(session, *asset, file->character, item, pose);
        if (!distances) {
            return distances.error();
        }
        worst.positions = std::max(worst.positions, distances->positions);
        worst.uvs = std::max(worst.uvs, distances->uvs);
    }
    const bool good = !item["poses"].empty() && worst.positions <= item.value("limit", kLargestDistance) &&
                      worst.uvs <= kLargestUvDistance;
    const bool uvs = std::any_of(item["poses"].begin(), item["poses"].end(),
                                 [](const Json& pose) { return pose.contains("corners"); });
    char uvText[64] = "";
    if (uvs) {
        std::snprintf(uvText, sizeof uvText, ", texture coordinates %.1e", worst.uvs);
    }
    std::printf("%-34s %2zu poses, largest distance %.1e of the extent%s%s\n", item["name"].get<std::string>().c_str(),
                item["poses"].size(), worst.positions, uvText, good ? "" : "  TOO FAR");
    return good;
}

int run(const std::string& path) {
    std::ifstream stream(path);
    const Json cases = Json::parse(stream, nullptr, false);
    if (!cases.is_array() || cases.empty()) {
        std::printf("%s: no cases\n", path.c_str());
        return 1;
    }
    const char* validation = std::getenv("SUPPLE_VALIDATION");
    DeviceFlags flags;
    flags.validate = validation != nullptr && std::string(validation) != "0";
    bool good = true;
    const int exitCode = withSession(flags, [&](Session& session) -> Status {
        for (const Json& item : cases) {
            const Result<bool> compared = compareCase(session, item);
            if (!compared) {
                return compared.error();
            }
            good = good && *compared;
        }
        return success();
    });
    return exitCode != 0 ? exitCode : good ? 0 : 1;
}

} // namespace
} // namespace supple::tools

int main(int argc, char** argv) {
    if (argc != 2) {
        std::printf("usage: supple_blender_limit CASES.json\n");
        return 2;
    }
    return supple::tools::run(argv[1]);
}
