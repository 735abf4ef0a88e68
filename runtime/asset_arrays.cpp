// A character out of a host's arrays.
#include "cage/limits.h"
#include "cage/message.h"
#include "cage/repair.h"
#include "cage/single_joint.h"
#include "cage/trim.h"
#include "runtime/asset.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace supple::runtime {

namespace {

using std::to_string;

/// Copies the arrays into a cage, and gathers what is wrong with them, one line for each kind of fault.
class ArrayReader {
public:
    ArrayReader(const SuppleCageDesc& desc, const std::string& name, cage::Cage& cage)
        : desc_(desc), name_(name), cage_(cage) {}

    Status read() {
        if (Status status = checkPointers(); !status) {
            return status;
        }
        readVertices();
        if (Status status = readFaces(); !status) {
            return status;
        }
        readCorners();
        readSharpness();
        readHoles();
        return faults_.empty() ? success() : Status(Error{ErrorCode::asset, faults_});
    }

private:
    [[nodiscard]] Status refuse(const std::string& reason) const {
        return Error{ErrorCode::asset, name_ + ": " + reason};
    }
    void note(const cage::Found& found, const char* one, const char* many) {
        if (found.count > 0) {
            faults_ += (faults_.empty() ? "" : "\n") + name_ + ": " + found.told(one, many);
        }
    }

    Status checkPointers() {
        if (desc_.positions == nullptr || (desc_.faceCount > 0 && desc_.faceVertexCounts == nullptr) ||
            (desc_.faceCount > 0 && desc_.faceVertexIndices == nullptr)) {
            return Error{ErrorCode::nullPointer, name_ + ": positions, faceVertexCounts or faceVertexIndices is null"};
        }
        if (desc_.vertexCount == 0 || desc_.faceCount == 0) {
            return refuse(desc_.vertexCount == 0 ? "empty: no vertices, so there is no surface"
                                                 : "nothing but points: no faces, so there is no surface");
        }
        const auto present = [](uint32_t count, auto... arrays) { return count == 0 || (... && (arrays != nullptr)); };
        if (!present(desc_.creaseCount, desc_.creaseVertices, desc_.creaseSharpnesses) ||
            !present(desc_.cornerCount, desc_.cornerVertices, desc_.cornerSharpnesses) ||
            !present(desc_.creaseScalarCount, desc_.creaseScalars) || !present(desc_.holeCount, desc_.holes)) {
            return Error{ErrorCode::nullPointer, name_ + ": a count without its array"};
        }
        return success();
    }

    void readVertices() {
        cage::Found found;
        for (uint32_t v = 0; v < desc_.vertexCount; ++v) {
            const float* p = desc_.positions + 3 * size_t{v};
            if (cage::faultOfCoordinates(p, 3) != nullptr) {
                found.add([&] { return "vertex " + to_string(v); });
            }
            cage_.positions.emplace_back(p[0], p[1], p[2]);
            cage_.sourceVertices.push_back(v);
        }
        note(found, "position is not finite or beyond 1e+09", "positions are not finite or beyond 1e+09");
    }

    Status readFaces() {
        cage_.faceStarts.push_back(0);
        uint64_t corners = 0;
        for (uint32_t f = 0; f < desc_.faceCount; ++f) {
            corners += desc_.faceVertexCounts[f];
            if (corners > 0x7FFFFFFFu) {
                return refuse("face " + to_string(f) + ": more than 2^31 corners");
            }
            cage_.faceStarts.push_back(static_cast<uint32_t>(corners));
        }
        cage_.faceVertices.assign(desc_.faceVertexIndices, desc_.faceVertexIndices + corners);
        cage::Found found;
        for (uint32_t f = 0; f < desc_.faceCount; ++f) {
            for (uint32_t c = cage_.faceStarts[f]; c < cage_.faceStarts[f + 1]; ++c) {
                if (cage_.faceVertices[c] >= desc_.vertexCount) {
                    found.add([&] {
                        return "vertex " + to_string(cage_.faceVertices[c]) + " of " + to_string(desc_.vertexCount) +
                               " in face " + to_string(f);
                    });
                }
            }
        }
        note(found, "corner names no vertex", "corners name no vertex");
        return success();
    }

    void readCorners() {
        const auto read = [&](const float* uvs, std::vector<glm::vec2>& corners) {
            for (size_t c = 0; uvs != nullptr && c < cage_.faceVertices.size(); ++c) {
                corners.emplace_back(uvs[2 * c], uvs[2 * c + 1]);
            }
        };
        read(desc_.cornerUvs, cage_.cornerUvs);
        read(desc_.cornerUvs1, cage_.cornerUvs1);
        cage::Found found;
        for (uint32_t f = 0; f < desc_.faceCount && desc_.faceTrimTiles != nullptr; ++f) {
            const uint32_t tile = desc_.faceTrimTiles[f];
            if (tile != SUPPLE_NO_TRIM_TILE && tile >= cage::kMaxTrimTiles) {
                found.add([&] {
                    return "tile " + to_string(tile) + " of " + to_string(cage::kMaxTrimTiles) + " at face " +
                           to_string(f);
                });
            }
            cage_.faceTrimTiles.push_back(tile);
        }
        note(found, "face has no such trim tile", "faces have no such trim tiles");
    }

    void readSharpness() {
        cage::Found creases;
        for (uint32_t i = 0; i < desc_.creaseCount; ++i) {
            const uint32_t a = desc_.creaseVertices[2 * size_t{i}], b = desc_.creaseVertices[2 * size_t{i} + 1];
            if (a >= desc_.vertexCount || b >= desc_.vertexCount || !(desc_.creaseSharpnesses[i] >= 0.0f)) {
                creases.add([&] { return "crease " + to_string(i); });
            }
            cage_.creases.push_back({a, b, desc_.creaseSharpnesses[i]});
        }
        note(creases, "crease has no such vertices, or no sharpness of 0 and more",
             "creases have no such vertices, or no sharpness of 0 and more");
        cage::Found corners;
        for (uint32_t i = 0; i < desc_.cornerCount; ++i) {
            if (desc_.cornerVertices[i] >= desc_.vertexCount || !(desc_.cornerSharpnesses[i] >= 0.0f)) {
                corners.add([&] { return "corner " + to_string(i); });
            }
            cage_.sharpVertices.push_back({desc_.cornerVertices[i], desc_.cornerSharpnesses[i]});
        }
        note(corners, "corner has no such vertex, or no sharpness of 0 and more",
             "corners have no such vertex, or no sharpness of 0 and more");
        cage::Found scalars;
        for (uint32_t i = 0; i < desc_.creaseScalarCount; ++i) {
            const SuppleCreaseScalar& scalar = desc_.creaseScalars[i];
            if (!(scalar.alpha > 0.0f && scalar.alpha <= 1.0f)) {
                scalars.add([&] { return "crease scalar " + to_string(i); });
            }
            cage_.creaseScalars.push_back({scalar.vertex, scalar.toward, scalar.alpha});
        }
        note(scalars, "crease scalar has an alpha that is not in (0, 1]",
             "crease scalars have an alpha that is not in (0, 1]");
    }

    void readHoles() {
        cage::Found found;
        for (uint32_t i = 0; i < desc_.holeCount; ++i) {
            if (desc_.holes[i] >= desc_.faceCount) {
                found.add([&] {
                    return "hole " + to_string(i) + ", face " + to_string(desc_.holes[i]) + " of " +
                           to_string(desc_.faceCount);
                });
            }
            cage_.holes.push_back(desc_.holes[i]);
        }
        note(found, "hole is no face", "holes are no faces");
        std::sort(cage_.holes.begin(), cage_.holes.end());
        cage_.holes.erase(std::unique(cage_.holes.begin(), cage_.holes.end()), cage_.holes.end());
    }

    const SuppleCageDesc& desc_;
    const std::string& name_;
    cage::Cage& cage_;
    std::string faults_; ///< lines
};

} // namespace

Result<cage::Character> characterFromArrays(const SuppleCageDesc& desc, const std::string& name, bool strict) {
    cage::Character character;
    const Status status = ArrayReader(desc, name, character.cage).read();
    if (!status) {
        return status.error();
    }
    character.name = name;
    if (const Status repaired = cage::repairCage(character.cage, character.weights, character.morphs,
                                                 cage::CageNames{{"cage"}, {}}, character.damages);
        !repaired) {
        return Error{repaired.error().code, name + ": " + repaired.error().message};
    }
    if (const Status sound = cage::reportDamages(character, strict); !sound) {
        return sound.error();
    }
    cage::bindToOneJoint(character, name);
    character.sourceVertexCount = desc.vertexCount;
    return character;
}

} // namespace supple::runtime
