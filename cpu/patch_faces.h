// Which face of a scheme's mesh a patch is made of: the cage's face and vertices name both.
#pragma once

#include "base/result.h"
#include "cage/character.h"

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace supple::cpu {

/// A face of the mesh that a scheme makes patches of, and the corner of it that is corner 0 of the patch.
struct PatchFace {
    uint32_t face = 0, firstCorner = 0;
};

/// Finds the face of every patch.
class FaceFinder {
public:
    /// `corners` of a face: vertices of the cage, or cage::kNone for points that the scheme added.
    void add(uint32_t sourceFace, std::vector<uint32_t> corners) {
        if (sourceFace >= bySource_.size()) {
            bySource_.resize(sourceFace + 1);
        }
        bySource_[sourceFace].push_back(static_cast<uint32_t>(faces_.size()));
        faces_.push_back(std::move(corners));
    }
    /// All faces of a mesh whose first vertices are the cage's.
    void addAll(const cage::Cage& mesh, std::span<const uint32_t> sourceFaces, uint32_t cageVertices) {
        for (uint32_t f = 0; f < mesh.faceCount(); ++f) {
            std::vector<uint32_t> corners;
            for (uint32_t c = mesh.faceStarts[f]; c < mesh.faceStarts[f + 1]; ++c) {
                corners.push_back(mesh.faceVertices[c] < cageVertices ? mesh.faceVertices[c] : cage::kNone);
            }
            add(sourceFaces.empty() ? f : sourceFaces[f], std::move(corners));
        }
    }
    /// `Patch`: has face, cornerCount and corners.
    template <class Patch>
    [[nodiscard]] Result<std::vector<PatchFace>> find(std::span<const Patch> patches) const {
        std::vector<PatchFace> found;
        for (const Patch& patch : patches) {
            const size_t before = found.size();
            for (uint32_t turn = 0; turn < patch.cornerCount && found.size() == before; ++turn) {
                for (const uint32_t face : candidates(patch.face)) {
                    if (found.size() == before && agrees(faces_[face], patch, turn)) {
                        found.push_back({face, turn});
                    }
                }
            }
            if (found.size() == before) {
                return Error{ErrorCode::argument, "face " + std::to_string(patch.face) + ": the patch is not found"};
            }
        }
        return found;
    }

private:
    [[nodiscard]] std::span<const uint32_t> candidates(uint32_t sourceFace) const {
        return sourceFace < bySource_.size() ? std::span<const uint32_t>(bySource_[sourceFace])
                                             : std::span<const uint32_t>();
    }
    template <class Patch>
    static bool agrees(const std::vector<uint32_t>& corners, const Patch& patch, uint32_t turn) {
        bool same = corners.size() == patch.cornerCount;
        for (uint32_t i = 0; same && i < patch.cornerCount; ++i) {
            same = corners[(i + turn) % patch.cornerCount] == patch.corners[i];
        }
        return same;
    }
    std::vector<std::vector<uint32_t>> faces_;
    std::vector<std::vector<uint32_t>> bySource_;
};

} // namespace supple::cpu
