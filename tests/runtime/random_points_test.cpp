// Rays, places and points by chance over whole files: answers are points of the surface, frames are orthonormal, and
// hostile numbers are refused. SUPPLE_POINT_TRIALS asks for more of each than a test has time for, and
// SUPPLE_POINT_ASSETS for other files than the samples: a folder, with those below it.
#include "tests/support/crowd.h"
#include "tests/support/worst.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>
#include <random>
#include <supple/supple.hpp>

namespace supple::test {
namespace {

uint32_t trials() {
    const char* const asked = std::getenv("SUPPLE_POINT_TRIALS");
    return asked != nullptr ? static_cast<uint32_t>(std::strtoul(asked, nullptr, 10)) : 300u;
}

/// Null: the samples, without those that differ in what moves alone.
const char* folderAsked() {
    return std::getenv("SUPPLE_POINT_ASSETS");
}

std::vector<std::filesystem::path> filesToTry() {
    const char* const asked = folderAsked();
    std::vector<std::filesystem::path> files;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(asked != nullptr ? asked : SUPPLE_SAMPLE_ASSETS)) {
        const std::string ending = entry.path().extension().string();
        const bool isVariant = asked == nullptr && entry.path().stem().string().ends_with("_moving");
        if (!isVariant && (ending == ".glb" || ending == ".gltf" || ending == ".obj")) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// An asset of a file; no handle if it is refused.
SuppleAsset assetOf(CrowdContext& context, const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    const std::string name = path.filename().string(), folder = path.parent_path().string();
    SuppleAssetDesc desc{};
    desc.structSize = sizeof(desc);
    desc.name = name.c_str();
    desc.bytes = bytes.data();
    desc.byteCount = bytes.size();
    desc.baseDirectory = folder.c_str();
    SuppleAsset asset{};
    (void)suppleCreateAsset(context.handle(), &desc, &asset);
    return asset;
}

glm::dvec3 asVector(const float* v) {
    return {v[0], v[1], v[2]};
}

/// One character in a pose, with chance.
class Trial {
public:
    Trial(Crowd& crowd, SuppleAsset asset) : crowd_(crowd) {
        SuppleAssetInfo info{};
        info.structSize = sizeof(info);
        EXPECT_EQ(suppleGetAssetInfo(crowd.context().handle(), asset, &info), SUPPLE_OK);
        const SuppleInstance instance = crowd.spawn();
        if (crowd.clipCount() > 0) {
            crowd.pose(instance, 0, 0.4, glm::rotate(glm::mat4(1.0f), 0.7f, glm::vec3(0.3f, 1.0f, 0.2f)));
        }
        crowd.run();
        const std::vector<glm::vec4> all = as<glm::vec4>(crowd.slotBytes(crowd.output().info.deformedCage, 0));
        for (uint32_t v = 0; v < info.cageVertexCount; ++v) {
            cage_.emplace_back(all[v]);
            low_ = glm::min(low_, cage_.back());
            high_ = glm::max(high_, cage_.back());
        }
        faces_ = info.faceCount;
    }

    /// Rays from everywhere, some of them along axes or from far away; hits lie on them.
    void cast(uint32_t count) {
        std::vector<glm::vec3> rays;
        for (uint32_t k = 0; k < count; ++k) {
            glm::vec3 from = anywhere(3.0f), way = anywhere(1.0f) - from;
            if (k % 5 == 0) {
                from = cage_[random_() % cage_.size()];
                way = anywhere(1.0f) - middle();
            } else if (k % 5 == 1) {
                way = glm::vec3(0.0f);
                way[static_cast<int>(random_() % 3)] = k % 2 == 0 ? 1.0f : -1e-20f;
            } else if (k % 50 == 2) {
                from *= 1e5f;
                way = middle() - from;
            }
            rays.push_back(from);
            rays.push_back(way == glm::vec3(0.0f) ? glm::vec3(0.0f, 1.0f, 0.0f) : way);
        }
        const std::vector<SuppleSurfaceJet> jets = find(SUPPLE_FIND_RAY, count, &rays[0].x);
        for (uint32_t k = 0; k < count; ++k) {
            if (points_[k].face == SUPPLE_NO_FACE) {
                continue;
            }
            ++hits;
            const glm::dvec3 d = glm::normalize(glm::dvec3(rays[2 * k + 1])),
                             e = asVector(jets[k].position) - glm::dvec3(rays[2 * k]);
            EXPECT_GE(glm::dot(e, d), -1e-5 * extent() - 1e-6 * glm::length(e));
            raise(beside, glm::length(e - glm::dot(e, d) * d) / (extent() + 0.1 * glm::length(e)));
        }
        keepFound();
    }
    /// The nearest points; none of the samples is nearer. scatter() comes first.
    void nearest(uint32_t count) {
        std::vector<glm::vec3> places;
        for (uint32_t k = 0; k < count; ++k) {
            places.push_back(k % 10 == 0 ? 1e4f * anywhere(1.0f) : anywhere(2.0f));
        }
        const std::vector<SuppleSurfaceJet> jets = find(SUPPLE_FIND_NEAREST, count, &places[0].x);
        for (uint32_t k = 0; k < count; ++k) {
            ASSERT_NE(points_[k].face, SUPPLE_NO_FACE);
            double best = std::numeric_limits<double>::infinity();
            for (const glm::dvec3& sample : samples_) {
                best = std::min(best, glm::distance(sample, glm::dvec3(places[k])));
            }
            const double own = glm::distance(asVector(jets[k].position), glm::dvec3(places[k]));
            farther += own > best + 1e-3 * extent() + 1e-6 * best ? 1 : 0;
        }
        keepFound();
    }
    void scatter(uint32_t count) {
        for (const SuppleSurfaceJet& jet : find(SUPPLE_FIND_SCATTER, count, nullptr)) {
            if (samples_.size() < kSamples) {
                samples_.push_back(asVector(jet.position));
            }
        }
        for (uint32_t k = 0; k < count; k += 3) { // on borders and corners too
            points_[k].a = std::round(points_[k].a);
            points_[k].b = 0.0f;
        }
        keepFound();
    }
    /// The device's frames of all that was found.
    void checkFrames() {
        SupplePointSetDesc desc = describe(kept_);
        SupplePointSet set{};
        ASSERT_EQ(suppleCreatePointSet(crowd_.context().handle(), &desc, &set), SUPPLE_OK);
        crowd_.run();
        SupplePointOutput output{};
        output.structSize = sizeof(output);
        ASSERT_EQ(suppleGetPointOutput(crowd_.context().handle(), set, &output), SUPPLE_OK);
        const std::vector<glm::vec4> rows = as<glm::vec4>(crowd_.read(output.frames));
        ASSERT_EQ(rows.size(), 3 * kept_.size());
        for (size_t k = 0; k < rows.size(); k += 3) {
            glm::dmat3 frame;
            for (int c = 0; c < 3; ++c) {
                frame[c] = {rows[k][c], rows[k + 1][c], rows[k + 2][c]};
            }
            const glm::dmat3 product = glm::transpose(frame) * frame - glm::dmat3(1.0);
            raise(skew, std::max({glm::length(product[0]), glm::length(product[1]), glm::length(product[2])}));
            raise(off,
                  glm::length(glm::dvec3(rows[k].w, rows[k + 1].w, rows[k + 2].w) - glm::dvec3(middle())) / extent());
        }
        EXPECT_EQ(suppleDestroyPointSet(crowd_.context().handle(), set), SUPPLE_OK);
    }
    /// Whatever stands in one number of a point, it is refused, or the point exists.
    void checkHostile(uint32_t count) {
        uint32_t refused = 0;
        for (uint32_t k = 0; k < count; ++k) {
            SuppleSurfacePoint bad = kept_[random_() % kept_.size()];
            switch (k % 4) {
            case 0:
                bad.face = faces_ + (k % 8 == 0 ? 0 : static_cast<uint32_t>(random_()) % ~faces_);
                break;
            case 1:
                bad.side = 5 + static_cast<uint32_t>(random_() >> 1);
                break;
            case 2:
                (k % 8 == 2 ? bad.a : bad.b) = std::numeric_limits<float>::quiet_NaN();
                break;
            default:
                (k % 8 == 3 ? bad.a : bad.b) = k % 16 < 8 ? -1e-3f : 1e30f;
                break;
            }
            SuppleSurfacePoint points[] = {kept_[0], bad};
            SupplePointSetDesc desc = describe(points);
            SupplePointSet set{};
            refused += suppleCreatePointSet(crowd_.context().handle(), &desc, &set) == SUPPLE_ERROR_ARGUMENT ? 1 : 0;
            EXPECT_EQ(set.id, 0u);
        }
        EXPECT_EQ(refused, count);
    }

    uint32_t hits = 0, farther = 0;
    double beside = 0.0, skew = 0.0, off = 0.0;

private:
    static constexpr size_t kSamples = 256;

    [[nodiscard]] glm::vec3 middle() const { return 0.5f * (low_ + high_); }
    [[nodiscard]] double extent() const { return glm::distance(glm::dvec3(low_), glm::dvec3(high_)); }
    [[nodiscard]] glm::vec3 anywhere(float boxes) {
        const auto number = [&] { return static_cast<float>(random_() % 65536) / 32768.0f - 1.0f; };
        const float size = boxes * static_cast<float>(extent()) / 2.0f;
        return middle() + size * glm::vec3(number(), number(), number());
    }
    [[nodiscard]] SupplePointSetDesc describe(std::span<const SuppleSurfacePoint> points) const {
        SupplePointSetDesc desc{};
        desc.structSize = sizeof(desc);
        desc.group = crowd_.group();
        desc.points = points.data();
        desc.pointCount = static_cast<uint32_t>(points.size());
        return desc;
    }
    /// Fills points_, and looks at each number.
    std::vector<SuppleSurfaceJet> find(SupplePointQueryKind kind, uint32_t count, const float* values) {
        points_.assign(count, {SUPPLE_NO_FACE, ~0u, -1.0f, -1.0f});
        std::vector<SuppleSurfaceJet> jets(count);
        SupplePointQuery query{};
        query.structSize = sizeof(query);
        query.kind = kind;
        query.count = count;
        query.values = values;
        query.cage = &cage_[0].x;
        query.cageVertexCount = static_cast<uint32_t>(cage_.size());
        query.jets = jets.data();
        EXPECT_EQ(suppleFindPoints(crowd_.context().handle(), crowd_.group(), &query, points_.data()), SUPPLE_OK);
        for (uint32_t k = 0; k < count; ++k) {
            const SuppleSurfacePoint& p = points_[k];
            EXPECT_TRUE(p.face < faces_ || p.face == SUPPLE_NO_FACE);
            EXPECT_TRUE(p.a >= 0.0f && p.a <= 1.0f && p.b >= 0.0f && p.b <= 1.0f);
            double sum = 0.0;
            for (const float* v : {jets[k].position, jets[k].du, jets[k].dv}) {
                sum += glm::length(asVector(v));
            }
            EXPECT_TRUE(std::isfinite(sum)) << "face " << p.face << " at " << p.a << ", " << p.b;
        }
        return jets;
    }
    void keepFound() {
        std::copy_if(points_.begin(), points_.end(), std::back_inserter(kept_),
                     [](const SuppleSurfacePoint& p) { return p.face != SUPPLE_NO_FACE; });
    }

    Crowd& crowd_;
    std::vector<glm::vec3> cage_;
    glm::vec3 low_{std::numeric_limits<float>::infinity()}, high_{-std::numeric_limits<float>::infinity()};
    uint32_t faces_ = 0;
    std::mt19937 random_{11};
    std::vector<SuppleSurfacePoint> points_, kept_;
    std::vector<glm::dvec3> samples_;
};

class RandomPoints : public CrowdContexts {};

TEST_F(RandomPoints, LieOnTheSurfacesOfFiles) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    // Places that may have a nearer point. None of those at samples had; shapes of a few large faces have some.
    const double mostFarther = folderAsked() != nullptr ? 0.01 * trials() : 1.0 + 0.002 * trials();
    uint32_t characters = 0;
    for (const std::filesystem::path& path : filesToTry()) {
        const SuppleAsset asset = assetOf(own, path);
        if (asset.id == 0) {
            std::printf("%s: refused\n", path.filename().c_str());
            EXPECT_NE(folderAsked(), nullptr) << path;
            (void)own.takeLines();
            continue;
        }
        for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_LOOP, SUPPLE_SCHEME_AUTO}) {
            if (scheme == SUPPLE_SCHEME_AUTO && folderAsked() == nullptr) {
                continue; // it takes one of the others
            }
            SuppleGroupDesc desc{};
            desc.asset = asset;
            desc.capacity = 1;
            desc.scheme = scheme;
            desc.rate = 2;
            Crowd crowd(own, desc);
            ASSERT_TRUE(crowd.valid()) << path;
            const auto begin = std::chrono::steady_clock::now();
            Trial trial(crowd, asset);
            trial.scatter(trials());
            trial.cast(trials());
            trial.nearest(trials());
            const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
            trial.checkFrames();
            trial.checkHostile(32);
            std::printf("%-40s scheme %u: %u of %u rays hit, %.1e beside; %u places have a nearer point; frames off by "
                        "%.1e; %.1f s\n",
                        path.filename().c_str(), scheme, trial.hits, trials(), trial.beside, trial.farther, trial.skew,
                        seconds.count());
            EXPECT_GT(trial.hits, trials() / 50) << path << ", scheme " << scheme;
            EXPECT_LE(trial.beside, 5e-6) << path << ", scheme " << scheme;
            EXPECT_LE(trial.farther, mostFarther) << path << ", scheme " << scheme;
            EXPECT_LE(trial.skew, 2e-6) << path << ", scheme " << scheme;
            EXPECT_LE(trial.off, 2.0) << path << ", scheme " << scheme;
            ++characters;
            (void)own.takeLines();
        }
        EXPECT_EQ(suppleDestroyAsset(own.handle(), asset), SUPPLE_OK);
    }
    EXPECT_GE(characters, folderAsked() != nullptr ? 1u : 8u);
}

} // namespace
} // namespace supple::test
